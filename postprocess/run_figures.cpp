#include "postprocess/run_figures.hpp"

#include "core/error.hpp"
#include "postprocess/quantity.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace tessera::post {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

struct Known {
  const char* key;
  const char* label;
  const char* unit;
};

constexpr Known summary_keys[] = {
    {"title", "Title", ""},
    {"case", "Case", ""},
    {"version", "Program version", ""},
    {"formulation", "Formulation", ""},
    {"scheme", "Scheme", ""},
    {"dissipation", "Dissipation", ""},
    {"arrangement", "Arrangement", ""},
    {"subvolumes", "Subvolumes", ""},
    {"seed", "Seed", ""},
    {"particles", "Particles", ""},
    {"neighbours_mean", "Neighbours, mean", ""},
    {"spacing", "Spacing", "m"},
    {"support", "Largest kernel radius", "m"},
    {"time", "End time", "s"},
    {"steps", "Steps", ""},
    {"dt_min", "Smallest time step", "s"},
    {"dt_max", "Largest time step", "s"},
    {"wall_seconds", "Wall time", "s"},
    {"us_per_particle_step", "Cost per particle and step (µs)", ""},
    {"cpu_seconds", "Processor time of the steps", "s"},
    {"setup_seconds", "Processor time of the set-up", "s"},
    {"peak_bytes", "Largest memory of the program (bytes)", ""},
    {"threads", "Threads", ""},
    {"bytes_per_particle", "Memory per particle (bytes)", ""},
    {"max.equivalent_plastic_strain", "Largest equivalent plastic strain", ""},
    {"max.von_mises", "Largest von Mises stress", "Pa"},
    {"max.pressure", "Largest pressure (tension positive)", "Pa"},
    {"min.pressure", "Smallest pressure (compression negative)", "Pa"},
    {"max.displacement", "Largest displacement", "m"},
    {"min.jacobian", "Smallest J", ""},
    {"energy.kinetic", "Kinetic energy", "J"},
    {"energy.internal", "Internal energy", "J"},
    {"energy.plastic", "Plastic work", "J"},
    {"energy.dissipated", "Energy dissipated by the scheme", "J"},
    {"energy.external", "External work", "J"},
    {"energy.balance_error", "Energy balance error, worst", ""},
    {"momentum.linear_drift", "Change of the linear momentum, relative", ""},
    {"momentum.angular_drift", "Change of the angular momentum, relative", ""},
    {"error.l1_displacement", "Displacement error, L1", "m"},
    {"error.l2_displacement", "Displacement error, L2", ""},
    {"error.l2_displacement_relative", "Displacement error, L2 relative", ""},
    {"error.l1_velocity", "Velocity error, L1", "m/s"},
    {"error.l2_velocity", "Velocity error, L2", ""},
    {"error.l2_velocity_relative", "Velocity error, L2 relative", ""},
    {"error.l2_velocity_thesis", "Velocity error, L2 over the subvolumes' sum", ""},
    {"error.l1_pressure", "Pressure error, L1", "Pa"},
    {"error.l2_pressure", "Pressure error, L2", ""},
    {"error.l2_pressure_relative", "Pressure error, L2 relative", ""},
};

constexpr Known quality_keys[] = {
    {"particles", "Particles", ""},
    {"spacing_mean", "Mean distance of nearest neighbours", "m"},
    {"spacing_min", "Smallest distance", "m"},
    {"spacing_ratio", "Smallest distance over the mean", ""},
    {"spacing_min_over_h", "Smallest distance over the h that merging used", ""},
    {"volume_min", "Smallest subvolume over the mean", ""},
    {"volume_max", "Largest subvolume over the mean", ""},
    {"volume_sum", "Sum of the subvolumes", "m³"},
    {"domain_volume", "Volume of the tessellated body", "m³"},
    {"volume_error", "Sum against the tessellated body, relative", ""},
    {"cad_volume", "Volume of the CAD body", "m³"},
    {"cad_error", "Tessellated body against the CAD body, relative", ""},
    {"closure_error", "Closure of the cells, worst", ""},
    {"first_moment_error", "Error of the first moment", ""},
    {"area_sum", "Open part of the boundary before it is balanced", ""},
    {"area_correction", "Share of the boundary areas changed to balance them", ""},
    {"area_imbalance", "Imbalance of the boundary areas left", ""},
    {"corners", "Corners of the body", ""},
    {"corner_particles", "Particles on them", ""},
    {"hidden_pairs", "Near pairs that do not see each other", ""},
    {"inserted_particles", "Particles inserted beside slots", ""},
    {"disconnected_cells", "Cells in several pieces", ""},
    {"stranded_volume", "Volume left on the far side of a gap, over all", ""},
};

json read(const fs::path& file) {
  std::ifstream in(file);
  json root = json::parse(in, nullptr, false);
  require(!root.is_discarded() && root.is_object(), "the file is damaged", file.string(),
          "run the case again");
  return root;
}

/// The value at "a.b"; nullptr where there is none.
const json* at(const json& root, const std::string& key) {
  const auto dot = key.find('.');
  const auto found = root.find(key.substr(0, dot));
  if (found == root.end())
    return nullptr;
  if (dot == std::string::npos)
    return &*found;
  return found->is_object() ? at(*found, key.substr(dot + 1)) : nullptr;
}

void add(std::vector<Figure>& figures, const std::string& key, const std::string& label,
         const std::string& unit, const json* value) {
  if (!value)
    return;
  if (value->is_string())
    figures.push_back({key, label, unit, value->get<std::string>(), std::nullopt});
  if (value->is_number())
    figures.push_back({key, label, unit, value->dump(), value->get<double>()});
}

/// What the last positions span: the deformed body's size.
void add_extent(std::vector<Figure>& figures, const json& root) {
  const json *low = at(root, "extent_min"), *high = at(root, "extent_max");
  if (!low || !high || low->size() != 3 || high->size() != 3)
    return;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!(*low)[c].is_number() || !(*high)[c].is_number())
      continue;
    const double size = (*high)[c].get<double>() - (*low)[c].get<double>();
    const std::string axis(1, static_cast<char>('x' + c));
    if (c == 2 && size == 0)
      continue; // plane strain
    figures.push_back({"extent." + axis, "Size along " + axis, "m", fmt::format("{}", size), size});
  }
}

} // namespace

std::vector<Figure> summary_figures(const fs::path& folder) {
  const fs::path file = folder / "summary.json";
  require(fs::exists(file), "no finished run is stored here", folder.string(),
          fmt::format("run the case first: tessera run CASE.toml -o {}", folder.string()));
  const json root = read(file);
  std::vector<Figure> figures;
  for (const Known& known : summary_keys) {
    add(figures, known.key, known.label, known.unit, at(root, known.key));
    if (std::string_view(known.key) != "min.jacobian")
      continue;
    // After the extremes: what the case itself asked for.
    add_extent(figures, root);
    const json* probes = at(root, "probes");
    if (!probes || !probes->is_object())
      continue;
    for (const auto& [name, value] : probes->items()) {
      const Quantity quantity = column_quantity(name);
      add(figures, "probes." + name, quantity.label, quantity.unit, &value);
    }
  }
  return figures;
}

std::vector<Figure> quality_figures(const fs::path& folder) {
  const fs::path file = folder / "quality.json";
  std::vector<Figure> figures;
  if (!fs::exists(file))
    return figures;
  json root = read(file);
  const auto number = [&](const char* key) {
    const json* value = at(root, key);
    return value && value->is_number() ? value->get<double>() : 0.0;
  };
  if (const double cad = number("cad_volume"); cad > 0)
    root["cad_error"] = std::abs(number("domain_volume") - cad) / cad;
  const bool plane = number("dimension") == 2; // volumes are areas then
  for (const Known& known : quality_keys) {
    std::string label = known.label;
    if (plane && label.starts_with("Volume of"))
      label.replace(0, 6, "Area");
    const bool area = plane && std::string_view(known.unit) == "m³";
    add(figures, known.key, label, area ? "m²" : known.unit, at(root, known.key));
  }
  const json* sets = at(root, "sets");
  if (sets && sets->is_object())
    for (const auto& [name, count] : sets->items())
      add(figures, "sets." + name, fmt::format("Particles in set '{}'", name), "", &count);
  return figures;
}

const Figure* find_figure(const std::vector<Figure>& figures, const std::string& key) {
  const auto found =
      std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return f.key == key; });
  return found == figures.end() ? nullptr : &*found;
}

std::string shown(const Figure& figure, double factor) {
  const bool whole = figure.text.find_first_not_of("-0123456789") == std::string::npos;
  if (!figure.value || (whole && factor == 1))
    return figure.text;
  const double value = *figure.value * factor;
  if (std::abs(value) >= 1e4 && std::abs(value) < 1e7)
    return fmt::format("{:.0f}", value);
  return fmt::format("{:.5g}", value);
}

} // namespace tessera::post
