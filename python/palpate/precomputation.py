# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Green's functions of bodies."""

import inspect
import warnings

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid

from .arguments import (
    COLLOCATIONS,
    DOMAINS,
    PRECISIONS,
    SUBDIVISIONS,
    choice,
    flag,
    listed,
    number,
    numbers,
    progress_callback,
    surface_of,
    vectors,
    vertex_list,
    whole_number,
)
from .arrays import array, as_ids, as_vtk
from .errors import Error, ModelWarning, run
from .PalpateElastostatics import (
    vtkBoundaryElementGreensFunctions,
    vtkFiniteElementGreensFunctions,
    vtkHalfSpaceGreensFunctions,
    vtkReferenceBoundaryConditions,
    vtkShellGreensFunctions,
    vtkSolidBoundary,
    vtkToleranceGreensFunctions,
)
from .surfaces import remesh

FIXED = "PrecomputeFixed"  # carries an argument to a filter
GRID_POINT = "PrecomputeGridPoint"
THICKNESS = "Thickness"

__all__ = ["precompute"]


def precompute(surface, young=None, poisson=None, fixed=None, method="bem", precision="double",
               tolerance=None, columns=None, domain="interior", reciprocal=True,
               smooth_angle=30.0, progress=None, *, collocation="averaged", patch_columns=False,
               threads=0, solver="direct", integration_tolerance=None, support_patch=None,
               estimate_error=None, max_levels=None, max_layers=None, max_vertices=None, subdivision=None,
               volume=None, element="quadratic", cell_size=0.0, probes=None, thickness=None,
               clamped=True, edge_length=None):
    """Compute the Green's functions of an elastic body from its surface.

    Parameters
    ----------
    surface : vtkPolyData or vtkUnstructuredGrid
        A closed triangle surface of n vertices, normals out of what it encloses (see `repair`); for a
        half-space a flat one, normals out of it; for a shell its middle, open or closed, normals to the
        side that it is touched from. For finite elements also the tetrahedra themselves, whose boundary
        is then the surface: its n vertices are the grid's points on it, in their order.
        Lengths in metres, or in any one unit.
    young : float, optional
        Young's modulus, Pa, > 0. None takes the surface's field data.
    poisson : float, optional
        Poisson's ratio in (-1, 0.5]. None takes the surface's field data.
    fixed : array_like of bool, optional
        n values, where the body is held, or of a grid one a point. None takes the surface's point array
        `BoundaryType`.
    method : {"bem", "fem", "halfspace", "shell"}
        Boundary elements; finite elements in tetrahedra (`columns`, `reciprocal`, `smooth_angle`,
        `patch_columns`, `progress`, `volume`, `element`, `cell_size` and `probes` go with it); the half-space below a flat
        surface: no support, no matrix, each Green's function computed exactly when it is asked for
        (`columns`, `reciprocal`, `progress` and `threads` go with it); or a plate or thin shell about the
        surface (`columns`, `reciprocal`, `progress`, `thickness` and `clamped` go with it).
    precision : {"double", "mixed", "float"}
        Double; factored in float and refined to 1e-11 in double, which is faster where few columns are
        wanted and slower where all are; or all in float (half the memory and time, about 1e-5).
    tolerance : float, optional
        Largest relative error, above 0 and below 1. The cheapest settings whose estimated error meets it
        are chosen: how often the surface is refined, precision, integration tolerance (none of which
        may then be given, nor `columns`). The field array `ToleranceSteps` says what was tried. The error is that of displacements and contact compliances, relative, under unit forces
        spread like a cone over the length `ErrorLoadLength`, which 95 % of the loads do not exceed.
    columns : array_like of int, optional
        Vertices whose Green's functions are computed, by number or as a mask of n booleans; all free
        ones by default. Moving or releasing fixed vertices needs theirs, too.
    domain : {"interior", "exterior", "unsupported"}
        Material inside the surface, or everywhere outside it, or (of finite elements and shells, too) inside a
        body that nothing holds: loads are balanced by tractions that vary like a rigid motion over the
        whole surface, and displacements counted from the body's mean motion. `BoundaryType` is not read
        then.
    reciprocal : bool
        Symmetrise the compliance between free vertices, so that all that is served comes from one
        energy. Distributed loads on coarse or sharp-edged meshes are more accurate without, pressures on
        nearly incompressible bodies much more so. Above a Poisson ratio of 0.45 the change of volume is
        kept, which takes the columns of all free vertices.
    smooth_angle : float
        Traction may jump at edges sharper than this, degrees, unless the surface has a cell array
        `SmoothPatch`. 180 for one traction a vertex.
    progress : callable or bool, optional
        Called as progress(fraction, stage); return False to abort. True shows a bar.
    collocation : {"averaged", "vertex"}
        Enforce the boundary integral equation in the mean around each vertex, or at the vertices as in
        the paper (faster to assemble, several times less accurate).
    patch_columns : bool
        Also compute what `solve` needs for `face_tractions` on surfaces with sharp edges.
    threads : int
        0 for all cores, at most 1024.
    solver : {"direct", "iterative"}
        Factor the system, or iterate to a residual of 1e-9 in double precision, which is cheaper where
        few columns of a large surface are wanted.
    integration_tolerance : float, optional
        Relative tolerance of the integrals, 1e-6 by default.
    support_patch : bool, optional
        End the support's traction at its rim and not half an edge beyond, which is several times more
        accurate near it. By default with a `tolerance` only.
    estimate_error : bool, optional
        Of boundary and finite elements, where it is the default: estimate the error on a coarser mesh, or
        for small surfaces on a finer one (filled anew, but not with several materials): the field arrays
        `ErrorEstimate`, `ContactErrorEstimate` and so on, -1 where that fails. Of shells of up to a
        thousand vertices, where it is not: on four times as many, in sixteen times the time.
    max_levels, max_layers, max_vertices : int, optional
        How often (4), with how many layers along the rim of the support (3, see `refine`), and up to how
        many vertices (3000), a `tolerance` may refine the surface.
    subdivision : {"loop", "flat", "curved"}, optional
        As in `refine`, how a `tolerance` refines; flat by default.
    volume : vtkUnstructuredGrid, optional
        For finite elements: tetrahedra whose boundary the surface is. Cell arrays may give materials
        (see `vtkFiniteElementGreensFunctions`). By default the surface is filled with tetrahedra.
    element : {"quadratic", "linear"}
        Shape functions of finite elements.
    cell_size : float
        Largest circumradius of the tetrahedra that the surface is filled with, m; 0 for as the surface's
        triangles ask for.
    probes : array_like, optional
        k by 3 places inside a body of finite elements, m, whose fields are to be known under any contact:
        `probe` and scenes look into bodies of several or anisotropic materials there and nowhere else.
    thickness : float or array_like of float, optional
        Of a shell, m: one number or n, linear between vertices. None takes the surface's point or cell
        array `Thickness`.
    clamped : bool
        Hold the rotations of a shell's fixed vertices, too; else they turn as on hinges. The point array
        `HeldComponents` may hold single components (see `vtkShellGreensFunctions`).
    edge_length : float, optional
        Of boundary and finite elements: remesh the surface to edges of about this length first, m. The
        model is of the coarser mesh; `on_original` shows what it does on the surface given. `columns`,
        `tolerance` and `volume` do not go with it.

    Returns
    -------
    vtkPolyData
        The surface, refined if a `tolerance` called for it or remeshed to an `edge_length`, or the
        boundary of its tetrahedra, with its Green's functions, provenance and diagnostics as arrays.

    Raises
    ------
    Error
        With the sentence of what is wrong with the surface, the support or the material.
    Aborted
        If `progress` returned False.

    Warns
    -----
    ModelWarning
        Where the model is doubtful, with the measured number; also kept in its field array `Warnings`.

    Examples
    --------
    >>> import palpate
    >>> nodule = palpate.refine(palpate.read(palpate.example("nodule")))
    >>> model = palpate.precompute(nodule, young=20e3, poisson=0.45)
    >>> palpate.greens_functions(model).shape
    (390, 267)
    >>> float(palpate.array(model, "ErrorEstimate")[0]) < 0.2
    True
    """
    choice(method, {"bem": 0, "fem": 1, "halfspace": 2, "shell": 3}, "method")
    if isinstance(surface, vtkUnstructuredGrid):
        if method != "fem" or volume is not None:
            raise Error("tetrahedra in place of a surface go with method='fem', and without volume")
        surface, fixed, volume = *boundary_of(surface, fixed), surface
    if domain == "unsupported" and fixed is not None:
        raise Error("domain='unsupported' is of bodies that nothing holds: leave fixed out")
    settings = dict(
        precision=precision, tolerance=tolerance, domain=domain, smooth_angle=smooth_angle,
        collocation=collocation, patch_columns=patch_columns, threads=threads, solver=solver,
        integration_tolerance=integration_tolerance, support_patch=support_patch,
        estimate_error=estimate_error, max_levels=max_levels, max_layers=max_layers, max_vertices=max_vertices,
        subdivision=subdivision, volume=volume, element=element, cell_size=cell_size, probes=probes,
        thickness=thickness, clamped=clamped, edge_length=edge_length)
    refuse_foreign(method, settings)
    if method == "bem":
        greens = boundary_elements(columns, **settings)
    elif method == "fem":
        greens = finite_elements(**settings)
    elif method == "shell":
        greens = vtkShellGreensFunctions()
        greens.SetClamped(flag(clamped, "clamped"))
        greens.SetUnsupported(unsupported(domain, method))
        greens.SetEstimateError(flag(False if estimate_error is None else estimate_error, "estimate_error"))
    else:
        greens = vtkHalfSpaceGreensFunctions()
    problem = posed(surface, young, poisson, fixed)
    if edge_length is not None:
        if not (columns is None and tolerance is None and volume is None):
            raise Error("edge_length makes another mesh of the surface, to which columns, tolerance and "
                        "volume do not belong: leave them out, or remesh first")
        problem = remesh(problem, edge_length, smooth_angle=smooth_angle, keep_original=True)
    if thickness is not None:
        set_thickness(greens, problem, thickness)
    greens.SetInputData(problem)
    greens.SetReciprocal(flag(reciprocal, "reciprocal"))
    greens.SetNumberOfThreads(whole_number(threads, "threads", 1024))
    if columns is not None:
        nodes = vertex_list(columns, surface.GetNumberOfPoints(), "columns")
        greens.SetColumnNodes(as_ids(nodes, "columns"))
    return computed(greens, progress)


def posed(surface, young, poisson, fixed, require_material=True):
    """A copy of a surface with its material and support, as `precompute` takes them."""
    conditions = vtkReferenceBoundaryConditions()
    conditions.SetRequireMaterial(require_material)
    conditioned = vtkPolyData()
    conditioned.ShallowCopy(surface_of(surface))
    if fixed is not None:
        fixed = listed(fixed, "fixed")
        if fixed.dtype.kind not in "biuf" or not np.isfinite(fixed).all():
            raise Error("fixed must hold booleans")
        if fixed.shape != (surface.GetNumberOfPoints(),):
            raise Error(f"fixed must hold {surface.GetNumberOfPoints()} values, one a vertex, not "
                        f"{'x'.join(map(str, fixed.shape))}")
        conditioned.GetPointData().AddArray(as_vtk(fixed.astype(bool), FIXED, 1, np.uint8))
        conditions.SetFixedArrayName(FIXED)
    conditions.SetInputData(conditioned)
    if young is not None:
        conditions.SetYoungsModulus(number(young, "Young's modulus"))
    if poisson is not None:
        conditions.SetPoissonRatio(number(poisson, "Poisson's ratio"))
    result = run(conditions)
    result.GetPointData().RemoveArray(FIXED)
    return result


def computed(greens, progress, stacklevel=3):
    """The model that a filter makes, with its warnings, to whoever is so many calls above."""
    model = run(greens, progress_callback(progress))
    if model.GetFieldData().HasArray("Warnings"):
        for sentence in array(model, "Warnings"):
            warnings.warn(sentence, ModelWarning, stacklevel=stacklevel)
    return model


def boundary_of(grid, fixed):
    """The surface of a grid's tetrahedra, and what is fixed of it, if it is told by the grid's points."""
    numbered = vtkUnstructuredGrid()
    numbered.ShallowCopy(grid)
    numbered.GetPointData().AddArray(as_ids(range(grid.GetNumberOfPoints()), GRID_POINT))
    boundary = vtkSolidBoundary()
    boundary.SetInputData(numbered)
    surface = run(boundary)
    points = array(surface, GRID_POINT)
    if np.shape(fixed) == (grid.GetNumberOfPoints(),):
        fixed = np.asarray(fixed)[points]
    surface.GetPointData().RemoveArray(GRID_POINT)
    return surface, fixed


METHODS_OF = {
    "threads": ("bem", "halfspace"), "smooth_angle": ("bem", "fem"), "patch_columns": ("bem", "fem"),
    "estimate_error": ("bem", "fem", "shell"), "volume": ("fem",), "element": ("fem",), "cell_size": ("fem",),
    "probes": ("fem",), "edge_length": ("bem", "fem"),
    "thickness": ("shell",), "clamped": ("shell",), "domain": ("bem", "fem", "shell"),
}


def refuse_foreign(method, settings):
    """Refuse settings that a method does not have, unless they are at their defaults."""
    defaults = inspect.signature(precompute).parameters
    for name, value in settings.items():
        default = defaults[name].default
        is_set = value is not default and (isinstance(value, np.ndarray) or value != default)
        if is_set and method not in METHODS_OF.get(name, ("bem",)):
            raise Error(f"{name} makes no sense for method={method!r}: leave it out")


def set_thickness(greens, surface, thickness):
    """Give the filter one thickness, or its surface one a vertex."""
    values = numbers(thickness, "thickness")
    if values.ndim == 0:
        if not values > 0:
            raise Error(f"thickness must be a positive number, not {thickness}")
        greens.SetThickness(float(values))
        return
    if values.shape != (surface.GetNumberOfPoints(),):
        raise Error(f"thickness must be one number or {surface.GetNumberOfPoints()}, one a vertex, not "
                    f"{'x'.join(map(str, values.shape))}")
    surface.GetPointData().AddArray(as_vtk(values, THICKNESS, 1, float))
    surface.GetCellData().RemoveArray(THICKNESS)


def unsupported(domain, method):
    """Whether nothing holds a body of a method that has no exterior domains."""
    if choice(domain, DOMAINS, "domain") == DOMAINS["exterior"]:
        raise Error(f"domain='exterior' makes no sense for method='{method}': leave it out")
    return domain == "unsupported"


def finite_elements(volume, element, cell_size, probes, domain, smooth_angle, patch_columns, estimate_error,
                    **_):
    """The filter of finite elements, but for its surface and columns."""
    filter = vtkFiniteElementGreensFunctions()
    filter.SetUnsupported(unsupported(domain, "fem"))
    if probes is not None:
        places = listed(probes, "probes")
        for place in vectors(places, len(places), "probes"):
            filter.AddProbe(*place)
    if volume is not None:
        if not isinstance(volume, vtkUnstructuredGrid):
            raise Error(f"volume must be a vtkUnstructuredGrid, not {type(volume).__name__}")
        filter.SetInputData(1, volume)
    filter.SetElement(choice(element, {"linear": 0, "quadratic": 1}, "element"))
    filter.SetCellSize(number(cell_size, "cell_size"))
    filter.SetEstimateError(flag(True if estimate_error is None else estimate_error, "estimate_error"))
    filter.SetSmoothAngle(number(smooth_angle, "smooth_angle"))
    filter.SetPatchColumns(flag(patch_columns, "patch_columns"))
    return filter


def boundary_elements(columns, precision, tolerance, domain, smooth_angle, collocation, patch_columns,
                      solver, integration_tolerance, support_patch, estimate_error, max_levels,
                      max_layers, max_vertices, subdivision, **_):
    """The filter of boundary elements, or the one that chooses by tolerance, but for its surface."""
    if tolerance is None:
        if any(limit is not None for limit in (max_levels, max_layers, max_vertices, subdivision)):
            raise Error("max_levels, max_layers, max_vertices and subdivision go with a tolerance: give "
                        "one, or refine the surface yourself")
        bem = vtkBoundaryElementGreensFunctions()
        bem.SetPrecision(choice(precision, PRECISIONS, "precision"))
        bem.SetSolver(choice(solver, {"direct": 0, "iterative": 1}, "solver"))
        bem.SetEstimateError(flag(True if estimate_error is None else estimate_error, "estimate_error"))
        if integration_tolerance is not None:
            bem.SetTolerance(number(integration_tolerance, "integration_tolerance"))
    else:
        if (precision != "double" or solver != "direct" or integration_tolerance is not None
                or columns is not None):
            raise Error("a tolerance chooses precision, solver, integration_tolerance and columns: leave "
                        "them out, or the tolerance")
        bem = vtkToleranceGreensFunctions()
        bem.SetErrorTolerance(number(tolerance, "tolerance"))
        if max_levels is not None:
            bem.SetMaximumNumberOfLevels(whole_number(max_levels, "max_levels", 9))
        if max_layers is not None:
            bem.SetMaximumNumberOfLayers(whole_number(max_layers, "max_layers", 9))
        if max_vertices is not None:
            bem.SetMaximumNumberOfVertices(whole_number(max_vertices, "max_vertices", 100000))
        if subdivision is not None:
            bem.SetSubdivision(choice(subdivision, SUBDIVISIONS, "subdivision"))
    if support_patch is not None:
        bem.SetSupportPatch(flag(support_patch, "support_patch"))
    bem.SetCollocation(choice(collocation, COLLOCATIONS, "collocation"))
    bem.SetDomain(choice(domain, DOMAINS, "domain"))
    bem.SetSmoothAngle(number(smooth_angle, "smooth_angle"))
    bem.SetPatchColumns(flag(patch_columns, "patch_columns"))
    return bem
