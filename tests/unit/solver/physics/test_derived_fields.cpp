#include "solver/physics/derived_fields.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace tessera::solver {
namespace {

MaterialPoint stressed(const Mat3& sigma) {
  return {Mat3::Identity(), sigma, 0, 0};
}

double value(const std::string& name, const MaterialPoint& point) {
  const DerivedField* field = find_derived_field(name);
  EXPECT_NE(field, nullptr) << name;
  std::array<double, 9> out{};
  field->compute(point, out.data());
  return out[0];
}

Mat3 turned(const Mat3& tensor) {
  const Mat3 R = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  return R * tensor * R.transpose();
}

TEST(DerivedFields, TensionShearAndCompression) {
  struct Known {
    Vec3 principal;
    double triaxiality, lode;
  };
  for (const Known& known :
       {Known{{2e6, 0, 0}, 1.0 / 3, 0}, Known{{3e6, 0, -3e6}, 0, 30}, Known{{0, 0, -5e6}, -1.0 / 3, 60},
        Known{{7e6, 6e6, 5e6}, 6 / std::numbers::sqrt3, 30}}) {
    const MaterialPoint point = stressed(turned(known.principal.asDiagonal()));
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(value("PrincipalStress" + std::to_string(i + 1), point), known.principal[i], 1e-8);
    EXPECT_NEAR(value("Triaxiality", point), known.triaxiality, 1e-12);
    EXPECT_NEAR(value("LodeAngle", point), known.lode, 1e-6); // acos is flat at its ends
  }
}

TEST(DerivedFields, WithoutADeviatorTriaxialityAndLodeAngleAreZero) {
  for (const double p : {0.0, 4e8}) {
    EXPECT_EQ(value("Triaxiality", stressed(p * Mat3::Identity())), 0);
    EXPECT_EQ(value("LodeAngle", stressed(p * Mat3::Identity())), 0);
  }
}

TEST(DerivedFields, StretchesDoNotFeelRotationsAndFIsStoredRowByRow) {
  Mat3 F = Mat3::Zero();
  F.diagonal() << 0.5, 3, 1.2;
  MaterialPoint point{Eigen::AngleAxisd(1.1, Vec3(0, 1, 1).normalized()) * F, Mat3::Zero(), 7, 8};
  EXPECT_NEAR(value("PrincipalStretch1", point), 3, 1e-14);
  EXPECT_NEAR(value("PrincipalStretch2", point), 1.2, 1e-14);
  EXPECT_NEAR(value("PrincipalStretch3", point), 0.5, 1e-14);
  EXPECT_EQ(value("StrainEnergy", point), 7);
  EXPECT_EQ(value("WaveSpeed", point), 8);
  std::array<double, 9> rows{};
  find_derived_field("DeformationGradient")->compute(point, rows.data());
  EXPECT_EQ(rows[1], point.F(0, 1));
  EXPECT_EQ(rows[5], point.F(1, 2));
  EXPECT_EQ(find_derived_field("Nothing"), nullptr);
}

} // namespace
} // namespace tessera::solver
