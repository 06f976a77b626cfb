"""Prints what VTK's own reader sees in a .vtkhdf file, at every time step, as JSON."""

import json
import sys

import h5py
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader


def arrays(data):
    named = (data.GetAbstractArray(index) for index in range(data.GetNumberOfArrays()))
    return {array.GetName(): vtk_to_numpy(array).tolist() for array in named}


def main(path):
    reader = vtkHDFReader()
    if not reader.CanReadFile(path):
        sys.exit(f"VTK cannot read {path}")
    reader.SetFileName(path)
    reader.UpdateInformation()
    key = reader.GetExecutive().TIME_STEPS()
    times = reader.GetOutputInformation(0).Get(key)
    steps = []
    for step in range(reader.GetNumberOfSteps()):
        reader.SetStep(step)
        reader.UpdateTimeStep(times[step])
        grid = reader.GetOutputDataObject(0)
        cells = range(grid.GetNumberOfCells())
        steps.append(
            {
                "class": grid.GetClassName(),
                "points": vtk_to_numpy(grid.GetPoints().GetData()).tolist(),
                "cell_types": [grid.GetCellType(cell) for cell in cells],
                "cells": [
                    [grid.GetCell(cell).GetPointId(node) for node in range(grid.GetCell(cell).GetNumberOfPoints())]
                    for cell in cells
                ],
                "point_data": arrays(grid.GetPointData()),
                "cell_data": arrays(grid.GetCellData()),
                "field_data": arrays(grid.GetFieldData()),
            }
        )
    with h5py.File(path, "r") as file:
        attributes = dict(file.attrs)
    json.dump({"attributes": attributes, "times": list(times), "steps": steps}, sys.stdout)


main(sys.argv[1])
