/// What stored names mean to a reader: "VonMises" in Pa becomes "von Mises stress (MPa)".
#pragma once

#include <string>
#include <vector>

namespace tessera::post {

/// How a field's numbers are best told apart by colour.
enum class Palette {
  from_zero, ///< magnitudes: the scale begins at zero
  spread,    ///< the scale spans what there is
  diverging  ///< two-sided about `centre`
};

struct Quantity {
  std::string label; ///< "von Mises stress"
  std::string unit;  ///< SI: "Pa", "m", "m/s", "s", "J", ...; empty for pure numbers
  Palette palette = Palette::spread;
  double centre = 0;
};

/// Of a point array of a frame or a cloud; `name` may end in a component (".x", ".xy"). Unknown names stand
/// for themselves.
Quantity field_quantity(const std::string& name);

/// What the components of an array are called: "x" to "z", "xx" to "xz" of a symmetric tensor in ParaView's
/// order, "xx" to "zz" of a full one row by row; none for numbers and other lengths.
const std::vector<std::string>& component_names(int components);

/// The field as the name of a column, its unit the suffix: "Stress.xy" becomes "Stress_xy_Pa".
std::string field_column(const std::string& name);

/// Of a column of history.csv, whose unit is its suffix: "radius_m" is "Radius" in m, "plastic_strain" a pure
/// number.
Quantity column_quantity(const std::string& name);

/// A unit of readable size: multiply SI values by `factor`.
struct Unit {
  double factor = 1;
  std::string name;
};

/// Of the finite ones; 0 where there is none.
double largest_magnitude(const std::vector<double>& values);

/// The prefixed unit in which people give a value of this `magnitude` (SI).
Unit readable_unit(const std::string& unit, double magnitude);

/// "Radius (mm)"; the label alone for pure numbers where `pure` is empty, else "Plastic strain (-)".
std::string titled(const std::string& label, const std::string& unit, const std::string& pure = "-");

/// Four significant digits at most, without needless zeros: "6.913", "1.2e-05", "12345".
std::string figure(double value);

/// "80 µs": a value in its readable unit.
std::string with_unit(double value, const std::string& unit);

} // namespace tessera::post
