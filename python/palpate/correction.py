# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Green's functions corrected by measurements."""

from .arguments import flag, number, positive, surface_of, whole_number
from .measurement_tables import MOST, set_measurements
from .PalpateElastostatics import vtkComplianceCorrection
from .precomputation import computed

__all__ = ["correct"]


def correct(model, measurements, *, modes=0, smoothing=None, folds=5, keep_outliers=False,
            length_unit="m", force_unit="N", place_tolerance=0.02, progress=None):
    """Correct a model's Green's functions by displacements under known forces.

    The compliance between free vertices becomes a factor times the prior's and a correction that needs no
    model of the inside: what was measured is kept but for noise, its mirror image by reciprocity likewise,
    and between and beyond it goes over to the prior smoothly. It stays symmetric and positive definite.

    Parameters
    ----------
    model : vtkPolyData
        The prior, from `precompute`, `identify` or an import, with the Green's functions of all its free
        vertices.
    measurements : str, path-like, vtkPolyData or vtkUnstructuredGrid
        A table as for `identify`.
    modes : int
        Correct in so many leading modes of the prior's compliance; 0 for all.
    smoothing : float, optional
        Noise over what is corrected, variances; by default as probes left out in turn tell.
    folds : int
        Of that cross-validation (`HoldOutError`, `PriorHoldOutError`), 0 for none.
    keep_outliers : bool
        Believe displacements that contradict the rest, too.
    length_unit, force_unit : str
        Of the measurements, the model's being metres: as in `import_compliance`.
    place_tolerance : float
        How far a place may be from the surface, over its diagonal.
    progress : callable or bool, optional
        Called as progress(fraction, stage); return False to abort. True shows a bar.

    Returns
    -------
    vtkPolyData
        The model corrected, with the field arrays of `identify`; `IdentifiedParameters` holds the factor.

    Raises
    ------
    Error
        With the sentence of what is wrong with the table, by row, or the model.
    Aborted
        If `progress` returned False.

    Examples
    --------
    >>> import palpate
    >>> nodule = palpate.refine(palpate.read(palpate.example("nodule")))
    >>> body, prior = (palpate.precompute(nodule, young=young, poisson=0.4, estimate_error=False)
    ...                for young in (20e3, 10e3))
    >>> table = palpate.simulate_measurements(body, noise=0.01)
    >>> model = palpate.correct(prior, table)
    >>> bool(abs(palpate.array(model, "IdentifiedParameters")[0, 0] - 0.5) < 0.01)
    True
    """
    filter = vtkComplianceCorrection()
    filter.SetInputData(surface_of(model))
    set_measurements(filter, 1, measurements, length_unit, force_unit)
    filter.SetNumberOfModes(whole_number(modes, "modes", MOST))
    if smoothing is not None:
        filter.SetSmoothing(positive(smoothing, "smoothing"))
    filter.SetNumberOfFolds(whole_number(folds, "folds", 1000))
    filter.SetLeaveOutOutliers(not flag(keep_outliers, "keep_outliers"))
    filter.SetPlaceTolerance(number(place_tolerance, "place_tolerance"))
    return computed(filter, progress)
