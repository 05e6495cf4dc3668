#include "preprocess/geometry/domain_stream.hpp"
#include "preprocess/geometry/iges_file.hpp"
#include "tests/unit/preprocess/geometry/iges_box.hpp"
#include "tests/unit/preprocess/geometry/import_fixture.hpp"

namespace tessera::preprocess {
namespace {

class ImportIges : public ImportFixture {};

TEST_F(ImportIges, closed_surfaces_become_a_solid) {
  for (const char* name : {"box.igs", "box.IGES"}) {
    const Domain domain = import(write(name, test::iges_box({10, 20, 30})), "mm");
    EXPECT_NEAR(domain.volume / 6000e-9, 1, 1e-12);
    EXPECT_NEAR(domain.cad_volume / 6000e-9, 1, 1e-9);
    EXPECT_EQ(domain.surfaces.size(), 6u);
    EXPECT_EQ(domain.corners.size(), 8u);
    EXPECT_EQ(curves(domain), 12u);
    EXPECT_NEAR((domain.upper - Vec3(10e-3, 20e-3, 30e-3)).norm(), 0, 1e-12);
  }
}

TEST_F(ImportIges, open_surfaces_are_refused_with_their_free_edges) {
  const std::string said = complaint(write("open.igs", test::iges_box({10, 20, 30}, 5)));
  EXPECT_SAYS(said, "its 5 surfaces do not close: 4 free edges, the first near (");
  EXPECT_SAYS(said, "30)"); // the lid is missing
  EXPECT_SAYS(complaint(write("one.igs", test::iges_box({10, 20, 30}, 1))), "its 1 surface does not close");
}

TEST_F(ImportIges, the_files_own_unit_counts) {
  const std::map<std::string, std::pair<std::string, double>> files{
      {test::iges_box({1, 2, 3}, 6, 1, "INCH"), {"in", 0.0254}},
      {test::iges_box({1, 2, 3}, 6, 6, "M"), {"m", 1}},
      {test::iges_box({1, 2, 3}, 6, 10, "CM"), {"cm", 1e-2}},
      {test::iges_box({1, 2, 3}, 6, 3, "MM"), {"mm", 1e-3}},
      {test::iges_box({1, 2, 3}, 6, 4, "FT"), {"ft", 0.3048}}};
  for (const auto& [text, unit] : files) {
    EXPECT_EQ(iges_length_unit(text), unit.first);
    std::ostringstream said;
    Progress progress(said, false, false);
    GeometrySource source{.file = write("box.igs", text), .unit = "um"};
    const Domain domain = import_geometry(source, progress);
    EXPECT_NEAR(domain.upper[2] / (3 * unit.second), 1, 1e-9) << unit.first;
    EXPECT_SAYS(said.str(), "written in " + unit.first + ", not in um");
  }
}

TEST_F(ImportIges, plane_surface_is_a_figure) {
  const Domain domain = import_plane(write("lid.igs", test::iges_box({10, 20, 30}, 6, 2, "MM", 5)), "mm");
  EXPECT_EQ(domain.dimension, 2);
  EXPECT_NEAR(domain.volume / 200e-6, 1, 1e-12);
  EXPECT_EQ(domain.corners.size(), 4u);
  EXPECT_SAYS(complaint(write("box.igs", test::iges_box({10, 20, 30})), 2),
              "does not lie in a plane z = const");
}

TEST_F(ImportIges, files_that_are_none_or_cut_off_are_refused) {
  const std::string text = test::iges_box({1, 2, 3});
  EXPECT_SAYS(complaint(write("poem.igs", "Wer reitet so spaet")), "not an IGES file");
  EXPECT_SAYS(complaint(write("cut.igs", text.substr(0, text.size() / 2))), "cut off");
  EXPECT_EQ(iges_length_unit("nothing"), "");
  EXPECT_EQ(iges_length_unit(text.substr(0, 100)), "");
}

TEST_F(ImportIges, same_file_same_bits) {
  const auto file = write("box.igs", test::iges_box({10, 20, 30}));
  EXPECT_TRUE(to_bytes(import(file)) == to_bytes(import(file)));
}

} // namespace
} // namespace tessera::preprocess
