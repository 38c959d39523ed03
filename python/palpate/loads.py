# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What bodies bear besides contacts, and what they stand on."""

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .arguments import listed, number, numbers, positive, progress_callback, surface_of, vector, vectors
from .arrays import as_vtk
from .errors import Error, run
from .PalpateElastostatics import vtkBodyForce, vtkElasticFoundation

__all__ = ["foundation", "gravity"]

SPRINGS = "SpringStiffness"


def gravity(model, density=None, acceleration=(0, 0, -9.81)):
    """How a body hangs under its weight, or deforms under any acceleration that is the same all over.

    Parameters
    ----------
    model : vtkPolyData
        From `precompute`: of boundary elements with the Green's functions of all free vertices (and
        `patch_columns` where edges are sharp), of finite elements, or a shell; or one of the latter two,
        or an unsupported one, on a `foundation`.
    density : float, optional
        In the mean over the volume, kg/m^3. None takes the model's, which volume meshes with the cell
        array `Density` have.
    acceleration : array_like of float
        Of gravity, 3 values, m/s^2. A body that is accelerated itself feels the opposite. Use a
        `vtkBodyForce` where it changes often: it keeps the answers along the three axes.

    Returns
    -------
    vtkPolyData
        The model with `Displacement` (n by 3, m) and `Traction` (n by 3, Pa: of the support where the
        method knows it, else zero), and the field array `LargestDisplacementGradient`.

    Raises
    ------
    Error
        With the sentence of what is wrong.

    Examples
    --------
    >>> import palpate
    >>> model = palpate.precompute(palpate.refine(palpate.read(palpate.example("nodule"))), 1e4, 0.4)
    >>> hung = palpate.gravity(model, density=1000)
    >>> bool(palpate.array(hung, "Displacement")[:, 2].min() < 0)
    True
    """
    algorithm = vtkBodyForce()
    algorithm.SetInputData(surface_of(model))
    algorithm.SetAcceleration(*vector(acceleration, "acceleration"))
    if density is not None:
        algorithm.SetDensity(positive(density, "density"))
    return run(algorithm)


def foundation(model, normal=0.0, shear=None, springs=None, *, probes=None, progress=None):
    """Put a model on springs: an elastic foundation in place of its support, and single springs.

    Parameters
    ----------
    model : vtkPolyData
        From `precompute`, n vertices, with the Green's functions of all free vertices and of the fixed
        ones that are to move (`columns=np.arange(n)`); or an unsupported one, which springs hold.
    normal : float
        Stiffness of the foundation under fixed vertices along the surface's normal, Pa/m; 0 for none.
    shear : float, optional
        The same along the surface; None for that along the normal.
    springs : array_like of float, optional
        To ground, N/m: n values, the same in all directions, or n by 3 by 3 symmetric blocks; fixed
        vertices without any stay fixed. None takes the point array `SpringStiffness`, if there is one.
    probes : array_like, optional
        k by 3 places inside, m, whose fields are to be known under any contact: any of a body of one
        isotropic material, else some of those that the model was precomputed with, which stay known
        without.
    progress : callable or bool, optional
        As in `precompute`.

    Returns
    -------
    vtkPolyData
        The model on springs, as exact as the one given. Young's modulus scales its springs, too.

    Raises
    ------
    Error
        With the sentence of what is wrong.

    Examples
    --------
    A support that gives way by a millimetre under 2 kPa:

    >>> import numpy as np
    >>> import palpate
    >>> nodule = palpate.refine(palpate.read(palpate.example("nodule")))
    >>> n = nodule.GetNumberOfPoints()
    >>> firm = palpate.precompute(nodule, 1e4, 0.4, columns=np.arange(n))
    >>> soft = palpate.foundation(firm, normal=2e6)
    >>> pushed = [palpate.press(m, point=(0, 0, 1), force=(0, 0, -1), radius=0.02) for m in (firm, soft)]
    >>> sunk = [palpate.array(p, "Displacement")[:, 2].min() for p in pushed]
    >>> bool(sunk[1] < sunk[0])
    True
    """
    surface = vtkPolyData()
    surface.ShallowCopy(surface_of(model))
    if springs is not None:
        count = surface.GetNumberOfPoints()
        values = numbers(springs, "springs")
        if values.shape not in ((count,), (count, 3, 3)):
            raise Error(f"springs must be {count} values, or {count} by 3 by 3, not "
                        f"{'x'.join(map(str, values.shape)) or 'one'}")
        surface.GetPointData().AddArray(
            as_vtk(values.reshape(count, -1), SPRINGS, values[0].size, np.float64))
    algorithm = vtkElasticFoundation()
    algorithm.SetInputData(surface)
    algorithm.SetNormalStiffness(number(normal, "normal"))
    if shear is not None:
        if not number(shear, "shear") >= 0:
            raise Error(f"shear must be at least 0, not {shear}")
        algorithm.SetShearStiffness(number(shear, "shear"))
    if probes is not None:
        places = listed(probes, "probes")
        for place in vectors(places, len(places), "probes"):
            algorithm.AddProbe(*place)
    return run(algorithm, progress_callback(progress))
