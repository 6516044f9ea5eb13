#!/usr/bin/env python3
"""Builds reef.obj and sea_floor.obj (with their .mtl files) beside this script.

    python3 scenes/meshes/make_reef.py

Standard library only; the same bytes on every run. Metres, y up. A lump of rock with ledges, about 1.4 m across, and ripples of
sand around its foot.
"""
import math
import pathlib
import random

import masonry
from make_shapes import ball, unit
from masonry import Model

masonry.COLOURS.update({"reef_rock": (116, 108, 100), "reef_sand": (202, 190, 158)})

RNG = random.Random(12)
KNOBS = [(unit([RNG.gauss(0, 1), RNG.gauss(0.2, 0.7), RNG.gauss(0, 1)]), RNG.uniform(0.05, 0.17), RNG.uniform(0.22, 0.5))
         for _ in range(40)]


def rock_radius(d):
    """How far the surface is from the middle that way."""
    x, y, z = d
    radius = 0.46 * (1 + 0.20 * x * x - 0.10 * z * z)
    for way, tall, wide in KNOBS:
        angle = math.acos(max(-1.0, min(1.0, sum(a * b for a, b in zip(d, way)))))
        radius += tall * math.exp(-((angle / wide) ** 2) * 1.4)
    radius += 0.012 * math.sin(19 * x + 3) * math.sin(17 * y) * math.sin(21 * z + 1)
    return radius


def reef():
    model = Model()
    corners, faces = ball(4)
    points = []
    for d in corners:
        r = rock_radius(d)
        points.append((1.15 * r * d[0], 0.30 + 0.72 * r * d[1], r * d[2]))
    for face in faces:
        model.face("reef", "reef_rock", [points[i] for i in face])
    return model


def sea_floor():
    model, step, reach = Model(), 0.1, 4.0

    def height(x, z):
        far = math.hypot(x, z)
        ripple = 0.011 * math.sin(15 * (x + 0.35 * z) + 1.4 * math.sin(1.9 * z) + 0.8 * math.sin(2.7 * x))
        return ripple + 0.05 * math.exp(-((far / 0.9) ** 2)) + 0.02 * math.sin(1.3 * x + 2) * math.sin(1.1 * z)
    n = round(2 * reach / step)
    for i in range(n):
        for k in range(n):
            xs, zs = [-reach + step * (i + d) for d in (0, 1)], [-reach + step * (k + d) for d in (0, 1)]
            quad = [(xs[0], zs[0]), (xs[0], zs[1]), (xs[1], zs[1]), (xs[1], zs[0])]
            model.face("sea_floor", "reef_sand", [(a, height(a, b), b) for a, b in quad])
    deep = -0.5  # closed below, so that it is solid
    edge = [-reach + step * i for i in range(n + 1)]
    rim = ([(x, reach) for x in edge] + [(reach, z) for z in edge[-2::-1]] + [(x, -reach) for x in edge[-2::-1]]
           + [(-reach, z) for z in edge[1:-1]])
    for (ax, az), (bx, bz) in zip(rim, rim[1:] + rim[:1]):
        model.face("sea_floor", "reef_sand", [(ax, height(ax, az), az), (ax, deep, az), (bx, deep, bz),
                                              (bx, height(bx, bz), bz)])
    model.face("sea_floor", "reef_sand", [(x, deep, z) for x, z in reversed(rim)])
    return model


if __name__ == "__main__":
    here = pathlib.Path(__file__).resolve().parent
    reef().write(here / "reef.obj", "A lump of rock", maker="make_reef.py")
    sea_floor().write(here / "sea_floor.obj", "Ripples of sand", maker="make_reef.py")
