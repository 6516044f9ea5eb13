#!/usr/bin/env python3
"""Builds lean_to.obj and lean_to.mtl beside this script: a garden wall with a small tiled roof that stands out from it.

    python3 scenes/meshes/make_lean_to.py

Standard library only; the same bytes on every run. Metres, y up, the ground's top at y = 0. The wall runs along x and
looks to +z; its back is rendered. Groups: wall, coping, roof, timber, bed, paving.
"""
import pathlib
import random

import masonry
from masonry import PROUD, SLABS, Face, Model, coping, flag, lay_bricks, pick, soil_bed, spaced, wall_body

masonry.COLOURS.update({"tile_red": (160, 92, 66), "tile_dark": (138, 80, 60), "tile_brown": (148, 98, 72),
                        "oak": (128, 100, 72)})
TILES = [("tile_red", 5), ("tile_dark", 3), ("tile_brown", 3)]

LEFT, RIGHT, MIDDLE, HALF, TOP = -3.2, 2.6, -0.6, 0.16, 3.2
FRONT = MIDDLE + HALF
# The roof: from the wall down to its eaves.
ROOF_LEFT, ROOF_RIGHT, RIDGE, EAVES, OUT = -1.1, 1.9, 2.72, 2.22, 1.5


def wall(model, rng):
    core = HALF - PROUD
    wall_body(model, lambda u, v, side: (u, v, MIDDLE + (core if side == 0 else -core)), spaced(LEFT, RIGHT, 0.5),
              lambda u: TOP, lambda u: None)
    lay_bricks(model, rng, Face((LEFT, 0, MIDDLE + core), (1, 0), (0, 1)), RIGHT - LEFT, lambda u: TOP)
    for x, along, out in ((LEFT, (0, 1), (-1, 0)), (RIGHT, (0, -1), (1, 0))):
        start = MIDDLE - core if out[0] < 0 else MIDDLE + core
        lay_bricks(model, rng, Face((x, 0, start), along, out), 2 * core, lambda u: TOP, phase=0.25, edge=0.0)
    coping(model, rng, lambda u, v, w: (u, v, MIDDLE + w), LEFT - 0.055, RIGHT + 0.055, lambda u: TOP, HALF)


def roof(model, rng):
    """Rows of tiles, each over the one below, on two brackets of oak."""
    rows, long, thick = 6, OUT / 6, 0.035

    def level(z):
        return RIDGE + (EAVES - RIDGE) * z / OUT
    for row in range(rows):
        z0, z1 = row * long, (row + 1) * long + 0.06
        joints = spaced(ROOF_LEFT, ROOF_RIGHT, 0.21)
        for a, b in zip(joints, joints[1:]):
            lift = 0.004 * rng.random()
            outline = [(b - 0.004, level(z0) + lift, FRONT + z0), (b - 0.004, level(z0) - thick, FRONT + z0),
                       (b - 0.004, level(z1) - thick + 0.03, FRONT + z1), (b - 0.004, level(z1) + 0.03 + lift, FRONT + z1)]
            model.prism("roof", pick(rng, TILES), outline, (a - b + 0.008, 0, 0))
    deck = [(ROOF_RIGHT, level(0) - thick, FRONT), (ROOF_RIGHT, level(0) - 0.09, FRONT),
            (ROOF_RIGHT, level(OUT) - 0.09, FRONT + OUT), (ROOF_RIGHT, level(OUT) - thick, FRONT + OUT)]
    model.prism("timber", "oak", deck, (ROOF_LEFT - ROOF_RIGHT, 0, 0))
    for x in (ROOF_LEFT + 0.2, ROOF_RIGHT - 0.2):
        foot, head = 1.35, OUT * 0.72
        # A brace from the wall to the rafter, and the post on the wall that it stands on.
        model.prism("timber", "oak", [(x + 0.05, foot, FRONT), (x + 0.05, level(head) - 0.09, FRONT + head),
                                      (x + 0.05, level(head) - 0.07, FRONT + head - 0.14), (x + 0.05, foot + 0.18, FRONT)],
                    (-0.1, 0, 0))
        model.box("timber", "oak", (x - 0.05, foot - 0.15, FRONT - 0.01), (x + 0.05, level(0) - 0.09, FRONT + 0.07))


def ground(model, rng):
    soil_bed(model, rng, LEFT, RIGHT, FRONT - 0.02, 0.12)
    x0, z0, cell, columns, rows = -4.2, -2.4, 0.6, 14, 14
    model.box("paving", "sand", (x0, -0.2, z0), (x0 + columns * cell, -0.02, z0 + rows * cell))
    for i in range(columns):
        for k in range(rows):
            flag(model, rng, x0 + i * cell, z0 + k * cell, x0 + (i + 1) * cell, z0 + (k + 1) * cell)


def main():
    model, rng = Model(), random.Random(1989)
    wall(model, rng)
    roof(model, rng)
    ground(model, rng)
    model.write(pathlib.Path(__file__).resolve().parent / "lean_to.obj", "A garden wall with a small roof",
                "make_lean_to.py")


if __name__ == "__main__":
    main()
