# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What pressed bodies bear, at their surface and inside."""

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPointSet, vtkPolyData

from .arguments import listed, progress_callback, surface_of, vectors, whole_number
from .arrays import as_vtk
from .errors import run
from .PalpateElastostatics import vtkInteriorProbe, vtkSurfaceStress

__all__ = ["probe", "surface_stress"]


def surface_stress(pressed):
    """Strain and stress at the surface of a pressed body.

    Parameters
    ----------
    pressed : vtkPolyData
        From `press` or `solve`, m triangles: of a solid of any materials, a cavity or a half-space, not
        of shells, given matrices and what is on springs.

    Returns
    -------
    vtkPolyData
        The same with the cell arrays `Strain` and `Stress` (m by 6: xx, yy, zz, xy, yz, xz; Pa),
        `VonMisesStress` (m) and `PrincipalStress` (m by 3, the largest first). Their error is of the
        first order in the edges.

    Raises
    ------
    Error
        With the sentence of what is wrong.

    Examples
    --------
    >>> import palpate
    >>> model = palpate.precompute(palpate.refine(palpate.read(palpate.example("nodule"))), 1e4, 0.4)
    >>> top = palpate.press(model, point=(0, 0, 1), force=(0, 0, -1), radius=0.02)
    >>> stressed = palpate.surface_stress(top)
    >>> bool(palpate.array(stressed, "PrincipalStress")[:, 2].min() < 0)  # it is pressed
    True
    """
    algorithm = vtkSurfaceStress()
    algorithm.SetInputData(surface_of(pressed))
    return run(algorithm)


def probe(pressed, points, *, threads=0, progress=None):
    """Displacement, strain and stress at places inside a pressed body.

    Parameters
    ----------
    pressed : vtkPolyData
        From `press` or `solve`, of one isotropic material, whatever method computed the model; or of
        several with these points among its `probes` (see `precompute`).
    points : array_like or vtkPointSet
        k by 3, or data of k points. Use a `vtkInteriorProbe` where many contacts are probed at the same
        places: it keeps the integrals.
    threads : int
        0 for all cores, at most 1024.
    progress : callable or bool, optional
        As in `precompute`.

    Returns
    -------
    vtkPolyData
        The points with `Displacement` (k by 3), `Strain` and `Stress` (k by 6: xx, yy, zz, xy, yz, xz;
        Pa), `VonMisesStress`, `PrincipalStress` (k by 3, the largest first), `InsideMaterial` (0 where
        there is none, with zeros in the others) and `EdgesFromSurface`: below one the surface's kinks
        show in strains.

    Raises
    ------
    Error
        With the sentence of what is wrong.

    Examples
    --------
    >>> import palpate
    >>> model = palpate.precompute(palpate.refine(palpate.read(palpate.example("nodule"))), 1e4, 0.4)
    >>> top = palpate.press(model, point=(0, 0, 1), force=(0, 0, -1), radius=0.02)
    >>> middle = model.GetCenter()
    >>> inside = palpate.probe(top, [middle])
    >>> bool(palpate.array(inside, "Stress")[0, 2] < 0)  # it is pressed
    True
    """
    algorithm = vtkInteriorProbe()
    algorithm.SetInputData(surface_of(pressed))
    if not isinstance(points, vtkPointSet):
        places = listed(points, "points")
        places = vectors(places, len(places), "points")
        points = vtkPolyData()
        coordinates = vtkPoints()
        coordinates.SetData(as_vtk(places, "Points", 3))
        points.SetPoints(coordinates)
    algorithm.SetProbeData(points)
    algorithm.SetNumberOfThreads(whole_number(threads, "threads", 1024))
    return run(algorithm, progress_callback(progress))
