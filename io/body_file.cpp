#include "io/body_file.hpp"

#include "core/error.hpp"
#include "io/vtk_arrays.hpp"
#include "io/vtk_messages.hpp"
#include "io/vtk_write.hpp"

#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>

namespace tessera::io {
namespace {

constexpr const char* remedy = "prepare the case again";

template <std::size_t N>
void insert(vtkUnstructuredGrid& grid, int type, const std::vector<std::array<std::int32_t, N>>& simplices) {
  for (const auto& simplex : simplices) {
    std::array<vtkIdType, N> ids;
    std::copy(simplex.begin(), simplex.end(), ids.begin());
    grid.InsertNextCell(type, static_cast<vtkIdType>(N), ids.data());
  }
}

template <std::size_t N>
std::array<std::int32_t, N> simplex_of(const vtkIdType* ids) {
  std::array<std::int32_t, N> simplex;
  std::transform(ids, ids + N, simplex.begin(), [](vtkIdType p) { return static_cast<std::int32_t>(p); });
  return simplex;
}

} // namespace

void write_body(const BodyMesh& mesh, const std::filesystem::path& file) {
  const vtkNew<vtkUnstructuredGrid> grid;
  const vtkNew<vtkPoints> points;
  points->SetData(make_array<vtkDoubleArray>(
      "Points", 3, static_cast<std::int64_t>(mesh.points.size()),
      [&](std::int64_t i, int c) { return mesh.points[static_cast<std::size_t>(i)](c); }));
  grid->SetPoints(points);
  insert(*grid, VTK_TETRA, mesh.solids);
  insert(*grid, VTK_TRIANGLE, mesh.faces);
  insert(*grid, VTK_LINE, mesh.edges);
  grid->GetFieldData()->AddArray(make_value<vtkTypeInt32Array>("dimension", mesh.dimension));
  const vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  write_vtk(*writer, file);
}

BodyMesh read_body(const std::filesystem::path& file) {
  require_complete(file);
  const VtkMessages messages;
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  vtkDataArray* dimension = grid ? grid->GetFieldData()->GetArray("dimension") : nullptr;
  require(messages.text().empty() && dimension && dimension->GetNumberOfValues() == 1 &&
              grid->GetNumberOfCells() > 0,
          "the file is damaged or holds no body", file.string(), remedy);
  BodyMesh mesh;
  mesh.dimension = static_cast<int>(dimension->GetComponent(0, 0));
  mesh.points.resize(static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    grid->GetPoint(static_cast<vtkIdType>(p), mesh.points[p].data());
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    grid->GetCellPoints(c, count, ids);
    const int type = grid->GetCellType(c);
    require((type == VTK_TETRA && count == 4) || (type == VTK_TRIANGLE && count == 3) ||
                (type == VTK_LINE && count == 2),
            "the body holds other cells than tetrahedra, triangles and lines", file.string(), remedy);
    require(
        std::all_of(ids, ids + count, [&](vtkIdType p) { return p >= 0 && p < grid->GetNumberOfPoints(); }),
        "a cell of the body names no point", file.string(), remedy);
    if (type == VTK_TETRA)
      mesh.solids.push_back(simplex_of<4>(ids));
    else if (type == VTK_TRIANGLE)
      mesh.faces.push_back(simplex_of<3>(ids));
    else
      mesh.edges.push_back(simplex_of<2>(ids));
  }
  return mesh;
}

} // namespace tessera::io
