#!/usr/bin/env python3
"""Builds open_cube.obj, gable_lines.obj, gable_faces.obj and ground.obj (with their .mtl files) beside this script.

    python3 scenes/meshes/make_rough.py

Standard library only; the same bytes on every run. Metres, y up. All stand on y = 0; the cube is open to +z. The gabled house
is a sketch that limbs follow (figure 9 of Ned Greene's "Voxel Space Automata", SIGGRAPH 1989), and no solid.
"""
import math
import pathlib

import masonry
from masonry import Model

masonry.COLOURS.update({"chalk": (224, 220, 212), "gravel": (158, 150, 138)})


def open_cube():
    """Walls, floor and ceiling 10 cm thick around an inside 1.4 m wide."""
    model, half, thick = Model(), 0.7, 0.1
    outer = half + thick
    model.box("cube", "chalk", (-outer, 0, -outer), (outer, thick, half))
    model.box("cube", "chalk", (-outer, thick + 2 * half, -outer), (outer, 2 * outer, half))
    model.box("cube", "chalk", (-outer, thick, -outer), (outer, thick + 2 * half, -half))
    for low, high in ((-outer, -half), (half, outer)):
        model.box("cube", "chalk", (low, thick, -half), (high, thick + 2 * half, half))
    model.box("ground", "gravel", (-9, -0.1, -9), (9, 0, 9))
    return model


def arch(half, foot, crown, steps=12):
    """A pointed arch from left to right: two arcs about the other side's foot."""
    rise = crown - foot
    side = [(-half * (1 - math.sin(0.5 * math.pi * i / steps) ** 2), foot + rise * math.sin(0.5 * math.pi * i / steps))
            for i in range(steps + 1)]
    return side + [(-x, y) for x, y in side[-2::-1]]


class Lines:
    """Polylines by group."""

    def __init__(self):
        self.points, self.groups = [], {}

    def line(self, group, points):
        first = len(self.points) + 1
        self.points += points
        self.groups.setdefault(group, []).append(range(first, first + len(points)))

    def write(self, path, about):
        out = [f"# {about}", "# Made by make_rough.py; metres, y up."]
        out += ["v " + " ".join(f"{c:.4f}".rstrip("0").rstrip(".") for c in p) for p in self.points]
        for group, lines in self.groups.items():
            out.append(f"g {group}")
            out += ["l " + " ".join(map(str, line)) for line in lines]
        path.write_text("\n".join(out) + "\n", encoding="ascii")
        print(f"{path.name}: {len(self.points)} vertices, groups {', '.join(self.groups)}")


HALF, FRONT, BACK, EAVES, RIDGE = 2.1, 1.2, -2.0, 2.7, 4.9  # of the gabled house


def gable_lines():
    """Posts, arches, eaves and the railing of a terrace: what limbs follow as lines."""
    lines = Lines()
    for z in (FRONT, BACK):
        for x in (-HALF, HALF):
            lines.line("posts", [(x, 0, z), (x, EAVES, z)])
        for half, foot, crown in ((HALF, EAVES, RIDGE), (0.72, 0.0, 2.5)):
            lines.line("gables", [(x, y, z) for x, y in arch(half, foot, crown)])
    for x in (-1.41, 1.41):
        lines.line("gables", [(x + dx, y, FRONT) for dx, y in arch(0.38, 0.0, 1.75)])
    for x in (-HALF - 0.35, HALF + 0.35):
        lines.line("eaves", [(x, EAVES - 0.3, z) for z in (BACK, FRONT)])
    low, middle, high, z, bay = 0.15, 0.62, 1.05, 2.4, 1.2
    for i in range(5):
        x = -2.4 + bay * i
        lines.line("railing", [(x, 0, z), (x, low, z), (x, high, z)])
    for i in range(4):
        a, b = -2.4 + bay * i, -2.4 + bay * (i + 1)
        lines.line("railing", [(a, low, z), (0.5 * (a + b), low, z), (b, low, z)])
        lines.line("railing", [(a, high, z), (0.5 * (a + b), high, z), (b, high, z)])
        lines.line("railing", [(a, low, z), (0.5 * (a + b), middle, z), (b, low, z)])
        lines.line("railing", [(0.5 * (a + b), middle, z), (0.5 * (a + b), high, z)])
    return lines


def gable_faces():
    """Its walls and roof, without thickness."""
    model = Model()
    for x in (-HALF, HALF):
        model.face("walls", "chalk", [(x, 0, BACK), (x, 0, FRONT), (x, EAVES, FRONT), (x, EAVES, BACK)])
    model.face("walls", "chalk", [(-HALF, 0, BACK), (HALF, 0, BACK), (HALF, EAVES, BACK), (-HALF, EAVES, BACK)])
    profile = arch(HALF, EAVES, RIDGE)
    profile = [(-HALF - 0.35, EAVES - 0.3)] + profile + [(HALF + 0.35, EAVES - 0.3)]
    for (x0, y0), (x1, y1) in zip(profile, profile[1:]):
        model.face("roof", "gravel", [(x0, y0, FRONT), (x1, y1, FRONT), (x1, y1, BACK), (x0, y0, BACK)])
    return model


def ground():
    model = Model()
    model.box("ground", "gravel", (-9, -0.1, -9), (9, 0, 9))
    return model


if __name__ == "__main__":
    here = pathlib.Path(__file__).resolve().parent
    open_cube().write(here / "open_cube.obj", "A cube with one side open", maker="make_rough.py")
    gable_lines().write(here / "gable_lines.obj", "A gabled house, sketched: posts, arches, eaves and a railing")
    gable_faces().write(here / "gable_faces.obj", "A gabled house, sketched: walls and roof", maker="make_rough.py")
    ground().write(here / "ground.obj", "Ground", maker="make_rough.py")
