# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A body of springs, and its stiffness in the formats of other programs."""

import numpy as np

from support.surfaces import polydata


def truss(scale=1e5):
    """Springs between all corners and the middle of an octahedron, loose: stiffness, surface, points."""
    points = np.vstack([np.eye(3), -np.eye(3), np.zeros(3)])
    stiffness = np.zeros((21, 21))
    for i in range(7):
        for j in range(i):
            along = points[i] - points[j]
            along /= np.linalg.norm(along)
            spring = np.kron([[1, -1], [-1, 1]], scale * np.outer(along, along))
            rows = [3 * k + c for k in (i, j) for c in range(3)]
            stiffness[np.ix_(rows, rows)] += spring
    triangles = [(x, y, z) if (x < 3) ^ (y < 3) ^ (z < 3) else (x, z, y)
                 for x in (0, 3) for y in (1, 4) for z in (2, 5)]
    return stiffness, polydata(points[:6], triangles), points


def lower_triangle(matrix):
    """Column by column: rows and values that are not zero."""
    return [[(i, matrix[i, j]) for i in range(j, len(matrix)) if matrix[i, j]]
            for j in range(len(matrix))]


def dmig_text(stiffness, points, name="KAAX"):
    """Bulk data in free fields, nodes from 1, three components each."""
    cards = ["BEGIN BULK", f"DMIG,{name},0,6,2,0"]
    for j, column in enumerate(lower_triangle(stiffness)):
        cards += [f"DMIG,{name},{j // 3 + 1},{j % 3 + 1},,{i // 3 + 1},{i % 3 + 1},{float(value)!r}"
                  for i, value in column]
    cards += [f"GRID,{i + 1},,{float(x)!r},{float(y)!r},{float(z)!r}"
              for i, (x, y, z) in enumerate(points)]
    return "\n".join(cards + ["ENDDATA", ""])


def market_text(stiffness):
    """Matrix Market, coordinate, symmetric."""
    entries = [f"{i + 1} {j + 1} {float(value)!r}"
               for j, column in enumerate(lower_triangle(stiffness)) for i, value in column]
    size = len(stiffness)
    return "\n".join(["%%MatrixMarket matrix coordinate real symmetric",
                      f"{size} {size} {len(entries)}", *entries, ""])


def harwell_boeing_text(stiffness):
    """As Ansys' HBMAT writes it: numbers of Fortran, a line each."""
    columns, size = lower_triangle(stiffness), len(stiffness)
    starts = np.cumsum([1] + [len(column) for column in columns])
    lines = ["stiffness".ljust(72) + "K", "".join(f"{count:14d}" for count in (1, 1, 1, 1, 0)),
             f"RSA{'':11}{size:14d}{size:14d}{starts[-1] - 1:14d}{0:14d}",
             "(8I10)".ljust(16) + "(1I10)".ljust(16) + "(1P,1E25.16)".ljust(20)]
    lines += ["".join(f"{start:10d}" for start in starts[k:k + 8]) for k in range(0, size + 1, 8)]
    lines += [f"{i + 1:10d}" for column in columns for i, _ in column]
    lines += [f"{value:25.16E}".replace("E", "D") for column in columns for _, value in column]
    return "\n".join(lines + [""])


def mapping_text(size):
    """What HBMAT says of the rows of nodes from 1, three each."""
    rows = [f"{row + 1:10d}{row // 3 + 1:10d}   U{'XYZ'[row % 3]}" for row in range(size)]
    return "\n".join(["Matrix Eqn   Node   DOF", *rows, ""])
