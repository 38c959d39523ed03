# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts from displacements."""

from .arguments import flag, number, progress_callback, surface_of, unit_name, whole_number
from .errors import Error, run
from .measurement_tables import MOST, set_table
from .PalpateElastostatics import vtkContactRecovery

__all__ = ["recover_contacts"]


def recover_contacts(model, displacements, *, probe=None, friction=0.5, noise=None, patch_radius=None,
                     yielding_support=True, samples=50, seed=1, length_unit="m", place_tolerance=0.02,
                     progress=None):
    """Recover the contacts that displacements of a body's surface are due to.

    Parameters
    ----------
    model : vtkPolyData
        The body, from `precompute`.
    displacements : str, path-like, vtkPolyData or vtkUnstructuredGrid
        A table: a text file (`palpate recover --help` tells its columns), or data that carry it as
        field arrays, such as from `displacement_table` or `simulate_measurements`, whose forces are
        passed over, or their .vtp or .vtu.
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
    >>> kidney = palpate.refine(palpate.read(palpate.example("kidney")), levels=2)
    >>> model = palpate.precompute(kidney, young=8e3, poisson=0.45, estimate_error=False)
    >>> pressed = palpate.press(model, point=(0, 0, 0.03), force=(0, 0, -0.3), radius=0.015)
    >>> seen = range(0, pressed.GetNumberOfPoints(), 2)
    >>> u = palpate.array(pressed, "Displacement")[seen]
    >>> table = palpate.displacement_table(u, vertices=seen)
    >>> contacts = palpate.recover_contacts(model, table)
    >>> bool(abs(palpate.array(contacts, "RecoveredForce")[0, 2] / -0.3 - 1) < 0.05)
    True
    """
    filter = vtkContactRecovery()
    filter.SetInputData(surface_of(model))
    set_table(filter, 1, displacements, filter.SetDisplacementFileName, "displacements")
    filter.SetLengthUnit(unit_name(length_unit))
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
