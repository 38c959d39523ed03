# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of measurements."""

import os

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid

from .arguments import (flag, number, numbers, progress_callback, surface_of, unit_name, vector,
                        whole_number)
from .arrays import as_vtk
from .errors import Error, run
from .files import is_path, path_of, read_with
from .PalpateElastostatics import vtkRigSimulation
from .PalpateIO import vtkMeasurementTableReader

MOST = 2**31 - 1

__all__ = ["displacement_table", "measurement_table", "simulate_measurements"]


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


def simulate_measurements(model, *, probes=5, markers=50, radius=None, force=None, tilt=45.0,
                          noise=0.01, with_deviations=False, place_noise=0.0, outliers=0.0,
                          missing=0.0, rotation=(0, 0, 0), translation=(0, 0, 0), yield_length=0.0, seed=1):
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
    place_noise : float
        Standard deviation of markers' and contacts' places as the table tells them, each axis, m.
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
    rig.SetPlaceNoise(number(place_noise, "place_noise"))
    rig.SetOutliers(number(outliers, "outliers"))
    rig.SetMissing(number(missing, "missing"))
    rig.SetRotation(*vector(rotation, "rotation"))
    rig.SetTranslation(*vector(translation, "translation"))
    rig.SetSupportYieldLength(number(yield_length, "yield_length"))
    rig.SetSeed(whole_number(seed, "seed", MOST))
    return run(rig, progress_callback(None))


def set_measurements(filter, port, measurements, length_unit, force_unit):
    """A table, from a file or as an input, and its units."""
    set_table(filter, port, measurements, filter.SetMeasurementFileName, "measurements")
    filter.SetLengthUnit(unit_name(length_unit))
    filter.SetForceUnit(unit_name(force_unit))


def set_table(filter, port, table, set_file_name, what):
    """A table as an input where VTK's data carry it, else by its file."""
    if is_path(table):
        if os.fsdecode(path_of(table)).lower().endswith((".vtp", ".vtu")):
            filter.SetInputData(port, read_with(vtkMeasurementTableReader(), table))
        else:
            set_file_name(path_of(table))
    elif isinstance(table, vtkPolyData):
        filter.SetInputData(port, table)
    elif isinstance(table, vtkUnstructuredGrid):
        carrier = vtkPolyData()
        carrier.GetFieldData().ShallowCopy(table.GetFieldData())
        filter.SetInputData(port, carrier)
    else:
        raise Error(f"{what} must be a file or a vtkPolyData or vtkUnstructuredGrid that carries their "
                    f"table, not {type(table).__name__}")


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
