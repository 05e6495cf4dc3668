#include "io/field_series.hpp"
#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/vtk_arrays.hpp"
#include "io/vtk_messages.hpp"
#include "io/vtk_write.hpp"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkXMLUtilities.h>

#include <fmt/format.h>

#include <algorithm>

namespace tessera::io {
namespace {

namespace fs = std::filesystem;

/// Frames of an earlier run and what a killed run left half-written; other files in the folder are not ours.
bool is_frame_file(const fs::path& file) {
  const std::string name = file.filename().string();
  return file.extension() == ".vtu" && (name.starts_with("fields_") || name.starts_with(".fields_"));
}

const Field* find(const Frame& frame, std::string_view name) {
  for (const Field& field : frame.fields)
    if (field.name == name)
      return &field;
  return nullptr;
}

/// Points where the particles are now, so that the picture is the deformed body without any filter.
vtkSmartPointer<vtkPoints> current_points(const Frame& frame) {
  const Field* u = find(frame, "Displacement");
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(make_array<vtkFloatArray>(
      "Points", 3, static_cast<std::int64_t>(frame.X.size()), [&](std::int64_t i, int c) {
        const auto p = static_cast<std::size_t>(i);
        return frame.X[p](c) + (u ? u->values[3 * p + static_cast<std::size_t>(c)] : 0.0);
      }));
  return points;
}

vtkSmartPointer<vtkDataArray> stored(const Field& field) {
  const auto tuples = static_cast<std::int64_t>(field.values.size()) / field.components;
  const auto value = [&](std::int64_t i, int c) {
    return field.values[static_cast<std::size_t>(i * field.components + c)];
  };
  // A float cannot tell the numbers above 2^24 apart.
  if (field.name == "id")
    return make_array<vtkTypeInt32Array>(field.name, field.components, tuples, value);
  return make_array<vtkFloatArray>(field.name, field.components, tuples, value);
}

std::string pvd(const std::vector<std::pair<double, std::string>>& entries) {
  std::string text = "<?xml version=\"1.0\"?>\n"
                     "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
                     "  <Collection>\n";
  for (const auto& [time, file] : entries)
    text += fmt::format("    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", time, file);
  return text + "  </Collection>\n</VTKFile>\n";
}

} // namespace

FrameSeries::FrameSeries(fs::path folder) : folder_(std::move(folder)) {
  make_output_folder(folder_ / "fields");
  std::error_code error;
  fs::remove(folder_ / "fields.pvd", error); // first: it must never list a frame that is gone
  require(!error, fmt::format("cannot remove the earlier fields.pvd: {}", error.message()), folder_.string(),
          "choose another folder with -o");
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder_ / "fields"))
    if (is_frame_file(entry.path()))
      old.push_back(entry.path());
  for (const fs::path& file : old)
    fs::remove(file, error);
}

void FrameSeries::write(const Frame& frame) {
  const auto n = frame.X.size();
  for (const Field& field : frame.fields)
    if (field.values.size() != n * static_cast<std::size_t>(field.components))
      throw RunError(fmt::format("field '{}' has {} values where {} belong", field.name, field.values.size(),
                                 n * static_cast<std::size_t>(field.components)),
                     folder_.string(), "");
  const vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(current_points(frame));
  const vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < static_cast<vtkIdType>(n); ++i)
    vertices->InsertNextCell(1, &i);
  grid->SetCells(VTK_VERTEX, vertices);
  for (const Field& field : frame.fields)
    grid->GetPointData()->AddArray(stored(field));
  grid->GetFieldData()->AddArray(make_value<vtkDoubleArray>("TimeValue", frame.time));
  grid->GetFieldData()->AddArray(make_value<vtkTypeInt64Array>("Step", frame.step));

  const std::string name = fmt::format("fields/fields_{:04d}.vtu", entries_.size());
  const vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  write_vtk(*writer, folder_ / name);
  auto entries = entries_;
  entries.emplace_back(frame.time, name);
  write_text(folder_ / "fields.pvd", pvd(entries));
  entries_ = std::move(entries);
}

std::vector<StoredFrame> read_series(const fs::path& folder) {
  const fs::path file = folder / "fields.pvd";
  const std::string remedy = "run the case first: 'tessera run CASE.toml -o DIR' writes it";
  require(fs::exists(file), "there are no stored fields", file.string(), remedy);
  require_complete(file);
  const VtkMessages messages;
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  require(collection != nullptr, "the file lists no frames", file.string(), remedy);
  std::vector<StoredFrame> frames;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* entry = collection->GetNestedElement(i);
    const char* name = entry->GetAttribute("file");
    double time = 0;
    if (name && entry->GetScalarAttribute("timestep", time))
      frames.push_back({time, folder / name});
  }
  require(!frames.empty(), "the file lists no frames", file.string(), remedy);
  std::stable_sort(frames.begin(), frames.end(),
                   [](const StoredFrame& a, const StoredFrame& b) { return a.time < b.time; });
  return frames;
}

} // namespace tessera::io
