#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Where the free edge of a sheet acts on a grid of squares.

A half plane stands between two columns of cells (theta = 1/2) and cuts the links of the rows up to its edge.  In the flow
without friction its faces are blocked: potential r^1/2 sin(a/2), a the angle from the plane's continuation.  Friction
alone holds the velocity to that of the sheet: r^1/2 cos(a/2), by the stencil of a cut cell.  Far away the grid's solution is that of a
half plane that ends at another place: without the term r^-1/2 of a shift.  Printed is that place, in cells beyond the
end of the last row that is cut, also for a last row that is cut with a weight w and open with 1 - w.

Usage: validation/convergence/half_plane.py
"""
import numpy as np

half = 100  # cells from the edge to the sides of the grid
x, y = np.meshgrid(np.arange(-half, half) + 0.5, np.arange(-half, half + 1) - 0.5, indexing="ij")  # last cut row ends at y = 0
low, high = half - 1, half  # columns beside the plane
rows = y[0, 1:-1]


def exact(kind, end):
    """Of a half plane that ends at y = end."""
    angle, radius = np.arctan2(x, y - end), np.hypot(x, y - end)
    return np.sqrt(radius) * (np.sin(angle / 2) if kind == "flux" else np.cos(angle / 2))


def links(kind, last_weight):
    """Coefficients of the cells beside the plane, by row: of the cell across, of the cell away from it, and their own."""
    weight = np.where(rows < -1, 1.0, np.where(rows < 0, last_weight, 0.0))
    if kind == "flux":
        return 1.0 - weight, np.ones_like(weight), weight - 2.0
    # (u_e - u)/h_e - (u - u_w)/h_w over (h_e + h_w)/2 with the lengths 1/2 and 1
    return 1.0 - weight, 1.0 - weight + weight / 0.75, -2.0 * (1.0 - weight) - 3.0 / 0.75 * weight


def solver(kind, last_weight):
    """Solves the Laplace equation inside for the values on the sides: block elimination, column by column."""
    across, away, own = links(kind, last_weight)
    ones = np.ones_like(rows)
    neighbours = np.eye(rows.size, k=1) + np.eye(rows.size, k=-1) - 2.0 * np.eye(rows.size)
    columns = range(1, x.shape[0] - 1)
    to_low = {i: away if i == low else across if i == high else ones for i in columns}
    to_high = {i: across if i == low else away if i == high else ones for i in columns}
    inverse, before = {}, 0.0
    for i in columns:
        diagonal = neighbours + np.diag(own if i in (low, high) else -2.0 * ones)
        inverse[i] = np.linalg.inv(diagonal - before)
        if i + 1 in to_low:
            before = to_low[i + 1][:, None] * inverse[i] * to_high[i]

    def solve(sides):
        u, right = sides.copy(), {}
        for i in columns:
            right[i] = -to_low[i] * (sides[i - 1, 1:-1] if i == 1 else inverse[i - 1] @ right[i - 1])
            right[i][0] -= sides[i, 0]
            right[i][-1] -= sides[i, -1]
        for i in reversed(columns):
            u[i, 1:-1] = inverse[i] @ (right[i] - to_high[i] * u[i + 1, 1:-1])
        return u

    return solve


def acts_at(kind, last_weight):
    """The end of the half plane whose values on the sides of the grid leave no r^-1/2 inside."""
    solve = solver(kind, last_weight)
    ring = (np.hypot(x, y) > half / 6) & (np.hypot(x, y) < half / 3)

    def left(end):
        shift = ((exact(kind, end + 0.01) - exact(kind, end - 0.01)) / 0.02)[ring]
        return (solve(exact(kind, end)) - exact(kind, end))[ring] @ shift / (shift @ shift)

    ends, rests = [-0.5, 0.5], [left(-0.5), left(0.5)]
    while abs(rests[-1]) > 1e-8:
        ends.append(ends[-1] - rests[-1] * (ends[-1] - ends[-2]) / (rests[-1] - rests[-2]))
        rests.append(left(ends[-1]))
    return ends[-1]


print("weight of the last row | without friction | friction")
for last_weight in (1.0, 0.9, 0.75, 0.5, 0.25, 0.1):
    print(f"{last_weight:.2f} | {acts_at('flux', last_weight):+.4f} | {acts_at('friction', last_weight):+.4f}")
