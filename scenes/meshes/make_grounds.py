#!/usr/bin/env python3
"""Builds patio.obj and cottage.obj (with their .mtl files) beside this script: grounds on which elements spread.

    python3 scenes/meshes/make_grounds.py

Standard library only; the same bytes on every run. Metres, y up. The patio: a floor of sand between two low walls, with
two beds in kerbs. The cottage: a small house with a gabled roof on a meadow that rolls a little, a path to its door, and
a boulder beside it.
"""
import math
import pathlib

import masonry
from make_shapes import body
from masonry import Model, spaced

masonry.COLOURS.update({"turf": (98, 112, 66), "boulder": (150, 146, 138), "thatch_lath": (112, 92, 74),
                        "oak": (104, 80, 58), "whitewash": (226, 220, 206)})


def patio():
    model = Model()
    model.face("paving", "sand", [(-2.6, 0, 2.2), (2.6, 0, 2.2), (2.6, 0, -2.2), (-2.6, 0, -2.2)])
    model.box("wall", "limestone_warm", (-2.8, -0.1, -2.4), (2.8, 0.9, -2.2))
    model.box("wall", "limestone_warm", (-2.8, -0.1, -2.2), (-2.6, 0.6, 2.2))
    model.box("coping", "limestone_pale", (-2.86, 0.9, -2.46), (2.86, 0.97, -2.14))
    model.box("coping", "limestone_pale", (-2.86, 0.6, -2.14), (-2.54, 0.66, 2.26))
    for low, high in (((-1.7, -1.5), (-0.43, -0.62)), ((0.7, -0.1), (1.9, 1.2))):
        (x0, z0), (x1, z1) = low, high
        for a, b in (((x0, z0), (x1, z0 + 0.09)), ((x0, z1 - 0.09), (x1, z1)),
                     ((x0, z0 + 0.09), (x0 + 0.09, z1 - 0.09)), ((x1 - 0.09, z0 + 0.09), (x1, z1 - 0.09))):
            model.box("kerb", "limestone_grey", (a[0], -0.1, a[1]), (b[0], 0.14, b[1]))
        model.box("bed", "soil", (x0 + 0.09, -0.1, z0 + 0.09), (x1 - 0.09, 0.1, z1 - 0.09))
    return model


def roll(x, z):
    """How high the meadow lies: level by the house and along the path."""
    near = min(1.0, max(0.0, abs(x) - 0.55) / 1.2)
    away = min(1.0, max(0.0, z - 0.1) / 0.8) if abs(x) < 2.5 and z > -2.9 else 1.0
    swell = 0.09 * math.sin(1.3 * x + 0.7 * z) + 0.07 * math.sin(0.9 * z - 1.9 * x + 1.0) + 0.05
    return swell * near * away


def cottage():
    model = Model()
    step = 0.25
    xs, zs = spaced(-9.0, 9.0, step), spaced(-8.0, 8.0, step)
    for x0, x1 in zip(xs, xs[1:]):
        for z0, z1 in zip(zs, zs[1:]):
            path = abs(x0 + x1) / 2 < 0.5 and z0 >= 0
            if path or (abs(x0 + x1) / 2 < 2 and -2.5 < (z0 + z1) / 2 < 0):
                continue
            a, b, c, d = ((x, roll(x, z), z) for x, z in ((x0, z1), (x1, z1), (x1, z0), (x0, z0)))
            model.face("meadow", "turf", [a, b, c])
            model.face("meadow", "turf", [a, c, d])
    model.face("path", "sand", [(-0.5, 0, 8), (0.5, 0, 8), (0.5, 0, 0), (-0.5, 0, 0)])
    model.prism("wall", "whitewash", [(2, -0.2, 0), (2, -0.2, -2.5), (2, 1.9, -2.5), (2, 3.1, -1.25), (2, 1.9, 0)], (-4, 0, 0))
    model.box("timber", "oak", (-0.42, 0, 0), (0.42, 1.75, 0.03))
    for x in (-1.45, 0.85):
        model.box("timber", "oak", (x, 0.75, 0), (x + 0.6, 1.45, 0.03))
        model.box("glass", "marble", (x + 0.06, 0.81, 0.02), (x + 0.54, 1.39, 0.04))
    # Two slopes that lie on the gables and go beyond the walls.
    slope = (3.1 - 1.9) / 1.25
    for side in (1, -1):
        def at(out, up, x):  # `out` from the ridge, `up` above the walls' slope
            return (x, 3.1 + up - slope * out, -1.25 + side * out)
        lower, upper = [(1.6, 0.02), (0, 0.02)], [(0, 0.1), (1.6, 0.1)]
        outline = [at(o, u, 2.2 * side) for o, u in lower + upper]
        model.face("eaves", "oak", outline)
        model.face("eaves", "oak", [at(o, u, -2.2 * side) for o, u in (lower + upper)[::-1]])
        for (o0, u0), (o1, u1), group, material in ((lower[0], lower[1], "eaves", "oak"), (upper[0], upper[1], "roof", "thatch_lath"),
                                                    (upper[1], lower[0], "eaves", "oak")):
            model.face(group, material, [at(o0, u0, 2.2 * side), at(o0, u0, -2.2 * side), at(o1, u1, -2.2 * side), at(o1, u1, 2.2 * side)])
    return model


def boulder():
    def radius(d):
        x, y, z = d
        return 0.55 * (1 + 0.16 * math.sin(3 * x + 2 * y) + 0.1 * math.sin(5 * z - 3 * x) + 0.06 * math.sin(9 * y + 4 * z)) * (1 - 0.3 * abs(y))
    return body("stone", "boulder", 4, radius, (2.3, 0.22, 1.35))


if __name__ == "__main__":
    here = pathlib.Path(__file__).resolve().parent
    maker = pathlib.Path(__file__).name
    patio().write(here / "patio.obj", "A patio that is not paved yet", maker)
    house, stone = cottage(), boulder()
    for group, by_material in stone.faces.items():
        for material, faces in by_material.items():
            for corners in faces:
                house.face(group, material, [stone.points[i - 1] for i in corners])
    house.write(here / "cottage.obj", "A cottage on a meadow, with a boulder", maker)
