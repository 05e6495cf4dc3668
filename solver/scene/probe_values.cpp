#include "solver/scene/probe_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace tessera::solver {
namespace {

struct Quantity {
  const char* name;
  const char* unit; ///< as a suffix of the column's name
  double (*value)(const ProbeState& state,
                  const Vec3& from_axis); ///< from_axis: current position less centre
};

constexpr double degrees = 180 / std::numbers::pi;

constexpr std::array<Quantity, 15> quantities = {{
    {"x", "_m", [](const ProbeState& s, const Vec3&) { return s.X[0] + s.displacement[0]; }},
    {"y", "_m", [](const ProbeState& s, const Vec3&) { return s.X[1] + s.displacement[1]; }},
    {"z", "_m", [](const ProbeState& s, const Vec3&) { return s.X[2] + s.displacement[2]; }},
    {"radius", "_m", [](const ProbeState&, const Vec3& r) { return std::hypot(r[0], r[1]); }},
    {"angle", "_deg", [](const ProbeState&, const Vec3& r) { return degrees * std::atan2(r[1], r[0]); }},
    {"ux", "_m", [](const ProbeState& s, const Vec3&) { return s.displacement[0]; }},
    {"uy", "_m", [](const ProbeState& s, const Vec3&) { return s.displacement[1]; }},
    {"uz", "_m", [](const ProbeState& s, const Vec3&) { return s.displacement[2]; }},
    {"vx", "_m_s", [](const ProbeState& s, const Vec3&) { return s.velocity[0]; }},
    {"vy", "_m_s", [](const ProbeState& s, const Vec3&) { return s.velocity[1]; }},
    {"vz", "_m_s", [](const ProbeState& s, const Vec3&) { return s.velocity[2]; }},
    {"plastic_strain", "", [](const ProbeState& s, const Vec3&) { return s.plastic_strain; }},
    {"von_mises", "_Pa", [](const ProbeState& s, const Vec3&) { return s.von_mises; }},
    {"pressure", "_Pa", [](const ProbeState& s, const Vec3&) { return s.pressure; }},
    {"J", "", [](const ProbeState& s, const Vec3&) { return s.J; }},
}};

std::size_t index_of(const std::string& name) {
  const auto& names = probe_quantities();
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

Vec3 vector_of(std::span<const double> values, std::int32_t a) {
  return {values[3 * a], values[3 * a + 1], values[3 * a + 2]};
}

ProbeState state_of(const ProbeFields& f, std::int32_t a) {
  return {f.X[a],
          vector_of(f.displacement, a),
          vector_of(f.velocity, a),
          f.plastic_strain[a],
          f.von_mises[a],
          f.pressure[a],
          f.J[a]};
}

ProbeState state_at(const ProbeFields& f, const Sampling& point) {
  const auto number = [&](std::span<const double> values) {
    return point([&](std::int32_t b) { return values[b]; });
  };
  const auto vector = [&](std::span<const double> values) {
    return point([&](std::int32_t b) { return vector_of(values, b); });
  };
  return {point([&](std::int32_t b) { return f.X[b]; }),
          vector(f.displacement),
          vector(f.velocity),
          number(f.plastic_strain),
          number(f.von_mises),
          number(f.pressure),
          number(f.J)};
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
    : quantity_(index_of(probe.quantity)), reduce_(probe.reduce), centre_(probe.centre) {
  if (probe.at) {
    point_ = cloud.dimension == 3 ? build_sampling<3>(*probe.at, cloud.X, cloud.V, cloud.hidden)
                                  : build_sampling<2>(*probe.at, cloud.X, cloud.V, cloud.hidden);
  } else if (probe.on == "all") {
    particles_.resize(static_cast<std::size_t>(cloud.size()));
    std::iota(particles_.begin(), particles_.end(), 0);
  } else {
    particles_ = cloud.set(probe.on).particles;
  }
  if (probe.quantity == "angle")
    turned_.assign(point_ ? 1 : particles_.size(), 0.0);
}

double ProbeReader::value(std::size_t i, const ProbeState& state) {
  const Quantity& quantity = quantities[quantity_];
  const Vec3 from_axis = state.X + state.displacement - centre_;
  if (turned_.empty())
    return quantity.value(state, from_axis);
  // Nearer to the last reading than half a turn.
  const double now = quantity.value(state, from_axis) - quantity.value(state, state.X - centre_);
  turned_[i] = now - 360 * std::round((now - turned_[i]) / 360);
  return turned_[i];
}

double ProbeReader::read(const ProbeFields& fields) {
  if (point_)
    return value(0, state_at(fields, *point_));
  double low = std::numeric_limits<double>::infinity(), high = -low, total = 0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const double one = value(i, state_of(fields, particles_[i]));
    low = std::min(low, one);
    high = std::max(high, one);
    total += one;
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
