# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Green's functions from matrices made elsewhere."""

from .arguments import choice, flag, number, numbers, positive, surface_of, unit_name, vertex_list
from .arrays import as_ids, as_vtk
from .errors import Error
from .files import is_path, path_of
from .PalpateElastostatics import vtkImportedGreensFunctions
from .precomputation import computed, posed

ORDERS = {"by-node": 0, "by-component": 1}
KINDS = {"compliance": 0, "stiffness": 1}

__all__ = ["import_compliance", "import_stiffness"]


def import_compliance(surface, compliance, nodes=None, *, fixed=None, order="by-node",
                      length_unit="m", force_unit="N", node_tolerance=1e-5, mapping=None, name=None,
                      young=None, columns=None, reciprocal=True, progress=None):
    """Make Green's functions of a compliance (flexibility) matrix that was computed or measured.

    Parameters
    ----------
    surface : vtkPolyData
        A triangle surface, closed or not, of n vertices that are nodes of the matrix. Metres.
    compliance : array_like, str or path-like
        Displacements (rows) per force (columns), three of each a node: a square matrix, or a file of
        it: .npy, text (numbers between blanks, `,` or `;`), Matrix Market, Harwell-Boeing, or DMIG
        cards of NASTRAN's bulk data.
    nodes : array_like, str or path-like, optional
        Where the matrix' nodes are, in its order, in its unit of length: m by 3, or m by 4 with their
        numbers first where the matrix goes by numbers; or a file of them, such as GRID cards. By
        default those in the matrix' file, or the vertices in their order, or the free ones in theirs.
        Nodes that are no vertices are left out.
    fixed : array_like of bool, optional
        n values: vertices that are held. None takes the surface's point array `BoundaryType`, if it has
        one. Those that the matrix has are held by reactions, which are exact. The others are held where
        the matrix is from: they do not move, have no Green's function, and bear no contact.
    order : {"by-node", "by-component"}
        Rows of x, y, z of each node, or of all x, all y, all z.
    length_unit : {"m", "cm", "mm", "um", "in", "ft"}
        Of the matrix and its nodes.
    force_unit : {"N", "mN", "kN", "MN", "lbf", "kgf"}
        Of the matrix.
    node_tolerance : float
        How near a node is to the vertex that it is, over the surface's diagonal.
    mapping : str or path-like, optional
        What the rows of a file are, as Ansys' HBMAT writes it.
    name : str, optional
        Which of several DMIG matrices; by default the only one, or the only one that begins with K.
    young : float, optional
        Young's modulus that the matrix holds for, Pa: the field array `YoungsModulus`, by which the
        model can be scaled. By default that of a body of this size and compliance.
    columns : array_like of int, optional
        Vertices whose Green's functions are kept, by number or as a mask of n booleans; all free ones
        that can move by default.
    reciprocal : bool
        Symmetrise the matrix. Without, it is served as it is, however far from symmetric; with it, more
        than 1e-3 is refused.
    progress : callable or bool, optional
        Called as progress(fraction, stage); return False to abort. True shows a bar.

    Returns
    -------
    vtkPolyData
        The surface with its Green's functions, provenance and diagnostics as arrays.

    Raises
    ------
    Error
        With the sentence of what is wrong: shape, symmetry (`ReciprocityDefect`), definiteness, nodes
        that are no vertices, a damaged file.
    Aborted
        If `progress` returned False.

    Warns
    -----
    ModelWarning
        Where the matrix is doubtful, such as for its units.

    Examples
    --------
    >>> import numpy as np, palpate
    >>> nodule = palpate.refine(palpate.read(palpate.example("nodule")))
    >>> model = palpate.precompute(nodule, young=20e3, poisson=0.45)
    >>> free = palpate.greens_function_nodes(model)
    >>> rows = (3 * free[:, None] + np.arange(3)).ravel()
    >>> areas = np.repeat(palpate.array(model, "VertexArea")[free], 3)
    >>> compliance = palpate.greens_functions(model)[rows] / areas
    >>> again = palpate.import_compliance(nodule, compliance)
    >>> bool(np.allclose(palpate.greens_functions(again)[rows], compliance * areas, rtol=1e-9))
    True
    """
    return imported("compliance", surface, compliance, nodes, fixed=fixed, order=order,
                    length_unit=length_unit, force_unit=force_unit, node_tolerance=node_tolerance,
                    mapping=mapping, name=name, young=young, columns=columns, reciprocal=reciprocal,
                    progress=progress)


def import_stiffness(surface, stiffness, nodes=None, *, fixed=None, order="by-node",
                     length_unit="m", force_unit="N", node_tolerance=1e-5, mapping=None, name=None,
                     young=None, columns=None, unsupported=False, progress=None):
    """Make Green's functions of a stiffness matrix, such as a superelement's, by static condensation.

    Nodes that are no vertices of the surface, rotations and inner coordinates bear no force: they are
    condensed out. Vertices that are fixed are held, with exact reactions.

    Parameters
    ----------
    surface : vtkPolyData
        A triangle surface, closed or not, of n vertices that are nodes of the matrix. Metres.
    stiffness : array_like, str or path-like
        Forces per displacement, as `compliance` of `import_compliance`; of a body that is held, or of a
        loose one, of which `fixed` vertices must take all rigid motions.
    unsupported : bool
        Leave a loose body in one piece, all of whose vertices are nodes of the matrix, as one that nothing
        holds: see `domain` of `precompute`.
    nodes, fixed, order, length_unit, force_unit, node_tolerance, mapping, name, young, columns, progress
        As in `import_compliance`.

    Returns
    -------
    vtkPolyData
        The surface with its Green's functions, provenance and diagnostics as arrays.

    Raises
    ------
    Error
        With the sentence of what is wrong, such as a rigid motion that nothing resists.
    Aborted
        If `progress` returned False.

    Warns
    -----
    ModelWarning
        Where the matrix is doubtful, such as for its units or for how weakly it is held.

    Examples
    --------
    Springs of 2 kN/m between the three corners of a triangle and a block on springs of 500 N/m:

    >>> import numpy as np, palpate
    >>> from vtkmodules.vtkFiltersSources import vtkRegularPolygonSource
    >>> corners = vtkRegularPolygonSource()
    >>> corners.SetNumberOfSides(3)
    >>> corners.GeneratePolylineOff()
    >>> corners.Update()
    >>> triangle = corners.GetOutput()
    >>> block = np.diag([2e3, 2e3, 2e3, 3 * 2e3 + 500])
    >>> block[3, :3] = block[:3, 3] = -2e3
    >>> points = [triangle.GetPoint(i) for i in range(3)] + [(0, 0, -1)]
    >>> model = palpate.import_stiffness(triangle, np.kron(block, np.eye(3)), points)
    >>> pressed = palpate.press(model, triangle.GetPoint(0), force=(0, 0, -1))
    >>> palpate.array(pressed, "Displacement")[:, 2].round(6)
    array([-0.0025, -0.002 , -0.002 ])
    """
    return imported("stiffness", surface, stiffness, nodes, fixed=fixed, order=order,
                    length_unit=length_unit, force_unit=force_unit, node_tolerance=node_tolerance,
                    mapping=mapping, name=name, young=young, columns=columns, reciprocal=True,
                    progress=progress, unsupported=flag(unsupported, "unsupported"))


def imported(kind, surface, matrix, nodes, *, fixed, order, length_unit, force_unit, node_tolerance,
             mapping, name, young, columns, reciprocal, progress, unsupported=False):
    """What both have in common."""
    filter = vtkImportedGreensFunctions()
    filter.SetKind(KINDS[kind])
    give(filter.SetMatrixFileName, filter.SetMatrix, matrix, kind)
    if nodes is not None:
        give(filter.SetNodeFileName, filter.SetNodes, nodes, "nodes")
    if mapping is not None:
        if not is_path(matrix):
            raise Error("a mapping file goes with a file of the matrix, not with an array")
        filter.SetMappingFileName(path_of(mapping))
    if name is not None:
        if not isinstance(name, str):
            raise Error(f"the name of a matrix must be a string, not {type(name).__name__}")
        filter.SetMatrixName(name)
    filter.SetLengthUnit(unit_name(length_unit))
    filter.SetForceUnit(unit_name(force_unit))
    filter.SetDofOrder(choice(order, ORDERS, "order"))
    filter.SetNodeTolerance(number(node_tolerance, "node_tolerance"))
    filter.SetReciprocal(flag(reciprocal, "reciprocal"))
    filter.SetUnsupported(unsupported)
    if young is not None:
        filter.SetYoungsModulus(positive(young, "Young's modulus"))
    if columns is not None:
        columns = vertex_list(columns, surface_of(surface).GetNumberOfPoints(), "columns")
        filter.SetColumnNodes(as_ids(columns, "columns"))
    filter.SetInputData(posed(surface, 1.0, 0.0, fixed))
    return computed(filter, progress, stacklevel=4)


def give(set_file_name, set_array, value, what):
    """A file or an array to a filter."""
    if is_path(value):
        set_file_name(path_of(value))
        return
    table = numbers(value, what)
    if table.ndim != 2 or table.size == 0:
        raise Error(f"{what} must be a table of rows and columns, not {'x'.join(map(str, table.shape))}")
    set_array(as_vtk(table, what, table.shape[1]))
