# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""NumPy views of the arrays on a surface."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkDataObject

from .arguments import surface_of
from .errors import Error


def array(data, name):
    """A point, cell or field array of a data object, by name.

    Parameters
    ----------
    data : vtkDataObject
        Such as the result of `precompute`, `solve`, `press` or `stiffness`.
    name : str
        `"Displacement"`, `"Traction"`, `"Stiffness"`, `"ContactForce"` ...

    Returns
    -------
    numpy.ndarray or list of str
        A view, not a copy: n values, or n by components. Strings come as a list.

    Raises
    ------
    KeyError
        If there is no such array.
    Error
        If there is no data object.

    Examples
    --------
    >>> import palpate
    >>> kidney = palpate.read(palpate.example("kidney"))
    >>> palpate.array(kidney, "BoundaryType").shape
    (22,)
    """
    if not isinstance(data, vtkDataObject):
        raise Error(f"arrays are those of a vtkDataObject, not of {type(data).__name__}")
    for kind in (vtkDataObject.POINT, vtkDataObject.CELL, vtkDataObject.FIELD):
        attributes = data.GetAttributesAsFieldData(kind)
        found = attributes and attributes.GetAbstractArray(name)
        if isinstance(found, vtkStringArray):
            return [found.GetValue(i) for i in range(found.GetNumberOfValues())]
        if found is not None:
            return vtk_to_numpy(found)
    raise KeyError(f"there is no array '{name}'")


def stored(model, name):
    """An array that comes with Green's functions."""
    if not surface_of(model).GetFieldData().HasArray(name):
        raise Error("the surface carries no Green's functions: compute them with palpate.precompute")
    return array(model, name)


def greens_functions(model):
    """The matrix of Green's functions of a model.

    Parameters
    ----------
    model : vtkPolyData
        From `precompute`, n vertices.

    Returns
    -------
    numpy.ndarray
        Xi of James & Pai 2001, eq. 13: 3n rows by 3m columns, one block of three rows a vertex
        (displacement in metres where it is free, traction in pascals where it is fixed) and one block
        of three columns for each of the m vertices of `greens_function_nodes` (response to a unit
        traction where free, to a unit displacement where fixed). A view, not a copy. It holds for the
        field `GreensFunctionYoungsModulus`, which differs from `YoungsModulus` where that was changed
        after the computation.

    Raises
    ------
    Error
        If it is no surface or carries no Green's functions.

    Examples
    --------
    >>> import palpate
    >>> kidney = palpate.read(palpate.example("kidney"))
    >>> model = palpate.precompute(kidney, 8e3, 0.45)
    >>> palpate.greens_functions(model).shape, len(palpate.greens_function_nodes(model))
    ((66, 30), 10)
    """
    if (surface_of(model).GetFieldData().HasArray("GreensFunctionNodes")
            and not model.GetFieldData().HasArray("GreensFunctions")):
        raise Error("a half-space's Green's functions are computed when they are asked for: there is no "
                    "matrix of them")
    return stored(model, "GreensFunctions").T


def greens_function_nodes(model):
    """The vertices whose columns `greens_functions` holds, in order.

    Parameters
    ----------
    model : vtkPolyData
        From `precompute`.

    Returns
    -------
    numpy.ndarray
        m vertex numbers.

    Raises
    ------
    Error
        If it is no surface or carries no Green's functions.

    Examples
    --------
    >>> import palpate
    >>> model = palpate.precompute(palpate.read(palpate.example("kidney")), 8e3, 0.45)
    >>> bool((palpate.array(model, "BoundaryType")[palpate.greens_function_nodes(model)] == 0).all())
    True
    """
    return stored(model, "GreensFunctionNodes")


def as_vtk(values, name, components, dtype=np.float64):
    """A VTK array of a copy of the values."""
    values = np.ascontiguousarray(np.asarray(values, dtype=dtype).reshape(-1, components))
    result = numpy_to_vtk(values if components > 1 else values.ravel(), deep=True)
    result.SetName(name)
    return result


def as_ids(values, name):
    """An id array of a copy of the values."""
    result = numpy_to_vtkIdTypeArray(np.asarray(values, dtype=np.int64).ravel(), deep=True)
    result.SetName(name)
    return result
