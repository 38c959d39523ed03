# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of measurements in VTK's files."""

from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter


def carrier_of(table):
    """A grid without points that carries a table."""
    grid = vtkUnstructuredGrid()
    grid.GetFieldData().ShallowCopy(table.GetFieldData())
    return grid


def write_table(table, path):
    """Write a table as other programs would, by the path's ending in capitals or not."""
    is_grid = path.suffix.lower() == ".vtu"
    writer = vtkXMLUnstructuredGridWriter() if is_grid else vtkXMLPolyDataWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(carrier_of(table) if is_grid else table)
    writer.Write()
    return path
