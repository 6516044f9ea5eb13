#!/usr/bin/env python3
"""Builds boulder.obj (with its .mtl file) beside this script.

    python3 scenes/meshes/make_stone.py

Standard library only; the same bytes on every run. Metres, y up. A closed boulder that lies in the ground a little: what is
left of a ball once planes have broken its sides off, with weathered edges, bumps, and stains.
"""
import math
import pathlib
import random

import masonry
from masonry import Model

masonry.COLOURS.update({"granite": (150, 146, 140), "granite_warm": (157, 149, 138), "granite_dark": (138, 135, 131),
                        "lichen": (160, 158, 134)})

STEPS = 26  # into which each edge of an icosahedron is cut
HALF = (1.45, 1.0, 1.12)
FLOOR = -0.12


def unit(p):
    length = math.sqrt(sum(c * c for c in p))
    return tuple(c / length for c in p)


def ball():
    """Corners on the unit ball and triangles, counterclockwise from outside."""
    g = (1 + math.sqrt(5)) / 2
    corners = [unit(p) for p in [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g),
                                 (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
             (8, 6, 7), (9, 8, 1)]
    points, number, triangles = [], {}, []

    def at(a, b, c, i, j):
        p = unit(tuple((STEPS - i - j) * u + i * v + j * w for u, v, w in zip(a, b, c)))
        key = tuple(round(x, 9) + 0.0 for x in p)
        if key not in number:
            number[key] = len(points)
            points.append(p)
        return number[key]

    for a, b, c in ([corners[i] for i in face] for face in faces):
        for i in range(STEPS):
            for j in range(STEPS - i):
                triangles.append((at(a, b, c, i, j), at(a, b, c, i + 1, j), at(a, b, c, i, j + 1)))
                if i + j < STEPS - 1:
                    triangles.append((at(a, b, c, i + 1, j), at(a, b, c, i + 1, j + 1), at(a, b, c, i, j + 1)))
    return points, triangles


class Noise:
    """Smooth, about -1 .. 1: sums of waves every way."""

    def __init__(self, chance, per_metre, waves=24):
        self.waves = []
        for _ in range(waves):
            way = unit([chance.gauss(0, 1) for _ in range(3)])
            rate = 2 * math.pi * per_metre * chance.uniform(0.6, 1.5)
            self.waves.append((tuple(rate * c for c in way), chance.uniform(0, 2 * math.pi)))

    def __call__(self, p):
        return sum(math.sin(sum(a * b for a, b in zip(w, p)) + turn) for w, turn in self.waves) / math.sqrt(len(self.waves))


def boulder():
    chance = random.Random(20)
    planes = [(unit([chance.gauss(0, 1) for _ in range(3)]), chance.uniform(0.62, 0.86)) for _ in range(26)]
    planes.append((unit((0.1, 1.0, 0.25)), 0.72))  # a broad back
    coarse, fine, stains, growth = Noise(chance, 1.1), Noise(chance, 5.0), Noise(chance, 1.6), Noise(chance, 3.2)
    points, triangles = ball()
    placed = []
    for u in points:
        # A soft least of how far away the planes are in this direction; the ball itself is one of them.
        ways = [1.0] + [d / f for n, d in planes if (f := sum(a * b for a, b in zip(n, u))) > 0.05]
        radius = -math.log(sum(math.exp(-55 * w) for w in ways)) / 55
        p = tuple(radius * h * c for h, c in zip(HALF, u))
        bump = 0.022 * coarse(p) + 0.009 * fine(p)
        p = [c + bump * d for c, d in zip(p, u)]
        p[1] = max(p[1] + 0.5, FLOOR)
        placed.append(tuple(p))
    model = Model()
    for t in triangles:
        corners = [placed[i] for i in t]
        middle = [sum(c) / 3 for c in zip(*corners)]
        stain = stains(middle) + 0.35 * growth(middle)
        material = "granite_warm" if stain > 0.75 else "granite_dark" if stain < -0.95 else "granite"
        if growth(middle) + 0.3 * fine(middle) > 1.55 and middle[1] > 0.5:
            material = "lichen"
        model.face("boulder", material, corners)
    return model


boulder().write(pathlib.Path(__file__).with_name("boulder.obj"), "A boulder that lies in the ground a little",
                pathlib.Path(__file__).name)
