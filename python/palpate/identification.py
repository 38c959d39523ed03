# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials, and with them Green's functions, and contacts from measurements."""

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid

from .arguments import (
    choice,
    flag,
    number,
    numbers,
    progress_callback,
    surface_of,
    vector,
    whole_number,
)
from .arrays import as_vtk
from .errors import Error, run
from .files import path_of
from .imports import is_path
from .PalpateElastostatics import (
    vtkContactRecovery,
    vtkGreensFunctionIdentification,
    vtkRigSimulation,
    vtkStiffnessFieldIdentification,
)
from .precomputation import boundary_of, computed, posed

LOSSES = {"none": 0, "huber": 1, "cauchy": 2, "tukey": 3}
MOST = 2**31 - 1

__all__ = ["displacement_table", "identify", "identify_field", "measurement_table",
           "recover_contacts", "simulate_measurements"]


def identify(surface, measurements, *, poisson=None, poisson_range=None, fixed=None, method="bem",
             volume=None, largest_ratio=10.0, yielding_support=False, register=False, loss="cauchy",
             folds=5, length_unit="m", force_unit="N", interpolation_tolerance=1e-4,
             place_tolerance=0.02, smooth_angle=30.0, reciprocal=True, estimate_error=True, threads=0,
             next_probes=0, progress=None):
    """Identify the material of a body from displacements under known forces.

    Parameters
    ----------
    surface : vtkPolyData or vtkUnstructuredGrid
        The body at rest: a closed triangle surface of n vertices, or with method="fem" tetrahedra.
    measurements : str, path-like or vtkPolyData
        A table: a file (`palpate identify --help` tells its columns), or polydata that carry it as
        field arrays, such as from `measurement_table` and `simulate_measurements`.
    poisson : float, optional
        Poisson's ratio where it is known. By default it is identified.
    poisson_range : (float, float), optional
        Where it is looked for: by default from 0 to 0.499, with finite elements to 0.449.
    fixed : array_like of bool, optional
        n values, where the body is held. None takes the surface's point array `BoundaryType`.
    method : {"bem", "fem"}
        Boundary elements, or finite elements in tetrahedra.
    volume : vtkUnstructuredGrid, optional
        For finite elements: tetrahedra whose boundary the surface is. Its cell array `MaterialRegion`
        (int from 0) says which have a Young's modulus of their own.
    largest_ratio : float
        Of the Young's moduli of two regions.
    yielding_support : bool
        The support is an elastic foundation of unknown stiffness: `SupportYieldLength` is Young's
        modulus over its stiffness per area. The model that comes back is on a firm one, with the
        columns that `solve` needs for `foundation`.
    register : bool
        The measurements' frame is the surface's but for an unknown rigid motion.
    loss : {"cauchy", "huber", "tukey", "none"}
        How residuals count while outliers are looked for, which are then left out.
    folds : int
        Of the cross-validation by probes (`HoldOutError`), 0 for none.
    length_unit, force_unit : str
        Of the measurements, the surface's being metres: as in `import_compliance`.
    interpolation_tolerance : float
        Relative, of responses between those materials for which Green's functions are computed.
    place_tolerance : float
        How far a place may be from the surface, over its diagonal.
    smooth_angle, reciprocal, estimate_error, threads
        As in `precompute`.
    next_probes : int
        Propose so many further probes, of normal and tilted forces at sixteen places, that would tell
        most: `NextProbeVertex`, `NextProbeForce`, and `NextProbeDeviations`, which the parameters would
        have with all up to each. Takes about as long again.
    progress : callable or bool, optional
        Called as progress(fraction, stage); return False to abort. True shows a bar.

    Returns
    -------
    vtkPolyData
        The model of the identified material, as `precompute` gives it, with field arrays:
        `IdentifiedNames`, `IdentifiedParameters` (value, standard deviation, interval of 95 %),
        `IdentifiedCorrelations`, the table in the surface's frame with `MeasurementResidual` and
        `MeasurementOutlier`, `HoldOutError` and more (see array_names.h). The deviations are of noise;
        `ErrorEstimate` says what the mesh may add.

    Raises
    ------
    Error
        With the sentence of what is wrong with the table, by row, or what the data do not determine
        and which probe would help.
    Aborted
        If `progress` returned False.

    Examples
    --------
    >>> import palpate
    >>> nodule = palpate.refine(palpate.read(palpate.example("nodule")))
    >>> body = palpate.precompute(nodule, young=20e3, poisson=0.4)
    >>> table = palpate.simulate_measurements(body, noise=0.01)
    >>> model = palpate.identify(nodule, table, folds=0)
    >>> young, poisson = palpate.array(model, "IdentifiedParameters")[:, 0]
    >>> bool(abs(young / 20e3 - 1) < 0.02), bool(abs(poisson - 0.4) < 0.05)
    (True, True)
    """
    choice(method, {"bem": 0, "fem": 1}, "method")
    if isinstance(surface, vtkUnstructuredGrid) and (method != "fem" or volume is not None):
        raise Error("tetrahedra in place of a surface go with method='fem', and without volume")
    filter = vtkGreensFunctionIdentification()
    filter.SetMethod(method == "fem")
    surface = set_inputs(filter, surface, volume, measurements, length_unit, force_unit)
    set_unknowns(filter, poisson, poisson_range)
    set_fit(filter, register, loss, folds, place_tolerance, smooth_angle, reciprocal, threads)
    filter.SetLargestRatio(number(largest_ratio, "largest_ratio"))
    filter.SetYieldingSupport(flag(yielding_support, "yielding_support"))
    filter.SetNumberOfNextProbes(whole_number(next_probes, "next_probes", 100))
    filter.SetInterpolationTolerance(number(interpolation_tolerance, "interpolation_tolerance"))
    filter.SetEstimateError(flag(estimate_error, "estimate_error"))
    filter.SetInputData(posed(surface, 1.0, 0.3, fixed))  # what is identified takes their place
    return computed(filter, progress)


def identify_field(surface, measurements, *, poisson=None, poisson_range=None, fixed=None, volume=None,
                   modes=50, length=None, deviation=1.0, register=False, loss="cauchy", folds=5,
                   length_unit="m", force_unit="N", place_tolerance=0.02, smooth_angle=30.0,
                   reciprocal=True, threads=0, progress=None):
    """Identify a body whose stiffness varies inside from displacements under known forces.

    Young's modulus is a random field: its logarithm varies by `deviation` over `length`. The field that
    is most probable, given the measurements, is found in its leading modes; places that no measurement
    sees stay as the rest is. Finite elements only.

    Parameters
    ----------
    surface, measurements, poisson, poisson_range, fixed, volume, register, loss, folds, length_unit
        As in `identify` with method="fem".
    force_unit, place_tolerance, smooth_angle, reciprocal, threads, progress
        As in `identify`.
    modes : int
        Of the field, up to 1000. More resolve smaller places; time grows with their number.
    length : float, optional
        Over which stiffness varies, m; by default 0.15 of the surface's diagonal.
    deviation : float
        Standard, of ln E, expected before anything is measured.

    Returns
    -------
    model : vtkPolyData
        As of `identify`; where the filling with tetrahedra needs other triangles, on these.
        `IdentifiedParameters` are of the mean, `DeterminedUnknowns` says how many of the field's
        unknowns the measurements determine.
    volume : vtkUnstructuredGrid
        The tetrahedra with cell arrays `YoungsModulus` (Pa), `PoissonRatio` and `LogModulusDeviation`, the
        standard deviation of ln E that is left. `precompute` takes it as its surface.

    Raises
    ------
    Error
        With the sentence of what is wrong with the table, by row, or what the data do not determine.
    Aborted
        If `progress` returned False.

    Examples
    --------
    >>> import palpate
    >>> nodule = palpate.read(palpate.example("nodule"))
    >>> body = palpate.precompute(nodule, young=20e3, poisson=0.4, estimate_error=False)
    >>> table = palpate.simulate_measurements(body, noise=0.01)
    >>> model, volume = palpate.identify_field(nodule, table, poisson=0.4, modes=10, folds=0)
    >>> int(palpate.array(volume, "YoungsModulus").size) == volume.GetNumberOfCells()
    True
    """
    filter = vtkStiffnessFieldIdentification()
    surface = set_inputs(filter, surface, volume, measurements, length_unit, force_unit)
    set_unknowns(filter, poisson, poisson_range)
    set_fit(filter, register, loss, folds, place_tolerance, smooth_angle, reciprocal, threads)
    modes = whole_number(modes, "modes", 1000)
    if modes == 0:
        raise Error("a field takes at least one mode, not 0")
    filter.SetNumberOfModes(modes)
    if length is not None:
        length = number(length, "length")
        if not length > 0:
            raise Error(f"length must be positive, not {length:g}")
        filter.SetFieldLength(length)
    filter.SetFieldDeviation(number(deviation, "deviation"))
    filter.SetInputData(posed(surface, 1.0, 0.3, fixed))
    model = computed(filter, progress)
    return model, filter.GetOutputDataObject(1)


def set_inputs(filter, surface, volume, measurements, length_unit, force_unit):
    """Volume and table; gives back the surface."""
    if isinstance(surface, vtkUnstructuredGrid):
        if volume is not None:
            raise Error("tetrahedra in place of a surface go without volume")
        surface, volume = boundary_of(surface), surface
    if volume is not None:
        if not isinstance(volume, vtkUnstructuredGrid):
            raise Error(f"volume must be a vtkUnstructuredGrid, not {type(volume).__name__}")
        filter.SetInputData(1, volume)
    if is_path(measurements):
        filter.SetMeasurementFileName(path_of(measurements))
    elif isinstance(measurements, vtkPolyData):
        filter.SetInputData(2, measurements)
    else:
        raise Error("measurements must be a file or a vtkPolyData that carries their table, not "
                    f"{type(measurements).__name__}")
    for unit, set_unit in ((length_unit, filter.SetLengthUnit), (force_unit, filter.SetForceUnit)):
        if not isinstance(unit, str):
            raise Error(f"a unit must be a string, not {type(unit).__name__}")
        set_unit(unit)
    return surface


def set_fit(filter, register, loss, folds, place_tolerance, smooth_angle, reciprocal, threads):
    filter.SetRegister(flag(register, "register"))
    filter.SetLoss(choice(loss, LOSSES, "loss"))
    filter.SetNumberOfFolds(whole_number(folds, "folds", 1000))
    filter.SetPlaceTolerance(number(place_tolerance, "place_tolerance"))
    filter.SetSmoothAngle(number(smooth_angle, "smooth_angle"))
    filter.SetReciprocal(flag(reciprocal, "reciprocal"))
    filter.SetNumberOfThreads(whole_number(threads, "threads", 1024))


def set_unknowns(filter, poisson, poisson_range):
    """Poisson's ratio as it is known, or where it is looked for."""
    if poisson is not None:
        if poisson_range is not None:
            raise Error("give poisson, if it is known, or poisson_range, not both")
        filter.SetPoissonRatio(number(poisson, "Poisson's ratio"))
    if poisson_range is not None:
        limits = numbers(poisson_range, "poisson_range").ravel()
        if limits.size != 2 or not np.isfinite(limits).all():
            raise Error("poisson_range must be two numbers")
        filter.SetPoissonRange(*map(float, limits))


def measurement_table(probe, displacements, forces, *, markers=None, marker_vertices=None,
                      contacts=None, contact_vertices=None, radius=0.0, deviations=None):
    """Measurements in arrays as a table for `identify`.

    Parameters
    ----------
    probe : array_like of int
        m values: under which probe, from 0, each displacement was measured.
    displacements : array_like
        m by 3, metres; NaN where a component was not measured.
    forces : array_like
        p by 3, newtons on the body: of each probe.
    markers : array_like, optional
        m by 3: places of the markers at rest; or instead
    marker_vertices : array_like of int, optional
        m vertices of the surface.
    contacts : array_like, optional
        p by 3: places where the probes press, at rest; or instead
    contact_vertices : array_like of int, optional
        p vertices.
    radius : float or array_like
        Of the masks that spread the forces, one number or p.
    deviations : float or array_like, optional
        Standard deviations of the displacements: one number, m, or m by 3.

    Returns
    -------
    vtkPolyData
        Without points, with the table as field arrays (see array_names.h).

    Raises
    ------
    Error
        If sizes do not go together, or places are given twice or not at all.

    Examples
    --------
    >>> import palpate
    >>> table = palpate.measurement_table(
    ...     [0, 0], [[0, 0, -1e-3], [1e-4, 0, 0]], [[0, 0, -2]], marker_vertices=[3, 8],
    ...     contact_vertices=[3], radius=0.01)
    >>> palpate.array(table, "MeasuredDisplacement").shape
    (2, 3)
    """
    table = vtkPolyData()
    shown = numbers(displacements, "displacements")
    count, probes = len(np.atleast_1d(shown)), len(np.atleast_1d(numbers(forces, "forces")))

    add_tuples(table, "MeasurementProbe", probe, (count,), "probe")
    add_tuples(table, "MeasuredDisplacement", shown, (count, 3), "displacements")
    add_tuples(table, "ProbeForce", forces, (probes, 3), "forces")
    add_tuples(table, "ProbeRadius", radius, (probes,), "radius")
    add_places(table, "Measurement", marker_vertices, markers, count, "markers")
    add_places(table, "Probe", contact_vertices, contacts, probes, "contacts")
    add_deviations(table, deviations, count)
    return table


def simulate_measurements(model, *, probes=5, markers=50, radius=None, force=None, tilt=45.0,
                          noise=0.01, with_deviations=False, outliers=0.0, missing=0.0,
                          rotation=(0, 0, 0), translation=(0, 0, 0), yield_length=0.0, seed=1):
    """The displacements that a rig would measure on a model, to try `identify` on.

    Parameters
    ----------
    model : vtkPolyData
        The body on the rig, from `precompute`: of a finer mesh or another method than what will be
        identified, else its discretisation is not tried.
    probes, markers : int
        How many press, and how many are seen under each.
    radius : float, optional
        Of a probe's tip, m; two mean edges by default.
    force : float, optional
        N; by default so that the largest displacement is 1 % of the diagonal.
    tilt : float
        Largest angle of the forces from the normal, degrees.
    noise : float
        Standard deviation over the largest displacement.
    with_deviations : bool
        The table tells it.
    outliers, missing : float
        Shares of the displacements that are wrong, and that are not seen.
    rotation, translation : array_like
        The rig's frame: the body turned by a vector of degrees, then moved by metres.
    yield_length : float
        Young's modulus over the stiffness per area of the support, m; 0 for a firm one.
    seed : int
        Of all that is random.

    Returns
    -------
    vtkPolyData
        The surface with the table as field arrays, without Green's functions.

    Raises
    ------
    Error
        With the sentence of what is out of range.

    Examples
    --------
    >>> import palpate
    >>> nodule = palpate.read(palpate.example("nodule"))
    >>> body = palpate.precompute(nodule, young=20e3, poisson=0.4, estimate_error=False)
    >>> table = palpate.simulate_measurements(body, probes=3, markers=10)
    >>> palpate.array(table, "MeasuredDisplacement").shape
    (30, 3)
    """
    rig = vtkRigSimulation()
    rig.SetInputData(surface_of(model))
    rig.SetNumberOfProbes(whole_number(probes, "probes", MOST))
    rig.SetNumberOfMarkers(whole_number(markers, "markers", MOST))
    if radius is not None:
        rig.SetRadius(number(radius, "radius"))
    if force is not None:
        rig.SetForce(number(force, "force"))
    rig.SetTilt(number(tilt, "tilt"))
    rig.SetNoise(number(noise, "noise"))
    rig.SetWithDeviations(flag(with_deviations, "with_deviations"))
    rig.SetOutliers(number(outliers, "outliers"))
    rig.SetMissing(number(missing, "missing"))
    rig.SetRotation(*vector(rotation, "rotation"))
    rig.SetTranslation(*vector(translation, "translation"))
    rig.SetSupportYieldLength(number(yield_length, "yield_length"))
    rig.SetSeed(whole_number(seed, "seed", MOST))
    return run(rig, progress_callback(None))


def recover_contacts(model, displacements, *, probe=None, friction=0.5, noise=None, patch_radius=None,
                     yielding_support=True, samples=50, seed=1, length_unit="m", place_tolerance=0.02,
                     progress=None):
    """Recover the contacts that displacements of a body's surface are due to.

    Parameters
    ----------
    model : vtkPolyData
        The body, from `precompute`.
    displacements : str, path-like or vtkPolyData
        A table: a file (`palpate recover --help` tells its columns), or polydata that carry it as
        field arrays, such as from `displacement_table` or `simulate_measurements`, whose forces are
        passed over.
    probe : str, optional
        Whose displacements, where the table has those of several.
    friction : float
        Largest tangential over normal force; 0 for contacts without friction.
    noise : float, optional
        Standard deviation of a displacement's component, m; by default what the table says, or what
        the residuals tell.
    patch_radius : float, optional
        Of the patches that forces are spread over, m; 0 for single vertices; by default as the
        displacements tell.
    yielding_support : bool
        Let the support give way more or less than the model's, where the displacements tell.
    samples, seed : int
        Sets of noise that the deviations are found from, and what they begin with.
    length_unit : str
        Of the table, the surface's being metres: as in `import_compliance`.
    place_tolerance : float
        How far a place may be from the surface, over its diagonal.
    progress : callable or bool, optional
        Called as progress(fraction, stage); return False to abort. True shows a bar.

    Returns
    -------
    vtkPolyData
        The model with `Traction`, `Displacement`, `ContactPressure` and `ContactPressureDeviation` at
        its points, and field arrays with a tuple a contact, the strongest first: `ContactForce`,
        `ContactForceDeviation`, `ContactCentre`, `ContactCentreDeviation`, `ContactPeak` and more (see
        array_names.h). What is doubtful is said in `RecoveryWarnings`.

    Raises
    ------
    Error
        With the sentence of what is wrong with the table, or that it tells no contact.
    Aborted
        If `progress` returned False.

    Examples
    --------
    >>> import palpate
    >>> nodule = palpate.refine(palpate.read(palpate.example("nodule")), levels=2)
    >>> model = palpate.precompute(nodule, young=20e3, poisson=0.4, estimate_error=False)
    >>> pressed = palpate.press(model, point=(0, 0, 1), force=(0, 0, -1), radius_edges=2)
    >>> seen = range(0, pressed.GetNumberOfPoints(), 2)
    >>> u = palpate.array(pressed, "Displacement")[seen]
    >>> table = palpate.displacement_table(u, vertices=seen)
    >>> contacts = palpate.recover_contacts(model, table)
    >>> bool(abs(palpate.array(contacts, "RecoveredForce")[0, 2] + 1) < 0.05)
    True
    """
    filter = vtkContactRecovery()
    filter.SetInputData(surface_of(model))
    if is_path(displacements):
        filter.SetDisplacementFileName(path_of(displacements))
    elif isinstance(displacements, vtkPolyData):
        filter.SetInputData(1, displacements)
    else:
        raise Error("displacements must be a file or a vtkPolyData that carries their table, not "
                    f"{type(displacements).__name__}")
    if not isinstance(length_unit, str):
        raise Error(f"a unit must be a string, not {type(length_unit).__name__}")
    filter.SetLengthUnit(length_unit)
    if probe is not None:
        filter.SetProbeName(str(probe))
    filter.SetFriction(number(friction, "friction"))
    if noise is not None:
        filter.SetNoise(number(noise, "noise"))
    if patch_radius is not None:
        radius = number(patch_radius, "patch_radius")
        if radius < 0:
            raise Error(f"patch_radius must not be negative, not {radius:g}")
        filter.SetPatchRadius(radius)
    filter.SetYieldingSupport(flag(yielding_support, "yielding_support"))
    filter.SetNumberOfSamples(whole_number(samples, "samples", 100000))
    filter.SetSeed(whole_number(seed, "seed", MOST))
    filter.SetPlaceTolerance(number(place_tolerance, "place_tolerance"))
    return run(filter, progress_callback(progress))


def displacement_table(displacements, *, points=None, vertices=None, deviations=None):
    """Displacements in arrays as a table for `recover_contacts`.

    Parameters
    ----------
    displacements : array_like
        m by 3, metres; NaN where a component was not seen.
    points : array_like, optional
        m by 3: where, at rest; or instead
    vertices : array_like of int, optional
        m vertices of the surface.
    deviations : float or array_like, optional
        Standard deviations of the displacements: one number, m, or m by 3.

    Returns
    -------
    vtkPolyData
        Without points, with the table as field arrays (see array_names.h).

    Raises
    ------
    Error
        If sizes do not go together, or places are given twice or not at all.

    Examples
    --------
    >>> import palpate
    >>> table = palpate.displacement_table([[0, 0, -1e-3], [1e-4, 0, 0]], vertices=[3, 8])
    >>> palpate.array(table, "MeasuredDisplacement").shape
    (2, 3)
    """
    table = vtkPolyData()
    count = len(np.atleast_1d(numbers(displacements, "displacements")))
    add_tuples(table, "MeasuredDisplacement", displacements, (count, 3), "displacements")
    add_places(table, "Measurement", vertices, points, count, "points")
    add_deviations(table, deviations, count)
    return table


def add_tuples(table, name, values, shape, what):
    """A field array of numbers, spread over a shape if they are fewer."""
    values = numbers(values, what)
    try:
        values = np.broadcast_to(values, shape)
    except ValueError:
        raise Error(f"{what} must be {' by '.join(map(str, shape))} numbers, not "
                    f"{'x'.join(map(str, values.shape))}") from None
    components = shape[1] if len(shape) > 1 else 1
    table.GetFieldData().AddArray(as_vtk(np.array(values), name, components, float))


def add_places(table, kind, vertices, places, rows, what):
    """Vertices or places, one of the two."""
    if (vertices is None) == (places is None):
        raise Error(f"{what} are given as vertices or as places: give one of the two")
    if vertices is not None:
        add_tuples(table, f"{kind}Vertex", vertices, (rows,), what)
    else:
        add_tuples(table, f"{kind}Point", places, (rows, 3), what)


def add_deviations(table, deviations, count):
    """Standard deviations, if there are any."""
    if deviations is not None:
        given = numbers(deviations, "deviations")
        add_tuples(table, "MeasurementDeviation", given[:, None] if given.ndim == 1 else given,
                   (count, 3), "deviations")
