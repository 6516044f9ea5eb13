#!/usr/bin/env python3
"""Builds sphere.obj, wren.obj, lawn.obj and cut_earth.obj (with their .mtl files) beside this script.

    python3 scenes/meshes/make_shapes.py

Standard library only; the same bytes on every run. Metres, y up. Sphere and wren, bodies for attractors, are each an
icosahedron whose faces are cut in four again and again, its corners pushed out from the middle to the body's surface.
"""
import math
import pathlib
import random

import masonry
from masonry import Model, spaced

masonry.COLOURS.update({"chalk": (224, 220, 212), "clay": (206, 184, 160), "grass": (104, 120, 74),
                               "topsoil": (84, 66, 50), "subsoil": (128, 100, 74), "clay_soil": (150, 118, 88)})


def ball(cuts):
    """Unit vectors and triangles, counterclockwise from outside."""
    g = (1 + math.sqrt(5)) / 2
    corners = [unit(p) for p in ((-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g),
                                 (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1))]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
             (8, 6, 7), (9, 8, 1)]
    for _ in range(cuts):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(corners)
                corners.append(unit(tuple(p + q for p, q in zip(corners[a], corners[b]))))
            return middles[key]
        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    return corners, faces


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def body(group, material, cuts, radius, middle=(0, 0, 0)):
    """`radius` of a direction: how far the surface is from the middle that way."""
    model = Model()
    corners, faces = ball(cuts)
    points = [tuple(m + radius(d) * c for m, c in zip(middle, d)) for d in corners]
    for face in faces:
        model.face(group, material, [points[i] for i in face])
    return model


def wren():
    """A plump bird that looks to +x: soft balls that run into each other, seen from within its breast."""
    # Middle, radius along x, y and z, turned about z by so many degrees.
    parts = [((0.0, 0.0, 0.0), (0.34, 0.29, 0.27), 18),    # the breast
             ((-0.18, -0.03, 0.0), (0.30, 0.20, 0.22), 20),  # the back
             ((0.23, 0.27, 0.0), (0.19, 0.18, 0.175), 0),  # the head
             ((0.43, 0.28, 0.0), (0.10, 0.035, 0.035), -8),  # the beak
             ((-0.52, 0.06, 0.0), (0.26, 0.05, 0.10), -34)]   # the tail, which wrens carry up
    soft = 14.0

    def inside(p):
        """Above 0 inside; far from there it falls evenly."""
        total = 0.0
        for at, radii, turn in parts:
            a = math.radians(turn)
            x, y, z = (c - m for c, m in zip(p, at))
            x, y = math.cos(a) * x + math.sin(a) * y, math.cos(a) * y - math.sin(a) * x
            reach = math.sqrt((x / radii[0]) ** 2 + (y / radii[1]) ** 2 + (z / radii[2]) ** 2)
            total += math.exp(soft * min(radii) ** 0.5 * (1 - reach))
        return math.log(total)

    def radius(d):
        high = 0.9
        while inside(tuple((high - 0.02) * c for c in d)) <= 0:  # from outside, for the farthest way out
            high -= 0.02
        low = high - 0.02
        for _ in range(12):
            mid = 0.5 * (low + high)
            low, high = (mid, high) if inside(tuple(mid * c for c in d)) > 0 else (low, mid)
        return low
    return body("wren", "clay", 4, radius)


def lawn():
    """A strip to stand on, its top at y = 0."""
    model = Model()
    model.box("lawn", "grass", (-4, -0.1, -1.5), (4, 0, 1.5))
    return model


def cut_earth():
    """A block of earth under a lawn, cut along z = 0: layers that run unevenly into each other."""
    model, rng = Model(), random.Random(7)
    x0, x1, back, foot = -3.2, 3.2, -1.6, -2.4
    layers = [("clay_soil", -1.45, 0.10), ("subsoil", -0.55, 0.08), ("topsoil", -0.06, 0.012), ("grass", 0.0, 0.0)]
    waves = {name: [(1.1 + 2.6 * rng.random(), 6.28 * rng.random()) for _ in range(3)] for name, _, _ in layers}

    def top(layer, x):
        name, level, swing = layer
        return level + swing * sum(math.sin(a * x + b) for a, b in waves[name]) / 2
    xs = spaced(x0, x1, 0.1)
    for k, layer in enumerate(layers):
        for a, b in zip(xs, xs[1:]):
            low_a, low_b = (top(layers[k - 1], a), top(layers[k - 1], b)) if k else (foot, foot)
            high_a, high_b = top(layer, a), top(layer, b)
            model.face("earth", layer[0], [(a, low_a, 0), (b, low_b, 0), (b, high_b, 0), (a, high_a, 0)])
            model.face("earth", layer[0], [(b, low_b, back), (a, low_a, back), (a, high_a, back), (b, high_b, back)])
            if k == 0:
                model.face("earth", layer[0], [(a, foot, back), (b, foot, back), (b, foot, 0), (a, foot, 0)])
            if k == len(layers) - 1:
                model.face("earth", layer[0], [(a, high_a, 0), (b, high_b, 0), (b, high_b, back), (a, high_a, back)])
        for x, order in ((x0, 1), (x1, -1)):
            low, high = (top(layers[k - 1], x) if k else foot), top(layer, x)
            model.face("earth", layer[0], [(x, low, back), (x, low, 0), (x, high, 0), (x, high, back)][::order])
    return model


if __name__ == "__main__":
    here = pathlib.Path(__file__).resolve().parent
    for name, model, about in (("sphere", body("sphere", "chalk", 4, lambda d: 0.5), "A sphere of radius 0.5 m"),
                               ("wren", wren(), "A wren, rounder than life"),
                               ("lawn", lawn(), "A strip of lawn"),
                               ("cut_earth", cut_earth(), "A block of earth, cut")):
        model.write(here / f"{name}.obj", about, maker="make_shapes.py")
