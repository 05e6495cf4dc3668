"""Reads the frames and clouds the program writes, by VTK."""

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader


def read_array(path, name):
    """The point array `name` as a flat list of numbers; "Points" are the positions."""
    reader = vtkXMLPolyDataReader() if path.suffix == ".vtp" else vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    values = data.GetPoints().GetData() if name == "Points" else data.GetPointData().GetArray(name)
    if values is None:
        raise KeyError(f"{path} has no array {name}")
    return [values.GetValue(i) for i in range(values.GetNumberOfValues())]


def read_points(path):
    flat = read_array(path, "Points")
    return [tuple(flat[i : i + 3]) for i in range(0, len(flat), 3)]
