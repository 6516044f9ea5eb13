#!/usr/bin/env python3
"""Writes lsystem_tree.json beside this script: a tree by a bracketed L-system, as nodes with radii.

    python3 scenes/skeletons/make_lsystem_tree.py

Standard library only; the same bytes on every run. Metres, y up, the root at the origin. The system is the ternary tree of Prusinkiewicz and Lindenmayer, "The Algorithmic Beauty of Plants" (1990),
section 2.2: an apex becomes a shoot and three apices, while all older shoots stretch and thicken.

    axiom  F A        A -> ! F [&FA] / [&FA] / [&FA]        F -> longer, ! -> thicker

A turtle draws the word: F walks, & pitches down, / rolls, [ and ] keep and take up where it is. It bends
towards the light at each step (tropism), more in thin shoots. Where a plain system has equal branches, these
differ a little, each by random numbers with a seed, so the file is always the same.
"""
import json
import math
import pathlib
import random

GENERATIONS = 6
LENGTH = 0.40           # of a young shoot, metres
STRETCH = 1.13          # of older shoots, in each generation
TWIG = 0.006            # radius of a young shoot, metres
THICKENS = 1.68         # in each generation; sqrt(3) would keep cross sections
ROLLS = 94.7, 132.6, 132.7
PITCHES = 12.0, 37.0, 46.0
STEPS = 2               # nodes of a shoot
UP = 0.05               # how far a step of a young shoot turns to the light


def word(generations):
    """The word after so many generations: (letter, age) pairs."""
    letters = [("F", 0), ("A", 0)]
    for _ in range(generations):
        grown = []
        for letter, age in letters:
            if letter == "A":
                grown.append(("F", 0))
                for branch in range(3):
                    grown += [("[", 0), ("&", branch), ("F", 0), ("A", 0), ("]", 0), ("/", branch)]
            elif letter == "F":
                grown.append(("F", age + 1))
            else:
                grown.append((letter, age))
        letters = grown
    return letters


def turned(v, axis, degrees):
    """v about a unit axis (Rodrigues)."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    dot = sum(a * b for a, b in zip(v, axis))
    return tuple(c * a + s * b + (1 - c) * dot * k for a, b, k in zip(v, cross(axis, v), axis))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(v):
    length = math.sqrt(sum(a * a for a in v))
    return tuple(a / length for a in v)


def draw(letters):
    """Nodes of the word: parents, positions, radii."""
    random.seed(151)
    parent, position, radius = [-1], [(0.0, 0.0, 0.0)], [TWIG * THICKENS**GENERATIONS]
    node, heading, left = 0, (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)
    kept = []
    for letter, value in letters:
        if letter == "F":
            length = LENGTH * STRETCH**value * random.uniform(0.82, 1.12) / STEPS
            for step in range(1, STEPS + 1):
                up = UP / (1 + value)
                heading = unit((heading[0], heading[1] + up, heading[2]))
                left = unit(cross(cross(heading, left), heading))
                parent.append(node)
                position.append(tuple(p + length * h for p, h in zip(position[node], heading)))
                radius.append(TWIG * THICKENS ** (value + 0.6 * (1 - step / STEPS)))
                node = len(parent) - 1
        elif letter == "&":
            heading = unit(turned(heading, left, PITCHES[value] * random.uniform(0.75, 1.25)))
        elif letter == "/":
            left = unit(turned(left, heading, ROLLS[value] + random.uniform(-20, 20)))
        elif letter == "[":
            kept.append((node, heading, left))
        elif letter == "]":
            node, heading, left = kept.pop()
    return parent, position, radius


def main():
    parent, position, radius = draw(word(GENERATIONS))
    plant = {
        "name": "lsystem_tree",
        "parent": parent,
        "position_m": [[round(p, 3) for p in place] for place in position],
        "radius_m": [round(r, 4) for r in radius],
    }
    text = json.dumps({"espalier": "skeleton/1", "plants": [plant]}, separators=(",", ":"))
    pathlib.Path(__file__).with_name("lsystem_tree.json").write_text(text + "\n", encoding="ascii")


if __name__ == "__main__":
    main()
