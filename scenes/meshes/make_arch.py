#!/usr/bin/env python3
"""Builds arch_cm.obj and arch_cm.mtl beside this script: a wooden garden arch over a path.

    python3 scenes/meshes/make_arch.py

Standard library only; the same bytes on every run. As many programs write it: centimetres, z up. Groups: wood, path,
lawn.
"""
import math
import pathlib
import random

import masonry
from masonry import SLABS, Model, pick, spaced

masonry.COLOURS.update({"cedar": (150, 118, 86), "cedar_grey": (142, 126, 106), "lawn_green": (86, 104, 58)})

HALF_WIDE, HALF_DEEP, SPRING, BEAM = 0.75, 0.32, 1.75, 0.035


def bent(model, z, radius, half):
    """Two posts and the half circle between them, of a square section."""
    path = [(-radius, -0.1), *((radius * -math.cos(a), SPRING + radius * math.sin(a))
                               for a in (math.pi * i / 20 for i in range(21))), (radius, -0.1)]
    rings = []
    for i, (x, y) in enumerate(path):
        (ax, ay), (bx, by) = path[max(0, i - 1)], path[min(len(path) - 1, i + 1)]
        long = math.hypot(bx - ax, by - ay)
        nx, ny = -(by - ay) / long, (bx - ax) / long  # to the left of the way
        rings.append([(x + s * half * nx, y + s * half * ny, z + t * half) for s, t in ((1, 1), (1, -1), (-1, -1), (-1, 1))])
    for r, s in zip(rings, rings[1:]):
        for k in range(4):
            m = (k + 1) % 4
            model.face("wood", "cedar", [s[k], s[m], r[m], r[k]])
    model.face("wood", "cedar", rings[0])
    model.face("wood", "cedar", rings[-1][::-1])


def slats(model, rng):
    """Laths from the front to the back, up the sides and over the top; between them two uprights on each side."""
    for side in (-1, 1):
        for y in spaced(0.25, SPRING - 0.1, 0.24):
            x = side * HALF_WIDE
            model.box("wood", pick(rng, [("cedar", 2), ("cedar_grey", 1)]), (x - 0.012, y - 0.02, -HALF_DEEP),
                      (x + 0.012, y + 0.02, HALF_DEEP))
        for z in (-0.11, 0.11):
            x = side * (HALF_WIDE + 0.02)
            model.box("wood", "cedar_grey", (x - 0.01, 0.0, z - 0.018), (x + 0.01, SPRING + 0.1, z + 0.018))
    for i in range(1, 12):
        a, r = math.pi * i / 12, HALF_WIDE + BEAM + 0.012
        x, y, dx, dy = r * math.cos(a), SPRING + r * math.sin(a), -math.sin(a) * 0.03, math.cos(a) * 0.03
        ox, oy = math.cos(a) * 0.012, math.sin(a) * 0.012
        deep = HALF_DEEP + 0.1
        outline = [(x - dx - ox, y - dy - oy, deep), (x - dx + ox, y - dy + oy, deep), (x + dx + ox, y + dy + oy, deep),
                   (x + dx - ox, y + dy - oy, deep)]
        model.prism("wood", pick(rng, [("cedar", 2), ("cedar_grey", 1)]), outline, (0, 0, -2 * deep))


def ground(model, rng):
    model.box("lawn", "lawn_green", (-4.5, -0.12, -4.5), (4.5, 0.0, 4.5))
    z = -4.4
    while z < 4.2:
        deep = rng.choice((0.36, 0.44, 0.52))
        cut = rng.uniform(-0.15, 0.15)
        for x0, x1 in ((-0.5, cut - 0.012), (cut + 0.012, 0.5)):
            model.box("path", pick(rng, SLABS), (x0 + 0.02 * rng.random(), -0.05, z),
                      (x1 - 0.02 * rng.random(), 0.012 + 0.008 * rng.random(), min(z + deep - 0.024, 4.4)))
        z += deep


def main():
    model, rng = Model(), random.Random(11)
    for z in (-HALF_DEEP, HALF_DEEP):
        bent(model, z, HALF_WIDE, BEAM)
    slats(model, rng)
    ground(model, rng)
    model.points = [(100 * x, -100 * z + 0.0, 100 * y) for x, y, z in model.points]
    model.write(pathlib.Path(__file__).resolve().parent / "arch_cm.obj", "A garden arch", "make_arch.py",
                "centimetres, z up")


if __name__ == "__main__":
    main()
