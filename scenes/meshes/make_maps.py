#!/usr/bin/env python3
"""Draws people.png and silt.png, pictures that say where attractors lie, and builds plain.obj and coast.obj (with their .mtl
files and the pictures painted on them) beside this script.

    python3 scenes/meshes/make_maps.py

Standard library only; the same bytes on every run. Metres, y up; x to the east, z to the south. A plain with towns, 16 km by
12 km; and a coast where a river has built land into the sea, as large.
"""
import functools
import math
import pathlib
import random
import struct
import zlib

WIDE, HIGH = 16.0, 12.0  # km


def bell(distance, width):
    return math.exp(-0.5 * (distance / width) ** 2)


def mix(a, b, t):
    t = min(1.0, max(0.0, t))
    return tuple(p + (q - p) * t for p, q in zip(a, b))


def step(low, high, t):
    t = min(1.0, max(0.0, (t - low) / (high - low)))
    return t * t * (3 - 2 * t)


class Noise:
    """Smooth noise of mean 0, about -1 to 1: values on a grid that repeats, in several octaves."""

    def __init__(self, seed, octaves=4):
        rng = random.Random(seed)
        self.values = [rng.uniform(-1, 1) for _ in range(64 * 64)]
        self.octaves = octaves

    def smooth(self, x, y):
        i, j = math.floor(x), math.floor(y)
        u, v = step(0, 1, x - i), step(0, 1, y - j)

        def at(a, b):
            return self.values[(b % 64) * 64 + a % 64]
        top, bottom = at(i, j) * (1 - u) + at(i + 1, j) * u, at(i, j + 1) * (1 - u) + at(i + 1, j + 1) * u
        return top * (1 - v) + bottom * v

    def __call__(self, x, y):
        return sum(self.smooth(x * 2 ** o + 17.3 * o, y * 2 ** o + 5.1 * o) / 2 ** o for o in range(self.octaves))


class Cells:
    """Fields: the nearest of points strewn one to a square, and how far the border to the next one is."""

    def __init__(self, seed, size):
        self.seed, self.size = seed, size

    @functools.lru_cache(maxsize=None)
    def middle(self, i, j):
        rng = random.Random((self.seed * 7919 + i) * 7919 + j)
        return (i + rng.uniform(0.1, 0.9)) * self.size, (j + rng.uniform(0.1, 0.9)) * self.size, rng.random()

    def __call__(self, x, y):
        i, j = math.floor(x / self.size), math.floor(y / self.size)
        near = sorted((math.hypot(x - a, y - b), hue) for a, b, hue in
                      (self.middle(i + di, j + dj) for di in (-1, 0, 1) for dj in (-1, 0, 1)))
        return near[0][1], near[1][0] - near[0][0]


# Middle, width in km, and how dense.
TOWNS = [(-1.6, 0.4, 1.25, 1.0), (4.9, -3.1, 0.70, 0.85), (5.6, 2.9, 0.60, 0.75), (-5.7, -3.4, 0.65, 0.75),
         (-5.4, 3.9, 0.50, 0.65), (0.6, -4.5, 0.35, 0.6), (1.9, 4.6, 0.40, 0.6), (-7.0, 0.5, 0.28, 0.5),
         (-3.4, -5.0, 0.25, 0.45), (7.0, 0.1, 0.30, 0.5), (-2.2, 4.9, 0.28, 0.5), (4.4, 5.1, 0.25, 0.45)]
ROUGH, RELIEF, FIELDS = Noise(3), Noise(8), Cells(5, 0.55)


def stream(z):
    """How far east the river runs."""
    return 2.05 + 0.75 * math.sin(0.62 * z + 0.6) + 0.3 * math.sin(1.5 * z)


def water(x, z):
    """Above 0 in the river and in the lake."""
    river = 0.13 - abs(x - stream(z)) / math.hypot(1, 0.6)
    lake = 0.75 - math.hypot((x + 4.4) / 1.5, z - 0.9) + 0.12 * ROUGH(1.3 * x, 1.3 * z)
    return max(river, 0.6 * lake)


def woods(x, z):
    return RELIEF(0.33 * x, 0.33 * z) - 0.45


def towns(x, z):
    out = 1 + 0.22 * ROUGH(0.8 * x, 0.8 * z)
    return max(weight * bell(math.hypot(x - a, z - b) * out, width) for a, b, width, weight in TOWNS)


def people(x, z):
    """How densely the plain is settled: not at all on water, hardly in woods."""
    if water(x, z) > -0.02:
        return 0.0
    return max(towns(x, z) ** 1.3, 0.05 * step(0.05, -0.15, woods(x, z)))


def plain_colour(x, z):
    hue, border = FIELDS(x + 0.12 * ROUGH(x, z), z)
    crops = ((126, 142, 84), (148, 152, 96), (112, 132, 78), (166, 158, 108), (134, 146, 92), (122, 136, 88))
    colour = crops[int(hue * len(crops))]
    colour = mix((104, 118, 74), colour, border / 0.05)
    colour = mix(colour, (66, 90, 58), step(-0.04, 0.04, woods(x, z)) * (0.9 + 0.1 * ROUGH(9 * x, 9 * z)))
    colour = mix(colour, (186, 178, 166), 0.9 * step(0.16, 0.5, towns(x, z) + 0.05 * ROUGH(5 * x, 5 * z)))
    wet = water(x, z)
    colour = mix(colour, (88, 126, 146), step(-0.012, 0.012, wet))
    shade = 1 + 0.05 * RELIEF(0.9 * x, 0.9 * z) * (wet < 0)
    return tuple(c * shade for c in colour)


APEX = (0.0, -2.9)  # of the delta: the river comes from the north
COAST, SHOALS, MARSH = Noise(21, 5), Noise(33), Noise(40, 3)


def upstream(z):
    """How far east the river runs before it parts."""
    return 0.55 * math.sin(1.15 * (z - APEX[1])) * step(0, 1.5, APEX[1] - z)


def built(x, z):
    """How far within the land that the river has built, in km; below 0 beyond it."""
    dx, dz = x - APEX[0], z - APEX[1]
    way = math.atan2(dx, dz)  # 0 is south
    reach = 7.15 * math.cos(0.62 * way) + 0.42 * math.cos(5 * way + 0.5) + 0.3 * COAST(2.2 * way + 3, 0.4 * dx)
    return min(reach - math.hypot(dx, dz), 4.5 * (1.22 - abs(way)) * math.hypot(dx, dz) / 3)


def shore(x, z):
    """Above 0 on land: the old coast, and what was built."""
    old = -1.1 - z + 0.035 * x * x + 0.4 * COAST(0.45 * x, 0.3)
    return max(old, built(x, z) + 0.05 * COAST(1.5 * x, 1.5 * z))


def bars(x, z):
    """Above 0 on bars of sand, which lie along the way to the sea."""
    dx, dz = x - APEX[0], z - APEX[1]
    far = math.hypot(dx, dz)
    return SHOALS(5.5 * math.atan2(dx, dz) + 0.12 * far, 0.42 * far) - 0.38 + 0.25 * bell(far, 2.2) * -2


def silt(x, z):
    """Where channels go: over all that was built, most to the sea, and not over its bars; and where the river comes."""
    if z < APEX[1]:
        return 0.5 * bell(x - upstream(z), 0.05)
    deep = built(x, z)
    if deep < -0.12:
        return 0.0
    if math.hypot(x - APEX[0], z - APEX[1]) < 0.5:
        return 0.5
    return step(0.05, -0.07, bars(x, z)) * (0.35 + 0.65 * bell(deep - 0.1, 1.1))


def coast_colour(x, z):
    land, deep = shore(x, z), built(x, z)
    if land < 0:
        plume = step(-2.4, 0.0, deep + 0.25 * COAST(0.8 * x, 0.8 * z))
        return mix((38, 72, 100), mix((70, 124, 142), (140, 158, 142), step(0.62, 1.0, plume)), plume)
    upland = mix((96, 110, 72), (126, 126, 86), 0.5 + 0.6 * RELIEF(0.7 * x, 0.7 * z))
    plain = mix((112, 134, 86), (142, 148, 100), 0.5 + 0.6 * MARSH(1.1 * x, 1.1 * z))
    plain = mix(plain, (90, 118, 84), step(0.2, 0.6, MARSH(0.6 * x + 9, 0.6 * z)))
    plain = mix(plain, (196, 184, 146), step(-0.04, 0.12, bars(x, z)))
    colour = mix(upland, plain, step(-0.1, 0.25, deep))
    return mix((206, 194, 158), colour, step(0.02, 0.16, land))  # a beach


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_png(path, width, height, value):
    """`value` of a place gives a grey from 0 to 1, or a display colour from 0 to 255."""
    rows, grey = [], isinstance(value(0.0, 0.0), float)
    for j in range(height):
        row = bytearray([0])
        for i in range(width):
            at = value(((i + 0.5) / width - 0.5) * WIDE, ((j + 0.5) / height - 0.5) * HIGH)
            row += bytes([round(255 * at)] if grey else [min(255, max(0, round(c))) for c in at])
        rows.append(bytes(row))
    head = struct.pack(">IIBBBBB", width, height, 8, 0 if grey else 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(b"".join(rows), 9))
                     + chunk(b"IEND", b""))
    print(f"{path.name}: {width} x {height}")


def write_ground(path, about, colour):
    """A level rectangle with a picture on it."""
    x, z = 500 * WIDE, 500 * HIGH
    path.write_text("\n".join([
        f"# {about}", "# Made by make_maps.py; metres, y up.", f"mtllib {path.stem}.mtl",
        f"v {-x:g} 0 {z:g}", f"v {x:g} 0 {z:g}", f"v {x:g} 0 {-z:g}", f"v {-x:g} 0 {-z:g}",
        "vt 0 0", "vt 1 0", "vt 1 1", "vt 0 1", f"g {path.stem}", f"usemtl {path.stem}", "f 1/1 2/2 3/3 4/4"]) + "\n")
    path.with_suffix(".mtl").write_text(
        f"# Made by make_maps.py\nnewmtl {path.stem}\nKd 1 1 1\nmap_Kd {path.stem}.png\n")
    write_png(path.with_suffix(".png"), 720, 540, colour)


if __name__ == "__main__":
    here = pathlib.Path(__file__).resolve().parent
    write_png(here / "people.png", 240, 180, people)
    write_png(here / "silt.png", 240, 180, silt)
    write_ground(here / "plain.obj", "A plain with fields, woods and towns", plain_colour)
    write_ground(here / "coast.obj", "Land that a river has built into the sea", coast_colour)
