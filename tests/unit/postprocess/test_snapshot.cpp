#include "core/error.hpp"
#include "postprocess/compare.hpp"
#include "postprocess/field_difference.hpp"
#include "postprocess/point_data.hpp"
#include "tests/unit/postprocess/stored_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tessera::post {
namespace {

using test::contains;
using test::content;
using test::TemporaryFolder;

/// A lattice of 9 x 5 points 1 mm apart in the plane, sheared by x = X + Y/2, with fields linear in X and x.
Snapshot sheared() {
  Snapshot out;
  out.file = "sheared.vtu";
  out.frame.time = 0.5;
  io::StoredField u{"Displacement", 3, {}}, of_X{"Pressure", 1, {}}, of_x{"VonMises", 1, {}},
      stress{"Stress", 6, {}};
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 9; ++i) {
      const Vec3 X(1e-3 * i, 1e-3 * j, 0), x = X + Vec3(X[1] / 2, 0, 0);
      out.cloud.X.push_back(X);
      out.cloud.V.push_back(1e-6);
      out.frame.x.push_back(x);
      u.values.insert(u.values.end(), {X[1] / 2, 0, 0});
      of_X.values.push_back(7 + 3e3 * X[0] - 2e3 * X[1]);
      of_x.values.push_back(5 + 3e3 * x[0] - 2e3 * x[1]);
      for (int c = 0; c < 6; ++c)
        stress.values.push_back(c + X[0]);
    }
  out.cloud.dimension = 2;
  out.cloud.spacing = 1e-3;
  out.frame.fields = {u, of_X, of_x, stress};
  return out;
}

TEST(Section, LinearFieldsAreExactInBothConfigurations) {
  const std::vector<Snapshot> runs{sheared()};
  const Section section = section_from("0.001,0.0013:7e-3,2.7e-3");
  const SectionCurves as_it_was = cut(section, runs, {"Pressure"}, Configuration::reference, 11);
  const SectionCurves as_it_is = cut(section, runs, {"VonMises", "Displacement"}, Configuration::current, 11);
  ASSERT_EQ(as_it_was.curves.size(), 1u);
  ASSERT_EQ(as_it_is.curves.size(), 2u);
  EXPECT_DOUBLE_EQ(as_it_was.distance.back(), std::hypot(6e-3, 1.4e-3));
  for (std::size_t i = 0; i < 11; ++i) {
    const Vec3& p = as_it_was.points[i];
    EXPECT_NEAR(as_it_was.curves[0].values[i], 7 + 3e3 * p[0] - 2e3 * p[1], 1e-11);
    EXPECT_NEAR(as_it_is.curves[0].values[i], 5 + 3e3 * p[0] - 2e3 * p[1], 1e-11);
    EXPECT_NEAR(as_it_is.curves[1].values[i], p[1] / 2, 1e-15) << "the vector's magnitude";
  }
}

/// A bar pressed to a tenth of its height, as feet of impacted bars are: its curve has no gap, and the
/// field's own value in the middle of the body.
TEST(Section, AFlattenedBodyIsSeenFromSideToSide) {
  Snapshot flat = sheared();
  for (std::size_t a = 0; a < flat.cloud.X.size(); ++a) {
    const Vec3& X = flat.cloud.X[a];
    flat.frame.x[a] = Vec3(2 * X[0] + 40 * X[0] * X[0], 0.1 * X[1], 0);
    flat.frame.fields[1].values[a] = 1e3 * X[0];
  }
  const SectionCurves curves =
      cut(section_from("0.0005,0.0002:0.018,0.0002"), {flat}, {"Pressure"}, Configuration::current, 101);
  for (std::size_t i = 0; i < curves.points.size(); ++i) {
    const double x = curves.points[i][0], X = (std::sqrt(4 + 160 * x) - 2) / 80;
    EXPECT_NEAR(curves.curves[0].values[i], 1e3 * X, 0.02) << x;
  }
}

TEST(Section, ThereIsNothingOutsideTheBody) {
  const std::vector<Snapshot> runs{sheared()};
  const SectionCurves curves =
      cut(section_from("-0.02,0.002:0.004,0.002"), runs, {"Stress.yy"}, Configuration::reference, 25);
  EXPECT_TRUE(std::isnan(curves.curves[0].values.front()));
  EXPECT_NEAR(curves.curves[0].values.back(), 1.004, 1e-12);
  const std::string text = csv_text(curves, {"one, two"});
  EXPECT_TRUE(text.starts_with("distance_m,x_m,y_m,z_m,\"Stress_yy_Pa one, two\"\n0,-0.02,0.002,0,\n"))
      << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 26);
  EXPECT_THROW(cut(section_from("1,1,1:2,2,2"), runs, {"Pressure"}, Configuration::current), InputError);
}

TEST(Section, IsWrittenAsTwoPoints) {
  const Section section = section_from("-1e-3,0,2:4,5.5,-6");
  EXPECT_EQ(section.from, Vec3(-1e-3, 0, 2));
  EXPECT_EQ(section.to, Vec3(4, 5.5, -6));
  for (const char* wrong : {"", "1,2,3", "1,2,3:", "1:2", "1,2,3,4:0,0,0", "1,2,x:0,0,0", "1,,2:3,3,3",
                            "0,0,0:0,0,0", "0,0,0:1,1,nan", "0,0,0:1,1,1:2,2,2"})
    EXPECT_THROW(section_from(wrong), InputError) << wrong;
}

TEST(Snapshot, FieldsAreNamedWithTheirComponents) {
  const Snapshot snapshot = sheared();
  EXPECT_EQ(field_of(snapshot, "Stress.xz").values[1], 5 + 1e-3);
  EXPECT_EQ(field_of(snapshot, "Displacement").components, 3);
  EXPECT_EQ(field_of(snapshot, "Displacement.x").components, 1);
  for (const auto& [name, hint] : {std::pair{"Presure", "did you mean 'Pressure'"},
                                   {"Stress", "Stress.xx, .yy"},
                                   {"Stress.xw", "Stress.xx"},
                                   {"Pressure.x", "has no components"}})
    try {
      field_of(snapshot, name);
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_TRUE(contains(error.what(), hint)) << error.what();
    }
}

TEST(FieldDifference, OfEqualRunsIsZeroAndOfOthersWhatItIs) {
  std::vector<Snapshot> runs{sheared(), sheared(), sheared()};
  for (double& value : runs[2].frame.fields[1].values)
    value *= 1.25;
  for (std::size_t i = 0; i < runs[2].frame.x.size(); ++i)
    runs[2].frame.fields[0].values[3 * i + 2] = 4; // across, so that magnitudes alone would differ otherwise
  const auto differences = differences_from_first(runs, {"Pressure", "Displacement"});
  ASSERT_EQ(differences.size(), 3u);
  for (std::size_t run : {0u, 1u})
    for (const FieldDifference& field : differences[run].fields) {
      EXPECT_EQ(field.relative, 0);
      EXPECT_EQ(field.largest, 0);
    }
  EXPECT_EQ(differences[2].points, 45u);
  EXPECT_NEAR(differences[2].fields[0].relative.value(), 0.25, 1e-14);
  EXPECT_NEAR(differences[2].fields[0].largest, 0.25 * (7 + 24), 1e-12);
  EXPECT_NEAR(differences[2].fields[1].largest, 4, 1e-14);
}

TEST(FieldDifference, CountsPointsInsideBothAndLeavesOutWhatIsZero) {
  std::vector<Snapshot> runs{sheared(), sheared()};
  for (Vec3& X : runs[1].cloud.X)
    X[0] += 5e-3; // the two share four of nine columns and what is within 1.25 spacings
  for (double& value : runs[0].frame.fields[2].values)
    value = 0;
  const auto differences = differences_from_first(runs, {"VonMises"});
  EXPECT_LT(differences[1].points, 45u);
  EXPECT_GE(differences[1].points, 20u);
  EXPECT_FALSE(differences[1].fields[0].relative);
}

TEST(PointData, EveryArrayHasItsColumnsWithUnits) {
  const TemporaryFolder folder;
  test::store_run(folder.path(), 7e-3);
  const Snapshot first = read_snapshot(folder.path(), "first"), last = read_snapshot(folder.path());
  EXPECT_EQ(first.frame.time, 0);
  EXPECT_EQ(last.frame.time, 8e-5);
  const std::string text = point_data_csv(last);
  const std::string header = text.substr(0, text.find('\n'));
  EXPECT_EQ(header,
            "reference_x_m,reference_y_m,reference_z_m,x_m,y_m,z_m,volume_m3,Displacement_x_m,"
            "Displacement_y_m,Displacement_z_m,Velocity_x_m_s,Velocity_y_m_s,Velocity_z_m_s,"
            "PlasticStrain,VonMises_Pa,Pressure_Pa,Stress_xx_Pa,Stress_yy_Pa,Stress_zz_Pa,Stress_xy_Pa,"
            "Stress_yz_Pa,Stress_xz_Pa,J");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), last.cloud.size() + 1);
  EXPECT_THROW(read_snapshot(folder.path(), "nan"), InputError);
  std::filesystem::remove(folder / "cloud.vtp");
  EXPECT_THROW(read_snapshot(folder.path()), InputError);
}

TEST(Compare, DrawsSectionsAndTellsFieldDifferences) {
  const TemporaryFolder folder;
  test::store_run(folder / "a", 7e-3);
  test::store_run(folder / "b", 7e-3);
  Sight sight;
  sight.fields = {"Velocity.z"};
  sight.sections = {section_from("-0.006,0,0.002:0.006,0,0.002")};
  const Comparison comparison =
      compare({folder / "a", folder / "b"}, folder / "out", Progress::silent(), sight);
  const auto values = [&](const std::string& name) {
    const auto found = std::find(comparison.rows.begin(), comparison.rows.end(), name);
    return found == comparison.rows.end()
               ? std::vector<std::string>{}
               : comparison.values[static_cast<std::size_t>(found - comparison.rows.begin())];
  };
  using Values = std::vector<std::string>;
  EXPECT_EQ(values("von Mises stress: difference from the first, L2 relative"), (Values{"-", "0"}));
  EXPECT_EQ(values("Velocity z: largest difference from the first (m/s)"), (Values{"-", "0"}));
  for (const char* name : {"compare_section_1.csv", "compare_section_1.png", "compare_velocity_z.png"})
    EXPECT_EQ(std::count(comparison.files.begin(), comparison.files.end(), folder / "out" / name), 1) << name;
  EXPECT_TRUE(content(folder / "out/compare_section_1.csv")
                  .starts_with("distance_m,x_m,y_m,z_m,Velocity_z_m_s a,Velocity_z_m_s b\n"));
  EXPECT_TRUE(contains(content(folder / "out/compare.csv"), "difference.plastic_strain.l2_relative,"));
  sight.sections.clear();
  compare({folder / "a", folder / "b"}, folder / "out", Progress::silent(), sight);
  EXPECT_FALSE(std::filesystem::exists(folder / "out/compare_section_1.csv")) << "of the comparison before";
  sight.sections = {section_from("0,0:0.006,0.006")};
  EXPECT_THROW(compare({folder / "a", folder / "b"}, folder / "other", Progress::silent(), sight), InputError)
      << "without z in space";
  sight.sections = {section_from("0,0,0.002:1,1,1")};
  EXPECT_THROW(compare({folder / "a", folder / "b"}, folder / "other", Progress::silent(), sight), InputError)
      << "in the body with its first point only";
  sight.sections.clear();
  sight.fields = {"Nothing"};
  EXPECT_THROW(compare({folder / "a", folder / "b"}, folder / "other", Progress::silent(), sight),
               InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "other")) << "nothing is written before all inputs are good";
}

} // namespace
} // namespace tessera::post
