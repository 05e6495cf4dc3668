#include "io/cloud_file.hpp"

#include "core/error.hpp"
#include "io/vtk_arrays.hpp"
#include "io/vtk_messages.hpp"
#include "io/vtk_write.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeUInt64Array.h>
#include <vtkTypeUInt8Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <limits>

namespace tessera::io {
namespace {

namespace fs = std::filesystem;

constexpr int format_version = 2;
constexpr std::string_view mask_prefix = "set:";
constexpr std::string_view area_prefix = "area:";
constexpr const char* prepare_again = "prepare the cloud again";

/// VTK writes array names into XML attributes as they are: what XML would trip over travels as %XX.
std::string encoded(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f || std::string_view("%\"&<>'").find(c) != std::string_view::npos)
      out += fmt::format("%{:02X}", byte);
    else
      out += c;
  }
  return out;
}

std::string decoded(std::string_view name) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    unsigned byte = 0;
    const auto hex = name.substr(i, 3);
    if (hex.size() == 3 && hex[0] == '%' &&
        std::from_chars(&hex[1], &hex[1] + 2, byte, 16).ec == std::errc()) {
      out += static_cast<char>(byte);
      i += 2;
    } else {
      out += name[i];
    }
  }
  return out;
}

vtkSmartPointer<vtkDoubleArray> vectors(const std::string& name, const std::vector<Vec3>& values) {
  return make_array<vtkDoubleArray>(
      name, 3, static_cast<std::int64_t>(values.size()),
      [&](std::int64_t i, int c) { return values[static_cast<std::size_t>(i)](c); });
}

vtkSmartPointer<vtkStringArray> text(const char* name, const std::string& value) {
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetName(name);
  array->InsertNextValue(value);
  return array;
}

void add_set(vtkPointData& data, const ParticleSet& set, std::int64_t particles) {
  std::vector<std::int64_t> entry(static_cast<std::size_t>(particles), -1);
  for (std::size_t k = 0; k < set.particles.size(); ++k)
    entry[static_cast<std::size_t>(set.particles[k])] = static_cast<std::int64_t>(k);
  data.AddArray(make_array<vtkTypeUInt8Array>(
      std::string(mask_prefix) + encoded(set.name), 1, particles,
      [&](std::int64_t i, int) { return entry[static_cast<std::size_t>(i)] >= 0 ? 1 : 0; }));
  if (set.area.empty())
    return;
  data.AddArray(make_array<vtkDoubleArray>(std::string(area_prefix) + encoded(set.name), 3, particles,
                                           [&](std::int64_t i, int c) {
                                             const std::int64_t k = entry[static_cast<std::size_t>(i)];
                                             return k >= 0 ? set.area[static_cast<std::size_t>(k)](c) : 0.0;
                                           }));
}

/// The arrays of a file being read, with the errors a person needs when one is missing or of the wrong shape.
class Source {
 public:
  Source(vtkPolyData& data, const fs::path& file) : data_(&data), file_(file.string()) {}

  std::int64_t points() const { return data_->GetNumberOfPoints(); }

  vtkDataArray& array(const std::string& name, int components) const {
    auto* found = vtkDataArray::SafeDownCast(data_->GetPointData()->GetAbstractArray(name.c_str()));
    return checked(found, name, components, points());
  }
  std::vector<Vec3> vectors(const std::string& name) const { return vectors(array(name, 3)); }
  std::vector<Vec3> vectors(vtkDataArray& from) const {
    std::vector<Vec3> out(static_cast<std::size_t>(points()));
    for (std::size_t i = 0; i < out.size(); ++i)
      from.GetTuple(static_cast<vtkIdType>(i), out[i].data());
    return out;
  }
  double number(const std::string& name) const { return field(name).GetTuple1(0); }
  std::uint64_t seed() const {
    // Through double a seed above 2^53 would change, and VTK reads 64 bits as one of several array types.
    vtkDataArray& array = field("seed");
    require(array.GetDataTypeSize() == sizeof(std::uint64_t) && array.GetDataType() != VTK_DOUBLE,
            "the field 'seed' is not a 64-bit integer", file_, prepare_again);
    std::uint64_t value = 0;
    std::memcpy(&value, array.GetVoidPointer(0), sizeof value);
    return value;
  }
  std::string word(const std::string& name) const {
    auto* found = vtkStringArray::SafeDownCast(data_->GetFieldData()->GetAbstractArray(name.c_str()));
    require(found != nullptr && found->GetNumberOfValues() == 1,
            fmt::format("the file has no field '{}'", name), file_, prepare_again);
    return found->GetValue(0);
  }
  bool has_field(const std::string& name) const {
    return data_->GetFieldData()->GetAbstractArray(name.c_str()) != nullptr;
  }
  bool has_array(const std::string& name) const { return data_->GetPointData()->HasArray(name.c_str()); }
  /// Any number of pairs; none where the file has no such field.
  std::vector<std::array<std::int32_t, 2>> pairs(const std::string& name) const {
    if (!has_field(name))
      return {};
    auto* found = vtkDataArray::SafeDownCast(data_->GetFieldData()->GetAbstractArray(name.c_str()));
    vtkDataArray& array = checked(found, name, 2, found != nullptr ? found->GetNumberOfTuples() : 0);
    std::vector<std::array<std::int32_t, 2>> out(static_cast<std::size_t>(array.GetNumberOfTuples()));
    for (std::size_t i = 0; i < out.size(); ++i)
      for (int c = 0; c < 2; ++c)
        out[i][static_cast<std::size_t>(c)] =
            static_cast<std::int32_t>(array.GetComponent(static_cast<vtkIdType>(i), c));
    return out;
  }
  vtkPolyData& data() const { return *data_; }

 private:
  vtkDataArray& field(const std::string& name) const {
    auto* found = vtkDataArray::SafeDownCast(data_->GetFieldData()->GetAbstractArray(name.c_str()));
    return checked(found, name, 1, 1);
  }
  vtkDataArray& checked(vtkDataArray* found, const std::string& name, int components,
                        std::int64_t tuples) const {
    require(found != nullptr, fmt::format("the file has no array '{}'", name), file_, prepare_again);
    require(found->GetNumberOfComponents() == components && found->GetNumberOfTuples() == tuples,
            fmt::format("array '{}' has {} x {} values where {} x {} belong", name,
                        found->GetNumberOfTuples(), found->GetNumberOfComponents(), tuples, components),
            file_, prepare_again);
    return *found;
  }

  vtkPolyData* data_;
  std::string file_;
};

std::vector<ParticleSet> read_sets(const Source& source) {
  std::vector<ParticleSet> sets;
  vtkPointData* arrays = source.data().GetPointData();
  for (int a = 0; a < arrays->GetNumberOfArrays(); ++a) {
    const std::string name = arrays->GetArrayName(a) ? arrays->GetArrayName(a) : "";
    if (!name.starts_with(mask_prefix))
      continue;
    const std::string bare = name.substr(mask_prefix.size());
    const std::string area_name = std::string(area_prefix) + bare;
    vtkDataArray& mask = source.array(name, 1);
    vtkDataArray* area = arrays->HasArray(area_name.c_str()) ? &source.array(area_name, 3) : nullptr;
    ParticleSet set;
    set.name = decoded(bare);
    for (std::int64_t i = 0; i < source.points(); ++i) {
      if (mask.GetTuple1(i) == 0)
        continue;
      set.particles.push_back(static_cast<std::int32_t>(i));
      if (!area)
        continue;
      Vec3 share;
      area->GetTuple(i, share.data());
      set.area.push_back(share);
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

void require_format(const Source& source, const std::string& file) {
  require(source.has_field("format_version"),
          "the file is not a particle cloud: it has no field 'format_version'", file,
          "name a cloud.vtp that 'tessera prepare' wrote");
  const double version = source.number("format_version");
  require(version == format_version,
          fmt::format("the cloud's format version is {:g}, this program reads version {}", version,
                      format_version),
          file, "prepare the cloud again with this program");
}

} // namespace

void write_cloud(const ParticleCloud& cloud, const fs::path& file) {
  const std::int64_t n = cloud.size();
  const vtkNew<vtkPolyData> data;
  const vtkNew<vtkPoints> points;
  points->SetData(vectors("Points", cloud.X));
  data->SetPoints(points);
  const vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < n; ++i)
    vertices->InsertNextCell(1, &i);
  data->SetVerts(vertices);

  vtkPointData& arrays = *data->GetPointData();
  arrays.AddArray(make_array<vtkDoubleArray>(
      "volume", 1, n, [&](std::int64_t i, int) { return cloud.V[static_cast<std::size_t>(i)]; }));
  arrays.AddArray(vectors("area", cloud.A));
  arrays.AddArray(vectors("centroid", cloud.centroid));
  arrays.AddArray(make_array<vtkTypeUInt8Array>("cad_dimension", 1, n, [&](std::int64_t i, int) {
    return cloud.cad_dimension[static_cast<std::size_t>(i)];
  }));
  arrays.AddArray(make_array<vtkTypeInt32Array>("id", 1, n, [](std::int64_t i, int) { return i; }));
  if (!cloud.sight.empty())
    arrays.AddArray(make_array<vtkDoubleArray>(
        "sight", 1, n, [&](std::int64_t i, int) { return cloud.sight[static_cast<std::size_t>(i)]; }));
  for (const ParticleSet& set : cloud.sets)
    add_set(arrays, set, n);

  vtkFieldData& fields = *data->GetFieldData();
  if (const auto& pairs = cloud.hidden.pairs(); !pairs.empty())
    fields.AddArray(make_array<vtkTypeInt32Array>(
        "hidden_pairs", 2, static_cast<std::int64_t>(pairs.size()), [&](std::int64_t i, int c) {
          return pairs[static_cast<std::size_t>(i)][static_cast<std::size_t>(c)];
        }));
  fields.AddArray(make_value<vtkTypeInt32Array>("format_version", format_version));
  fields.AddArray(make_value<vtkTypeInt32Array>("dimension", cloud.dimension));
  fields.AddArray(make_value<vtkDoubleArray>("spacing", cloud.spacing));
  fields.AddArray(make_value<vtkDoubleArray>("domain_volume", cloud.domain_volume));
  fields.AddArray(make_value<vtkTypeUInt64Array>("seed", cloud.seed));
  fields.AddArray(text("arrangement", cloud.arrangement));
  fields.AddArray(text("subvolumes", cloud.subvolumes));

  const vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  write_vtk(*writer, file);
}

ParticleCloud read_cloud(const fs::path& file) {
  require_complete(file);
  const std::string origin = file.string();
  const VtkMessages messages;
  const vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  try {
    reader->Update();
  } catch (const std::exception& error) { // sizes in the file that no memory holds
    throw InputError(fmt::format("the file is damaged: {}", error.what()), origin, prepare_again);
  }
  require(messages.text().empty(), fmt::format("the file is damaged: {}", messages.last()), origin,
          prepare_again);
  require(reader->GetErrorCode() == 0 && reader->GetOutput() != nullptr, "the file is not VTK polygonal data",
          origin, prepare_again);

  const Source source(*reader->GetOutput(), file);
  require_format(source, origin);
  require(source.points() > 0 && source.points() <= std::numeric_limits<std::int32_t>::max(),
          fmt::format("the cloud has {} particles", source.points()), origin, prepare_again);
  ParticleCloud cloud;
  cloud.dimension = static_cast<int>(source.number("dimension"));
  cloud.spacing = source.number("spacing");
  cloud.domain_volume = source.number("domain_volume");
  cloud.seed = source.seed();
  cloud.arrangement = source.word("arrangement");
  cloud.subvolumes = source.word("subvolumes");
  cloud.X = source.vectors(*source.data().GetPoints()->GetData());
  cloud.A = source.vectors("area");
  cloud.centroid = source.vectors("centroid");
  vtkDataArray& volume = source.array("volume", 1);
  vtkDataArray& cad_dimension = source.array("cad_dimension", 1);
  for (std::int64_t i = 0; i < source.points(); ++i) {
    cloud.V.push_back(volume.GetTuple1(i));
    cloud.cad_dimension.push_back(static_cast<std::uint8_t>(cad_dimension.GetTuple1(i)));
  }
  cloud.sets = read_sets(source);
  if (source.has_array("sight")) {
    vtkDataArray& sight = source.array("sight", 1);
    for (std::int64_t i = 0; i < source.points(); ++i)
      cloud.sight.push_back(sight.GetTuple1(i));
  }
  auto pairs = source.pairs("hidden_pairs");
  for (const auto& [a, b] : pairs)
    require(a >= 0 && a < b && b < source.points(),
            fmt::format("the hidden pair {}, {} names no two particles", a, b), origin, prepare_again);
  require(std::is_sorted(pairs.begin(), pairs.end()), "the hidden pairs are not in order", origin,
          prepare_again);
  cloud.hidden = {source.points(), std::move(pairs)};
  cloud.validate(origin);
  return cloud;
}

void write_cells(const CellMesh& cells, const ParticleCloud& cloud, const fs::path& file) {
  const vtkNew<vtkUnstructuredGrid> grid;
  const vtkNew<vtkPoints> points;
  points->SetData(vectors("Points", cells.points));
  grid->SetPoints(points);
  for (const CellMesh::Cell& cell : cells.cells) {
    if (cell.faces.size() == 1) { // a plane cell
      const std::vector<vtkIdType> loop(cell.faces[0].begin(), cell.faces[0].end());
      grid->InsertNextCell(VTK_POLYGON, static_cast<vtkIdType>(loop.size()), loop.data());
      continue;
    }
    std::vector<vtkIdType> faces{static_cast<vtkIdType>(cell.faces.size())};
    for (const auto& loop : cell.faces) {
      faces.push_back(static_cast<vtkIdType>(loop.size()));
      faces.insert(faces.end(), loop.begin(), loop.end());
    }
    const vtkNew<vtkIdList> stream;
    stream->SetNumberOfIds(static_cast<vtkIdType>(faces.size()));
    std::copy(faces.begin(), faces.end(), stream->begin());
    grid->InsertNextCell(VTK_POLYHEDRON, stream);
  }
  const auto count = static_cast<std::int64_t>(cells.cells.size());
  const auto owner = [&](std::int64_t c) { return cells.cells[static_cast<std::size_t>(c)].particle; };
  grid->GetCellData()->AddArray(
      make_array<vtkTypeInt32Array>("particle", 1, count, [&](std::int64_t c, int) { return owner(c); }));
  grid->GetCellData()->AddArray(make_array<vtkDoubleArray>(
      "volume", 1, count, [&](std::int64_t c, int) { return cloud.V[static_cast<std::size_t>(owner(c))]; }));

  const vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  write_vtk(*writer, file);
}

} // namespace tessera::io
