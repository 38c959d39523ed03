# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials, and with them Green's functions, from measurements."""

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

from .arguments import choice, flag, number, numbers, positive, whole_number
from .errors import Error
from .measurement_tables import set_measurements
from .PalpateElastostatics import (vtkGreensFunctionIdentification, vtkIdentificationByCrossValidation,
                                   vtkStiffnessFieldIdentification)
from .precomputation import boundary_of, computed, posed

LOSSES = {"none": 0, "huber": 1, "cauchy": 2, "tukey": 3}

__all__ = ["identify", "identify_best", "identify_field"]


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
    measurements : str, path-like, vtkPolyData or vtkUnstructuredGrid
        A table: a text file (`palpate identify --help` tells its columns), or data that carry it as
        field arrays, such as from `measurement_table` and `simulate_measurements`, or their .vtp or .vtu.
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
        As in `precompute`; threads of boundary elements.
    next_probes : int
        Propose so many further probes, of normal and tilted forces at sixteen places, that would tell
        most, each at another place while there are any: `NextProbeVertex`, `NextProbeForce`, and `NextProbeDeviations`, which the parameters would
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
    if method == "fem" and threads != 0:
        raise Error("threads makes no sense for method='fem': leave it out")
    filter = vtkGreensFunctionIdentification()
    filter.SetMethod(method == "fem")
    surface = set_inputs(filter, surface, volume, measurements, length_unit, force_unit)
    set_unknowns(filter, poisson, poisson_range)
    set_fit(filter, register, loss, folds, place_tolerance, smooth_angle, reciprocal)
    filter.SetNumberOfThreads(whole_number(threads, "threads", 1024))
    filter.SetLargestRatio(number(largest_ratio, "largest_ratio"))
    filter.SetYieldingSupport(flag(yielding_support, "yielding_support"))
    filter.SetNumberOfNextProbes(whole_number(next_probes, "next_probes", 100))
    filter.SetInterpolationTolerance(number(interpolation_tolerance, "interpolation_tolerance"))
    filter.SetEstimateError(flag(estimate_error, "estimate_error"))
    filter.SetInputData(posed(surface, None, None, fixed, require_material=False))
    return computed(filter, progress)


def identify_field(surface, measurements, *, poisson=None, poisson_range=None, fixed=None, volume=None,
                   modes=50, length=None, deviation=None, register=False, loss="cauchy", folds=5,
                   length_unit="m", force_unit="N", place_tolerance=0.02, smooth_angle=30.0,
                   reciprocal=True, estimate_error=True, progress=None):
    """Identify a body whose stiffness varies inside from displacements under known forces.

    Young's modulus is a random field: its logarithm varies by `deviation` over `length`. The field that
    is most probable, given the measurements, is found in its leading modes; places that no measurement
    sees stay as the rest is. Finite elements only.

    Parameters
    ----------
    surface, measurements, poisson, poisson_range, fixed, volume, register, loss, folds, length_unit
        As in `identify` with method="fem".
    force_unit, place_tolerance, smooth_angle, reciprocal, progress
        As in `identify`.
    estimate_error : bool
        As in `precompute`, of a body of one modulus; warns where a field explains less than the mesh errs.
    modes : int
        Of the field, up to 1000. More resolve smaller places; time grows with their number.
    length : float, optional
        Over which stiffness varies, m; by default 0.15 of the surface's diagonal.
    deviation : float, optional
        Standard, of ln E, expected before anything is measured: 1 for factors of three either way. By
        default the one that makes the measurements most probable.

    Returns
    -------
    model : vtkPolyData
        As of `identify`; where the filling with tetrahedra needs other triangles, on these.
        `IdentifiedParameters` are of the mean, `DeterminedUnknowns` says how many of the field's
        unknowns the measurements determine.
    volume : vtkUnstructuredGrid
        The tetrahedra with cell arrays `YoungsModulus` (Pa), `PoissonRatio` and `LogModulusDeviation`, the
        standard deviation of ln E that is left, and with support and mean material: `precompute(volume,
        method="fem")` gives the model again.

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
    filter.SetEstimateError(flag(estimate_error, "estimate_error"))
    surface = set_inputs(filter, surface, volume, measurements, length_unit, force_unit)
    set_unknowns(filter, poisson, poisson_range)
    set_fit(filter, register, loss, folds, place_tolerance, smooth_angle, reciprocal)
    set_field(filter, modes, length, deviation)
    return model_and_volume(filter, surface, fixed, progress)


def identify_best(surface, measurements, *, poisson=None, poisson_range=None, fixed=None, method="bem",
                  volume=None, yielding_support=False, modes=50, length=None, deviation=None,
                  register=False, loss="cauchy", folds=5, length_unit="m", force_unit="N",
                  place_tolerance=0.02, smooth_angle=30.0, estimate_error=True, progress=None):
    """Identify the simplest model of a body that predicts probes left out about as well as any.

    From the most constrained on: of one material, as `identify`; with method="fem" of stiffness that
    varies inside, as `identify_field`; and the first one's model corrected, as `correct`. Taken is the
    first whose error under probes left out is within a twentieth of the least, or larger by less than the
    standard error of the difference over probes.

    Parameters
    ----------
    surface, measurements, poisson, poisson_range, fixed, method, volume, yielding_support, register, loss
        As in `identify`.
    modes, length, deviation
        As in `identify_field`.
    folds : int
        Of the cross-validation by probes, at least 2.
    length_unit, force_unit, place_tolerance, smooth_angle, estimate_error, progress
        As in `identify`.

    Returns
    -------
    model : vtkPolyData
        As of the function that made it, with field arrays `TriedModels` and `TriedHoldOutErrors`.
    volume : vtkUnstructuredGrid
        As of `identify_field` if a field was taken, else without cells.

    Raises
    ------
    Error
        With the sentence of what is wrong with the table, by row, or why no model can be identified.
    Aborted
        If `progress` returned False.

    Examples
    --------
    >>> import palpate
    >>> nodule = palpate.refine(palpate.read(palpate.example("nodule")))
    >>> body = palpate.precompute(nodule, young=20e3, poisson=0.4, estimate_error=False)
    >>> table = palpate.simulate_measurements(body, noise=0.01)
    >>> model, volume = palpate.identify_best(nodule, table, poisson=0.4, estimate_error=False)
    >>> palpate.array(model, "IdentifiedNames"), volume.GetNumberOfCells()
    (["Young's modulus"], 0)
    """
    choice(method, {"bem": 0, "fem": 1}, "method")
    filter = vtkIdentificationByCrossValidation()
    filter.SetMethod(method == "fem")
    filter.SetEstimateError(flag(estimate_error, "estimate_error"))
    surface = set_inputs(filter, surface, volume, measurements, length_unit, force_unit)
    set_unknowns(filter, poisson, poisson_range)
    set_fit(filter, register, loss, folds, place_tolerance, smooth_angle, True)
    set_field(filter, modes, length, deviation)
    filter.SetYieldingSupport(flag(yielding_support, "yielding_support"))
    return model_and_volume(filter, surface, fixed, progress)


def model_and_volume(filter, surface, fixed, progress):
    """What filters give that may find a field."""
    filter.SetInputData(posed(surface, None, None, fixed, require_material=False))
    model = computed(filter, progress, stacklevel=4)
    return model, filter.GetOutputDataObject(1)


def set_field(filter, modes, length, deviation):
    """What is known of a field beforehand."""
    modes = whole_number(modes, "modes", 1000)
    if modes == 0:
        raise Error("a field takes at least one mode, not 0")
    filter.SetNumberOfModes(modes)
    if length is not None:
        filter.SetFieldLength(positive(length, "length"))
    if deviation is not None:
        filter.SetFieldDeviation(positive(deviation, "deviation"))


def set_inputs(filter, surface, volume, measurements, length_unit, force_unit):
    """Volume and table; gives back the surface."""
    if isinstance(surface, vtkUnstructuredGrid):
        if volume is not None:
            raise Error("tetrahedra in place of a surface go without volume")
        surface, volume = boundary_of(surface, None)[0], surface
    if volume is not None:
        if not isinstance(volume, vtkUnstructuredGrid):
            raise Error(f"volume must be a vtkUnstructuredGrid, not {type(volume).__name__}")
        filter.SetInputData(1, volume)
    set_measurements(filter, 2, measurements, length_unit, force_unit)
    return surface


def set_fit(filter, register, loss, folds, place_tolerance, smooth_angle, reciprocal):
    filter.SetRegister(flag(register, "register"))
    filter.SetLoss(choice(loss, LOSSES, "loss"))
    filter.SetNumberOfFolds(whole_number(folds, "folds", 1000))
    filter.SetPlaceTolerance(number(place_tolerance, "place_tolerance"))
    filter.SetSmoothAngle(number(smooth_angle, "smooth_angle"))
    filter.SetReciprocal(flag(reciprocal, "reciprocal"))


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
