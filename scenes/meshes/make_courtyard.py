#!/usr/bin/env python3
"""Builds courtyard.obj, column.obj and maze_walls.obj (with their .mtl files) beside this script.

    python3 scenes/meshes/make_courtyard.py

Standard library only; the same bytes on every run. Metres, y up, the ground's top at y = 0.
The courtyard: a brick garden wall along x with an arched window, swept down to a pier on the right; a lower wall
returns towards +z on the left. Groups: wall, coping, window, paving, bed, kerb.
"""
import math
import pathlib
import random

# Display values (sRGB, 0..255), warm and a little desaturated.
COLOURS = {
    "brick_rose": (172, 112, 92),
    "brick_red": (162, 100, 80),
    "brick_orange": (180, 122, 94),
    "brick_buff": (186, 142, 114),
    "brick_plum": (142, 94, 82),
    "brick_burnt": (122, 88, 77),
    "mortar": (176, 162, 142),
    "limestone_pale": (210, 201, 182),
    "limestone_warm": (198, 184, 158),
    "limestone_grey": (184, 177, 163),
    "slab_warm": (156, 148, 135),
    "slab_pale": (166, 159, 147),
    "slab_grey": (146, 142, 134),
    "slab_rose": (155, 142, 130),
    "slab_ochre": (160, 149, 129),
    "slab_dark": (134, 129, 121),
    "sand": (112, 100, 84),
    "soil": (72, 54, 40),
    "soil_dark": (58, 43, 32),
    "soil_light": (86, 66, 49),
    "marble": (206, 200, 190),
    "plaster": (188, 178, 160),
}
BRICKS = [("brick_rose", 28), ("brick_red", 27), ("brick_orange", 18), ("brick_buff", 9), ("brick_plum", 12),
          ("brick_burnt", 6)]
STONES = [("limestone_pale", 4), ("limestone_warm", 3), ("limestone_grey", 3)]
SLABS = [("slab_warm", 6), ("slab_pale", 4), ("slab_grey", 5), ("slab_rose", 3), ("slab_ochre", 2), ("slab_dark", 2)]
SOILS = [("soil", 6), ("soil_dark", 3), ("soil_light", 2)]

COURSE, BRICK, JOINT, PROUD = 0.08, 0.24, 0.01, 0.01  # a brick and its joint: two by six voxels of 4 cm


class Model:
    """Polygons by group and material; corners are written once."""

    def __init__(self):
        self.points, self.index, self.faces = [], {}, {}

    def corner(self, p):
        key = tuple(round(c, 4) + 0.0 for c in p)
        if key not in self.index:
            self.index[key] = len(self.points) + 1
            self.points.append(key)
        return self.index[key]

    def face(self, group, material, points):
        """Counterclockwise seen from outside."""
        corners = [self.corner(p) for p in points]
        corners = [c for i, c in enumerate(corners) if c != corners[i - 1]]
        if len(set(corners)) >= 3:
            self.faces.setdefault(group, {}).setdefault(material, []).append(corners)

    def prism(self, group, material, outline, depth):
        """A closed solid: `outline` counterclockwise seen from where the vector `depth` points away from."""
        back = [tuple(a + d for a, d in zip(p, depth)) for p in outline]
        self.face(group, material, outline)
        for i, p in enumerate(outline):
            j = (i + 1) % len(outline)
            self.face(group, material, [p, back[i], back[j], outline[j]])
        self.face(group, material, back[::-1])

    def box(self, group, material, low, high):
        (x0, y0, z0), (x1, y1, z1) = low, high
        self.prism(group, material, [(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)], (0, 0, z0 - z1))

    def write(self, path, about, maker="make_courtyard.py", unit="metres, y up"):
        materials = sorted({m for group in self.faces.values() for m in group})
        out = [f"# {about}", f"# Made by {maker}; {unit}.", f"mtllib {path.with_suffix('.mtl').name}"]
        out += ["v " + " ".join(f"{c:.4f}".rstrip("0").rstrip(".") for c in p) for p in self.points]
        for group, by_material in self.faces.items():
            out.append(f"g {group}")
            for material, faces in by_material.items():
                out.append(f"usemtl {material}")
                out += ["f " + " ".join(map(str, corners)) for corners in faces]
        path.write_text("\n".join(out) + "\n", encoding="ascii")
        mtl = [f"# Made by {maker}; Kd are display values (sRGB)."]
        for material in materials:
            mtl += [f"newmtl {material}", "Kd " + " ".join(f"{c / 255:.4f}" for c in COLOURS[material])]
        path.with_suffix(".mtl").write_text("\n".join(mtl) + "\n", encoding="ascii")
        triangles = sum(len(f) - 2 for g in self.faces.values() for fs in g.values() for f in fs)
        print(f"{path.name}: {len(self.points)} vertices, {triangles} triangles, groups {', '.join(self.faces)}")


def pick(rng, weighted):
    at = rng.random() * sum(w for _, w in weighted)
    for name, weight in weighted:
        at -= weight
        if at < 0:
            return name
    return weighted[-1][0]


def swept(low, high, start, end):
    """A level that goes from `low` to `high` between `start` and `end` in the S of a garden wall's swan neck."""
    def level(u):
        t = min(1.0, max(0.0, (u - start) / (end - start)))
        return low + (high - low) * t * t * (3 - 2 * t)
    return level


def spaced(start, end, step):
    n = max(1, round((end - start) / step))
    return [start + (end - start) * i / n for i in range(n + 1)]


class Face:
    """An upright plane to lay bricks on: u runs along `along`, v is height, bricks stand out along `out`."""

    def __init__(self, origin, along, out):
        self.origin, self.along, self.out = origin, along, out

    def at(self, u, v, proud=0.0):
        ox, oy, oz = self.origin
        return (ox + u * self.along[0] + proud * self.out[0], oy + v, oz + u * self.along[1] + proud * self.out[1])


def lay_bricks(model, rng, face, width, top, gaps=lambda v0, v1: [], proud=PROUD, first=0, last=999, phase=0.0, edge=0.009):
    """Running bond over 0 <= u <= width, under `top(u)`, but for the intervals of u that `gaps` gives for a course."""
    for course in range(first, last):
        v0 = course * COURSE
        v1 = v0 + COURSE - JOINT
        if v0 + 0.02 > max(top(u) for u in spaced(0, width, 0.1)):
            break
        u = -BRICK * ((0.5 if course % 2 else 0.0) + phase) - BRICK
        while u < width:
            pieces = [(max(u, -edge), min(u + BRICK - JOINT, width + edge))]
            u += BRICK
            for g0, g1 in gaps(v0, v1):
                pieces = [p for a, b in pieces for p in ((a, min(b, g0)), (max(a, g1), b))]
            colour = pick(rng, BRICKS)
            stand = proud + (rng.random() - 0.5) * 0.004
            for a, b in pieces:
                if b - a > 0.015:
                    lay_brick(model, face, colour, a, b, v0, v1, top, stand)


def lay_brick(model, face, colour, a, b, v0, v1, top, stand):
    """One brick, cut where the wall's top slopes."""
    if top(a) >= v1 and top(b) >= v1:
        line = [(a, v1), (b, v1)]
    else:
        line = [(u, min(v1, top(u))) for u in spaced(a, b, 0.02) if top(u) > v0 + 0.004]
    line = [p for i, p in enumerate(line) if i in (0, len(line) - 1) or not line[i - 1][1] == p[1] == line[i + 1][1]]
    if len(line) < 2:
        return
    outline = [(line[0][0], v0), (line[-1][0], v0)] + line[::-1]
    inward = tuple(-(stand + 0.002) * c for c in (face.out[0], 0, face.out[1]))
    model.prism("wall", colour, [face.at(u, v, stand) for u, v in outline], inward)


def wall_body(model, place, us, top, hole, foot=-0.15):
    """The mortar core between two faces, closed: strips between the stations `us`, each with a hole or without.

    `place(u, v, side)` gives a point; side 0 is the face whose u runs to the right, side 1 the one behind it.
    """
    def quad(points):
        model.face("wall", "mortar", [place(*p) for p in points])

    def cover(a, b, low_a, low_b, high_a, high_b):
        rise_a, rise_b = [(a, low_a), (a, high_a)], [(b, low_b), (b, high_b)]
        if (low_a, low_b) == (foot, foot) and (high_a, high_b) == (top(a), top(b)):  # share corners with the opening
            rise_a[1:1] = [(a, v) for v in hole(a) or ()]
            rise_b[1:1] = [(b, v) for v in hole(b) or ()]
        # A fan from the side that has no more than its two ends.
        ring = rise_b + rise_a[::-1] if len(rise_b) == 2 else rise_a[:1] + rise_b + rise_a[:0:-1]
        for side, order in ((0, 1), (1, -1)):
            for p, q in zip(ring[1:], ring[2:]):
                quad([(*c, side) for c in (ring[0], p, q)][::order])

    for a, b in zip(us, us[1:]):
        opening = hole(0.5 * (a + b))
        if opening:
            (sill, head_a), (_, head_b) = hole(a) or opening, hole(b) or opening
            cover(a, b, foot, foot, sill, sill)
            cover(a, b, head_a, head_b, top(a), top(b))
            quad([(a, sill, 0), (b, sill, 0), (b, sill, 1), (a, sill, 1)])
            quad([(a, head_a, 1), (b, head_b, 1), (b, head_b, 0), (a, head_a, 0)])
        else:
            cover(a, b, foot, foot, top(a), top(b))
        quad([(a, top(a), 0), (b, top(b), 0), (b, top(b), 1), (a, top(a), 1)])
        quad([(a, foot, 1), (b, foot, 1), (b, foot, 0), (a, foot, 0)])
        for u, facing in ((a, 1), (b, -1)):
            here, beyond = opening is not None, hole(u + (-1e-6 if facing == 1 else 1e-6)) is not None
            if here and not beyond:  # the opening's jambs
                sill, head = opening[0], (hole(u) or opening)[1]
                jamb = [(u, sill, 0), (u, sill, 1), (u, head, 1), (u, head, 0)]
                quad(jamb if facing == 1 else jamb[::-1])
    for u, ends in ((us[0], 1), (us[-1], 0)):
        side = [(u, foot, 1), (u, foot, 0), (u, top(u), 0), (u, top(u), 1)]
        quad(side if ends else side[::-1])


def coping(model, rng, place, u0, u1, top, half, stone=0.62, thick=0.10, ridge=0.045, over=0.055):
    """Saddle-backed stones that follow the wall's top. `place(u, v, w)`: w across, 0 on the wall's middle."""
    joints = spaced(u0, u1, stone)
    profile = [(-half - over, 0.0), (-half - over, thick * 0.72), (0.0, thick + ridge), (half + over, thick * 0.72),
               (half + over, 0.0)]
    for i, (a, b) in enumerate(zip(joints, joints[1:])):
        a, b = (a + 0.004 if i else a), (b - 0.004 if b < u1 else b)
        material, lift = pick(rng, STONES), rng.random() * 0.006
        level = abs(top(a) - top(b)) < 1e-6
        rings = []
        for u in ([a, b] if level else spaced(a, b, 0.06)):
            slope = (top(u + 1e-4) - top(u - 1e-4)) / 2e-4
            stretch = math.sqrt(1 + slope * slope)
            rings.append([place(u, top(u) - 0.012 + lift + v * stretch, w) for w, v in profile])
        for r, s in zip(rings, rings[1:]):
            for k in range(5):
                m = (k + 1) % 5
                model.face("coping", material, [r[k], r[m], s[m], s[k]])
        model.face("coping", material, rings[0][::-1])
        model.face("coping", material, rings[-1])


def pier(model, rng, x, z, half, height, finial):
    """A square brick pier with a stone cap and a ball on it."""
    core = half - PROUD
    model.box("wall", "mortar", (x - core, -0.15, z - core), (x + core, height, z + core))
    for face in four_faces(x, z, core):
        lay_bricks(model, rng, face, 2 * core, lambda u: height, phase=0.02)
    for lift, reach, tall, stone in ((0.0, 0.03, 0.05, "limestone_grey"), (0.05, 0.07, 0.08, "limestone_pale")):
        w = half + reach
        model.box("coping", stone, (x - w, height + lift, z - w), (x + w, height + lift + tall, z + w))
    w, base, tip = half + 0.05, height + 0.13, height + 0.25
    corners = [(x - w, base, z + w), (x + w, base, z + w), (x + w, base, z - w), (x - w, base, z - w)]
    small = [(x + (c[0] - x) * 0.3, tip, z + (c[2] - z) * 0.3) for c in corners]
    for i in range(4):
        model.face("coping", "limestone_pale", [corners[i], corners[(i + 1) % 4], small[(i + 1) % 4], small[i]])
    model.face("coping", "limestone_pale", small)
    model.face("coping", "limestone_pale", corners[::-1])
    turned(model, "coping", "limestone_warm", x, z, 20,
           [(0.0, tip - 0.02), (0.07, tip - 0.02), (0.055, tip + 0.04)]
           + [(finial * math.cos(a), tip + 0.03 + finial * (0.94 + math.sin(a)))
              for a in (math.radians(-70 + 16 * i) for i in range(10))]
           + [(0.0, tip + 0.03 + finial * 1.94)])


def four_faces(x, z, half):
    return [Face((x - half, 0, z + half), (1, 0), (0, 1)), Face((x + half, 0, z - half), (-1, 0), (0, -1)),
            Face((x + half, 0, z + half), (0, -1), (1, 0)), Face((x - half, 0, z - half), (0, 1), (-1, 0))]


def turned(model, group, material, x, z, sides, profile):
    """A closed solid of revolution about an upright axis; the profile (radius, height) goes from bottom to top."""
    def ring(r, y):
        return [(x + r * math.cos(2 * math.pi * i / sides), y, z - r * math.sin(2 * math.pi * i / sides))
                for i in range(sides)]
    rings = [ring(r, y) for r, y in profile]
    for low, high in zip(rings, rings[1:]):
        for i in range(sides):
            j = (i + 1) % sides
            model.face(group, material, [low[i], low[j], high[j], high[i]])


# The main wall, along x. Its front looks to +z.
LEFT, RIGHT, MIDDLE, HALF = -3.0, 2.52, -0.6, 0.16
WALL_TOP = swept(3.44, 2.24, 1.18, 2.14)
WINDOW, SILL, SPRING, REACH = -0.74, 1.04, 2.08, 0.52  # the opening: middle, sill, spring of the arch, half width
# The lower wall, along z, on the left.
RETURN_X, RETURN_END = LEFT + HALF, 2.56
RETURN_TOP = swept(2.64, 1.28, -0.1, 1.06)


def arch(reach, u):
    """The height of a round arch's edge at u from its middle, or None beside it."""
    return SPRING + math.sqrt(max(0.0, reach * reach - u * u)) if abs(u) <= reach + 1e-9 else None


def main_wall(model, rng):
    core = HALF - PROUD
    hidden = REACH + 0.06  # the stones of the surround cover the core's edge

    def hole(u):
        head = arch(hidden, u - WINDOW)
        return (SILL - 0.06, head) if head else None

    us = [LEFT + PROUD]
    us += spaced(LEFT + PROUD, WINDOW - hidden, 0.5)[1:]
    us += [WINDOW - hidden * math.cos(math.pi * i / 20) for i in range(1, 20)]
    us += spaced(WINDOW + hidden, 1.18, 0.4) + spaced(1.18, 2.14, 0.06)[1:] + [RIGHT]

    def place(u, v, side):
        return (u, v, MIDDLE + (core if side == 0 else -core))
    wall_body(model, place, us, WALL_TOP, hole)

    def gaps_from(mirror):
        def gaps(v0, v1):
            if v1 < SILL - 0.12 or v0 > SPRING + hidden:
                return []
            if v1 < SILL:
                reach = REACH + 0.16
            else:
                reach = hidden + 0.04 if v0 < SPRING else math.sqrt(max(0.0, (hidden + 0.04) ** 2 - (v0 - SPRING) ** 2))
            middle = mirror(WINDOW)
            return [(middle - reach, middle + reach)]
        return gaps
    width = RIGHT - LEFT - PROUD
    front = Face((LEFT + PROUD, 0, MIDDLE + core), (1, 0), (0, 1))
    back = Face((RIGHT, 0, MIDDLE - core), (-1, 0), (0, -1))
    lay_bricks(model, rng, front, width, lambda u: WALL_TOP(LEFT + PROUD + u), gaps_from(lambda x: x - LEFT - PROUD))
    lay_bricks(model, rng, back, width, lambda u: WALL_TOP(RIGHT - u), gaps_from(lambda x: RIGHT - x), edge=0.0)
    end = Face((LEFT + PROUD, 0, MIDDLE - core), (0, 1), (-1, 0))
    lay_bricks(model, rng, end, 2 * core, lambda u: WALL_TOP(LEFT), phase=0.25, edge=0.0)
    # A plinth of four courses that stands out, with a sloping course of stone on it.
    for face, start in ((front, 0.0), (back, 0.0)):
        lay_bricks(model, rng, face, width, lambda u: 0.30, proud=0.045, last=4, phase=0.25, edge=0.0)
        stones = spaced(start, width, 0.7)
        for a, b in zip(stones, stones[1:]):
            outline = [face.at(a + 0.003, 0.31, 0.055), face.at(a + 0.003, 0.35, 0.045), face.at(a + 0.003, 0.40, 0.0),
                       face.at(a + 0.003, 0.31, 0.0)]
            along = (b - a - 0.006) * face.along[0]
            model.prism("wall", pick(rng, STONES), outline, (along, 0, 0))
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


def window(model, rng):
    """A surround of long and short stones, voussoirs with a keystone, and a sill; it lines the whole depth."""
    group, depth = "window", HALF + 0.035
    lo, hi = MIDDLE - depth, MIDDLE + depth

    def slab(stone, outline, out=0.0):
        model.prism(group, stone, [(x, y, hi + out) for x, y in outline], (0, 0, lo - hi - 2 * out))
    heights = spaced(SILL, SPRING, 0.26)
    for i, (y0, y1) in enumerate(zip(heights, heights[1:])):
        for side in (-1, 1):
            long = 0.34 if i % 2 == 0 else 0.20
            x0, x1 = sorted((WINDOW + side * REACH, WINDOW + side * (REACH + long)))
            slab(pick(rng, STONES), [(x0, y0 + 0.003), (x1, y0 + 0.003), (x1, y1 - 0.003), (x0, y1 - 0.003)],
                 0.004 * (i % 2))
    count = 13
    for i in range(count):
        key = i == count // 2
        a0, a1 = math.pi * i / count + 0.004, math.pi * (i + 1) / count - 0.004
        outer = REACH + (0.36 if key else 0.24 + 0.02 * (i % 2))
        inner = REACH - (0.03 if key else 0.0)
        turn = [a0 + (a1 - a0) * k / 4 for k in range(5)]
        ring = [(WINDOW + outer * math.cos(a), SPRING + outer * math.sin(a)) for a in turn]
        ring += [(WINDOW + inner * math.cos(a), SPRING + inner * math.sin(a)) for a in turn[::-1]]
        slab("limestone_pale" if key else pick(rng, STONES), ring, 0.03 if key else 0.004 * (i % 2))
    x0, x1, out = WINDOW - REACH - 0.24, WINDOW + REACH + 0.24, 0.09
    profile = [(-depth - out, SILL - 0.13), (depth + out, SILL - 0.13), (depth + out, SILL - 0.05),
               (depth - 0.05, SILL), (-depth + 0.05, SILL), (-depth - out, SILL - 0.05)]
    model.prism(group, "limestone_pale", [(x1, y, MIDDLE - w) for w, y in profile], (x0 - x1, 0, 0))


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


def soil_bed(model, rng, x0, x1, z0, z1, level=0.12):
    """A lumpy, closed body of earth."""
    xs, zs = spaced(x0, x1, 0.08), spaced(z0, z1, 0.08)
    swell = [(rng.random() * 6, rng.random() * 6, rng.random() * 6.28) for _ in range(5)]
    heights = {(i, k): level + sum(0.006 * math.sin(a * x + b * z + c) for a, b, c in swell) + 0.022 * (rng.random() - 0.5)
               for i, x in enumerate(xs) for k, z in enumerate(zs)}

    def top(i, k):
        return (xs[i], heights[i, k], zs[k])
    for i in range(len(xs) - 1):
        for k in range(len(zs) - 1):
            model.face("bed", pick(rng, SOILS), [top(i, k + 1), top(i + 1, k + 1), top(i + 1, k)])
            model.face("bed", pick(rng, SOILS), [top(i, k + 1), top(i + 1, k), top(i, k)])
    last_x, last_z = len(xs) - 1, len(zs) - 1
    for rim in ([(i, last_z) for i in range(last_x + 1)], [(last_x, k) for k in range(last_z, -1, -1)],
                [(i, 0) for i in range(last_x, -1, -1)], [(0, k) for k in range(last_z + 1)]):
        foot = [(xs[i], -0.1, zs[k]) for i, k in (rim[0], rim[-1])]
        model.face("bed", "soil_dark", foot + [top(*at) for at in rim[::-1]])
    model.face("bed", "soil_dark", [(x0, -0.1, z0), (x1, -0.1, z0), (x1, -0.1, z1), (x0, -0.1, z1)])


def kerb(model, rng, start, end, wide=0.12, high=0.17):
    """Stones with a chamfer from one point of the ground to another, along x or z."""
    (x0, z0), (x1, z1) = start, end
    length = abs(x1 - x0) + abs(z1 - z0)
    for a, b in zip(spaced(0, length, 0.52), spaced(0, length, 0.52)[1:]):
        a, b, lift = a + 0.004, b - 0.004, 0.006 * rng.random()
        profile = [(-wide / 2, -0.08), (wide / 2, -0.08), (wide / 2, high - 0.02 + lift),
                   (wide / 2 - 0.02, high + lift), (-wide / 2 + 0.02, high + lift), (-wide / 2, high - 0.02 + lift)]
        stone = pick(rng, STONES)
        if z0 == z1:
            model.prism("kerb", stone, [(x0 + b, y, z0 - w) for w, y in profile], (a - b, 0, 0))
        else:
            model.prism("kerb", stone, [(x0 + w, y, z0 + b) for w, y in profile], (0, 0, a - b))


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


def flag(model, rng, x0, z0, x1, z1):
    gap, bevel = 0.006, 0.012
    x0, z0, x1, z1 = x0 + gap, z0 + gap, x1 - gap, z1 - gap
    level = [0.004 + 0.008 * (rng.random() - 0.5)] * 4
    level = [v + 0.003 * (rng.random() - 0.5) for v in level]
    rims = [(x0, z1), (x1, z1), (x1, z0), (x0, z0)]
    mid_x, mid_z = 0.5 * (x0 + x1), 0.5 * (z0 + z1)

    def ring(inset, drop):
        return [(x + math.copysign(inset, mid_x - x), v - drop, z + math.copysign(inset, mid_z - z))
                for (x, z), v in zip(rims, level)]
    foot = [(x, -0.05, z) for x, z in rims]
    low, high, material = ring(0, bevel), ring(bevel, 0), pick(rng, SLABS)
    for a, b in ((foot, low), (low, high)):
        for i in range(4):
            j = (i + 1) % 4
            model.face("paving", material, [a[i], a[j], b[j], b[i]])
    model.face("paving", material, [high[0], high[1], high[2]])
    model.face("paving", material, [high[0], high[2], high[3]])
    model.face("paving", material, foot[::-1])


def courtyard():
    model, rng = Model(), random.Random(1989)
    main_wall(model, rng)
    return_wall(model, rng)
    for x in (-2.12, 0.64):
        buttress(model, rng, x)
    pier(model, rng, 2.76, MIDDLE, 0.24, 2.52, 0.13)
    pier(model, rng, RETURN_X, RETURN_END + 0.22, 0.24, 1.56, 0.13)
    window(model, rng)
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
    here = pathlib.Path(__file__).resolve().parent
    courtyard().write(here / "courtyard.obj", "A courtyard wall with an arched window")
    column().write(here / "column.obj", "A round column on a plinth")
    maze_walls().write(here / "maze_walls.obj", "A flat frame with bars")
