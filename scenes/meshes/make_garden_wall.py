#!/usr/bin/env python3
"""Builds garden_wall.obj, column.obj and maze_walls.obj (with their .mtl files) beside this script.

    python3 scenes/meshes/make_garden_wall.py

Standard library only; the same bytes on every run. Metres, y up, the ground's top at y = 0.
The garden wall: of brick along x with an arched window, swept down to a pier on the right; a lower wall
returns towards +z on the left. Groups: wall, coping, window, paving, bed, kerb.
"""
import pathlib
import random

from masonry import (COURSE, PROUD, STONES, Face, Model, Window, coping, flag, kerb, lay_bricks, pick, pier, plinth,
                     soil_bed, spaced, swept, turned, wall_body)

# The main wall, along x. Its front looks to +z.
LEFT, RIGHT, MIDDLE, HALF = -3.0, 2.52, -0.6, 0.16
WALL_TOP = swept(3.44, 2.24, 1.18, 2.14)
WINDOW = Window(-0.74, 1.04, 2.08, 0.52)
# The lower wall, along z, on the left.
RETURN_X, RETURN_END = LEFT + HALF, 2.56
RETURN_TOP = swept(2.64, 1.28, -0.1, 1.06)


def main_wall(model, rng):
    core, opening = HALF - PROUD, WINDOW.hidden
    us = [LEFT + PROUD]
    us += spaced(LEFT + PROUD, WINDOW.middle - opening, 0.5)[1:] + WINDOW.stations()
    us += spaced(WINDOW.middle + opening, 1.18, 0.4) + spaced(1.18, 2.14, 0.06)[1:] + [RIGHT]

    def place(u, v, side):
        return (u, v, MIDDLE + (core if side == 0 else -core))
    wall_body(model, place, us, WALL_TOP, WINDOW.hole)
    width = RIGHT - LEFT - PROUD
    front = Face((LEFT + PROUD, 0, MIDDLE + core), (1, 0), (0, 1))
    back = Face((RIGHT, 0, MIDDLE - core), (-1, 0), (0, -1))
    lay_bricks(model, rng, front, width, lambda u: WALL_TOP(LEFT + PROUD + u), WINDOW.gaps(lambda x: x - LEFT - PROUD))
    lay_bricks(model, rng, back, width, lambda u: WALL_TOP(RIGHT - u), WINDOW.gaps(lambda x: RIGHT - x), edge=0.0)
    end = Face((LEFT + PROUD, 0, MIDDLE - core), (0, 1), (-1, 0))
    lay_bricks(model, rng, end, 2 * core, lambda u: WALL_TOP(LEFT), phase=0.25, edge=0.0)
    for face in (front, back):
        plinth(model, rng, face, width)
    coping(model, rng, lambda u, v, w: (u, v, MIDDLE + w), LEFT - 0.055, RIGHT, WALL_TOP, HALF)


def return_wall(model, rng):
    core, start, end = HALF - PROUD, MIDDLE + HALF - 0.02, RETURN_END
    us = spaced(start, -0.1, 0.2) + spaced(-0.1, 1.06, 0.06)[1:] + [end]
    # Seen from the court (+x), u runs towards -z: stations are given by -z.
    wall_body(model, lambda u, v, side: (RETURN_X + (core if side == 0 else -core), v, -u), [-z for z in us[::-1]],
              lambda u: RETURN_TOP(-u), lambda u: None)
    inner = Face((RETURN_X + core, 0, end), (0, -1), (1, 0))
    outer = Face((RETURN_X - core, 0, start), (0, 1), (-1, 0))
    lay_bricks(model, rng, inner, end - start, lambda u: RETURN_TOP(end - u), edge=0.0)
    lay_bricks(model, rng, outer, end - start, lambda u: RETURN_TOP(start + u), edge=0.0)
    coping(model, rng, lambda u, v, w: (RETURN_X + w, v, -u), -end, -start, lambda u: RETURN_TOP(-u), HALF)


def buttress(model, rng, x):
    """Two stages of brick against the front, each under a sloping stone."""
    half, wall_z = 0.24, MIDDLE + HALF - 0.02
    stages = [(-0.15, 1.36, 0.46), (1.36, 2.56, 0.28)]
    nexts = [0.28, 0.02]
    for (low, high, deep), after in zip(stages, nexts):
        core = deep - PROUD
        model.box("wall", "mortar", (x - half + PROUD, low, wall_z), (x + half - PROUD, high, wall_z + core))
        first = 0 if low < 0 else round(low / COURSE)
        faces = [(Face((x - half + PROUD, 0, wall_z + core), (1, 0), (0, 1)), 2 * (half - PROUD), 0.009),
                 (Face((x + half - PROUD, 0, wall_z + core), (0, -1), (1, 0)), core, 0.0),
                 (Face((x - half + PROUD, 0, wall_z), (0, 1), (-1, 0)), core, 0.0)]
        for face, width, edge in faces:
            lay_bricks(model, rng, face, width, lambda u: high, first=first, phase=0.02, edge=edge)
        rise = (deep - after) * 1.35
        out, side = deep + 0.045, half + 0.03
        profile = [(0.0, high), (out, high), (out, high + 0.05), (after, high + 0.05 + rise), (0.0, high + 0.05 + rise)]
        model.prism("coping", pick(rng, STONES), [(x + side, y, wall_z + d) for d, y in profile[::-1]],
                    (-2 * side, 0, 0))


def beds(model, rng):
    inside, outside = MIDDLE + HALF - 0.03, MIDDLE - HALF + 0.03
    court = RETURN_X + HALF - 0.03
    soil_bed(model, rng, court, 2.44, inside, 0.22)
    soil_bed(model, rng, court, -2.14, 0.22, 2.40)
    soil_bed(model, rng, -2.94, 2.44, -1.44, outside)
    kerb(model, rng, (-2.04, 0.24), (2.56, 0.24))
    kerb(model, rng, (-2.10, 0.18), (-2.10, 2.46))
    kerb(model, rng, (-3.06, -1.50), (2.56, -1.50))
    kerb(model, rng, (-3.00, -1.44), (-3.00, -0.76))
    kerb(model, rng, (2.50, -1.44), (2.50, -0.84))
    kerb(model, rng, (2.50, -0.36), (2.50, 0.18))
    kerb(model, rng, (-2.70, 2.40), (-2.16, 2.40))


def paving(model, rng):
    """Random ashlar on a grid of 30 cm: slabs of five shapes, joints of 12 mm over sand."""
    x0, z0, cell, columns, rows = -3.3, -3.9, 0.3, 22, 26
    model.box("paving", "sand", (x0, -0.2, z0), (x0 + columns * cell, -0.02, z0 + rows * cell))
    free = {(i, k) for i in range(columns) for k in range(rows)}
    shapes = [((3, 2), 5), ((2, 3), 4), ((2, 2), 6), ((3, 3), 2), ((2, 1), 4), ((1, 2), 4), ((1, 1), 1)]
    for k in range(rows):
        for i in range(columns):
            if (i, k) not in free:
                continue
            fits = [(s, w) for s, w in shapes
                    if all((i + a, k + b) in free for a in range(s[0]) for b in range(s[1]))]
            wide, deep = pick(rng, fits)
            free -= {(i + a, k + b) for a in range(wide) for b in range(deep)}
            flag(model, rng, x0 + i * cell, z0 + k * cell, x0 + (i + wide) * cell, z0 + (k + deep) * cell)


def garden_wall():
    model, rng = Model(), random.Random(1989)
    main_wall(model, rng)
    return_wall(model, rng)
    for x in (-2.12, 0.64):
        buttress(model, rng, x)
    pier(model, rng, 2.76, MIDDLE, 0.24, 2.52, 0.13)
    pier(model, rng, RETURN_X, RETURN_END + 0.22, 0.24, 1.56, 0.13)
    WINDOW.surround(model, rng, MIDDLE, HALF)
    paving(model, rng)
    beds(model, rng)
    return model


def column():
    """Greene's figure 3: a round column, 0.3 m in radius, on a plinth."""
    model = Model()
    model.box("plinth", "limestone_grey", (-0.46, 0.0, -0.46), (0.46, 0.14, 0.46))
    turned(model, "plinth", "limestone_grey", 0, 0, 48,
           [(0.0, 0.13), (0.42, 0.13), (0.42, 0.16), (0.40, 0.20), (0.34, 0.24), (0.32, 0.26), (0.0, 0.26)])
    turned(model, "column", "marble", 0, 0, 48, [(0.0, 0.25), (0.30, 0.25), (0.30, 3.0), (0.0, 3.0)])
    return model


def maze_walls():
    """For figure 2's flat walk in the plane z = 0: a frame with bars that a walk must find its way around."""
    model, thick = Model(), 0.03
    bars = [((-1.0, 0.0), (1.0, 0.04)), ((-1.0, 1.46), (1.0, 1.5)), ((-1.0, 0.04), (-0.96, 1.46)),
            ((0.96, 0.04), (1.0, 1.46))]
    bars += [((-0.62, 0.34), (0.96, 0.38)), ((-0.96, 0.72), (-0.16, 0.76)), ((0.2, 0.72), (0.66, 0.76)),
             ((-0.58, 1.08), (0.34, 1.12)), ((0.62, 0.76), (0.66, 1.24)), ((-0.62, 1.08), (-0.58, 1.3))]
    for (x0, y0), (x1, y1) in bars:
        model.box("frame" if bars.index(((x0, y0), (x1, y1))) < 4 else "bars", "plaster", (x0, y0, -thick), (x1, y1, thick))
    return model


if __name__ == "__main__":
    here, maker = pathlib.Path(__file__).resolve().parent, "make_garden_wall.py"
    garden_wall().write(here / "garden_wall.obj", "A garden wall with an arched window", maker)
    column().write(here / "column.obj", "A round column on a plinth", maker)
    maze_walls().write(here / "maze_walls.obj", "A flat frame with bars", maker)
