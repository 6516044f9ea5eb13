#!/usr/bin/env python3
"""Builds courtyard.obj and courtyard.mtl beside this script: a walled court, after figure 5 of Ned Greene's "Voxel Space
Automata" (SIGGRAPH 1989).

    python3 scenes/meshes/make_courtyard.py

Standard library only; the same bytes on every run. Metres, y up, the ground at y = 0. The wall with the window
stands along x and shows its front to +z; a wall returns on either side, and two low ones in front leave a gate between
them. The paving is one flat bed of sand, for tiles to be laid on; kerbs stand out around it.
Groups: wall, coping, window, paving, bed, kerb, turf.
"""
import pathlib
import random

import masonry
from masonry import (PROUD, Face, Model, Window, coping, kerb, lay_bricks, pick, pier, plinth, soil_bed, spaced,
                     swept, wall_body)

masonry.COLOURS.update({"grass": (118, 124, 82), "grass_dry": (122, 126, 85), "grass_deep": (115, 122, 80)})
GRASS = [("grass", 6), ("grass_dry", 3), ("grass_deep", 3)]

HALF = 0.16                       # of every wall's thickness
OVER, CAP = 0.008, (0.0, 0.03)    # by which copings and the caps of piers stand out: less than a voxel, as edges that
                                  # shade themselves would be no place that is bright all over
WIDE = 2.36                       # the middles of the walls left and right
BACK, FRONT = -2.08, 2.42         # of the wall with the window, and of the low ones
END = WIDE + HALF                 # where the wall with the window ends
GATE = 0.84                       # the middles of its piers
LOW = 0.94                        # how high the walls in front are
EDGE_X, EDGE_Z = 3.3, 3.9         # of the ground; in front it goes on to NEAR, beyond the world, where the viewer stands
NEAR = 5.4
SAND = -0.001                     # a little below the grass, so that pictures carry on grass where the ground ends
WINDOW = Window(0.0, 0.98, 1.66, 0.48)


def back_top(x):
    """A gable of two swan necks over the window."""
    return swept(2.66, 1.98, 0.86, 1.72)(abs(x))


LEFT_TOP = swept(1.98, 1.46, -1.3, -0.5)   # by z
RIGHT_TOP = swept(1.98, LOW, -1.5, -0.3)


def back_wall(model, rng):
    core, opening = HALF - PROUD, WINDOW.hidden
    rise = spaced(0.86, 1.72, 0.06)
    us = [-END + PROUD] + [-u for u in rise[::-1]] + [-opening] + WINDOW.stations() + [opening] + rise + [END - PROUD]
    wall_body(model, lambda u, v, side: (u, v, BACK + (core if side == 0 else -core)), us, back_top, WINDOW.hole)
    width = 2 * (END - PROUD)
    for face, sign in ((Face((-END + PROUD, 0, BACK + core), (1, 0), (0, 1)), 1),
                       (Face((END - PROUD, 0, BACK - core), (-1, 0), (0, -1)), -1)):
        lay_bricks(model, rng, face, width, lambda u: back_top(END - PROUD - u),
                   WINDOW.gaps(lambda x, sign=sign: sign * x + END - PROUD), edge=0.0)
        plinth(model, rng, face, width)
    for x, along, out in ((-END + PROUD, (0, 1), (-1, 0)), (END - PROUD, (0, -1), (1, 0))):
        start = BACK - core if out[0] < 0 else BACK + core
        lay_bricks(model, rng, Face((x, 0, start), along, out), 2 * core, lambda u: back_top(END), phase=0.25, edge=0.0)
    coping(model, rng, lambda u, v, w: (u, v, BACK + w), -END - 0.055, END + 0.055, back_top, HALF, stone=0.52, over=OVER)


def side_wall(model, rng, x, top, end):
    """From the wall with the window to z = `end`. Stations run by -z, so that u runs to the right as seen from +x."""
    core, start = HALF - PROUD, BACK + HALF - 0.02
    us = [-z for z in spaced(start, end, 0.08)[::-1]]
    wall_body(model, lambda u, v, side: (x + (core if side == 0 else -core), v, -u), us, lambda u: top(-u), lambda u: None)
    right, left = Face((x + core, 0, end), (0, -1), (1, 0)), Face((x - core, 0, start), (0, 1), (-1, 0))
    lay_bricks(model, rng, right, end - start, lambda u: top(end - u), edge=0.0)
    lay_bricks(model, rng, left, end - start, lambda u: top(start + u), edge=0.0)
    coping(model, rng, lambda u, v, w: (x + w, v, -u), -end, -start, lambda u: top(-u), HALF, over=OVER)


def low_wall(model, rng, start, end):
    core = HALF - PROUD
    wall_body(model, lambda u, v, side: (u, v, FRONT + (core if side == 0 else -core)), spaced(start, end, 0.4),
              lambda u: LOW, lambda u: None)
    for face in (Face((start, 0, FRONT + core), (1, 0), (0, 1)), Face((end, 0, FRONT - core), (-1, 0), (0, -1))):
        lay_bricks(model, rng, face, end - start, lambda u: LOW, edge=0.0)
    coping(model, rng, lambda u, v, w: (u, v, FRONT + w), start, end, lambda u: LOW, HALF, over=OVER)


def beds(model, rng):
    """Around the court, and outside along the feet of two of its walls."""
    level, inner = 0.05, WIDE - HALF + 0.03
    back, front = BACK + HALF - 0.03, FRONT - HALF + 0.03
    soil_bed(model, rng, -inner, inner, back, -1.24, level)
    soil_bed(model, rng, -inner, -1.66, -1.24, front, level)
    soil_bed(model, rng, 1.66, inner, -1.24, front, level)
    for x0, x1 in ((-1.66, -GATE - 0.18), (GATE + 0.18, 1.66)):
        soil_bed(model, rng, x0, x1, 1.84, front, level)
    out_x, out_back = WIDE + HALF - 0.03, BACK - HALF + 0.03
    soil_bed(model, rng, -out_x, out_x + 0.4, out_back - 0.42, out_back, level)
    soil_bed(model, rng, out_x, out_x + 0.4, out_back, FRONT + HALF, level)


def kerbs(model, rng):
    edge_x, back, front = 1.625, -1.20, 1.80
    kerb(model, rng, (-edge_x - 0.06, back), (edge_x + 0.06, back), high=0.14)
    for x in (-edge_x, edge_x):
        kerb(model, rng, (x, back + 0.06), (x, front + 0.06), high=0.14)
    for sign in (-1, 1):
        inner, outer = sorted((sign * (GATE + 0.14), sign * (edge_x - 0.06)))
        kerb(model, rng, (inner, front), (outer, front), high=0.14)
        kerb(model, rng, (sign * (GATE + 0.14), front + 0.06), (sign * (GATE + 0.14), FRONT - 0.24), high=0.14)


def floor(model):
    """The sand that tiles are laid on: the court, and a path through the gate."""
    model.box("paving", "sand", (-WIDE, -0.2, BACK), (WIDE, SAND, FRONT))
    model.box("paving", "sand", (-GATE, -0.2, FRONT), (GATE, SAND, NEAR))


def turf(model, rng):
    """Grass around it all, in patches."""
    def ground(x0, x1, z0, z1):
        low, high = -0.2, 0.0005
        rim = [(x0, z1), (x1, z1), (x1, z0), (x0, z0)]
        for (xa, za), (xb, zb) in zip(rim, rim[1:] + rim[:1]):
            model.face("turf", "grass", [(xa, low, za), (xb, low, zb), (xb, high, zb), (xa, high, za)])
        model.face("turf", "grass", [(x, low, z) for x, z in rim[::-1]])
        xs, zs = spaced(x0, x1, 0.3), spaced(z0, z1, 0.3)
        for xa, xb in zip(xs, xs[1:]):
            for za, zb in zip(zs, zs[1:]):
                model.face("turf", pick(rng, GRASS), [(xa, high, zb), (xb, high, zb), (xb, high, za), (xa, high, za)])
    ground(-EDGE_X, EDGE_X, -EDGE_Z, BACK)
    ground(-EDGE_X, -WIDE, BACK, FRONT)
    ground(WIDE, EDGE_X, BACK, FRONT)
    ground(-EDGE_X, -GATE, FRONT, NEAR)
    ground(GATE, EDGE_X, FRONT, NEAR)


def courtyard():
    model, rng = Model(), random.Random(1989)
    back_wall(model, rng)
    WINDOW.surround(model, rng, BACK, HALF)
    side_wall(model, rng, -WIDE, LEFT_TOP, FRONT - 0.18)
    side_wall(model, rng, WIDE, RIGHT_TOP, FRONT - 0.18)
    low_wall(model, rng, -WIDE + 0.2, -GATE - 0.18)
    low_wall(model, rng, GATE + 0.18, WIDE - 0.2)
    pier(model, rng, -WIDE, FRONT, 0.22, 1.56, 0.12, CAP)
    pier(model, rng, WIDE, FRONT, 0.22, 1.14, 0.12, CAP)
    for x in (-GATE, GATE):
        pier(model, rng, x, FRONT, 0.2, 1.2, 0.12, CAP)
    beds(model, rng)
    kerbs(model, rng)
    floor(model)
    turf(model, rng)
    return model


if __name__ == "__main__":
    courtyard().write(pathlib.Path(__file__).resolve().parent / "courtyard.obj", "A walled court with an arched window",
                      "make_courtyard.py")
