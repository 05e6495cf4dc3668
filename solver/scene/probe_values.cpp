#include "solver/scene/probe_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace tessera::solver {
namespace {

struct Quantity {
  const char* name;
  const char* unit; ///< as a suffix of the column's name
  double (*value)(const ProbeFields&, std::int32_t);
};

double position(const ProbeFields& f, std::int32_t a, int c) {
  return f.X[a][c] + f.displacement[3 * a + c];
}

constexpr std::array<Quantity, 13> quantities = {{
    {"x", "_m", [](const ProbeFields& f, std::int32_t a) { return position(f, a, 0); }},
    {"y", "_m", [](const ProbeFields& f, std::int32_t a) { return position(f, a, 1); }},
    {"z", "_m", [](const ProbeFields& f, std::int32_t a) { return position(f, a, 2); }},
    {"radius", "_m",
     [](const ProbeFields& f, std::int32_t a) { return std::hypot(position(f, a, 0), position(f, a, 1)); }},
    {"ux", "_m", [](const ProbeFields& f, std::int32_t a) { return f.displacement[3 * a]; }},
    {"uy", "_m", [](const ProbeFields& f, std::int32_t a) { return f.displacement[3 * a + 1]; }},
    {"uz", "_m", [](const ProbeFields& f, std::int32_t a) { return f.displacement[3 * a + 2]; }},
    {"vx", "_m_s", [](const ProbeFields& f, std::int32_t a) { return f.velocity[3 * a]; }},
    {"vy", "_m_s", [](const ProbeFields& f, std::int32_t a) { return f.velocity[3 * a + 1]; }},
    {"vz", "_m_s", [](const ProbeFields& f, std::int32_t a) { return f.velocity[3 * a + 2]; }},
    {"plastic_strain", "", [](const ProbeFields& f, std::int32_t a) { return f.plastic_strain[a]; }},
    {"von_mises", "_Pa", [](const ProbeFields& f, std::int32_t a) { return f.von_mises[a]; }},
    {"pressure", "_Pa", [](const ProbeFields& f, std::int32_t a) { return f.pressure[a]; }},
}};

std::size_t index_of(const std::string& name) {
  const auto& names = probe_quantities();
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

} // namespace

const std::vector<std::string>& probe_quantities() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Quantity& q : quantities)
      list.emplace_back(q.name);
    return list;
  }();
  return names;
}

const std::vector<std::string>& probe_reductions() {
  static const std::vector<std::string> names = {"max", "min", "mean", "extent"};
  return names;
}

std::string column_name(const Probe& probe) {
  return probe.name + quantities.at(index_of(probe.quantity)).unit;
}

ProbeReader::ProbeReader(const Probe& probe, const ParticleCloud& cloud)
    : quantity_(index_of(probe.quantity)), reduce_(probe.reduce) {
  if (probe.on == "all") {
    particles_.resize(static_cast<std::size_t>(cloud.size()));
    std::iota(particles_.begin(), particles_.end(), 0);
  } else {
    particles_ = cloud.set(probe.on).particles;
  }
}

double ProbeReader::read(const ProbeFields& fields) const {
  double low = std::numeric_limits<double>::infinity(), high = -low, total = 0;
  for (std::int32_t a : particles_) {
    const double value = quantities[quantity_].value(fields, a);
    low = std::min(low, value);
    high = std::max(high, value);
    total += value;
  }
  if (reduce_ == "max")
    return high;
  if (reduce_ == "min")
    return low;
  if (reduce_ == "extent")
    return high - low;
  return total / static_cast<double>(particles_.size());
}

} // namespace tessera::solver
