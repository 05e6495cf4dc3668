#include "io/frame_file.hpp"

#include "core/error.hpp"
#include "io/vtk_messages.hpp"
#include "io/vtk_write.hpp"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <fmt/format.h>

namespace tessera::io {
namespace {

std::vector<double> numbers(vtkDataArray& array) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(array.GetNumberOfValues()));
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i)
    for (int c = 0; c < array.GetNumberOfComponents(); ++c)
      values.push_back(array.GetComponent(i, c));
  return values;
}

} // namespace

StoredFields read_frame(const std::filesystem::path& file) {
  constexpr const char* remedy = "run the case again";
  require_complete(file);
  const VtkMessages messages;
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  try {
    reader->Update();
  } catch (const std::exception& error) { // sizes in the file that no memory holds
    throw InputError(fmt::format("the file is damaged: {}", error.what()), file.string(), remedy);
  }
  require(messages.text().empty(), fmt::format("the file is damaged: {}", messages.last()), file.string(),
          remedy);
  vtkUnstructuredGrid* grid = reader->GetOutput();
  require(grid && grid->GetNumberOfPoints() > 0, "the frame holds no particles", file.string(), remedy);

  StoredFields frame;
  vtkDataArray* time = grid->GetFieldData()->GetArray("TimeValue");
  require(time && time->GetNumberOfValues() == 1, "the frame has no 'TimeValue'", file.string(), remedy);
  frame.time = time->GetComponent(0, 0);
  frame.x.resize(static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (std::size_t a = 0; a < frame.x.size(); ++a)
    grid->GetPoint(static_cast<vtkIdType>(a), frame.x[a].data());
  vtkPointData& arrays = *grid->GetPointData();
  for (int i = 0; i < arrays.GetNumberOfArrays(); ++i)
    if (vtkDataArray* array = arrays.GetArray(i); array && array->GetName())
      frame.fields.push_back({array->GetName(), array->GetNumberOfComponents(), numbers(*array)});
  return frame;
}

} // namespace tessera::io
