# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""All Green's functions of a cantilever by scikit-fem and SciPy's SuperLU, beside Palpate's finite elements.

The same quadratic tetrahedra, the same material and support, and as many right-hand sides. Needs scikit-fem
(`pip install scikit-fem`), and the package under PYTHONPATH=build/python:tests; processor time.
"""

import sys
import time

import numpy as np
import skfem
from scipy.sparse.linalg import splu
from skfem.models.elasticity import lame_parameters, linear_elasticity

import palpate
from support.solids import bar, base_of
from support.surfaces import points_of


def by_scikit_fem(points, cells):
    """Seconds to assemble, factor and solve for a unit force on each free vertex of the surface."""
    started = time.process_time()
    mesh = skfem.MeshTet(points.T, cells.T)
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementTetP2()))
    stiffness = linear_elasticity(*lame_parameters(1.0, 0.3)).assemble(basis)
    held = basis.get_dofs(lambda x: x[2] < 1e-9).all()
    free = np.setdiff1d(np.arange(stiffness.shape[0]), held)
    factors = splu(stiffness[free][:, free].tocsc())
    place = np.full(stiffness.shape[0], -1)
    place[free] = np.arange(free.size)
    rows = place[basis.nodal_dofs[:, mesh.boundary_nodes()].ravel()]
    rows = rows[rows >= 0]
    for first in range(0, rows.size, 96):
        block = np.zeros((free.size, min(96, rows.size - first)))
        block[rows[first:first + 96], np.arange(block.shape[1])] = 1
        factors.solve(block)
    return time.process_time() - started


def by_palpate(grid):
    started = time.process_time()
    palpate.precompute(grid, 1.0, 0.3, fixed=base_of(grid), method="fem", estimate_error=False)
    return time.process_time() - started


def main():
    for n in map(int, sys.argv[1:] or ("2", "3", "4")):
        grid = bar((n, n, 8 * n), (1.0, 1.0, 8.0))
        cells = np.array([[grid.GetCell(c).GetPointId(k) for k in range(4)]
                          for c in range(grid.GetNumberOfCells())])
        theirs, ours = by_scikit_fem(points_of(grid), cells), by_palpate(grid)
        print(f"n = {n}: scikit-fem {theirs:.2f} s, Palpate {ours:.2f} s, {theirs / ours:.1f} times")


if __name__ == "__main__":
    main()
