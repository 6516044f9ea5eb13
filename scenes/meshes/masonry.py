"""What the walls, beds and floors of the scripts beside this file are built of: bricks, stones, earth.

Standard library only; the same bytes on every run. Metres, y up.
"""
import math
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

    def write(self, path, about, maker, unit="metres, y up"):
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


def pier(model, rng, x, z, half, height, finial, over=(0.03, 0.07)):
    """A square brick pier with a stone cap in two steps and a ball on it."""
    core = half - PROUD
    model.box("wall", "mortar", (x - core, -0.15, z - core), (x + core, height, z + core))
    for face in four_faces(x, z, core):
        lay_bricks(model, rng, face, 2 * core, lambda u: height, phase=0.02)
    for lift, reach, tall, stone in ((0.0, over[0], 0.05, "limestone_grey"), (0.05, over[1], 0.08, "limestone_pale")):
        w = half + reach
        model.box("coping", stone, (x - w, height + lift, z - w), (x + w, height + lift + tall, z + w))
    w, base, tip = half + over[1] - 0.02, height + 0.13, height + 0.25
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


class Window:
    """An arched opening in a wall along x: its middle, sill, spring of the arch, half width."""

    def __init__(self, middle, sill, spring, reach):
        self.middle, self.sill, self.spring, self.reach = middle, sill, spring, reach
        self.hidden = reach + 0.06  # the stones of the surround cover the core's edge

    def head(self, reach, u):
        """The height of a round arch's edge at u from the middle, or None beside it."""
        return self.spring + math.sqrt(max(0.0, reach * reach - u * u)) if abs(u) <= reach + 1e-9 else None

    def hole(self, u):
        """For wall_body."""
        head = self.head(self.hidden, u - self.middle)
        return (self.sill - 0.06, head) if head else None

    def stations(self):
        return [self.middle - self.hidden * math.cos(math.pi * i / 20) for i in range(1, 20)]

    def gaps(self, mirror):
        """For lay_bricks; `mirror` gives u for an x."""
        def gaps(v0, v1):
            if v1 < self.sill - 0.12 or v0 > self.spring + self.hidden:
                return []
            wide = self.hidden + 0.04
            if v1 < self.sill:
                reach = self.reach + 0.16
            else:
                reach = wide if v0 < self.spring else math.sqrt(max(0.0, wide ** 2 - (v0 - self.spring) ** 2))
            middle = mirror(self.middle)
            return [(middle - reach, middle + reach)]
        return gaps

    def surround(self, model, rng, z, half, group="window"):
        """Long and short stones, voussoirs with a keystone, and a sill; they line the whole depth of the wall."""
        depth = half + 0.035
        lo, hi, middle = z - depth, z + depth, self.middle

        def slab(stone, outline, out=0.0):
            model.prism(group, stone, [(x, y, hi + out) for x, y in outline], (0, 0, lo - hi - 2 * out))
        heights = spaced(self.sill, self.spring, 0.26)
        for i, (y0, y1) in enumerate(zip(heights, heights[1:])):
            for side in (-1, 1):
                long = 0.34 if i % 2 == 0 else 0.20
                x0, x1 = sorted((middle + side * self.reach, middle + side * (self.reach + long)))
                slab(pick(rng, STONES), [(x0, y0 + 0.003), (x1, y0 + 0.003), (x1, y1 - 0.003), (x0, y1 - 0.003)],
                     0.004 * (i % 2))
        count = 13
        for i in range(count):
            key = i == count // 2
            a0, a1 = math.pi * i / count + 0.004, math.pi * (i + 1) / count - 0.004
            outer = self.reach + (0.36 if key else 0.24 + 0.02 * (i % 2))
            inner = self.reach - (0.03 if key else 0.0)
            turn = [a0 + (a1 - a0) * k / 4 for k in range(5)]
            ring = [(middle + outer * math.cos(a), self.spring + outer * math.sin(a)) for a in turn]
            ring += [(middle + inner * math.cos(a), self.spring + inner * math.sin(a)) for a in turn[::-1]]
            slab("limestone_pale" if key else pick(rng, STONES), ring, 0.03 if key else 0.004 * (i % 2))
        x0, x1, out = middle - self.reach - 0.24, middle + self.reach + 0.24, 0.09
        sill = self.sill
        profile = [(-depth - out, sill - 0.13), (depth + out, sill - 0.13), (depth + out, sill - 0.05),
                   (depth - 0.05, sill), (-depth + 0.05, sill), (-depth - out, sill - 0.05)]
        model.prism(group, "limestone_pale", [(x1, y, z - w) for w, y in profile], (x0 - x1, 0, 0))


def plinth(model, rng, face, width):
    """Four courses that stand out from the foot of a wall, with a sloping course of stone on them."""
    lay_bricks(model, rng, face, width, lambda u: 0.30, proud=0.045, last=4, phase=0.25, edge=0.0)
    stones = spaced(0.0, width, 0.7)
    for a, b in zip(stones, stones[1:]):
        outline = [face.at(a + 0.003, 0.31, 0.055), face.at(a + 0.003, 0.35, 0.045), face.at(a + 0.003, 0.40, 0.0),
                   face.at(a + 0.003, 0.31, 0.0)]
        along = [(b - a - 0.006) * c for c in face.along]
        model.prism("wall", pick(rng, STONES), outline, (along[0], 0, along[1]))


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
