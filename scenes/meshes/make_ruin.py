#!/usr/bin/env python3
"""Builds ruin.obj and ruin.mtl beside this script: what is left of a chapel's wall, with a pointed window.

    python3 scenes/meshes/make_ruin.py

Standard library only; the same bytes on every run. Metres, y up, the ground about y = 0. The wall runs along x and looks
to +z. As a mesh that was scanned or bought, it is open and unwelded: most stones have no back, no two faces share a
corner, and the turf is a sheet. Groups: wall, window, tracery, fallen, turf.
"""
import math
import pathlib
import random

import masonry
from masonry import Face, Model, pick, spaced

masonry.COLOURS.update({
    "ashlar_warm": (186, 170, 140), "ashlar_pale": (200, 188, 162), "ashlar_grey": (164, 158, 146),
    "ashlar_rust": (178, 154, 122), "ashlar_dark": (134, 128, 116), "mossy": (124, 124, 98), "rubble": (142, 130, 110),
    "dressed_pale": (206, 196, 172), "dressed_warm": (192, 178, 150), "dressed_grey": (176, 170, 156),
    "turf": (84, 94, 58), "earth": (96, 82, 62)})
ASHLAR = [("ashlar_warm", 7), ("ashlar_pale", 4), ("ashlar_grey", 5), ("ashlar_rust", 2), ("ashlar_dark", 2)]
DAMP = [("ashlar_grey", 4), ("ashlar_dark", 4), ("mossy", 4), ("ashlar_warm", 2)]
DRESSED = [("dressed_pale", 4), ("dressed_warm", 4), ("dressed_grey", 3)]

LEFT, RIGHT, HALF, LEAF = -3.7, 3.9, 0.34, 0.24  # the wall's ends, half its thickness, the depth of its faced stones
# The window about x = 0: half its width, sill, spring of the arch, and the width of its surround.
REACH, SILL, SPRING, ROUND = 0.78, 1.30, 2.62, 0.26
# What still stands: the height of the crown along x, and the crack, by height.
CROWN = [(-3.7, 1.5), (-3.35, 2.3), (-2.9, 2.5), (-2.5, 3.4), (-2.1, 3.75), (-1.75, 4.6), (-1.2, 5.05), (-0.75, 4.8),
         (-0.3, 4.75), (0.06, 4.45), (0.1, 3.3), (1.0, 3.05), (1.3, 3.3), (1.6, 2.75), (2.1, 2.35), (2.45, 1.55), (2.9, 1.3),
         (3.2, 0.75), (3.6, 0.5), (3.9, 0.3)]
CRACK = [(-0.2, -1.75), (0.5, -1.45), (0.9, -1.6), (1.5, -1.22), (1.9, -1.34), (2.4, -1.18), (3.1, -1.5), (3.5, -1.36), (4.2, -1.12),
         (4.9, -1.3)]


def along(line, t):
    """The value at t of a line through points, level beyond its ends."""
    if t <= line[0][0]:
        return line[0][1]
    for (a, p), (b, q) in zip(line, line[1:]):
        if t <= b:
            return p + (q - p) * (t - a) / (b - a)
    return line[-1][1]


class Unwelded(Model):
    """Each face has corners of its own."""

    def corner(self, p):
        self.points.append(tuple(round(c, 3) + 0.0 for c in p))
        return len(self.points)


def opening(v):
    """Half the width at height v of the hole that the surround fills, or 0."""
    if v <= SPRING:
        return REACH + ROUND if v > SILL - 0.14 else 0.0
    radius = 2 * REACH + ROUND
    return max(0.0, math.sqrt(max(0.0, radius * radius - (v - SPRING) ** 2)) - REACH)


def stands(x, y):
    return LEFT < x < RIGHT and -0.2 < y < along(CROWN, x) and abs(x) >= opening(y)


def stone(model, rng, at, corners, material, open_sides, proud=0.0, depth=LEAF, group="wall"):
    """A faced stone: a face that is not quite flat, worn edges, and those of its sides that are seen."""
    mid = [sum(c[i] for c in corners) / 4 for i in (0, 1)]
    worn, tilt = 0.016 + 0.014 * rng.random(), 0.016
    rim = [at(u, v, proud - 0.022) for u, v in corners]
    front = []
    for u, v in corners:
        du, dv = mid[0] - u, mid[1] - v
        inset = [math.copysign(min(abs(d) * 0.4, worn * (0.7 + 0.8 * rng.random())), d) for d in (du, dv)]
        front.append(at(u + inset[0], v + inset[1], proud + tilt * (rng.random() - 0.3)))
    model.face(group, material, front)
    back = [at(u, v, proud - depth * (0.85 + 0.3 * rng.random())) for u, v in corners]
    for i in range(4):
        k = (i + 1) % 4
        model.face(group, material, [rim[i], rim[k], front[k], front[i]])
        if open_sides[i]:
            model.face(group, material, [back[i], back[k], rim[k], rim[i]])
    if any(open_sides):
        model.face(group, material, back[::-1])


def courses(rng, top):
    heights = [-0.12]
    while heights[-1] < top:
        heights.append(heights[-1] + rng.choice((0.2, 0.23, 0.26, 0.3)))
    return list(zip(heights, heights[1:]))


def face_of_wall(model, rng, face, flip):
    """One face of the wall in courses, as far as it stands. `flip` is -1 where u runs against x."""
    start = LEFT if flip > 0 else -RIGHT

    def x_of(u):
        return flip * (start + u)
    for row, (v0, v1) in enumerate(courses(rng, 5.1)):
        proud = 0.07 if v0 < 0.5 else 0.0
        ends, u = [], -0.3 * rng.random()
        while u < RIGHT - LEFT:
            step = rng.uniform(0.28, 0.7)
            ends.append((max(u, 0.0), min(u + step, RIGHT - LEFT)))
            u += step
        middle = 0.5 * (v0 + v1)
        split = flip * along(CRACK, middle) - start
        pieces = []
        for a, b in ends:
            if a + 0.06 < split < b - 0.06:
                gap = 0.03 + 0.015 * rng.random()
                pieces += [[a, a, split - gap, split - gap], [split + gap, split + gap, b, b]]
            else:
                pieces.append([a, a, b, b])
        for a0, a1, b0, b1 in pieces:  # its left end at v0 and v1, its right end
            low, high, centre = opening(v0 + 1e-6), opening(v1), -start
            if low > 0.0 or high > 0.0:  # cut to the arch
                left0, left1, right0, right1 = centre - low, centre - high, centre + low, centre + high
                if a0 < centre < b0:
                    halves = [(a0, a1, min(b0, left0), min(b1, left1)), (max(a0, right0), max(a1, right1), b0, b1)]
                elif b0 <= centre:
                    halves = [(a0, a1, min(b0, left0), min(b1, left1))]
                else:
                    halves = [(max(a0, right0), max(a1, right1), b0, b1)]
            else:
                halves = [(a0, a1, b0, b1)]
            for c0, c1, d0, d1 in halves:
                if d0 - c0 < 0.05 and d1 - c1 < 0.05:
                    continue
                c0, c1, d0, d1 = min(c0, d0), min(c1, d1), max(c0, d0), max(c1, d1)
                x = x_of(0.25 * (c0 + c1 + d0 + d1))
                if middle > along(CROWN, x) + 0.12 * (rng.random() - 0.5):
                    continue
                damp = v0 < 0.45 + 0.3 * rng.random() or middle > along(CROWN, x) - 0.3
                cracked = abs(0.5 * (c0 + d0) - split) < 0.5 * (d0 - c0) + 0.06
                # Whatever may be seen of its sides: to the lower neighbour, the two beside, the upper one.
                free = [False, cracked or not stands(x_of(d0 + 0.3), middle + 0.15), not stands(x, v1 + 0.25),
                        cracked or not stands(x_of(c0 - 0.3), middle + 0.15)]
                stone(model, rng, face.at, [(c0, v0), (d0, v0), (d1, v1), (c1, v1)],
                      pick(rng, DAMP if damp else ASHLAR), free, proud)


def core(model, rng):
    """The rubble between the two faces, lower than they are and rough on top."""
    depth = HALF - 0.12
    stations = [LEFT + 0.12]
    while stations[-1] < RIGHT - 0.2:
        stations.append(stations[-1] + rng.uniform(0.16, 0.3))
    for a, b in zip(stations, stations[1:]):
        x = 0.5 * (a + b)
        top = min(along(CROWN, a), along(CROWN, b)) - rng.uniform(0.05, 0.3)
        hole = max(opening(v) for v in (0.0, SILL)) if abs(x) < REACH + ROUND + 0.1 else 0.0
        spans = [(-0.1, top)]
        if hole:
            head = max((v for v in spaced(SPRING, 4.4, 0.02) if opening(v) > abs(x) - 0.06), default=SPRING)
            spans = [(-0.1, SILL - 0.2), (head, top)]
        for low, high in spans:
            if high - low < 0.1:
                continue
            ring = [(a, depth), (b, depth), (b, -depth), (a, -depth)]
            lift = [high + rng.uniform(-0.1, 0.06) for _ in ring]
            foot, head = [(u, low, w) for u, w in ring], [(u, h, w) for (u, w), h in zip(ring, lift)]
            for i in range(4):
                k = (i + 1) % 4
                model.face("wall", "rubble", [foot[i], foot[k], head[k], head[i]])
            model.face("wall", "rubble", head)
            if low > 0.0:
                model.face("wall", "rubble", foot[::-1])
        if rng.random() < 0.75 and spans[-1][1] - spans[-1][0] > 0.1:  # a stone that still lies in the fill
            loose(model, rng, "wall", (x, top + 0.02, rng.uniform(-0.1, 0.1)), rng.uniform(0.09, 0.17))


def turned(rng):
    """A random rotation as three rows, mostly about the upright."""
    yaw, lean, roll = rng.uniform(0, 2 * math.pi), rng.gauss(0, 0.28), rng.gauss(0, 0.28)
    cy, sy, cl, sl, cr, sr = (math.cos(yaw), math.sin(yaw), math.cos(lean), math.sin(lean), math.cos(roll), math.sin(roll))
    return [(cy * cr + sy * sl * sr, sr * cl, -sy * cr + cy * sl * sr),
            (-cy * sr + sy * sl * cr, cr * cl, sr * sy + cy * sl * cr), (sy * cl, -sl, cy * cl)]


def loose(model, rng, group, at, size, material=None):
    """A stone by itself, with its corners knocked off: six worn faces and the slopes between them."""
    half = (size * rng.uniform(0.9, 1.5), size * rng.uniform(0.55, 0.85), size * rng.uniform(0.7, 1.0))
    rows, material = turned(rng), material or pick(rng, DAMP if rng.random() < 0.4 else ASHLAR)

    def placed(p):
        return tuple(at[i] + sum(p[k] * rows[k][i] for k in range(3)) for i in range(3))
    wear = 0.16 * size
    knocked = {}
    for sx in (-1, 1):
        for sy in (-1, 1):
            for sz in (-1, 1):
                corner = [s * h * rng.uniform(0.86, 1.06) for s, h in zip((sx, sy, sz), half)]
                for axis in range(3):  # the corner as the face across this axis has it
                    knocked[sx, sy, sz, axis] = placed([c - (0 if i == axis else math.copysign(wear, c))
                                                        for i, c in enumerate(corner)])
    square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    for axis in range(3):
        b, c = (axis + 1) % 3, (axis + 2) % 3

        def sign(side, p, q):
            signs = [0, 0, 0]
            signs[axis], signs[b], signs[c] = side, p, q
            return tuple(signs)
        for side in (-1, 1):
            model.face(group, material, [knocked[(*sign(side, p, q), axis)] for p, q in square[::side]])
        for p, q in square:  # along the edge that runs with this axis
            ends = [knocked[(*sign(side, p, q), k)] for side, k in ((-1, b), (1, b), (1, c), (-1, c))]
            model.face(group, material, ends if p * q < 0 else ends[::-1])
    for sx in (-1, 1):
        for sy in (-1, 1):
            for sz in (-1, 1):
                three = [knocked[sx, sy, sz, axis] for axis in range(3)]
                model.face(group, material, three[::sx * sy * sz])


def sweep(model, group, material, sections):
    """A bar through rings of points, clockwise as one looks along it from behind its start."""
    for r, s in zip(sections, sections[1:]):
        for i in range(len(r)):
            k = (i + 1) % len(r)
            model.face(group, material, [s[i], s[k], r[k], r[i]])
    model.face(group, material, sections[0])
    model.face(group, material, sections[-1][::-1])


def window(model, rng):
    """Jambs of long and short stones, the half of the arch that still stands, a sill and what is left of the tracery."""
    deep, splay = HALF + 0.03, 0.16

    def profile(wide, out):  # across a jamb: how far from the opening's edge, and z
        front = deep + out
        return [(wide, front), (splay * 0.8, front), (splay * 0.55, front - 0.05), (0.0, 0.12), (0.0, -0.12),
                (splay * 0.8, -front), (wide, -front)]
    heights = spaced(SILL, SPRING, 0.33)
    for i, (y0, y1) in enumerate(zip(heights, heights[1:])):
        for side in (-1, 1):
            ring = profile(ROUND + (0.16 if (i + (side > 0)) % 2 else 0.02), 0.006 * (i % 2))
            sections = [[(side * (REACH + d), y, z) for d, z in ring[::side]] for y in (y0 + 0.004, y1 - 0.004)]
            sweep(model, "window", pick(rng, DRESSED), sections)
    # The arch: each half about the foot of the other; the right one broke off above its third stone.
    each = math.radians(60) / 7
    for side, count in ((-1, 7), (1, 2)):
        for i in range(count):
            ring = profile(ROUND + 0.02 * (i % 2), 0.006 * (i % 2))
            turns = [each * (i + share) + (0.002, 0, -0.002)[k] for k, share in enumerate((0, 0.5, 1))]
            sections = [[(side * ((2 * REACH + d) * math.cos(a) - REACH), SPRING + (2 * REACH + d) * math.sin(a), z)
                         for d, z in ring[::side]] for a in turns]
            sweep(model, "window", pick(rng, DRESSED), sections)
    for x0, x1 in ((-REACH - 0.34, -0.31), (-0.30, 0.42), (0.43, REACH + 0.34)):
        ring = [(deep + 0.08, SILL - 0.15), (deep + 0.08, SILL - 0.09), (deep - 0.1, SILL), (-deep + 0.1, SILL),
                (-deep - 0.08, SILL - 0.09), (-deep - 0.08, SILL - 0.15)]
        drop = 0.015 if x0 > 0 else 0.0
        sweep(model, "window", pick(rng, DRESSED), [[(x, y - drop, z) for z, y in ring] for x in (x0, x1)])
    tracery(model)


def tracery(model):
    """A mullion, one light of two, the stub of the other's arch, and a piece of the ring above."""
    bar = [(0.065, 0.0), (0.02, 0.085), (-0.02, 0.085), (-0.065, 0.0), (-0.02, -0.085), (0.02, -0.085)]
    spring = SPRING - 0.18

    def post(x, y0, y1):
        sweep(model, "tracery", "dressed_warm", [[(x + d, y, z) for d, z in bar] for y in (y0, y1)])

    def bow(x, y, radius, start, end):
        sections = []
        for degrees in spaced(start, end, 10 if end > start else -10):
            a = math.radians(degrees)
            sections.append([(x + (radius + d) * math.cos(a), y + (radius + d) * math.sin(a), z) for d, z in bar])
        sweep(model, "tracery", "dressed_warm", sections)
    left = -REACH + 0.03
    post(0.0, SILL - 0.02, spring)
    post(left, SILL - 0.02, spring)
    post(REACH - 0.03, SILL - 0.02, SILL + 0.45)
    bow(0.0, spring, -left, 120, 180)
    bow(left, spring, -left, 0, 60)
    bow(REACH - 0.03, spring, REACH - 0.03, 148, 180)
    bow(0.0, spring + 1.06, 0.42, 96, 262)


def buttress(model, rng, x, half=0.3):
    """Two stages against the front, each under sloping stones, the upper one without its cap."""
    for low, high, deep in ((-0.12, 1.75, 0.62), (1.75, 3.0, 0.36)):
        faces = [(Face((x - half, 0, HALF + deep), (1, 0), (0, 1)), 2 * half),
                 (Face((x + half, 0, HALF + deep), (0, -1), (1, 0)), deep),
                 (Face((x - half, 0, HALF), (0, 1), (-1, 0)), deep)]
        rows = spaced(low, high, 0.26)
        for row, (v0, v1) in enumerate(zip(rows, rows[1:])):
            for n, (face, width) in enumerate(faces):
                joint = width * (0.38 if (row + n) % 2 else 0.64)
                for a, b in ((0.0, joint), (joint, width)):
                    if v1 > 2.9 and rng.random() < 0.4:
                        continue
                    material = pick(rng, DAMP if v0 < 0.4 else ASHLAR)
                    stone(model, rng, face.at, [(a, v0), (b, v0), (b, v1), (a, v1)], material, [False, True, True, True],
                          0.05 if v0 < 0.4 else 0.0)
    for high, deep, after, count in ((1.75, 0.62, 0.36, 2), (2.98, 0.36, 0.02, 1)):
        for i in range(count):
            a, b = x - half - 0.04 + i * (half + 0.045), x - half - 0.04 + (i + 1) * (half + 0.035)
            ring = [(HALF + deep + 0.05, high - 0.01), (HALF + deep + 0.05, high + 0.06),
                    (HALF + after, high + 0.08 + 1.15 * (deep - after)), (HALF, high + 0.08 + 1.15 * (deep - after)),
                    (HALF, high - 0.01)]
            sweep(model, "wall", pick(rng, DRESSED), [[(u, y, z) for z, y in ring] for u in (a, b)])


def string_course(model, rng):
    """A moulding along the front under the sill, with gaps where pieces fell."""
    for a, b in zip(spaced(LEFT + 0.3, RIGHT - 1.2, 0.62), spaced(LEFT + 0.3, RIGHT - 1.2, 0.62)[1:]):
        if rng.random() < 0.3 or along(CROWN, b) < 1.3:
            continue
        ring = [(HALF - 0.02, 0.86), (HALF + 0.05, 0.87), (HALF + 0.09, 0.92), (HALF + 0.09, 0.95), (HALF - 0.02, 1.03)]
        sweep(model, "wall", pick(rng, DRESSED), [[(u, y, z) for z, y in ring] for u in (a + 0.006, b - 0.006)])


HEAP = [(2.7, 0.9, 0.52, 0.75), (1.5, 1.0, 0.26, 0.7), (3.6, 0.5, 0.34, 0.8), (0.5, 0.85, 0.14, 0.6), (2.6, -1.0, 0.42, 0.8),
        (-3.6, 0.3, 0.3, 0.7), (-0.9, -0.9, 0.2, 0.9)]  # heaps of what came down: x, z, height, reach


def ground_at(x, z):
    """The turf: swells that die out towards its rim, and earth washed over the heaps and against the wall."""
    fade = max(0.0, 1.0 - (max(abs(x) / 6.4, abs(z) / 5.4)) ** 4)
    swell = 0.022 * math.sin(1.3 * x + 0.6) * math.cos(1.1 * z) + 0.014 * math.sin(2.9 * x - 1.7 * z)
    lean = 0.1 * math.exp(-max(0.0, abs(z) - HALF) / 0.45) if LEFT - 0.4 < x < RIGHT + 0.4 else 0.0
    heaps = sum(h * math.exp(-((x - hx) ** 2 + (z - hz) ** 2) / (r * r)) for hx, hz, h, r in HEAP)
    return fade * (swell + lean + heaps * 0.8)


def turf(model, rng):
    xs, zs = spaced(-6.4, 6.4, 0.4), spaced(-5.4, 5.4, 0.4)

    def point(i, k):
        edge = i in (0, len(xs) - 1) or k in (0, len(zs) - 1)
        return (xs[i], 0.0 if edge else ground_at(xs[i], zs[k]), zs[k])
    for i in range(len(xs) - 1):
        for k in range(len(zs) - 1):
            x, z = xs[i] + 0.2, zs[k] + 0.2
            bare = ground_at(x, z) > 0.2 + 0.1 * rng.random()
            material = "earth" if bare else "turf"
            model.face("turf", material, [point(i, k + 1), point(i + 1, k + 1), point(i + 1, k), point(i, k)])


def fallen(model, rng):
    """The heaps, stones that rolled farther, and three of the arch with their moulding."""
    for hx, hz, height, reach in HEAP:
        for _ in range(round(44 * height * reach + 6)):
            away, a = reach * 0.95 * math.sqrt(rng.random()), rng.uniform(0, 2 * math.pi)
            x, z, size = hx + away * math.cos(a), hz + away * math.sin(a), rng.choice((0.09, 0.12, 0.15, 0.18, 0.22))
            if abs(z) < HALF + size * 0.8 and LEFT < x < RIGHT:
                continue
            loose(model, rng, "fallen", (x, ground_at(x, z) + size * rng.uniform(0.1, 0.5), z), size)
    for x, z, size in ((0.95, 2.1, 0.2), (1.9, 2.5, 0.13), (-0.6, 1.6, 0.12), (3.3, 2.0, 0.16), (4.6, 1.2, 0.2), (2.4, 2.0, 0.24),
                       (-2.9, 1.9, 0.14), (0.1, 2.9, 0.1), (-1.3, 2.4, 0.09), (4.4, -0.4, 0.22)):
        loose(model, rng, "fallen", (x, ground_at(x, z) + size * 0.3, z), size)


def main():
    model, rng = Unwelded(), random.Random(1536)
    face_of_wall(model, rng, Face((LEFT, 0, HALF), (1, 0), (0, 1)), 1)
    face_of_wall(model, rng, Face((RIGHT, 0, -HALF), (-1, 0), (0, -1)), -1)
    core(model, rng)
    buttress(model, rng, -2.35)
    string_course(model, rng)
    window(model, rng)
    fallen(model, rng)
    turf(model, rng)
    model.write(pathlib.Path(__file__).resolve().parent / "ruin.obj", "What is left of a chapel's wall.", "make_ruin.py")


if __name__ == "__main__":
    main()
