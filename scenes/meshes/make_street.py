#!/usr/bin/env python3
"""Builds street.obj and street.mtl beside this script: a street corner with an arcade, a square and a tower.

    python3 scenes/meshes/make_street.py

Standard library only; the same bytes on every run. Metres, y up, north is -z. The arcade looks south, as those of
Bologna do, over a street eight metres wide and a square. Groups: street, pavement, square, arcade, roofs, tower, and
the facades by the way that they look: facade_south, facade_north, facade_east, facade_west.
"""
import math
import pathlib

import masonry
from masonry import Model, spaced, turned

masonry.COLOURS.update({
    "plaster_red": (190, 108, 80),
    "plaster_ochre": (214, 160, 98),
    "plaster_rose": (206, 140, 114),
    "plaster_straw": (222, 188, 132),
    "brick_old": (158, 104, 80),
    "stone_pale": (214, 203, 184),
    "stone_warm": (196, 180, 154),
    "roof_tile": (164, 94, 66),
    "roof_tile_dark": (146, 84, 62),
    "shutter": (76, 96, 78),
    "shadow_glass": (70, 76, 84),
    "door": (104, 74, 56),
    "cobble": (138, 132, 126),
    "flag_pale": (192, 182, 168),
    "flag_dark": (172, 160, 146),
    "water": (110, 136, 140),
})

FACADE = {(0, 1): "facade_south", (0, -1): "facade_north", (1, 0): "facade_east", (-1, 0): "facade_west"}
DEEP = 0.3       # of windows and doors
SOCKEL = 0.2     # height of pavements and of the arcade's floor


class Wall:
    """An upright rectangle seen from outside: u runs to the right, v up; `out` is the way that it looks (x, z)."""

    def __init__(self, model, group, material, origin, out, width, low, high):
        self.model, self.group, self.material = model, group, material
        self.origin, self.out, self.along = origin, out, (out[1], -out[0])
        self.width, self.low, self.high = width, low, high

    def at(self, u, v, depth=0.0):
        x, z = self.origin
        return (x + u * self.along[0] - depth * self.out[0], v, z + u * self.along[1] - depth * self.out[1])

    def quad(self, u0, u1, v0, v1, material=None, depth=0.0):
        if u1 - u0 > 1e-6 and v1 - v0 > 1e-6:
            self.model.face(self.group, material or self.material,
                            [self.at(u0, v0, depth), self.at(u1, v0, depth), self.at(u1, v1, depth), self.at(u0, v1, depth)])

    def build(self, rows):
        """`rows`: (sill, head, [middles], half width, what fills it), from the lowest up, none above another."""
        v = self.low
        for sill, head, middles, half, fill in rows:
            self.quad(0, self.width, v, sill)
            u = 0.0
            for m in middles:
                self.quad(u, m - half, sill, head)
                self.opening(m - half, m + half, sill, head, fill)
                u = m + half
            self.quad(u, self.width, sill, head)
            v = head
        self.quad(0, self.width, v, self.high)

    def opening(self, u0, u1, v0, v1, fill):
        face = self.model.face
        stone = "stone_pale"
        a, b, c, d = [(u0, v0), (u1, v0), (u1, v1), (u0, v1)]
        for (p, q) in ((a, b), (b, c), (c, d), (d, a)):
            face(self.group, stone, [self.at(*p), self.at(*q), self.at(*q, DEEP), self.at(*p, DEEP)])
        if fill == "shutters":  # one leaf open against the wall would be finer than a voxel: closed, or half
            middle = 0.5 * (u0 + u1)
            self.quad(u0, middle, v0, v1, "shutter", DEEP)
            self.quad(middle, u1, v0, v1, "shadow_glass", DEEP)
        else:
            self.quad(u0, u1, v0, v1, fill, DEEP)
        # A sill that stands out.
        if v0 > self.low + 0.5:
            s, t, out = u0 - 0.15, u1 + 0.15, 0.2
            self.model.prism(self.group, stone,
                             [self.at(s, v0 - 0.2, -out), self.at(t, v0 - 0.2, -out), self.at(t, v0, -out),
                              self.at(s, v0, -out)], (-out * self.out[0], 0, -out * self.out[1]))


def middles(width, step, margin):
    count = max(1, int((width - 2 * margin) // step))
    start = 0.5 * (width - (count - 1) * step)
    return [start + i * step for i in range(count)]


def storeys(width, first, height, count, step=3.0, margin=1.2, half=0.6, tall=1.8):
    return [(first + i * height, first + i * height + tall, middles(width, step, margin), half,
             "shutters" if i % 2 == 0 else "shutter") for i in range(count)]


def hip_roof(model, x0, x1, z0, z1, eaves, pitch, over=0.7):
    """A hipped roof with eaves that stand out, closed below the eaves."""
    walls = [(x0, eaves, z0), (x0, eaves, z1), (x1, eaves, z1), (x1, eaves, z0)]
    x0, x1, z0, z1 = x0 - over, x1 + over, z0 - over, z1 + over
    half = 0.5 * min(x1 - x0, z1 - z0)
    top = eaves + 0.25 + half * math.tan(math.radians(pitch))
    if x1 - x0 >= z1 - z0:
        ridge = [(x0 + half, top, z0 + half), (x1 - half, top, z0 + half)]
    else:
        ridge = [(x0 + half, top, z0 + half), (x0 + half, top, z1 - half)]
    low = eaves + 0.25
    nw, ne, se, sw = (x0, low, z0), (x1, low, z0), (x1, low, z1), (x0, low, z1)
    west, east = ridge
    if x1 - x0 >= z1 - z0:
        model.face("roofs", "roof_tile", [sw, se, east, west])
        model.face("roofs", "roof_tile", [ne, nw, west, east])
        model.face("roofs", "roof_tile_dark", [se, ne, east])
        model.face("roofs", "roof_tile_dark", [nw, sw, west])
    else:
        north, south = ridge
        model.face("roofs", "roof_tile", [se, ne, north, south])
        model.face("roofs", "roof_tile", [nw, sw, south, north])
        model.face("roofs", "roof_tile_dark", [ne, nw, north])
        model.face("roofs", "roof_tile_dark", [sw, se, south])
    ring = [nw, sw, se, ne]
    for i, p in enumerate(ring):  # the edge, and the soffit as far as the walls: nothing looks into the house
        k = (i + 1) % 4
        q = ring[k]
        under = (p[0], eaves, p[2]), (q[0], eaves, q[2])
        model.face("roofs", "stone_warm", [*under, q, p])
        model.face("roofs", "stone_warm", [under[1], under[0], walls[i], walls[k]])


def house(model, x0, x1, z0, z1, height, material, sides, first=1.2, storey=3.2, count=3, step=3.0, pitch=20):
    """Walls on the given sides (keys of FACADE) and a roof."""
    origins = {(0, 1): ((x0, z1), x1 - x0), (0, -1): ((x1, z0), x1 - x0), (1, 0): ((x1, z1), z1 - z0),
               (-1, 0): ((x0, z0), z1 - z0)}
    for out, base in sides.items():
        origin, width = origins[out]
        wall = Wall(model, FACADE[out], material, origin, out, width, base, height)
        rows = storeys(width, max(base, 0.0) + first, storey, count, step)
        wall.build([row for row in rows if row[1] < height - 0.5])
    hip_roof(model, x0, x1, z0, z1, height, pitch)


def arcade(model, x0, x1, front, back, ceiling, bay=4.0, pier=0.8, spring=3.4):
    """Piers and round arches that carry the house above; the arcade looks to +z at z = `front`."""
    half = 0.5 * (bay - pier)
    inner = front - pier
    group = "arcade"
    count = round((x1 - x0) / bay)
    for i in range(count + 1):
        x = x0 + i * bay
        low = max(x0, x - 0.5 * pier) if i else x0
        a, b = (x0, x0 + pier) if i == 0 else ((x1 - pier, x1) if i == count else (x - 0.5 * pier, x + 0.5 * pier))
        model.box(group, "stone_warm", (a, 0.0, inner), (b, spring, front))
        model.box(group, "stone_pale", (a - (0.1 if i else 0), spring - 0.3, inner - 0.1), (b + (0.1 if i < count else 0), spring, front + 0.1))
    for i in range(count):
        a = x0 + (pier if i == 0 else i * bay + 0.5 * pier)
        b = x0 + ((i + 1) * bay - (pier if i == count - 1 else 0.5 * pier))
        middle, reach = 0.5 * (a + b), 0.5 * (b - a)
        steps = 12
        curve = [(middle - reach * math.cos(math.pi * k / steps), spring + min(reach, half) * math.sin(math.pi * k / steps))
                 for k in range(steps + 1)]
        left = x0 if i == 0 else x0 + i * bay
        right = x1 if i == count - 1 else x0 + (i + 1) * bay
        outline = [(left, spring), *curve, (right, spring)]
        for (p, q) in zip(outline, outline[1:]):  # strips from the arch up to the ceiling
            if q[0] - p[0] < 1e-9:
                continue
            model.face(group, "plaster_red", [(p[0], p[1], front), (q[0], q[1], front), (q[0], ceiling, front), (p[0], ceiling, front)])
            model.face(group, "plaster_red", [(q[0], q[1], inner), (p[0], p[1], inner), (p[0], ceiling, inner), (q[0], ceiling, inner)])
        for (p, q) in zip(curve, curve[1:]):
            model.face(group, "stone_pale", [(p[0], p[1], front), (p[0], p[1], inner), (q[0], q[1], inner), (q[0], q[1], front)])
    # Ceiling, back wall with shops, floor.
    model.face(group, "plaster_straw", [(x0, ceiling, back), (x1, ceiling, back), (x1, ceiling, front), (x0, ceiling, front)])
    wall = Wall(model, group, "plaster_ochre", (x0, back), (0, 1), x1 - x0, SOCKEL, ceiling)
    wall.build([(SOCKEL + 0.01, SOCKEL + 3.0, middles(x1 - x0, bay, 1.0), 1.1, "door")])
    for i, x in enumerate(spaced(x0, x1, 2.0)[:-1]):
        model.box(group, "flag_pale" if i % 2 else "flag_dark", (x, 0.0, back), (min(x + 2.0, x1), SOCKEL, front + 0.4))


def paving(model, group, materials, x0, x1, z0, z1, tile, level=0.0):
    xs, zs = spaced(x0, x1, tile), spaced(z0, z1, tile)
    for i, (a, b) in enumerate(zip(xs, xs[1:])):
        for k, (c, d) in enumerate(zip(zs, zs[1:])):
            model.face(group, materials[(i + k) % len(materials)], [(a, level, d), (b, level, d), (b, level, c), (a, level, c)])


def tower(model, x0, x1, z0, z1, height):
    """A brick tower such as families built, with a parapet that stands out and slits for windows."""
    sides = {(0, 1): ((x0, z1), x1 - x0), (0, -1): ((x1, z0), x1 - x0), (1, 0): ((x1, z1), z1 - z0), (-1, 0): ((x0, z0), z1 - z0)}
    for out, (origin, width) in sides.items():
        wall = Wall(model, "tower", "brick_old", origin, out, width, 0.0, height)
        wall.build([(v, v + 1.4, [0.5 * width], 0.3, "shadow_glass") for v in (15.0, 19.0, 23.0)])
    r = 0.5
    model.box("tower", "stone_warm", (x0 - r, height, z0 - r), (x1 + r, height + 0.4, z1 + r))
    for i in range(4):  # merlons
        a, b = x0 - r + i * (x1 - x0 + 2 * r) / 4, x0 - r + (i + 0.55) * (x1 - x0 + 2 * r) / 4
        for z in (z0 - r, z1 + r - 0.6):
            model.box("tower", "brick_old", (a, height + 0.4, z), (b, height + 1.4, z + 0.6))
    for i in range(1, 4):
        a, b = z0 - r + i * (z1 - z0 + 2 * r) / 4, z0 - r + (i + 0.55) * (z1 - z0 + 2 * r) / 4
        for x in (x0 - r, x1 + r - 0.6):
            model.box("tower", "brick_old", (x, height + 0.4, a), (x + 0.6, height + 1.4, b))


def fountain(model, x, z):
    turned(model, "square", "stone_pale", x, z, 16,
           [(0.0, 0.0), (2.8, 0.0), (2.8, 0.2), (2.3, 0.2), (2.3, 0.8), (2.0, 0.8), (2.0, 0.5), (0.3, 0.5), (0.25, 1.8),
            (0.9, 2.0), (0.9, 2.2), (0.0, 2.2)])


def main():
    model = Model()
    # The house over the arcade: south front at z = 18, the arcade four metres deep below it.
    arcade(model, 0.0, 36.0, 18.0, 13.6, 5.4)
    house(model, 0.0, 36.0, 4.0, 18.0, 15.4, "plaster_red",
          {(0, 1): 5.4, (0, -1): 0.0, (1, 0): 5.4, (-1, 0): 5.4}, first=1.2, storey=3.2, count=3)
    for out, origin, width in (((1, 0), (36.0, 13.6), 9.6), ((-1, 0), (0.0, 4.0), 9.6)):  # beside the arcade
        Wall(model, FACADE[out], "plaster_red", origin, out, width, 0.0, 5.4).build(
            [(1.2, 3.2, middles(width, 3.0, 1.0), 0.6, "shutters")])
    # Across the street that runs north.
    house(model, 43.0, 51.0, 2.0, 24.0, 9.6, "plaster_straw", {(0, 1): 0.0, (0, -1): 0.0, (1, 0): 0.0, (-1, 0): 0.0},
          count=3, storey=3.0)
    # South of the street, west of the square, with a tower at the corner.
    house(model, 0.0, 14.0, 26.0, 42.0, 12.6, "plaster_ochre",
          {(0, 1): 0.0, (0, -1): 0.0, (1, 0): 0.0, (-1, 0): 0.0}, count=4, storey=3.0)
    tower(model, 14.5, 18.9, 26.0, 30.4, 25.0)
    # Grounds, nowhere inside a house.
    for x0, x1, z0, z1 in ((-2, 53, 18.4, 26), (36, 43, 0, 18.4), (-2, 36, 0, 4), (-2, 0, 4, 18.4), (43, 53, 0, 2),
                           (51, 53, 2, 18.4), (-2, 0, 26, 44), (0, 19, 42, 44), (14, 19, 30.4, 42), (14, 14.5, 26, 30.4)):
        paving(model, "street", ["cobble"], x0, x1, z0, z1, 11.0)
    paving(model, "square", ["flag_pale", "flag_dark"], 19.0, 53.0, 26.0, 44.0, 1.8)
    model.box("pavement", "stone_warm", (-2.0, -0.1, 24.6), (19.0, SOCKEL, 26.0))
    model.box("pavement", "stone_warm", (41.8, -0.1, 2.0), (43.0, SOCKEL, 24.0))
    model.box("pavement", "stone_warm", (43.0, -0.1, 24.0), (53.0, SOCKEL, 25.2))
    fountain(model, 36.0, 34.5)
    folder = pathlib.Path(__file__).parent
    model.write(folder / "street.obj", "A street corner with an arcade, a square and a tower.", "make_street.py")


if __name__ == "__main__":
    main()
