#!/usr/bin/env python3
"""Makes the demo arm's meshes: surfaces of revolution and lofts of rounded rectangles, closed, as OBJ files [m].

rviz colours them as their material file says, not as the URDF does.

usage: make_demo_meshes.py DIRECTORY
"""
import math
import os
import sys

SIDES = 32


def ring(centre, radius_u, radius_v, u, v, power=2.0):
    """Points of a superellipse about `centre`: power 2 is an ellipse, a larger one a rounded rectangle."""
    points = []
    for i in range(SIDES):
        angle = 2.0 * math.pi * i / SIDES
        c, s = math.cos(angle), math.sin(angle)
        a = radius_u * math.copysign(abs(c) ** (2.0 / power), c)
        b = radius_v * math.copysign(abs(s) ** (2.0 / power), s)
        points.append(tuple(centre[k] + a * u[k] + b * v[k] for k in range(3)))
    return points


def loft(rings, start, end):
    """Vertices and triangles between rings along their axis, closed with a fan at each end; outside is outside."""
    vertices = [start] + [p for r in rings for p in r] + [end]
    first = lambda k: 1 + k * SIDES
    triangles = []
    for i in range(SIDES):
        j = (i + 1) % SIDES
        triangles.append((0, first(0) + j, first(0) + i))
        for k in range(len(rings) - 1):
            a, b, c, d = first(k) + i, first(k) + j, first(k + 1) + i, first(k + 1) + j
            triangles += [(a, b, d), (a, d, c)]
        triangles.append((len(vertices) - 1, first(len(rings) - 1) + i, first(len(rings) - 1) + j))
    return vertices, triangles


def along_x(sections, power=2.0):
    """A loft along x through sections (x, half height in y, half height in z)."""
    rings = [ring((x, 0.0, 0.0), ry, rz, (0, 1, 0), (0, 0, 1), power) for x, ry, rz in sections]
    return loft(rings, (sections[0][0], 0.0, 0.0), (sections[-1][0], 0.0, 0.0))


def along_z(sections, power=2.0):
    rings = [ring((0.0, 0.0, z), rx, ry, (1, 0, 0), (0, 1, 0), power) for z, rx, ry in sections]
    return loft(rings, (0.0, 0.0, sections[0][0]), (0.0, 0.0, sections[-1][0]))


def round_end(x, radius, sign):
    """Sections of half a ball at x, from its pole or up to it."""
    angles = [10, 30, 50, 70] if sign < 0 else [70, 50, 30, 10]
    return [(x + sign * radius * math.cos(math.radians(a)), radius * math.sin(math.radians(a)),
             radius * math.sin(math.radians(a))) for a in angles]


COLOURS = {'dark': (0.25, 0.25, 0.28), 'steel': (0.55, 0.58, 0.62), 'orange': (0.95, 0.50, 0.15)}

MESHES = {
    'pedestal': ('dark', lambda: along_z([(0.0, 0.14, 0.14), (0.02, 0.14, 0.14), (0.06, 0.09, 0.09), (0.22, 0.075, 0.075),
                                 (0.25, 0.085, 0.085)])),
    'turret': ('steel', lambda: along_z([(0.0, 0.085, 0.085), (0.03, 0.085, 0.085), (0.06, 0.06, 0.08), (0.14, 0.055, 0.07),
                               (0.16, 0.04, 0.05)], 4.0)),
    'upper_arm': ('orange', lambda: along_x(round_end(0.0, 0.055, -1) + [(0.0, 0.055, 0.055), (0.1, 0.045, 0.05),
                                                              (0.3, 0.035, 0.04), (0.4, 0.045, 0.045)]
                                 + round_end(0.4, 0.045, 1))),
    'forearm': ('orange', lambda: along_x([(0.055, 0.03, 0.03), (0.07, 0.038, 0.038), (0.2, 0.03, 0.03), (0.3, 0.026, 0.026)])),
    'palm': ('dark', lambda: along_x([(0.03, 0.02, 0.02), (0.035, 0.03, 0.025), (0.08, 0.032, 0.026), (0.095, 0.02, 0.02)], 5.0)),
}


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    os.makedirs(sys.argv[1], exist_ok=True)
    with open(os.path.join(sys.argv[1], 'arm.mtl'), 'w') as file:
        for name, colour in COLOURS.items():
            file.write('newmtl %s\nKd %.2f %.2f %.2f\nKa %.2f %.2f %.2f\n' % ((name,) + colour + colour))
    for name, (colour, make) in MESHES.items():
        vertices, triangles = make()
        with open(os.path.join(sys.argv[1], name + '.obj'), 'w') as file:
            file.write('# Made by scripts/make_demo_meshes.py\nmtllib arm.mtl\nusemtl %s\n' % colour)
            file.writelines('v %.5f %.5f %.5f\n' % v for v in vertices)
            file.writelines('f %d %d %d\n' % tuple(i + 1 for i in t) for t in triangles)


if __name__ == '__main__':
    main()
