#include "postprocess/render/cells.hpp"

#include "core/error.hpp"
#include "io/vtk_write.hpp"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace tessera::post {

CellMesh read_cells(const std::string& file) {
  io::require_complete(file);
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  vtkDataArray* owner = grid ? grid->GetCellData()->GetArray("particle") : nullptr;
  require(owner != nullptr && grid->GetNumberOfCells() > 0, "the file is damaged or holds no cells", file,
          "prepare the cloud again");
  CellMesh mesh;
  mesh.points.resize(static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    grid->GetPoint(p, mesh.points[static_cast<std::size_t>(p)].data());
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    CellMesh::Cell& cell =
        mesh.cells.emplace_back(CellMesh::Cell{static_cast<std::int32_t>(owner->GetTuple1(c)), {}});
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    if (grid->GetCellType(c) == VTK_POLYGON) {
      grid->GetCellPoints(c, count, ids);
      cell.faces.emplace_back(ids, ids + count);
      continue;
    }
    if (grid->GetCellType(c) != VTK_POLYHEDRON)
      continue;
    grid->GetFaceStream(c, count, ids);
    for (vtkIdType f = 0; f < count; ++f) {
      cell.faces.emplace_back(ids + 1, ids + 1 + *ids);
      ids += 1 + *ids;
    }
  }
  return mesh;
}

} // namespace tessera::post
