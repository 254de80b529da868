#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Mesh of a valve with three leaflets at an aortic root: valve.vtu beside this file (needs numpy and scipy).

Every leaflet is a family of conic sections. At level z (0 at the nadir, H at the commissures) it hangs on the wall, a
cylinder of radius R, at the angles -theta(z) and theta(z) of its crown, a superellipse fitted to digitised crowns; its
midline runs from the wall to half the opening b. Half a leaflet is meshed by Delaunay's rule in arc lengths along section
and midline, which nearly keeps distances, relaxed as a truss, mirrored and turned twice by 120 degrees. Normals point
outward and up, to the aorta. The file marks the vertices on the crown (`attached`) and gives each triangle the direction
around its leaflet (`circumference`). Lengths below in mm, in the file in m.
"""
from pathlib import Path

import numpy as np
from scipy.spatial import Delaunay, cKDTree

R = 12.7                    # of the wall
H = 1.17 * R                # height of the commissures
H_CROWN = 0.896 * H         # where the crown turns into vertical commissures
POST = 1.6                  # gap between neighbouring leaflets at the wall
PSI = np.pi / 3 - np.arcsin(POST / 2 / R)
M, N = 2.08, 2.21           # exponents of the crown
B = 0.08 * R                # half the opening in the middle, stress-free
P = 1.2                     # exponent of the midline
DIP = 0.35 * R              # how far the free edge hangs in the middle
DIP_WIDTH = 0.2
SIZE = 1.98                 # of an element


def crown_angle(z):
    return PSI * (1 - np.clip(1 - z / H_CROWN, 0, 1) ** N) ** (1 / M)


def midline_radius(z):
    q = np.clip((H - z) / H, 0, 1)
    return R - (R - B) * np.maximum(1 - q**P, 0) ** (1 / P)


def section(z, y):
    """Points of the section of level z at the widths y."""
    at_wall = R * np.array([np.cos(crown_angle(z)), max(np.sin(crown_angle(z)), 1e-9 / R)])
    e = y / at_wall[1]
    middle = midline_radius(z)
    x = np.sqrt(np.maximum(middle**2 + (at_wall[0] ** 2 - middle**2) * e**2, 0))
    c = DIP_WIDTH
    hang = (np.sqrt(c * c + 1) - np.sqrt(c * c + e * e)) / (np.sqrt(c * c + 1) - c)
    return np.column_stack([x, y, z * (1 - DIP / H * hang)])


def lengths_along(points):
    return np.r_[0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]


def half_section(z, n=400):
    """Widths and arc lengths from the middle to the wall."""
    y = R * np.sin(crown_angle(z)) * np.linspace(0, 1, n)
    return y, lengths_along(section(z, y))


class Chart:
    """From (arc length across, arc length along the midline) to space."""

    def __init__(self):
        self.z = H * np.linspace(0, 1, 4000) ** 2
        middle = np.column_stack([midline_radius(self.z), self.z * (1 - DIP / H)])
        self.s = lengths_along(middle)
        self.length = self.s[-1]
        levels = H * np.linspace(0, 1, 400) ** 2
        self.s_levels = np.interp(levels, self.z, self.s)
        self.half = np.array([half_section(z)[1][-1] for z in levels])

    def half_width(self, s):
        return np.interp(s, self.s_levels, self.half)

    def point(self, across, along):
        z = np.interp(along, self.s, self.z)
        y, arc = half_section(z)
        width = np.interp(min(abs(across), arc[-1]), arc, y)
        return section(z, np.array([np.copysign(width, across)]))[0]


def resampled(points, size):
    d = lengths_along(points)
    t = np.linspace(0, d[-1], max(1, round(d[-1] / size)) + 1)
    return np.column_stack([np.interp(t, d, points[:, k]) for k in range(2)])


def inside(points, polygon):
    """Even-odd rule."""
    found = np.zeros(len(points), bool)
    for (x0, y0), (x1, y1) in zip(polygon, np.roll(polygon, -1, axis=0)):
        if y0 != y1:
            crosses = (y0 > points[:, 1]) != (y1 > points[:, 1])
            found ^= crosses & (points[:, 0] < x0 + (points[:, 1] - y0) / (y1 - y0) * (x1 - x0))
    return found


def twice_areas(points, triangles):
    a, b, c = points[triangles[:, 0]], points[triangles[:, 1]], points[triangles[:, 2]]
    return (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]


def triangulated(points, outline):
    t = Delaunay(points).simplices
    return t[inside(points[t].mean(axis=1), outline) & (np.abs(twice_areas(points, t)) > 1e-3 * SIZE**2)]


def half_leaflet(chart):
    """Points in the chart, triangles, and how many of the points, which come first, are on the crown."""
    along = chart.length * np.linspace(0, 1, 1500) ** 1.5
    crown = resampled(np.column_stack([chart.half_width(along), along]), SIZE)
    top = resampled(np.array([[crown[-1, 0], chart.length], [0, chart.length]]), SIZE)
    axis = resampled(np.array([[0, chart.length], [0, 0]]), SIZE)
    outline = np.r_[crown[:-1], top[:-1], axis[:-1]]
    rows = np.arange(0, chart.length, SIZE * np.sqrt(3) / 2)
    seeds = np.array([(SIZE * (i + 0.5 * (j % 2)), y) for j, y in enumerate(rows) for i in range(int(20 / SIZE))])
    seeds = seeds[inside(seeds, outline)]
    near = cKDTree(resampled(np.r_[outline, outline[:1]], SIZE / 8)).query(seeds)[0] < 0.55 * SIZE
    points = np.r_[outline, seeds[~near]]
    for sweep in range(200):  # bars that only push, rest length a little above the mean
        if sweep % 10 == 0:
            t = triangulated(points, outline)
            bars = np.unique(np.sort(np.r_[t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]], axis=1), axis=0)
        d = points[bars[:, 1]] - points[bars[:, 0]]
        length = np.linalg.norm(d, axis=1)
        push = np.maximum(1.15 * np.sqrt((length**2).mean()) - length, 0)[:, None] * d / length[:, None]
        force = np.zeros_like(points)
        np.add.at(force, bars[:, 0], -push)
        np.add.at(force, bars[:, 1], push)
        force[: len(outline)] = 0
        points = points + 0.2 * force
    t = triangulated(points, outline)
    t[twice_areas(points, t) < 0] = t[twice_areas(points, t) < 0][:, ::-1]
    return points, t, len(crown)


def leaflet():
    chart = Chart()
    points, triangles, n_crown = half_leaflet(chart)
    mirror = np.arange(len(points))
    off_axis = points[:, 0] >= 1e-9
    mirror[off_axis] = len(points) + np.arange(off_axis.sum())
    attached = np.zeros(len(points) + off_axis.sum(), bool)
    attached[:n_crown] = True
    attached[mirror[:n_crown]] = True
    points = np.r_[points, points[off_axis] * [-1, 1]]
    triangles = np.r_[triangles, mirror[triangles][:, ::-1]]
    x = np.array([chart.point(across, along) for across, along in points])
    a, b, c = x[triangles[:, 0]], x[triangles[:, 1]], x[triangles[:, 2]]
    outward_up = np.column_stack([x[triangles].mean(axis=1)[:, 0], x[triangles].mean(axis=1)[:, 1], np.full(len(a), 5.0)])
    if (np.cross(b - a, c - a) * outward_up).sum() < 0:
        triangles = triangles[:, ::-1]
    return x, triangles, attached


def valve():
    x, triangles, attached = leaflet()
    parts = []
    for k in range(3):
        c, s = np.cos(2 * np.pi * k / 3), np.sin(2 * np.pi * k / 3)
        turn = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
        parts.append((x @ turn, triangles + k * len(x), attached, np.tile([-s, c, 0], (len(triangles), 1))))
    return [np.concatenate(field) for field in zip(*parts)]


def array(name, kind, values, components=1):
    rows = "\n".join(" ".join(f"{v:.12g}" for v in np.atleast_1d(row)) for row in values)
    return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">\n{rows}\n</DataArray>\n'


def write(file, x, triangles, attached, circumference):
    n = len(triangles)
    with open(file, "w") as out:
        out.write('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">\n')
        out.write(f'<UnstructuredGrid><Piece NumberOfPoints="{len(x)}" NumberOfCells="{n}">\n')
        out.write("<PointData>\n" + array("attached", "UInt8", attached.astype(int)) + "</PointData>\n")
        out.write("<CellData>\n" + array("circumference", "Float64", circumference, 3) + "</CellData>\n")
        out.write("<Points>\n" + array("Points", "Float64", x * 1e-3, 3) + "</Points>\n<Cells>\n")
        out.write(array("connectivity", "Int32", triangles) + array("offsets", "Int32", 3 * np.arange(1, n + 1)))
        out.write(array("types", "UInt8", np.full(n, 5)) + "</Cells>\n</Piece></UnstructuredGrid>\n</VTKFile>\n")


if __name__ == "__main__":
    mesh = valve()
    write(Path(__file__).with_name("valve.vtu"), *mesh)
    print(f"valve.vtu: {len(mesh[1])} triangles, {len(mesh[0])} vertices, {mesh[2].sum()} of them attached")
