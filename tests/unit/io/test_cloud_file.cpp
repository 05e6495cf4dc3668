#include "core/error.hpp"
#include "io/cloud_file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <bit>
#include <cmath>
#include <numbers>

namespace tessera::io {
namespace {

using test::TemporaryFolder;

/// Numbers with no short decimal form, tiny and huge ones, a negative zero.
ParticleCloud awkward_cloud(int n = 500) {
  ParticleCloud cloud;
  cloud.dimension = 2;
  cloud.spacing = std::numbers::pi / 7;
  cloud.domain_volume = 1.0 / 3;
  cloud.seed = 0xfedcba9876543211u;
  cloud.arrangement = "voronoi";
  cloud.subvolumes = "uniform";
  for (int i = 0; i < n; ++i) {
    cloud.X.emplace_back(std::sin(i), std::ldexp(1.0, -i % 900), -0.0);
    cloud.V.push_back(std::exp(-i / 10.0));
    cloud.A.emplace_back(i, 1e300 / (i + 1), 1e-300 * i);
    cloud.centroid.emplace_back(std::cos(i), 0, i);
    cloud.cad_dimension.push_back(static_cast<std::uint8_t>(i % 4));
    cloud.sight.push_back(std::sqrt(i + 1));
  }
  cloud.hidden = {n, {{0, 1}, {0, n - 1}, {3, 4}}};
  cloud.sets.push_back({"base \"<&>'% face", {0, 3, n - 1}, {{1, 2, 3}, {0, 0, 0}, {-1, 1e-17, 4}}});
  cloud.sets.push_back({"probe µ", {7}, {}});
  cloud.sets.push_back({"nobody", {}, {}});
  cloud.sets.push_back({"100%41", {1}, {}});
  return cloud;
}

template <class T>
bool same_bits(const T& a, const T& b) {
  return a == b;
}
bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same_bits(const Vec3& a, const Vec3& b) {
  return same_bits(a[0], b[0]) && same_bits(a[1], b[1]) && same_bits(a[2], b[2]);
}
template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  bool same = a.size() == b.size();
  for (std::size_t i = 0; same && i < a.size(); ++i)
    same = same_bits(a[i], b[i]);
  return same;
}

std::string message_of(const std::filesystem::path& file) {
  try {
    read_cloud(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CloudFile, RoundTripKeepsEveryBit) {
  const TemporaryFolder folder;
  const ParticleCloud cloud = awkward_cloud();
  write_cloud(cloud, folder / "cloud.vtp");
  const ParticleCloud read = read_cloud(folder / "cloud.vtp");
  EXPECT_EQ(read.dimension, cloud.dimension);
  EXPECT_TRUE(same_bits(read.spacing, cloud.spacing));
  EXPECT_TRUE(same_bits(read.domain_volume, cloud.domain_volume));
  EXPECT_EQ(read.seed, cloud.seed);
  EXPECT_EQ(read.arrangement, cloud.arrangement);
  EXPECT_EQ(read.subvolumes, cloud.subvolumes);
  EXPECT_TRUE(same_bits(read.X, cloud.X));
  EXPECT_TRUE(same_bits(read.V, cloud.V));
  EXPECT_TRUE(same_bits(read.A, cloud.A));
  EXPECT_TRUE(same_bits(read.centroid, cloud.centroid));
  EXPECT_EQ(read.cad_dimension, cloud.cad_dimension);
  EXPECT_TRUE(same_bits(read.sight, cloud.sight));
  EXPECT_EQ(read.hidden.pairs(), cloud.hidden.pairs());
  ASSERT_EQ(read.sets.size(), cloud.sets.size());
  for (std::size_t s = 0; s < cloud.sets.size(); ++s) {
    EXPECT_EQ(read.sets[s].name, cloud.sets[s].name);
    EXPECT_EQ(read.sets[s].particles, cloud.sets[s].particles);
    EXPECT_TRUE(same_bits(read.sets[s].area, cloud.sets[s].area)) << cloud.sets[s].name;
  }
}

TEST(CloudFile, EveryTruncationIsRefused) {
  const TemporaryFolder folder;
  write_cloud(awkward_cloud(60), folder / "cloud.vtp");
  const std::string whole = test::content(folder / "cloud.vtp");
  for (std::size_t length = 0; length < whole.size();
       length += length + 100 < whole.size() ? whole.size() / 40 + 1 : 1) {
    test::store(folder / "part.vtp", whole.substr(0, length));
    EXPECT_NE(message_of(folder / "part.vtp").find("part.vtp"), std::string::npos) << length;
  }
}

TEST(CloudFile, OneAlteredByteIsRefused) {
  const TemporaryFolder folder;
  write_cloud(awkward_cloud(60), folder / "cloud.vtp");
  const std::string whole = test::content(folder / "cloud.vtp");
  for (std::size_t at = 0; at < whole.size(); at += 97) {
    std::string altered = whole;
    altered[at] = static_cast<char>(altered[at] ^ 1);
    test::store(folder / "altered.vtp", altered);
    EXPECT_NE(message_of(folder / "altered.vtp").find("altered.vtp"), std::string::npos) << at;
  }
}

TEST(CloudFile, AHoleIsRefusedWithoutAChecksumToo) {
  const TemporaryFolder folder;
  write_cloud(awkward_cloud(), folder / "cloud.vtp");
  std::string text = test::content(folder / "cloud.vtp");
  text.erase(text.rfind("<!--"));
  text.erase(text.size() / 2, 1000);
  test::store(folder / "hole.vtp", text);
  testing::internal::CaptureStderr();
  const std::string message = message_of(folder / "hole.vtp");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "VTK's own messages belong in the error";
  EXPECT_NE(message.find("hole.vtp"), std::string::npos) << message;
  EXPECT_EQ(message.find("0x"), std::string::npos) << "no addresses of objects: " << message;
}

TEST(CloudFile, OtherFilesAreRefusedInWords) {
  const TemporaryFolder folder;
  EXPECT_NE(message_of(folder / "none.vtp").find("No such file"), std::string::npos);
  EXPECT_NE(message_of(folder.path()).find("folder"), std::string::npos);
  test::store(folder / "text.vtp", "hello");
  EXPECT_NE(message_of(folder / "text.vtp").find("not a VTK XML file"), std::string::npos);
  test::store(folder / "grid.vtp", "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid/></VTKFile>");
  EXPECT_FALSE(message_of(folder / "grid.vtp").empty());
  const vtkNew<vtkPolyData> bare;
  const vtkNew<vtkPoints> points;
  points->InsertNextPoint(1, 2, 3);
  bare->SetPoints(points);
  const vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(bare);
  writer->SetFileName((folder / "bare.vtp").c_str());
  writer->Write();
  EXPECT_NE(message_of(folder / "bare.vtp").find("not a particle cloud"), std::string::npos)
      << message_of(folder / "bare.vtp");
}

/// The file as another version, or a careless hand, would have written it.
void rewrite(const std::filesystem::path& file, const std::function<void(vtkPolyData&)>& change) {
  const vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  change(*reader->GetOutput());
  const vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(reader->GetOutput());
  writer->SetFileName(file.c_str());
  writer->Write();
}

TEST(CloudFile, AnotherFormatVersionIsRefusedWithBothNamed) {
  const TemporaryFolder folder;
  write_cloud(awkward_cloud(), folder / "cloud.vtp");
  rewrite(folder / "cloud.vtp",
          [](vtkPolyData& data) { data.GetFieldData()->GetArray("format_version")->SetTuple1(0, 7); });
  const std::string message = message_of(folder / "cloud.vtp");
  EXPECT_NE(message.find("version is 7"), std::string::npos) << message;
  EXPECT_NE(message.find("reads version 2"), std::string::npos) << message;
}

TEST(CloudFile, AMissingArrayAndABadValueAreNamed) {
  const TemporaryFolder folder;
  write_cloud(awkward_cloud(), folder / "a.vtp");
  std::filesystem::copy(folder / "a.vtp", folder / "b.vtp");
  rewrite(folder / "a.vtp", [](vtkPolyData& data) { data.GetPointData()->RemoveArray("centroid"); });
  EXPECT_NE(message_of(folder / "a.vtp").find("'centroid'"), std::string::npos)
      << message_of(folder / "a.vtp");
  rewrite(folder / "b.vtp",
          [](vtkPolyData& data) { data.GetPointData()->GetArray("volume")->SetTuple1(4, -1); });
  EXPECT_NE(message_of(folder / "b.vtp").find("particle 4"), std::string::npos);
  for (const double bad : {-1.0, 0.0, 500.0}) {
    write_cloud(awkward_cloud(), folder / "c.vtp");
    rewrite(folder / "c.vtp", [&](vtkPolyData& data) {
      data.GetFieldData()->GetArray("hidden_pairs")->SetComponent(0, 1, bad);
    });
    EXPECT_NE(message_of(folder / "c.vtp").find("hidden pair"), std::string::npos) << bad;
  }
}

TEST(CloudFile, AFullDiskIsNamed) {
  const TemporaryFolder folder;
  const ParticleCloud cloud = awkward_cloud(5000);
  const std::string message =
      test::message_with_file_limit(10000, [&] { write_cloud(cloud, folder / "cloud.vtp"); });
  EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CloudFile, CellsArePolyhedraWithOwnersAndVolumes) {
  const TemporaryFolder folder;
  CellMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
  mesh.cells.push_back({2, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
  mesh.cells.push_back({1, {{0, 1, 4, 2}}});
  ParticleCloud cloud;
  cloud.V = {9, 8, 1.0 / 6};
  write_cells(mesh, cloud, folder / "cells.vtu");
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "cells.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfCells(), 2);
  EXPECT_EQ(grid->GetCellType(0), VTK_POLYHEDRON);
  EXPECT_EQ(grid->GetCell(0)->GetNumberOfFaces(), 4);
  EXPECT_EQ(grid->GetCellType(1), VTK_POLYGON);
  EXPECT_EQ(grid->GetCell(1)->GetNumberOfPoints(), 4);
  EXPECT_EQ(grid->GetCellData()->GetArray("particle")->GetTuple1(0), 2);
  EXPECT_EQ(grid->GetCellData()->GetArray("volume")->GetTuple1(0), 1.0 / 6);
}

} // namespace
} // namespace tessera::io
