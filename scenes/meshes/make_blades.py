#!/usr/bin/env python3
"""Builds blade_ovate.obj, blade_lobed.obj, leaf_stalk.obj and leaf_sheet.obj (with their .mtl files) beside this script: the
outlines of leaves, flat and open, and a sheet of paper that they are laid before.

    python3 scenes/meshes/make_blades.py

Standard library only; the same bytes on every run. Centimetres, y up. They stand upright in the plane z = 0 and show their faces to
+z. The ovate one is a blade of 10 cm with a drawn-out tip, its foot at the origin, and the stalk that goes with it ends there. The
lobed one has five lobes about the point where its stalk ends, which is part of it and begins at the origin.
"""
import math
import pathlib

import masonry
from masonry import Model

masonry.COLOURS.update({"blade_green": (92, 132, 58), "blade_red": (156, 62, 38), "paper": (249, 246, 238)})

STALK, STALK_HALF = 1.4, 0.09


def half_width(t):
    """Of the ovate blade, from its foot (0) to its tip (1)."""
    body = math.sin(math.pi * t ** 0.74) ** 0.86
    tip = 1 - 0.42 * math.exp(-((1 - t) / 0.13) ** 2) * (1 - t) ** 0.12
    teeth = 1 - 0.018 * ((t * 26) % 1)
    return 3.15 * body * tip * teeth


def ovate():
    model, length, rows = Model(), 10, 130
    lines = []
    for i in range(rows + 1):
        t = i / rows
        lines.append((length * t, max(half_width(t), STALK_HALF if i == 0 else 0.0)))
    for (y0, w0), (y1, w1) in zip(lines, lines[1:]):
        if w1 > 1e-3:
            model.face("blade", "blade_green", [(-w0, y0, 0), (w0, y0, 0), (w1, y1, 0), (-w1, y1, 0)])
        else:
            model.face("blade", "blade_green", [(-w0, y0, 0), (w0, y0, 0), (0, y1, 0)])
    return model


def stalk():
    model = Model()
    model.face("stalk", "blade_green", [(-STALK_HALF, -STALK, 0), (STALK_HALF, -STALK, 0), (STALK_HALF, 0, 0), (-STALK_HALF, 0, 0)])
    return model


LOBES = ((0, 6.3, 27), (50, 5.6, 25), (-50, 5.6, 25), (104, 3.9, 26), (-104, 3.9, 26))  # degrees from up, length, half width


def reach(angle):
    """How far the lobed blade goes that way from where its stalk ends; angles from straight up."""
    far = 2.3 - 1.3 * min(1.0, max(0.0, abs(angle) - 138) / 42) ** 1.5
    for at, length, half in LOBES:
        off = abs((angle - at + 180) % 360 - 180) / half
        if off < 1:
            teeth = 1 + 0.055 * (math.cos(2 * math.pi * 2.5 * off) - 1) * math.sin(math.pi * off)
            far = max(far, (far + (length - far) * (1 - off) ** 1.12) * teeth)
    return far


def lobed():
    model, steps = Model(), 480
    foot = 3.0
    model.face("blade", "blade_red", [(-STALK_HALF, 0, 0), (STALK_HALF, 0, 0), (STALK_HALF, foot, 0), (-STALK_HALF, foot, 0)])
    rim = []
    for i in range(steps):
        angle = -180 + 360 * i / steps
        far, a = reach(angle), math.radians(angle)
        rim.append((far * math.sin(a), foot + far * math.cos(a), 0))
    for a, b in zip(rim, rim[1:] + rim[:1]):
        model.face("blade", "blade_red", [(0, foot, 0), b, a])
    return model


def sheet():
    model = Model()
    model.face("sheet", "paper", [(-9, -2.3, -0.2), (9, -2.3, -0.2), (9, 10.9, -0.2), (-9, 10.9, -0.2)])
    return model


if __name__ == "__main__":
    here = pathlib.Path(__file__).resolve().parent
    maker = pathlib.Path(__file__).name
    ovate().write(here / "blade_ovate.obj", "The outline of an ovate leaf", maker, "centimetres, y up")
    stalk().write(here / "leaf_stalk.obj", "The stalk of a leaf", maker, "centimetres, y up")
    sheet().write(here / "leaf_sheet.obj", "A sheet of paper behind leaves", maker, "centimetres, y up")
    lobed().write(here / "blade_lobed.obj", "The outline of a lobed leaf", maker, "centimetres, y up")
