# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What bodies do where they are touched."""

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkTable

from .arguments import (
    flag,
    number,
    numbers,
    positive,
    progress_callback,
    set_mask,
    surface_of,
    vector,
    vectors,
    vertex_list,
)
from .arrays import array, as_ids, as_vtk
from .errors import Error, run
from .PalpateElastostatics import (
    vtkCapacitanceSolve,
    vtkPointContact,
    vtkStiffnessArtifacts,
    vtkSurfaceStiffness,
)

__all__ = ["press", "solve", "stiffness", "stiffness_artifacts"]


def solve(model, nodes, displacements, free_tractions=None, face_tractions=None, *, springs=None,
          foundation=None):
    """Displace some vertices and solve for all displacements, tractions and the contact force.

    Parameters
    ----------
    model : vtkPolyData
        From `precompute`, n vertices.
    nodes : array_like of int
        s vertices whose displacements are prescribed: free ones in contact, or fixed ones moved (the
        latter need their columns precomputed).
    displacements : array_like
        s by 3, metres.
    free_tractions : array_like, optional
        n by 3, pascals: the traction on the other free vertices, the same on all smooth patches of a
        vertex, so that a load on one side of a sharp edge wraps round it: use `face_tractions` there.
        Zero by default; values at fixed vertices and at `nodes` do not count.
    face_tractions : array_like, optional
        One by 3 for each triangle, pascals: tractions that may jump across sharp edges. Needs
        `patch_columns` where the surface has sharp edges.
    springs : array_like of float, optional
        s stiffnesses, N/m: the displacement is then that of the far end of a spring that holds the
        vertex; 0 for a vertex that is moved itself.
    foundation : float, optional
        N/m per square metre: all fixed vertices not in `nodes` rest on springs of this stiffness times
        their area instead, all directions alike: a third of the triangles all of whose corners rest on
        them, or of all where there is none, as in `palpate.foundation`. Needs their columns.

    Returns
    -------
    vtkPolyData
        The model with `Displacement` and `Traction` (n by 3), and the field arrays `ContactForce` and
        `ContactTorque` (1 by 3, what acts on the body at `nodes`, the torque about their centroid) and
        `ContactCondition`.

    Raises
    ------
    Error
        With the sentence of what is wrong.

    Examples
    --------
    >>> import palpate
    >>> model = palpate.precompute(palpate.read(palpate.example("kidney")), 8e3, 0.45)
    >>> node = int(palpate.greens_function_nodes(model)[0])
    >>> moved = palpate.solve(model, [node], [(0, 0, 0.001)])
    >>> round(float(palpate.array(moved, "Displacement")[node, 2]), 9)
    0.001
    """
    count = surface_of(model).GetNumberOfPoints()
    nodes = vertex_list(nodes, count, "nodes")
    values = vectors(displacements, nodes.size, "displacements")
    stiffnesses = np.zeros(nodes.size) if springs is None else numbers(springs, "springs")
    if stiffnesses.shape != nodes.shape:
        raise Error(f"springs must be {nodes.size} stiffnesses, not {'x'.join(map(str, stiffnesses.shape))}")
    if foundation is not None:
        rest = np.setdiff1d(np.flatnonzero(array(model, "BoundaryType")), nodes)
        areas = positive(foundation, "foundation") * foundation_areas(model, rest)
        nodes = np.concatenate([nodes, rest])
        values = np.concatenate([values, np.zeros((rest.size, 3))])
        stiffnesses = np.concatenate([stiffnesses, areas])
    types = np.ones(nodes.size)
    tractions = np.zeros_like(values)
    if free_tractions is not None:
        given = vectors(free_tractions, count, "free_tractions")
        counts = given.any(axis=1)  # NaN counts: the filter refuses it
        counts &= ~np.isin(np.arange(count), nodes)
        types_given = model.GetPointData().GetArray("BoundaryType")
        if types_given and types_given.GetNumberOfValues() == count:
            counts &= array(model, "BoundaryType") == 0
        loaded = np.flatnonzero(counts)
        nodes = np.concatenate([nodes, loaded])
        values = np.concatenate([values, np.zeros((loaded.size, 3))])
        tractions = np.concatenate([tractions, given[loaded]])
        types = np.concatenate([types, np.zeros(loaded.size)])
        stiffnesses = np.concatenate([stiffnesses, np.zeros(loaded.size)])

    table = vtkTable()
    for column in (as_ids(nodes, "Node"), as_vtk(values, "Displacement", 3),
                   as_vtk(tractions, "Traction", 3), as_vtk(types, "BoundaryType", 1, np.uint8),
                   as_vtk(stiffnesses, "SpringStiffness", 1)):
        table.GetRowData().AddArray(column)
    solver = vtkCapacitanceSolve()
    surface = vtkPolyData()
    surface.ShallowCopy(model)
    if face_tractions is not None:
        loads = vectors(face_tractions, model.GetNumberOfCells(), "face_tractions")
        surface.GetCellData().AddArray(as_vtk(loads, "TriangleTraction", 3))
        solver.SetTriangleTractionArrayName("TriangleTraction")
    solver.SetInputData(surface)
    solver.SetConstraintsData(table)
    return run(solver)


def foundation_areas(model, vertices):
    """What of a foundation under some vertices is each one's, m^2."""
    corners = vtk_to_numpy(model.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    points = vtk_to_numpy(model.GetPoints().GetData()).astype(float)[corners]
    size = np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1) / 2
    is_held = np.isin(corners, vertices).all(axis=1)
    count = model.GetNumberOfPoints()
    within = np.bincount(corners[is_held].ravel(), np.repeat(size[is_held] / 3, 3), count)
    return np.where(within > 0, within, array(model, "VertexArea"))[vertices]


def press(model, point, displacement=None, force=None, radius=None, mask="linear", *,
          radius_in_edges=None, rigid_stiffness=0.0, distance="euclidean", measure="vertex",
          torque=None):
    """Press (or pull) the surface at a point.

    Parameters
    ----------
    model : vtkPolyData
        From `precompute`, n vertices.
    point : array_like
        Three coordinates; the contact is at the surface's nearest point.
    displacement : array_like, optional
        What the probe is moved by, metres. The force is K(x) times it (James & Pai 2001, eq. 34), with K
        interpolated between vertices, so that it is continuous wherever the contact slides. The
        material point follows as the force takes it: at a vertex by that displacement but for the
        asymmetry of its compliance, between vertices by less (60 to 95 % on the kidney with masks of
        one to two edges). `ElasticContactPoint` minus `ContactPoint` says by how much. Where vertices
        must move exactly by given values, use `solve`.
    force : array_like, optional
        What it is pushed with, newtons. Give one of the two.
    radius : float, optional
        Radius of the pressure mask, metres. By default the load goes to single vertices, which is
        soft without bound as the mesh is refined: give the size of what touches.
    mask : {"linear", "uniform", "gaussian", "hertzian", "gradient", "biharmonic"}
        How the pressure falls with distance. The last two are the smooth pressures nearest to a point
        load (James & Pai 2001, appendix A), as wide as sinks their centre like the linear one.
    radius_in_edges : float, optional
        The radius as a multiple of the mean edge length, instead of `radius`.
    rigid_stiffness : float
        Stiffness of fixed vertices and largest stiffness shown, N/m; 0 for the stiffest free vertex.
    distance : {"euclidean", "geodesic"}
        Straight, or along the surface, so that the pressure does not reach across a groove.
    measure : {"vertex", "mean"}
        Whether a prescribed displacement is that of the material point or the mean under the mask, on
        which the force does its work (stiffer by a third under the linear mask, a fourth under the
        Hertzian one).
    torque : array_like, optional
        What it is twisted with besides, newton metres, about the mask's centre and spread by the mask;
        that must hold three vertices or more.

    Returns
    -------
    vtkPolyData
        The model with `Displacement` and `Traction` (n by 3), and the field arrays `ContactForce` (on
        the body, N), `ContactPoint`, `ElasticContactPoint` and `HapticContactPoint` (1 by 3; x^C, x^E,
        x^H of James & Pai 2001, fig. 8); under a torque also `ContactTorque` and `ContactRotation` (1 by
        3, N m and rad, the mean under the mask).

    Raises
    ------
    Error
        With the sentence of what is wrong.

    Examples
    --------
    >>> import palpate
    >>> model = palpate.precompute(palpate.refine(palpate.read(palpate.example("nodule"))), 2e4, 0.45)
    >>> pressed = palpate.press(model, (0, 0, 0.05), force=(0, 0, -0.1), radius=0.01)
    >>> [round(float(f), 9) for f in palpate.array(pressed, "ContactForce")[0]]
    [0.0, 0.0, -0.1]
    """
    if (displacement is None) == (force is None):
        raise Error("give either a displacement or a force")
    contact = vtkPointContact()
    contact.SetInputData(surface_of(model))
    contact.SetPoint(*vector(point, "point"))
    if displacement is not None:
        contact.SetDisplacement(*vector(displacement, "displacement"))
    else:
        contact.SetForce(*vector(force, "force"))
    contact.SetRigidStiffness(number(rigid_stiffness, "rigid_stiffness"))
    if torque is not None:
        contact.SetTorque(*vector(torque, "torque"))
    set_mask(contact, radius, radius_in_edges, mask, distance, measure)
    return run(contact)


def stiffness(model, radius=None, mask="linear", *, radius_in_edges=None, rigid_stiffness=0.0,
              progress=None, distance="euclidean", measure="vertex", rotational=False):
    """The stiffness that a point-like contact feels at every vertex.

    Parameters
    ----------
    model : vtkPolyData
        From `precompute`, n vertices.
    radius : float, optional
        Radius of the pressure mask, metres; by default single vertices are pressed, whose stiffness
        depends on the mesh.
    mask : {"linear", "uniform", "gaussian", "hertzian", "gradient", "biharmonic"}
        As in `press`.
    radius_in_edges : float, optional
        The radius as a multiple of the mean edge length (the paper's fig. 7 uses 2).
    rigid_stiffness : float
        What fixed vertices show, N/m; 0 for the stiffest free vertex.
    progress : callable or bool, optional
        As in `precompute`.
    distance : {"euclidean", "geodesic"}
        As in `press`.
    measure : {"vertex", "mean"}
        The displacement that the stiffness goes by: the vertex's own, or the mean under the mask.
    rotational : bool
        Also compute `RotationalStiffness` (n by 9, N m/rad), the torque per mean rotation under the mask.

    Returns
    -------
    vtkPolyData
        The model with `Stiffness` (n by 9, the matrix row by row, N/m), `StiffnessNorm` (n,
        Frobenius), `StiffnessAsymmetry`, `StiffnessLimited`, `HapticRatio`, `MaskSupportShare` and
        `MaskBeyondShare` (n; how much of a mask would have been on fixed vertices, and on other
        components or the far side of a wall). Where a vertex's mask
        needs columns that were not computed, or its compliance is that of no stiffness (walls far
        thinner than the edges are long), it is NaN.

    Raises
    ------
    Error
        With the sentence of what is wrong.

    Examples
    --------
    >>> import palpate
    >>> model = palpate.precompute(palpate.refine(palpate.read(palpate.example("nodule"))), 2e4, 0.45)
    >>> field = palpate.stiffness(model, radius_in_edges=2)
    >>> palpate.array(field, "Stiffness").shape
    (130, 9)
    """
    algorithm = vtkSurfaceStiffness()
    algorithm.SetInputData(surface_of(model))
    algorithm.SetRigidStiffness(number(rigid_stiffness, "rigid_stiffness"))
    algorithm.SetRotational(flag(rotational, "rotational"))
    set_mask(algorithm, radius, radius_in_edges, mask, distance, measure)
    return run(algorithm, progress_callback(progress))


def stiffness_artifacts(model, radius=None, mask="linear", *, radius_in_edges=None,
                        smoothing_length=None, reference=None, rigid_stiffness=0.0, progress=None,
                        distance="euclidean", measure="vertex"):
    """Where the mesh, and not the material, makes a surface feel soft.

    Parameters
    ----------
    model : vtkPolyData
        From `precompute`, n vertices.
    radius, mask, radius_in_edges, rigid_stiffness, progress, distance, measure
        As in `stiffness`. To compare meshes of one body give all the same `radius`.
    smoothing_length : float, optional
        Waves of 2 pi times this length, metres, pass into the smooth part of the field by half, twice as
        long ones by 94 %; a tenth of the surface's diagonal by default. To compare meshes give all the
        same.
    reference : vtkPolyData, optional
        Another mesh of the body, in the same frame and unit, with its `Stiffness`: from here or from
        `stiffness`, e.g. of the next finer level.

    Returns
    -------
    vtkPolyData
        The model with all that `stiffness` gives, and `SingleVertexStiffnessNorm` (n, N/m, without a
        mask), `StiffnessCondition` (n), `PrincipalStiffness1`, `2`, `3` (n by 3, vectors along the
        principal axes as long as the stiffness in N/m, stiffest first, zero where there is none),
        `HapticStiffness` (n by 9, N/m, K^H of James & Pai 2001, section 6.4), `SmoothStiffnessNorm` (n,
        N/m), `StiffnessArtifact` and `SingleVertexArtifact` (n, the norm over its smooth part, minus 1),
        `StiffnessJump` (n, the largest of the vertex's edges, relative to their mean) and, with a
        `reference`, `StiffnessChange` (n, over the reference at the same point, minus 1; NaN where there
        is no such point). Field arrays (1 by 2, of single vertices and under the mask):
        `ArtifactVariation`, `ArtifactAreaCorrelation` (Spearman's, with the vertex areas) and
        `ArtifactLargestJump`; with a `reference` also `StiffnessChangeMeasures` (1 by 4: median, variation,
        95th percentile of the size, vertices compared).

    Raises
    ------
    Error
        With the sentence of what is wrong.

    Examples
    --------
    >>> import palpate
    >>> kidney = palpate.refine(palpate.read(palpate.example("kidney")), 2)
    >>> found = palpate.stiffness_artifacts(palpate.precompute(kidney, 8e3, 0.45), radius_in_edges=2)
    >>> single, masked = palpate.array(found, "ArtifactAreaCorrelation")[0]
    >>> bool(single > 0.8), bool(abs(masked) < 0.2)
    (True, True)
    """
    algorithm = vtkStiffnessArtifacts()
    algorithm.SetInputData(surface_of(model))
    algorithm.SetRigidStiffness(number(rigid_stiffness, "rigid_stiffness"))
    if smoothing_length is not None:
        algorithm.SetSmoothingLength(positive(smoothing_length, "smoothing_length"))
    if reference is not None:
        algorithm.SetReferenceData(surface_of(reference))
    set_mask(algorithm, radius, radius_in_edges, mask, distance, measure)
    return run(algorithm, progress_callback(progress))
