#include "core/error.hpp"
#include "io/field_series.hpp"
#include "io/frame_file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <limits>

namespace tessera::io {
namespace {

using test::TemporaryFolder;

/// A hundred particles on a line, moved by 0.5 along y.
struct Line {
  std::vector<Vec3> X;
  std::vector<double> displacement, stress, id;
  explicit Line(int n = 100) {
    for (int i = 0; i < n; ++i) {
      X.emplace_back(i, 1, 2);
      displacement.insert(displacement.end(), {0, 0.5, 0});
      for (int c = 0; c < 6; ++c)
        stress.push_back(100 * i + c);
      id.push_back(16777217 + i); // not a float
    }
  }
  Frame at(double time) const {
    return {time, 42, X, {{"Displacement", 3, displacement}, {"Stress", 6, stress}, {"id", 1, id}}};
  }
};

TEST(FrameSeries, AFrameHoldsTheDeformedBodyAndItsFields) {
  const TemporaryFolder folder;
  const Line line;
  FrameSeries(folder.path()).write(line.at(8e-5));
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "fields/fields_0000.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfPoints(), 100);
  ASSERT_EQ(grid->GetNumberOfCells(), 100);
  EXPECT_EQ(grid->GetCellType(99), VTK_VERTEX);
  double x[3];
  grid->GetPoint(7, x);
  EXPECT_EQ(x[0], 7);
  EXPECT_EQ(x[1], 1.5);
  EXPECT_EQ(x[2], 2);
  EXPECT_EQ(grid->GetPointData()->GetArray("Stress")->GetDataType(), VTK_FLOAT);
  EXPECT_EQ(grid->GetPointData()->GetArray("Stress")->GetComponent(7, 5), 705);
  EXPECT_EQ(grid->GetPointData()->GetArray("id")->GetTuple1(0), 16777217);
  EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 8e-5);
}

TEST(FrameSeries, IsReadableAfterEveryFrame) {
  const TemporaryFolder folder;
  const Line line;
  FrameSeries series(folder.path());
  EXPECT_THROW(read_series(folder.path()), InputError);
  for (int i = 0; i < 3; ++i) {
    series.write(line.at(i / 3.0));
    const auto frames = read_series(folder.path());
    ASSERT_EQ(frames.size(), static_cast<std::size_t>(i + 1));
    EXPECT_EQ(frames.back().time, i / 3.0);
    EXPECT_TRUE(std::filesystem::exists(frames.back().file));
  }
}

TEST(FrameSeries, ANewRunRemovesTheEarlierOneAndNothingElse) {
  const TemporaryFolder folder;
  const Line line;
  FrameSeries(folder.path()).write(line.at(0));
  test::store(folder / "fields/.fields_0001.tmp-1-1.vtu", "left by a killed run");
  test::store(folder / "fields/mine.vtu", "x");
  const FrameSeries series(folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder / "fields.pvd"));
  EXPECT_FALSE(std::filesystem::exists(folder / "fields/fields_0000.vtu"));
  EXPECT_FALSE(std::filesystem::exists(folder / "fields/.fields_0001.tmp-1-1.vtu"));
  EXPECT_TRUE(std::filesystem::exists(folder / "fields/mine.vtu"));
}

TEST(FrameSeries, AFullDiskKeepsTheFramesBefore) {
  const TemporaryFolder folder;
  const Line small(10), large(20000);
  const std::string message = test::message_with_file_limit(20000, [&] {
    FrameSeries series(folder.path());
    series.write(small.at(0));
    series.write(large.at(1));
  });
  EXPECT_NE(message.find("fields_0001.vtu"), std::string::npos) << message;
  EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  const auto frames = read_series(folder.path());
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_TRUE(std::filesystem::exists(frames[0].file));
  EXPECT_FALSE(std::filesystem::exists(folder / "fields/fields_0001.vtu"));
}

TEST(FrameSeries, AFieldOfTheWrongLengthIsRefused) {
  const TemporaryFolder folder;
  Line line;
  line.stress.pop_back();
  EXPECT_THROW(FrameSeries(folder.path()).write(line.at(0)), RunError);
}

TEST(FrameSeries, DamagedListsAreRefused) {
  const TemporaryFolder folder;
  for (const char* text : {"", "hello", "<VTKFile><Collection>", "<VTKFile></VTKFile>",
                           "<VTKFile><Collection></Collection></VTKFile>", "<VTKFile><Col</VTKFile>"}) {
    test::store(folder / "fields.pvd", text);
    EXPECT_THROW(read_series(folder.path()), InputError) << text;
  }
}

TEST(ReadFrame, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const Line line;
  FrameSeries(folder.path()).write(line.at(8e-5));
  const std::filesystem::path file = folder / "fields/fields_0000.vtu";
  const StoredFields frame = read_frame(file);
  EXPECT_EQ(frame.time, 8e-5);
  ASSERT_EQ(frame.x.size(), 100u);
  EXPECT_EQ(frame.x[7], Vec3(7, 1.5, 2));
  ASSERT_EQ(frame.fields.size(), 3u);
  EXPECT_EQ(frame.fields[1].name, "Stress");
  EXPECT_EQ(frame.fields[1].components, 6);
  EXPECT_EQ(frame.fields[1].values, line.stress);
  EXPECT_EQ(frame.fields[2].values, line.id);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THROW(read_frame(file), InputError);
  EXPECT_THROW(read_frame(folder / "none.vtu"), InputError);
}

} // namespace
} // namespace tessera::io
