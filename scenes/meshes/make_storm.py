#!/usr/bin/env python3
"""Builds storm_land.obj, storm_windows.obj and storm_cloud.obj (with their .mtl files) beside this script.

    python3 scenes/meshes/make_storm.py

Standard library only; the same bytes on every run. Metres, y up. Hills with a village, 220 m across; the panes of its
windows by themselves, so that a scene can light them; and the billowing underside of a cloud, 90 m above.
"""
import math
import pathlib
import random

import masonry
from masonry import Model, spaced

masonry.COLOURS.update({"pasture": (92, 104, 66), "field": (120, 112, 70), "heath": (84, 88, 62),
                        "lane": (128, 116, 96), "render": (214, 204, 186), "ashlar": (178, 170, 154), "tiles": (128, 74, 58),
                        "slate": (84, 90, 98), "pane": (70, 62, 50), "bark": (92, 78, 64), "cloud": (150, 152, 160)})

CHURCH = (-18, -12)
SUMMIT = (31, -4)
OAK = (24.5, -3)


def bell(distance, width):
    return math.exp(-0.5 * (distance / width) ** 2)


def height(x, z):
    rolling = 1.6 * math.sin(x / 23 + 1) * math.cos(z / 19) + 0.7 * math.sin(x / 9 + z / 13)
    summit = 11 * bell(math.hypot(x - SUMMIT[0], z - SUMMIT[1]), 15)
    ridge = 13 * bell(z + 85, 22) * (1 + 0.5 * math.sin(x / 27 + 2)) + 8 * bell(x + 95, 22)
    village = bell(math.hypot(x - CHURCH[0], 0.8 * (z - CHURCH[1])), 15)  # on level ground
    return (1 - 0.9 * village) * (rolling + summit + ridge)


def land():
    model, rng = Model(), random.Random(3)
    step = 2.5
    columns, rows = round(220 / step), round(175 / step)
    at = [[(-110 + step * i, height(-110 + step * i, -85 + step * k), -85 + step * k) for i in range(columns + 1)]
          for k in range(rows + 1)]
    plots = {}
    for k in range(rows):
        for i in range(columns):
            x, _, z = at[k][i]
            # Fields by the way that the land lies, in strips of their own.
            plot = (math.floor((x + 0.35 * z) / 24), math.floor((z - 0.2 * x) / 31))
            cover = plots.setdefault(plot, rng.choice(("pasture", "pasture", "field", "heath")))
            if math.hypot(x - SUMMIT[0], z - SUMMIT[1]) < 30:
                cover = "pasture"
            if z > -35 and abs(x + 6 + 7 * math.sin(z / 21)) < 1.6:
                cover = "lane"
            a, b, c, d = at[k][i], at[k + 1][i], at[k + 1][i + 1], at[k][i + 1]
            model.face("land", cover, [a, b, c])
            model.face("land", cover, [a, c, d])
    return model


class House:
    """A body with a gabled roof, turned about its middle."""

    def __init__(self, model, panes, middle, turn_deg):
        self.model, self.panes = model, panes
        (self.x, self.z), turn = middle, math.radians(turn_deg)
        self.ahead, self.aside = (math.cos(turn), math.sin(turn)), (-math.sin(turn), math.cos(turn))
        self.foot = height(self.x, self.z) - 0.6

    def place(self, along, up, across):
        return (self.x + along * self.ahead[0] + across * self.aside[0], self.foot + up,
                self.z + along * self.ahead[1] + across * self.aside[1])

    def prism(self, group, material, outline, along):
        """An outline (across, up), counterclockwise seen against the way along, from the first to the second."""
        low, high = along
        depth = tuple((low - high) * c for c in (self.ahead[0], 0, self.ahead[1]))
        self.model.prism(group, material, [self.place(high, u, -a) for a, u in outline], depth)

    def body(self, material, length, width, eaves, ridge, roof, middle=0.0):
        half, deep = length / 2, width / 2
        self.prism("walls", material, [(-deep, 0), (deep, 0), (deep, eaves), (0, ridge), (-deep, eaves)],
                   (middle - half, middle + half))
        over, thick = 0.5, 0.25
        fall = (ridge - eaves) / deep
        for side in (-1, 1):
            low, high = side * (deep + over), eaves - fall * over
            outline = [(0, ridge), (low, high), (low, high + thick), (0, ridge + thick)]
            self.prism("roofs", roof, outline if side < 0 else outline[::-1],
                       (middle - half - over, middle + half + over))

    def pane(self, along, up, across, wide, high):
        """A window just before a side wall."""
        side = 1 if across > 0 else -1
        corners = [self.place(along + side * s * wide / 2, up + t * high, across + 0.06 * side)
                   for s, t in ((1, 0), (-1, 0), (-1, 1), (1, 1))]
        self.panes.face("panes", "pane", corners)

    def gable_pane(self, along, up, wide, high):
        end = 1 if along > 0 else -1
        corners = [self.place(along + 0.06 * end, up + t * high, end * s * wide / 2)
                   for s, t in ((-1, 0), (1, 0), (1, 1), (-1, 1))]
        self.panes.face("panes", "pane", corners)


def village():
    model, panes, rng = land(), Model(), random.Random(11)
    houses = [((-35, -6), 12), ((-27, 4), -20), ((-9, 3), 30), ((-4, -13), -8), ((-31, -22), 40), ((3, -3), 75),
              ((-44, -16), -35), ((-15, -28), 10)]
    for middle, turn in houses:
        house = House(model, panes, middle, turn)
        length, width, eaves = 8 + 3 * rng.random(), 6 + rng.random(), 3.6 + 0.8 * rng.random()
        house.body("render", length, width, eaves, eaves + 2.6 + rng.random(), "tiles")
        for side in (-1, 1):
            for along in (-0.28, 0.02, 0.3):
                if rng.random() < 0.55:
                    house.pane(along * length, 1.7, side * width / 2, 0.9, 1.2)
            if rng.random() < 0.6:
                house.gable_pane(side * length / 2, eaves - 0.6, 0.9, 1.2)
    church = House(model, panes, CHURCH, 8)
    church.body("ashlar", 15, 8, 6.5, 11, "slate")
    for side in (-1, 1):
        for along in (-4.5, -1.5, 1.5, 4.5):
            church.pane(along, 2.6, side * 4, 1.1, 2.8)
    tower = -9.5
    church.prism("walls", "ashlar", [(-2.4, 0), (2.4, 0), (2.4, 15), (-2.4, 15)], (tower - 2.4, tower + 2.4))
    ring = [church.place(tower + a, 15, b) for a, b in ((2.7, -2.7), (2.7, 2.7), (-2.7, 2.7), (-2.7, -2.7))]
    tip = church.place(tower, 26, 0)
    for a, b in zip(ring, ring[1:] + ring[:1]):
        model.face("roofs", "slate", [b, a, tip])
    model.face("roofs", "slate", ring)
    for side in (-1, 1):
        church.pane(tower, 11, side * 2.4, 0.9, 2.2)
    x, z = OAK
    oak(model, (x, height(x, z) - 0.3, z), rng)
    return model, panes


def oak(model, foot, rng):
    """A bare tree: limbs that taper and fork, each a prism of five sides."""
    def limb(start, way, length, thick, depth):
        end = tuple(a + length * c for a, c in zip(start, way))
        side = unit(cross(way, (0.3, 0.1, 1) if abs(way[2]) < 0.9 else (1, 0, 0)))
        up = cross(way, side)
        slim = 0.68 * thick

        def ring(at, radius):
            turns = [math.tau * k / 5 for k in range(5)]
            return [tuple(p + radius * (math.cos(t) * s + math.sin(t) * u) for p, s, u in zip(at, side, up))
                    for t in turns]
        low, high = ring(start, thick), ring(end, slim)
        for k in range(5):
            j = (k + 1) % 5
            model.face("oak", "bark", [low[k], low[j], high[j], high[k]])
        if depth == 0:
            model.face("oak", "bark", high)
            return
        for _ in range(3 if depth > 3 else 2):
            turn, spread = math.tau * rng.random(), 0.42 + 0.5 * rng.random()
            aside = tuple(math.cos(turn) * s + math.sin(turn) * u for s, u in zip(side, up))
            next_way = unit(tuple(w + spread * a + (0.12 if axis == 1 else 0) for axis, (w, a) in
                                  enumerate(zip(way, aside))))
            limb(end, next_way, length * (0.68 + 0.2 * rng.random()), slim * (0.75 + 0.2 * rng.random()), depth - 1)
    limb(foot, (0.03, 0.998, 0.04), 3.0, 0.42, 5)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def cloud():
    """Soft balls that hang from a level: the lowest of them is the underside."""
    model, rng = Model(), random.Random(5)
    balls = []
    for count, radius in ((26, 26), (90, 13), (300, 6.5)):
        for _ in range(count):
            size = radius * (0.75 + 0.5 * rng.random())
            balls.append((-118 + 236 * rng.random(), -92 + 150 * rng.random(), size, 0.25 + 0.35 * rng.random()))
    step = 2.5

    def underside(x, z):
        soft, total = 0.9, 0.0
        for bx, bz, size, sag in balls:
            square = size * size - (x - bx) ** 2 - (z - bz) ** 2
            if square > 0:
                total += math.exp(soft * sag * math.sqrt(square)) - 1
        return 97 - math.log(1 + total) / soft
    xs, zs = spaced(-115, 115, step), spaced(-85, 55, step)
    low = [[(x, underside(x, z), z) for x in xs] for z in zs]
    for k in range(len(zs) - 1):
        for i in range(len(xs) - 1):
            a, b, c, d = low[k][i], low[k + 1][i], low[k + 1][i + 1], low[k][i + 1]
            model.face("cloud", "cloud", [c, b, a])
            model.face("cloud", "cloud", [d, c, a])
    return model


if __name__ == "__main__":
    here = pathlib.Path(__file__).resolve().parent
    ground, windows = village()
    for name, model, about in (("storm_land", ground, "Hills with a village"),
                               ("storm_windows", windows, "The panes of its windows"),
                               ("storm_cloud", cloud(), "The underside of a cloud")):
        model.write(here / f"{name}.obj", about, maker="make_storm.py")
