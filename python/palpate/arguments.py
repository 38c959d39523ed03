# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From Python's arguments to the filters' settings."""

import sys

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .errors import Error

PRECISIONS = {"double": 0, "mixed": 1, "float": 2}
COLLOCATIONS = {"averaged": 0, "vertex": 1}
SUBDIVISIONS = {"loop": 0, "flat": 1, "curved": 2}
DOMAINS = {"interior": 0, "exterior": 1, "unsupported": 2}
MASKS = {"linear": 0, "uniform": 1, "gaussian": 2, "hertzian": 3, "gradient": 4, "biharmonic": 5}
DISTANCES = {"euclidean": 0, "geodesic": 1}
MEASURES = {"vertex": 0, "mean": 1}


def shown(value):
    """Any value in a sentence: one line, not too long."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 40 else text[:37] + "..."


def choice(value, choices, what):
    """The number that a filter knows a choice by."""
    if not isinstance(value, str) or value not in choices:
        raise Error(f"there is no {what} {shown(value)}: choose one of {', '.join(choices)}")
    return choices[value]


def flag(value, what):
    """True or False."""
    try:
        return bool(value)
    except (TypeError, ValueError):
        raise Error(f"{what} must be True or False, not {shown(value)}") from None


def listed(values, what):
    """An array of anything that has a shape."""
    try:
        return np.asarray(values)
    except (TypeError, ValueError):
        raise Error(f"{what} must be a list of single values, not {shown(values)}") from None


def numbers(values, what):
    """An array of numbers."""
    try:
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise Error(f"{what} must be numbers") from None


def vector(value, what):
    """Three numbers."""
    components = numbers(value, what).ravel()
    if components.size != 3:
        raise Error(f"{what} must have three components, not {components.size}")
    return components


def vectors(values, count, what):
    """That many vectors of three numbers."""
    given = numbers(values, what)
    if given.size != 3 * count or (given.ndim > 1 and given.shape[-1] != 3):
        raise Error(f"{what} must be {count} by 3, not {'x'.join(map(str, given.shape))}")
    return given.reshape(count, 3)


def surface_of(value):
    """A surface, and nothing else."""
    if not isinstance(value, vtkPolyData):
        raise Error(f"a surface must be a vtkPolyData, not {type(value).__name__}")
    return value


def number(value, what):
    """A number that is one."""
    try:
        given = float(value)
    except (TypeError, ValueError, OverflowError):
        raise Error(f"{what} must be a number, not {shown(value)}") from None
    if given != given:
        raise Error(f"{what} must be a number, not NaN")
    return given


def positive(value, what):
    """A number above 0."""
    given = number(value, what)
    if given <= 0:
        raise Error(f"{what} must be above 0, not {given:g}")
    return given


def unit_name(value):
    """A unit, which the filters then look up."""
    if not isinstance(value, str):
        raise Error(f"a unit must be a string, not {type(value).__name__}")
    return value


def whole_number(value, what, most):
    """An integer from 0 to `most`, however it is written."""
    given = number(value, what)
    if np.isfinite(given) and given != int(given):
        raise Error(f"{what} must be a whole number, not {given:g}")
    if not 0 <= given <= most:
        raise Error(f"{what} must be 0 to {most}, not {given:.17g}")
    return int(given)


def vertex_list(values, count, what):
    """Vertex numbers, or a mask of booleans with one value a vertex."""
    given = listed(values, what)
    if given.dtype == bool:
        if given.shape != (count,):
            raise Error(f"{what} as booleans must hold {count} values, one a vertex")
        return np.flatnonzero(given)
    if given.size and (given.dtype.kind not in "iuf" or not (given == np.floor(given)).all()):
        raise Error(f"{what} must be whole numbers, vertices of the surface")
    wrong = given[(given < 0) | (given >= count)]
    if wrong.size:
        raise Error(f"{what} name vertex {wrong[0]:.0f}, but the surface has {count}")
    return given.astype(np.int64).ravel()


def progress_bar(fraction, stage):
    """Draws a bar on standard error."""
    width = 30
    done = int(round(width * fraction))
    print(f"\r{stage:10s} [{'#' * done}{'.' * (width - done)}] {100 * fraction:3.0f} %",
          end="\n" if fraction >= 1 else "", file=sys.stderr, flush=True)


def progress_callback(progress):
    """What a function's argument `progress` calls: the bar for True, nothing for None and False."""
    if progress is None or progress is False:
        return None
    if progress is True:
        return progress_bar
    if not callable(progress):
        raise Error(f"progress must be a function, True or False, not {shown(progress)}")
    return progress


def set_mask(algorithm, radius, radius_in_edges, mask, distance, measure):
    """Gives a filter its pressure mask and measure; a single vertex without any radius."""
    if radius is not None and radius_in_edges is not None:
        raise Error("give radius or radius_in_edges, not both")
    algorithm.SetMask(choice(mask, MASKS, "mask"))
    algorithm.SetDistance(choice(distance, DISTANCES, "distance"))
    algorithm.SetMeasure(choice(measure, MEASURES, "measure"))
    algorithm.SetRadiusInEdgeLengths(radius_in_edges is not None)
    given = radius if radius_in_edges is None else radius_in_edges
    algorithm.SetRadius(0.0 if given is None else number(given, "radius"))
