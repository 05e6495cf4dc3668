#include "postprocess/quantity.hpp"

#include <gtest/gtest.h>

namespace tessera::post {
namespace {

TEST(Quantity, ColumnsCarryTheirUnitsAsSuffixes) {
  const std::pair<const char*, std::pair<const char*, const char*>> cases[] = {
      {"radius_m", {"Radius", "m"}},
      {"time_s", {"Time", "s"}},
      {"tip_speed_m_s", {"Tip speed", "m/s"}},
      {"kinetic_J", {"Kinetic", "J"}},
      {"angular_momentum_x_kgm2_s", {"Angular momentum x", "kg m²/s"}},
      {"foot_Pa", {"Foot", "Pa"}},
      {"plastic_strain", {"Plastic strain", ""}},
      {"_m", {" m", ""}},
  };
  for (const auto& [column, expected] : cases) {
    EXPECT_EQ(column_quantity(column).label, expected.first) << column;
    EXPECT_EQ(column_quantity(column).unit, expected.second) << column;
  }
}

TEST(Quantity, UnitsAreThoseOfTheField) {
  EXPECT_EQ(with_unit(8e-5, "s"), "80 µs");
  EXPECT_EQ(with_unit(0.05, "s"), "50 ms");
  EXPECT_EQ(with_unit(0.9999999, "s"), "1 s");
  EXPECT_EQ(with_unit(6.98e-3, "m"), "6.98 mm");
  EXPECT_EQ(with_unit(3.2e-4, "m"), "0.32 mm");
  EXPECT_EQ(with_unit(6, "m"), "6 m");
  EXPECT_EQ(with_unit(4e8, "Pa"), "400 MPa");
  EXPECT_EQ(with_unit(-3.2e9, "Pa"), "-3200 MPa");
  EXPECT_EQ(with_unit(117e9, "Pa"), "117 GPa");
  EXPECT_EQ(with_unit(2.6e-10, "m³"), "0.26 mm³");
  EXPECT_EQ(with_unit(0, "Pa"), "0 Pa");
  EXPECT_EQ(with_unit(1.25, ""), "1.25");
  EXPECT_EQ(with_unit(45, "°"), "45°");
}

TEST(Quantity, FiguresHaveNoNeedlessDigits) {
  EXPECT_EQ(figure(-0.0), "0");
  EXPECT_EQ(figure(6.9134567), "6.913");
  EXPECT_EQ(figure(12345.678), "12346");
  EXPECT_EQ(figure(2.5e-6), "2.5e-06");
}

TEST(Quantity, FieldsAreNamedInWords) {
  EXPECT_EQ(titled(field_quantity("VonMises").label, "MPa"), "von Mises stress (MPa)");
  EXPECT_EQ(titled(field_quantity("PlasticStrain").label, ""), "Equivalent plastic strain (-)");
  EXPECT_EQ(field_quantity("Velocity.z").label, "Velocity z");
  EXPECT_EQ(field_quantity("Stress.xy").unit, "Pa");
  EXPECT_EQ(field_quantity("Temperature").label, "Temperature");
}

TEST(Quantity, FieldsAsColumnsEndInTheirUnit) {
  EXPECT_EQ(field_column("Stress.xy"), "Stress_xy_Pa");
  EXPECT_EQ(field_column("Velocity.x"), "Velocity_x_m_s");
  EXPECT_EQ(field_column("StrainEnergy"), "StrainEnergy_J_m3");
  EXPECT_EQ(field_column("LodeAngle"), "LodeAngle_deg");
  EXPECT_EQ(field_column("PlasticStrain"), "PlasticStrain");
  EXPECT_EQ(column_quantity("StrainEnergy_J_m3").unit, "J/m³");
}

TEST(Quantity, ComponentsHaveParaViewsOrder) {
  EXPECT_EQ(component_names(3), (std::vector<std::string>{"x", "y", "z"}));
  EXPECT_EQ(component_names(6)[4], "yz");
  EXPECT_EQ(component_names(9)[3], "yx");
  EXPECT_TRUE(component_names(1).empty());
}

} // namespace
} // namespace tessera::post
