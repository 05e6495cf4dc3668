#include "core/error.hpp"
#include "io/series.hpp"
#include "tests/unit/io/temporary_folder.hpp"

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

TEST(History, RoundTripKeepsEveryBit) {
  const TemporaryFolder folder;
  HistoryFile file(folder / "history.csv");
  file.columns({"time_s", "tip, \"left\"_m"});
  file.row({1.0 / 3, 1e-300});
  file.row({-0.0, std::numeric_limits<double>::infinity()});
  file.row({1, std::nan("")});
  const History history = read_history(folder / "history.csv"); // while it is still open: rows are flushed
  ASSERT_EQ(history.names, (std::vector<std::string>{"time_s", "tip, \"left\"_m"}));
  const auto& time = history.column("time_s");
  ASSERT_EQ(time.size(), 3u);
  EXPECT_EQ(time[0], 1.0 / 3);
  EXPECT_TRUE(std::signbit(time[1]));
  const auto& tip = history.column("tip, \"left\"_m");
  EXPECT_EQ(tip[0], 1e-300);
  EXPECT_TRUE(std::isinf(tip[1]));
  EXPECT_TRUE(std::isnan(tip[2]));
}

TEST(History, AnUnfinishedLastRowIsLeftOut) {
  const TemporaryFolder folder;
  for (const char* part : {"0.2", "0.2,", "0.2,1", "0.2,1.5e", "0.2,1\n0"}) {
    test::store(folder / "h.csv", std::string("time_s,x_m\n0.1,1\n") + part);
    const History history = read_history(folder / "h.csv");
    const std::size_t rows = std::string(part).find('\n') == std::string::npos ? 1 : 2;
    EXPECT_EQ(history.column("x_m").size(), rows) << part;
  }
}

TEST(History, BadFilesAreNamedWithTheLine) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_history(folder / "none.csv"), InputError);
  test::store(folder / "h.csv", "");
  EXPECT_THROW(read_history(folder / "h.csv"), InputError);
  test::store(folder / "h.csv", "time_s,x_m\n0.1,1\n0.2,abc\n0.3,1\n");
  try {
    read_history(folder / "h.csv");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("h.csv:3"), std::string::npos) << error.what();
  }
}

TEST(History, AnUnknownColumnIsAnsweredWithTheNearest) {
  const History history{{"time_s", "radius_m"}, {{0}, {1}}};
  try {
    history.column("radus_m");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'radius_m'"), std::string::npos) << error.what();
  }
}

TEST(History, AFullDiskIsNamed) {
  HistoryFile file("/dev/full");
  try {
    file.columns({"time_s"});
    FAIL();
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("No space left on device"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace tessera::io
