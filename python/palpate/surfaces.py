# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is done to surfaces before."""

from .arguments import (
    SUBDIVISIONS,
    choice,
    flag,
    number,
    positive,
    progress_callback,
    surface_of,
    whole_number,
)
from .errors import Error, run
from .PalpateElastostatics import (
    vtkElasticMeshRepair,
    vtkIsotropicRemeshing,
    vtkOriginalSurface,
    vtkSurfaceRefinement,
)

__all__ = ["on_original", "refine", "remesh", "repair"]


def remesh(surface, edge_length=None, iterations=3, *, smooth_angle=30.0, keep_original=False,
           progress=None):
    """Another mesh of a closed surface, with edges of about one length.

    Parameters
    ----------
    surface : vtkPolyData
        A closed triangle surface. The rims of its support and of its smooth patches keep their place.
    edge_length : float, optional
        Wanted, in the surface's unit; the surface's mean edge by default.
    iterations : int
        How often the mesh is worked over, 1 to 100.
    smooth_angle : float
        Edges sharper than this, degrees, are kept where there is no cell array `SmoothPatch`.
    keep_original : bool
        Keep the surface's own points and triangles with the result, for `on_original`.
    progress : callable or bool, optional
        As in `precompute`.

    Returns
    -------
    vtkPolyData
        The surface with its `BoundaryType`, a given `SmoothPatch` and the material.

    Raises
    ------
    Error
        With the sentence of what is wrong.

    Examples
    --------
    >>> import palpate
    >>> kidney = palpate.refine(palpate.read(palpate.example("kidney")), 3)
    >>> even = palpate.remesh(kidney, 0.008)
    >>> 250 < even.GetNumberOfPoints() < 500
    True
    """
    algorithm = vtkIsotropicRemeshing()
    algorithm.SetInputData(surface_of(surface))
    if edge_length is not None:
        algorithm.SetEdgeLength(positive(edge_length, "edge_length"))
    times = whole_number(iterations, "iterations", 100)
    if times == 0:
        raise Error("iterations must be 1 to 100, not 0")
    algorithm.SetNumberOfIterations(times)
    algorithm.SetSmoothAngle(number(smooth_angle, "smooth_angle"))
    algorithm.SetKeepOriginal(flag(keep_original, "keep_original"))
    return run(algorithm, progress_callback(progress))


def on_original(data):
    """Results of a remeshed surface on the surface that it was remeshed from.

    Parameters
    ----------
    data : vtkPolyData
        What came of `precompute` with an `edge_length`, or of `remesh` with `keep_original`, through
        `press`, `stiffness` and so on, with its points and triangles as they were.

    Returns
    -------
    vtkPolyData
        The original's n points and its triangles, with `data`'s point arrays of real numbers interpolated,
        its cell arrays from the nearest triangles, and its field arrays but for the Green's functions.
        The map itself is in `data`'s field arrays `OriginalPointTriangle` (n) and `OriginalPointWeights`
        (n by 3).

    Raises
    ------
    Error
        With the sentence of what is wrong, such as for a surface that has changed.

    Examples
    --------
    >>> import palpate
    >>> kidney = palpate.refine(palpate.read(palpate.example("kidney")), 3)
    >>> model = palpate.precompute(kidney, 8e3, 0.45, edge_length=0.008)
    >>> pressed = palpate.press(model, (0, 0, 0.03), force=(0, 0, -0.1), radius=0.015)
    >>> shown = palpate.on_original(pressed)
    >>> shown.GetNumberOfPoints() == kidney.GetNumberOfPoints() > 2 * model.GetNumberOfPoints()
    True
    """
    algorithm = vtkOriginalSurface()
    algorithm.SetInputData(surface_of(data))
    return run(algorithm)


def refine(surface, levels=1, subdivision="loop", support_layers=0, limit_share=0):
    """Subdivide a closed surface, with its boundary types and other data.

    Parameters
    ----------
    surface : vtkPolyData
        A closed triangle surface.
    levels : int
        How often every triangle is split in four, 0 to 8.
    subdivision : {"loop", "flat", "curved"}
        What the surface stands for: the control mesh of a smooth one, towards which its vertices move
        (Loop 1987); itself; or a surface through its vertices, smooth but for edges sharper than 30
        degrees (Vlachos et al. 2001).
    support_layers : int
        How many layers, each a quarter as wide as the one before, triangles are then cut into along the
        rim of the support, where stresses are singular: 0 to 9. The surface needs `BoundaryType`.
    limit_share : float
        How far vertices are moved, before that, to the smooth surface that Loop's subdivision tends to:
        from 0 to 1. With 0.5 the mesh encloses what that surface does, to a higher order.

    Returns
    -------
    vtkPolyData
        Old vertices keep their numbers.

    Raises
    ------
    Error
        With the sentence of what is wrong with the surface.

    Examples
    --------
    >>> import palpate
    >>> palpate.refine(palpate.read(palpate.example("spatula")), 2).GetNumberOfPoints()
    620
    """
    share = number(limit_share, "limit_share")
    if not 0 <= share <= 1:
        raise Error(f"limit_share must be from 0 to 1, not {share:g}")
    refinement = vtkSurfaceRefinement()
    refinement.SetInputData(surface_of(surface))
    refinement.SetNumberOfLevels(whole_number(levels, "levels", 8))
    refinement.SetSubdivision(choice(subdivision, SUBDIVISIONS, "subdivision"))
    refinement.SetLimitShare(share)
    refinement.SetSupportLayers(whole_number(support_layers, "support_layers", 9))
    return run(refinement)


def repair(surface):
    """Mend a surface so that it bounds elastic bodies.

    Parameters
    ----------
    surface : vtkPolyData
        Any polygons.

    Returns
    -------
    vtkPolyData
        A sound surface; what was changed is in the field array `RepairChanges`, a sentence each. A
        sound surface comes back as it is, without that array.

    Raises
    ------
    Error
        With the sentence of what could not be mended.

    Examples
    --------
    >>> import palpate
    >>> kidney = palpate.read(palpate.example("kidney"))
    >>> palpate.repair(kidney).GetFieldData().HasArray("RepairChanges")
    0
    """
    mender = vtkElasticMeshRepair()
    mender.SetInputData(surface_of(surface))
    return run(mender)
