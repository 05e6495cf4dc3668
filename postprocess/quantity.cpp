#include "postprocess/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace tessera::post {
namespace {

/// Suffixes of history columns, longest first where one ends in another.
constexpr std::array<std::pair<std::string_view, std::string_view>, 17> suffixes{{
    {"_kgm2_s", "kg m²/s"},
    {"_kgm_s", "kg m/s"},
    {"_rad_s", "rad/s"},
    {"_m_s2", "m/s²"},
    {"_m_s", "m/s"},
    {"_J_m3", "J/m³"},
    {"_m2", "m²"},
    {"_m3", "m³"},
    {"_m", "m"},
    {"_Pa", "Pa"},
    {"_J", "J"},
    {"_N", "N"},
    {"_kg", "kg"},
    {"_rad", "rad"},
    {"_deg", "°"},
    {"_K", "K"},
    {"_s", "s"},
}};

struct Prefixed {
  double from; ///< SI magnitude from which people use it
  Unit unit;
};

/// Prefixed units from small to large. Lengths stay in mm from a tenth, stresses in MPa to ten thousand: the
/// habits of the field rather than "between 1 and 1000".
const std::vector<Prefixed>* prefixed(const std::string& unit) {
  using Units = std::vector<Prefixed>;
  static const Units length{
      {0, {1e9, "nm"}}, {1e-7, {1e6, "µm"}}, {1e-4, {1e3, "mm"}}, {0.2, {1, "m"}}, {1e4, {1e-3, "km"}}};
  static const Units time{{0, {1e9, "ns"}}, {1e-6, {1e6, "µs"}}, {1e-3, {1e3, "ms"}}, {1, {1, "s"}}};
  static const Units stress{
      {0, {1, "Pa"}}, {1e3, {1e-3, "kPa"}}, {1e6, {1e-6, "MPa"}}, {1e10, {1e-9, "GPa"}}};
  static const Units energy{{0, {1e6, "µJ"}},    {1e-3, {1e3, "mJ"}}, {1, {1, "J"}},
                            {1e3, {1e-3, "kJ"}}, {1e6, {1e-6, "MJ"}}, {1e9, {1e-9, "GJ"}}};
  static const Units density{
      {0, {1, "J/m³"}}, {1e3, {1e-3, "kJ/m³"}}, {1e6, {1e-6, "MJ/m³"}}, {1e9, {1e-9, "GJ/m³"}}};
  static const Units force{{0, {1e3, "mN"}}, {1, {1, "N"}}, {1e3, {1e-3, "kN"}}, {1e6, {1e-6, "MN"}}};
  static const Units speed{{0, {1e3, "mm/s"}}, {0.1, {1, "m/s"}}, {1e4, {1e-3, "km/s"}}};
  static const Units area{{0, {1e12, "µm²"}}, {1e-9, {1e6, "mm²"}}, {0.1, {1, "m²"}}};
  static const Units volume{{0, {1e18, "µm³"}}, {1e-12, {1e9, "mm³"}}, {1e-4, {1, "m³"}}};
  if (unit == "m")
    return &length;
  if (unit == "s")
    return &time;
  if (unit == "Pa")
    return &stress;
  if (unit == "J")
    return &energy;
  if (unit == "J/m³")
    return &density;
  if (unit == "N")
    return &force;
  if (unit == "m/s")
    return &speed;
  if (unit == "m²")
    return &area;
  if (unit == "m³")
    return &volume;
  return nullptr;
}

std::string words(std::string_view name) {
  std::string out(name);
  for (char& c : out)
    if (c == '_')
      c = ' ';
  if (!out.empty())
    out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
  return out;
}

} // namespace

Quantity field_quantity(const std::string& name) {
  const auto dot = name.rfind('.');
  if (dot != std::string::npos) {
    const std::string component = name.substr(dot + 1);
    Quantity whole = field_quantity(name.substr(0, dot));
    if (whole.label == "Speed")
      whole.label = "Velocity";
    return {whole.label + " " + component, whole.unit, Palette::diverging, 0};
  }
  if (name == "PlasticStrain")
    return {"Equivalent plastic strain", "", Palette::from_zero, 0};
  if (name == "VonMises")
    return {"von Mises stress", "Pa", Palette::from_zero, 0};
  if (name == "Pressure")
    return {"Pressure (tension positive)", "Pa", Palette::diverging, 0};
  if (name == "Stress")
    return {"Cauchy stress", "Pa", Palette::diverging, 0};
  if (name == "Velocity")
    return {"Speed", "m/s", Palette::from_zero, 0};
  if (name == "Displacement")
    return {"Displacement", "m", Palette::from_zero, 0};
  if (name == "J")
    return {"Volume ratio J", "", Palette::diverging, 1};
  if (name.starts_with("PrincipalStress"))
    return {"Principal stress " + name.substr(15), "Pa", Palette::diverging, 0};
  if (name.starts_with("PrincipalStretch"))
    return {"Principal stretch " + name.substr(16), "", Palette::diverging, 1};
  if (name == "Triaxiality")
    return {"Stress triaxiality", "", Palette::diverging, 0};
  if (name == "LodeAngle")
    return {"Lode angle", "°", Palette::spread, 0};
  if (name == "StrainEnergy")
    return {"Strain energy density", "J/m³", Palette::from_zero, 0};
  if (name == "WaveSpeed")
    return {"Wave speed", "m/s", Palette::spread, 0};
  if (name == "volume")
    return {"Subvolume", "m³", Palette::spread, 0};
  if (name == "area")
    return {"Boundary area", "m²", Palette::from_zero, 0};
  return {name, "", Palette::spread, 0};
}

const std::vector<std::string>& component_names(int components) {
  static const std::vector<std::string> none, vector{"x", "y", "z"},
      symmetric{"xx", "yy", "zz", "xy", "yz", "xz"},
      full{"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
  return components == 3 ? vector : components == 6 ? symmetric : components == 9 ? full : none;
}

std::string field_column(const std::string& name) {
  std::string column = name;
  std::replace(column.begin(), column.end(), '.', '_');
  const std::string unit = field_quantity(name).unit;
  const auto suffix =
      std::find_if(suffixes.begin(), suffixes.end(), [&](const auto& s) { return s.second == unit; });
  return suffix == suffixes.end() ? column : column + std::string(suffix->first);
}

Quantity column_quantity(const std::string& name) {
  for (const auto& [suffix, unit] : suffixes)
    if (name.size() > suffix.size() && std::string_view(name).ends_with(suffix))
      return {words(std::string_view(name).substr(0, name.size() - suffix.size())), std::string(unit)};
  return {words(name), ""};
}

Unit readable_unit(const std::string& unit, double magnitude) {
  const std::vector<Prefixed>* choices = prefixed(unit);
  if (!choices || !(magnitude > 0) || !std::isfinite(magnitude))
    return {1, unit};
  Unit best = choices->front().unit;
  for (const Prefixed& choice : *choices)
    if (magnitude >= 0.9995 * choice.from)
      best = choice.unit; // 0.9999 ms is shown as 1 ms
  return best;
}

double largest_magnitude(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values)
    if (std::isfinite(value))
      most = std::max(most, std::abs(value));
  return most;
}

std::string titled(const std::string& label, const std::string& unit, const std::string& pure) {
  const std::string& shown = unit.empty() ? pure : unit;
  return shown.empty() ? label : fmt::format("{} ({})", label, shown);
}

std::string figure(double value) {
  if (value == 0)
    return "0"; // not "-0"
  if (std::abs(value) >= 1000 && std::abs(value) < 1e7)
    return fmt::format("{:.0f}", value);
  return fmt::format("{:.4g}", value);
}

std::string with_unit(double value, const std::string& unit) {
  const Unit readable = readable_unit(unit, std::abs(value));
  const std::string number = figure(value * readable.factor);
  return readable.name.empty() ? number : number + (readable.name == "°" ? "" : " ") + readable.name;
}

} // namespace tessera::post
