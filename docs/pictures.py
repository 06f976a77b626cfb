"""Pictures of a solid from its fields.vtkhdf, without a display: `pvpython docs/pictures.py FIELDS FOLDER`, or any Python with vtk.

FIELDS is the file of a run, FOLDER where picture-000.png, picture-001.png, ... go, one a moment. The nodes stand where they have
moved to; between elements is a spacing, for nodes are sites. Colour is a field: of nodes `displacement` (nm) or `velocity`
(m/s), of cells `virial_stress` (GPa) or `damage`.
"""

import argparse
import pathlib

import vtk

AXES = {"x": 0, "y": 1, "z": 2}
# VTK keeps a symmetric tensor as xx, yy, zz, xy, yz, xz.
TENSOR = {"xx": 0, "yy": 1, "zz": 2, "xy": 3, "yz": 4, "xz": 5}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fields", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--field", default="displacement")
    parser.add_argument("--component", default="y", help="x, y, z of a vector; xx, yy, zz, xy, yz, xz of a tensor")
    parser.add_argument("--limit", type=float, help="the end of the scale; by default the largest value of the last moment")
    parser.add_argument("--look", default="0.42,-0.7,0.57", help="where the camera stands, seen from the middle")
    parser.add_argument("--section", help="a normal such as 0,0,1: what is behind the plane through the middle")
    return parser.parse_args()


def main():
    asked = arguments()
    asked.folder.mkdir(parents=True, exist_ok=True)
    reader = vtk.vtkHDFReader(file_name=str(asked.fields))
    reader.UpdateInformation()
    warp = vtk.vtkWarpVector(input_connection=reader.GetOutputPort())
    warp.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "displacement")
    last = warp
    if asked.section:
        plane = vtk.vtkPlane(normal=numbers(asked.section))
        last = vtk.vtkExtractGeometry(input_connection=warp.GetOutputPort(), implicit_function=plane)
        last.ExtractBoundaryCellsOn()
    surface = vtk.vtkDataSetSurfaceFilter(input_connection=last.GetOutputPort())
    mapper = vtk.vtkPolyDataMapper(input_connection=surface.GetOutputPort())
    colours = vtk.vtkColorTransferFunction()
    colours.SetColorSpaceToDiverging()
    of_nodes = asked.field in ("displacement", "velocity")
    component = 0 if asked.field == "damage" else (AXES if of_nodes else TENSOR)[asked.component]
    mapper.SetLookupTable(colours)
    mapper.SetScalarMode(3 if of_nodes else 4)
    mapper.SelectColorArray(asked.field)
    colours.SetVectorModeToComponent()
    colours.SetVectorComponent(component)

    renderer = vtk.vtkRenderer(background=(1, 1, 1))
    actor = vtk.vtkActor(mapper=mapper)
    actor.property.point_size, actor.property.ambient, actor.property.diffuse = 3, 0.4, 0.6
    renderer.AddActor(actor)
    bar = vtk.vtkScalarBarActor(lookup_table=colours, title=f"{asked.field} {asked.component}", number_of_labels=5)
    bar.SetOrientationToHorizontal()
    bar.SetPosition(0.25, 0.03)
    bar.SetPosition2(0.5, 0.1)
    for text in (bar.title_text_property, bar.label_text_property):
        text.color, text.italic, text.bold, text.shadow = (0.1, 0.1, 0.1), 0, 0, 0
    renderer.AddViewProp(bar)
    window = vtk.vtkRenderWindow(off_screen_rendering=1, size=(1400, 900))
    window.AddRenderer(renderer)

    moments = range(reader.GetNumberOfSteps())
    limit = asked.limit
    for moment in reversed(moments):
        reader.SetStep(moment)
        warp.Update()
        if moment == moments[-1]:
            look_at(renderer, warp.GetOutput(), numbers(asked.look))
            data = warp.GetOutput().GetPointData() if of_nodes else warp.GetOutput().GetCellData()
            low, high = data.GetArray(asked.field).GetRange(component)
            limit = limit or max(abs(low), abs(high), 1e-12)
            colours.AddRGBPoint(-limit, 0.1, 0.35, 0.6)
            colours.AddRGBPoint(0, 0.95, 0.94, 0.92)
            colours.AddRGBPoint(limit, 0.65, 0.07, 0.16)
        if asked.section:
            plane.SetOrigin(warp.GetOutput().GetCenter())
        window.Render()
        image = vtk.vtkWindowToImageFilter(input=window)
        image.ReadFrontBufferOff()
        image.Update()
        name = str(asked.folder / f"picture-{moment:03}.png")
        vtk.vtkPNGWriter(file_name=name, input_connection=image.GetOutputPort()).Write()


def numbers(text):
    return [float(number) for number in text.split(",")]


def look_at(renderer, grid, look):
    middle, length = grid.GetCenter(), grid.GetLength()
    camera = renderer.GetActiveCamera()
    camera.SetParallelProjection(True)
    camera.SetFocalPoint(middle)
    camera.SetPosition([place + length * part for place, part in zip(middle, look)])
    low = [abs(part) for part in look]
    camera.SetViewUp((0, 1, 0) if low[2] > low[1] else (0, 0, 1))
    renderer.ResetCamera(grid.GetBounds())
    camera.Zoom(1.4)


main()
