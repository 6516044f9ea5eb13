#!/usr/bin/env python3
"""Builds bubble.obj, window.obj, glass.obj, snow.obj and dusk.obj (with their .mtl files, and dusk.png) beside this script.

    python3 scenes/meshes/make_winter.py

Standard library only; the same bytes on every run. Metres, y up. A bubble of radius 0.5 m with the normals of a sphere; a
window of one pane in a frame of wood, and its glass; a field of snow; and a board with a winter dusk on it, out of focus, to
stand far behind the glass.
"""
import math
import pathlib
import random
import struct
import zlib

import masonry
from make_shapes import ball
from masonry import Model

masonry.COLOURS.update({"wood": (72, 54, 44), "wood_dark": (54, 40, 33), "snow": (160, 178, 212), "glass": (190, 216, 240)})

WIDE, HIGH, BAR = 1.2, 0.9, 0.12  # of the glass; of the frame around it


def write_bubble(path):
    corners, faces = ball(4)
    out = ["# A bubble of radius 0.5 m", "# Made by make_winter.py; metres, y up.", f"mtllib {path.with_suffix('.mtl').name}"]
    number = "{:.4f}".format
    out += ["v " + " ".join(number(0.5 * c) for c in p) for p in corners]
    out += ["vn " + " ".join(number(c) for c in p) for p in corners]
    out += ["g bubble", "usemtl glass"]
    out += ["f " + " ".join(f"{i + 1}//{i + 1}" for i in face) for face in faces]
    path.write_text("\n".join(out) + "\n")
    write_clear(path.with_suffix(".mtl"), 0.03)


def write_clear(path, opacity):
    kd = " ".join(f"{c / 255:.4f}" for c in masonry.COLOURS["glass"])
    path.write_text(f"# Made by make_winter.py\nnewmtl glass\nKd {kd}\nd {opacity}\n")


def write_glass(path):
    x, y = WIDE / 2, HIGH / 2
    path.write_text("\n".join([
        "# The glass of window.obj", "# Made by make_winter.py; metres, y up.", f"mtllib {path.with_suffix('.mtl').name}",
        *(f"v {a} {b} 0" for a, b in ((-x, -y), (x, -y), (x, y), (-x, y))), "g glass", "usemtl glass", "f 1 2 3 4"]) + "\n")
    write_clear(path.with_suffix(".mtl"), 0.01)


def window():
    """Bars around the glass, mitred by eye: the sill below stands out."""
    model = Model()
    x, y = WIDE / 2, HIGH / 2
    front, back = 0.015, -0.05
    model.box("frame", "wood", (-x - BAR, y, back), (x + BAR, y + BAR, front))
    for side in (-1, 1):
        low, high = sorted((side * x, side * (x + BAR)))
        model.box("frame", "wood", (low, -y, back), (high, y, front))
    model.box("frame", "wood", (-x - BAR, -y - BAR, back), (x + BAR, -y, front))
    model.box("sill", "wood_dark", (-x - 2 * BAR, -y - BAR - 0.04, back), (x + 2 * BAR, -y - BAR, 0.14))
    return model


def snow():
    """Level but for low drifts."""
    model, step, reach = Model(), 0.25, 5.0

    def height(x, z):
        return 0.02 * math.sin(1.3 * x + 0.7 * z) + 0.015 * math.sin(2.1 * z - 0.8 * x + 1.0) - 0.035
    n = round(2 * reach / step)
    for i in range(n):
        for k in range(n):
            xs, zs = [(-reach + step * (i + d)) for d in (0, 1)], [(-reach + step * (k + d)) for d in (0, 1)]
            quad = [(xs[0], zs[0]), (xs[0], zs[1]), (xs[1], zs[1]), (xs[1], zs[0])]
            model.face("snow", "snow", [(a, height(a, b), b) for a, b in quad])
    return model


def write_board(path):
    """A board 8 m wide and 6 m high that looks to +z."""
    path.write_text("\n".join([
        "# A winter dusk, far away", "# Made by make_winter.py; metres, y up.", f"mtllib {path.with_suffix('.mtl').name}",
        "v -4 -3 0", "v 4 -3 0", "v 4 3 0", "v -4 3 0", "vt 0 0", "vt 1 0", "vt 1 1", "vt 0 1", "g dusk", "usemtl dusk",
        "f 1/1 2/2 3/3 4/4"]) + "\n")
    path.with_suffix(".mtl").write_text("# Made by make_winter.py\nnewmtl dusk\nKd 0.62 0.62 0.76\nmap_Kd dusk.png\n")
    write_picture(path.with_suffix(".png"), 512, 384)


def write_picture(path, width, height):
    rng = random.Random(11)
    lights = [(rng.random(), 0.27 + 0.10 * rng.random(), 0.010 + 0.016 * rng.random(), rng.random()) for _ in range(26)]
    trees = [(rng.random(), 0.05 + 0.10 * rng.random(), 0.02 + 0.03 * rng.random()) for _ in range(16)]

    def mix(a, b, t):
        t = min(1.0, max(0.0, t))
        return tuple(p + (q - p) * t for p, q in zip(a, b))

    rows = []
    for j in range(height):
        up = 1 - (j + 0.5) / height
        row = bytearray([0])
        for i in range(width):
            across = (i + 0.5) / width
            sky = mix((94, 92, 128), (14, 28, 70), (up - 0.36) / 0.45)
            sky = mix((196, 150, 138), sky, (up - 0.30) / 0.16)
            ridge = 0.36 + 0.03 * math.sin(5.1 * across + 1.2) + 0.015 * math.sin(13.0 * across)
            for at, tall, wide in trees:
                ridge = max(ridge, 0.34 + tall * max(0.0, 1 - ((across - at) / wide) ** 2))
            colour = mix((18, 28, 58), sky, (up - ridge) / 0.05 + 0.5)
            colour = mix((58, 78, 124), colour, (up - 0.26) / 0.07)
            colour = mix((30, 44, 88), colour, up / 0.26)
            for x, y, r, hue in lights:
                d = math.hypot((across - x) * width / height, up - y) / r
                colour = mix(colour, mix((255, 176, 92), (255, 226, 168), hue), 0.75 * min(1.0, max(0.0, (1.15 - d) / 0.3)))
            row += bytes(round(c) for c in colour)
        rows.append(bytes(row))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) + chunk(b"IEND", b""))


if __name__ == "__main__":
    here = pathlib.Path(__file__).resolve().parent
    write_bubble(here / "bubble.obj")
    write_glass(here / "glass.obj")
    write_board(here / "dusk.obj")
    for name, model, about in (("window", window(), "A window without its glass"), ("snow", snow(), "A field of snow")):
        model.write(here / f"{name}.obj", about, maker="make_winter.py")
