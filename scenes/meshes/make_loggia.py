#!/usr/bin/env python3
"""Builds loggia.obj and loggia.mtl beside this script: a white room, open at the front, in which light bounces.

    python3 scenes/meshes/make_loggia.py

Standard library only; the same bytes on every run. Metres, y up, the floor at y = 0. The room looks to +z, with a red
wall on its left and a blue one on its right, a skylight in the ceiling, two blocks and a lamp above one of them.
Groups: floor, back, red, blue, ceiling, block, lamp.
"""
import pathlib

WIDTH, HEIGHT, DEPTH, THICK = 4.0, 3.0, 3.6, 0.24
SKYLIGHT = (-1.5, 0.3, -1.1, 0.3)  # from and to, along x and z
COLOURS = {"white": (232, 228, 218), "stone": (206, 198, 182), "red": (188, 52, 40), "blue": (58, 96, 158), "glass": (250, 240, 220)}


def box(low, high):
    """Corners and outward faces."""
    corners = [tuple((high if i >> axis & 1 else low)[axis] for axis in range(3)) for i in range(8)]
    return corners, [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]


def parts():
    x, z = 0.5 * WIDTH, 0.5 * DEPTH
    left, right, back, front = SKYLIGHT
    outer = x + THICK
    yield "floor", "stone", (-outer, -THICK, -z - THICK), (outer, 0.0, z + 0.6)
    yield "back", "white", (-outer, 0.0, -z - THICK), (outer, HEIGHT, -z)
    yield "red", "red", (-outer, 0.0, -z), (-x, HEIGHT, z)
    yield "blue", "blue", (x, 0.0, -z), (outer, HEIGHT, z)
    top = HEIGHT + THICK
    yield "ceiling", "white", (-outer, HEIGHT, -z - THICK), (left, top, z)
    yield "ceiling", "white", (right, HEIGHT, -z - THICK), (outer, top, z)
    yield "ceiling", "white", (left, HEIGHT, -z - THICK), (right, top, back)
    yield "ceiling", "white", (left, HEIGHT, front), (right, top, z)
    yield "block", "white", (-1.25, 0.0, -1.2), (-0.35, 1.5, -0.3)
    yield "block", "white", (0.55, 0.0, -0.35), (1.35, 0.7, 0.45)
    yield "lamp", "glass", (0.83, 0.95, -0.07), (1.07, 1.19, 0.17)


def main():
    folder = pathlib.Path(__file__).parent
    with open(folder / "loggia.mtl", "w", encoding="ascii", newline="\n") as out:
        for name, colour in COLOURS.items():
            out.write(f"newmtl {name}\nKd " + " ".join(f"{c / 255:.4f}" for c in colour) + "\n")
            if name == "glass":
                out.write("Ke 1.0000 0.9000 0.7000\n")
    count = 0
    with open(folder / "loggia.obj", "w", encoding="ascii", newline="\n") as out:
        out.write("mtllib loggia.mtl\n")
        for group, material, low, high in parts():
            corners, faces = box(low, high)
            out.write(f"g {group}\nusemtl {material}\n")
            for corner in corners:
                out.write("v " + " ".join(f"{c:.3f}" for c in corner) + "\n")
            for face in faces:
                out.write("f " + " ".join(str(count + i + 1) for i in face) + "\n")
            count += len(corners)


main()
