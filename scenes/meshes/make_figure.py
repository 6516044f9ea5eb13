#!/usr/bin/env python3
"""Builds figure.obj (with its .mtl file) beside this script: a standing human figure, its arms a little away from it.

    python3 scenes/meshes/make_figure.py

Standard library only; the same bytes on every run. Metres, y up, the figure's feet at y = 0 and its face to +z. Limbs are
cones with round ends that run softly into each other; their common surface is found in a grid of cubes, one corner to each
cube that it passes (surface nets), so that the mesh is closed.
"""
import math
import pathlib

import masonry
from masonry import Model

masonry.COLOURS.update({"skin": (226, 186, 164)})

CELL = 0.022
SOFT = 0.035

# From, to, radius there and there; half of them are on the left (+x), the others mirror these.
MIDDLE = [((0, 1.62, 0.015), (0, 1.66, 0.01), 0.088, 0.092),    # head
          ((0, 1.43, -0.01), (0, 1.56, 0.0), 0.056, 0.054),     # neck
          ((0, 1.22, 0.0), (0, 1.33, -0.01), 0.122, 0.105),     # chest
          ((0, 1.05, 0.0), (0, 1.16, 0.0), 0.105, 0.115),       # waist
          ((0, 0.93, 0.0), (0, 0.99, 0.0), 0.118, 0.112)]       # hips
LEFT = [((0.06, 1.28, 0.0), (0.15, 1.38, -0.01), 0.095, 0.062),  # shoulder
        ((0.165, 1.375, -0.01), (0.27, 1.11, -0.02), 0.056, 0.043),  # upper arm
        ((0.27, 1.11, -0.02), (0.34, 0.87, 0.015), 0.042, 0.031),    # forearm
        ((0.345, 0.85, 0.02), (0.37, 0.74, 0.035), 0.032, 0.024),    # hand
        ((0.08, 0.92, 0.0), (0.105, 0.52, 0.01), 0.096, 0.062),      # thigh
        ((0.105, 0.52, 0.01), (0.115, 0.10, -0.015), 0.060, 0.038),  # shank
        ((0.115, 0.05, -0.03), (0.135, 0.035, 0.13), 0.042, 0.030)]  # foot


def parts():
    mirrored = [((-a[0], a[1], a[2]), (-b[0], b[1], b[2]), r, q) for a, b, r, q in LEFT]
    return MIDDLE + LEFT + mirrored


def distance(p, part):
    """To a cone with round ends; below 0 inside it."""
    a, b, r, q = part
    along = tuple(y - x for x, y in zip(a, b))
    to = tuple(y - x for x, y in zip(a, p))
    t = sum(x * y for x, y in zip(along, to)) / sum(x * x for x in along)
    t = min(1.0, max(0.0, t))
    return math.dist(to, tuple(t * x for x in along)) - (r + t * (q - r))


def field(p, all_parts):
    """Softly the least of the distances."""
    near = [d for d in (distance(p, part) for part in all_parts) if d < 0.3]
    if not near:
        return 0.3
    least = min(near)
    return least - SOFT * math.log(sum(math.exp((least - d) / SOFT * 2.0) for d in near)) / 2.0


def figure():
    low, size = (-0.47, -0.05, -0.20), (43, 85, 19)
    all_parts = parts()

    def corner(i, j, k):
        return tuple(o + CELL * n for o, n in zip(low, (i, j, k)))
    values = {(i, j, k): field(corner(i, j, k), all_parts)
              for i in range(size[0] + 1) for j in range(size[1] + 1) for k in range(size[2] + 1)}
    steps = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1), (1, 1, 1)]
    edges = [(a, b) for a in range(8) for b in range(a + 1, 8)
             if sum(x != y for x, y in zip(steps[a], steps[b])) == 1]
    points = {}
    for i in range(size[0]):
        for j in range(size[1]):
            for k in range(size[2]):
                at = [(i + x, j + y, k + z) for x, y, z in steps]
                met = []
                for a, b in edges:
                    va, vb = values[at[a]], values[at[b]]
                    if (va < 0) != (vb < 0):
                        t = va / (va - vb)
                        met.append(tuple(x + t * (y - x) for x, y in zip(corner(*at[a]), corner(*at[b]))))
                if met:
                    points[(i, j, k)] = tuple(sum(c) / len(met) for c in zip(*met))
    model = Model()
    turns = [((1, 0, 0), (0, 1, 0), (0, 0, 1)), ((0, 1, 0), (0, 0, 1), (1, 0, 0)), ((0, 0, 1), (1, 0, 0), (0, 1, 0))]

    def less(cube, *ways):
        return tuple(c - sum(way[n] for way in ways) for n, c in enumerate(cube))
    for (i, j, k), value in values.items():
        for along, u, v in turns:
            other = (i + along[0], j + along[1], k + along[2])
            if other not in values or (value < 0) == (values[other] < 0):
                continue
            around = [less((i, j, k), u, v), less((i, j, k), v), (i, j, k), less((i, j, k), u)]
            if not all(cube in points for cube in around):
                continue
            quad = [points[cube] for cube in around]
            if value >= 0:
                quad.reverse()
            model.face("figure", "skin", [quad[0], quad[1], quad[2]])
            model.face("figure", "skin", [quad[0], quad[2], quad[3]])
    return model


def write_smooth(model, path, about):
    """With the normal of the figure's surface at each corner, so that it has no facets where light glances off it."""
    model.write(path, about, maker="make_figure.py")
    all_parts = parts()

    def normal(p):
        reach = 0.004
        slope = []
        for axis in range(3):
            ahead, behind = list(p), list(p)
            ahead[axis] += reach
            behind[axis] -= reach
            slope.append(field(ahead, all_parts) - field(behind, all_parts))
        length = math.sqrt(sum(c * c for c in slope))
        return tuple(c / length for c in slope)
    lines = path.read_text().splitlines()
    last = max(i for i, line in enumerate(lines) if line.startswith("v "))
    normals = ["vn " + " ".join(f"{c:.3f}" for c in normal(p)) for p in model.points]
    faces = [" ".join(["f"] + [f"{c}//{c}" for c in line.split()[1:]]) if line.startswith("f ") else line
             for line in lines[last + 1:]]
    path.write_text("\n".join(lines[:last + 1] + normals + faces) + "\n")


if __name__ == "__main__":
    here = pathlib.Path(__file__).resolve().parent
    write_smooth(figure(), here / "figure.obj", "A standing figure")
