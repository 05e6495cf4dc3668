#include "postprocess/snapshot.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/point_grid.hpp"
#include "io/cloud_file.hpp"
#include "postprocess/quantity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

namespace tessera::post {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_of(const std::vector<io::StoredField>& fields) {
  std::vector<std::string> names;
  for (const io::StoredField& field : fields)
    names.push_back(field.name);
  return names;
}

io::StoredField component(const io::StoredField& whole, const std::string& name, std::size_t c) {
  io::StoredField field{name, 1, {}};
  for (std::size_t i = c; i < whole.values.size(); i += static_cast<std::size_t>(whole.components))
    field.values.push_back(whole.values[i]);
  return field;
}

/// Particles within `radius` of a point, ascending.
std::vector<std::int32_t> within(const PointGrid& grid, const Vec3& point, double radius) {
  std::vector<std::int32_t> found;
  grid.near(point, radius, [&](std::int32_t b, double distance) {
    if (distance <= radius)
      found.push_back(b);
  });
  std::sort(found.begin(), found.end());
  return found;
}

/// Among the particles near the point where they decide, else among all; empty outside the body.
template <int D>
std::optional<solver::Sampling> sampling_at(const Vec3& point, std::span<const Vec3> x,
                                            const ParticleCloud& cloud, const PointGrid& grid, double pitch) {
  // Where a ball holds more than 2 D particles, thrice it holds all that the nearest one's surroundings are
  // made of.
  double ball = 1.2 * pitch;
  while (ball < 10 * pitch && within(grid, point, ball).size() <= 2 * D)
    ball *= 1.3;
  try {
    const auto near = within(grid, point, 3 * ball);
    solver::Sampling sampling = solver::build_sampling<D>(point, x, cloud.V, near, cloud.hidden);
    if (sampling.support <= 3 * ball)
      return sampling;
  } catch (const InputError&) { // nobody near, or hidden
  }
  try {
    return solver::build_sampling<D>(point, x, cloud.V, cloud.hidden);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

} // namespace

const io::StoredFrame& chosen_frame(const std::vector<io::StoredFrame>& frames, const std::string& which) {
  if (which == "last")
    return frames.back();
  if (which == "first")
    return frames.front();
  double time = 0;
  const char* end = which.data() + which.size();
  const auto [stop, error] = std::from_chars(which.data(), end, time);
  require(error == std::errc() && stop == end && std::isfinite(time),
          fmt::format("'{}' names no frame", which), "", "last, first or a time in seconds do");
  const io::StoredFrame* nearest = &frames.front();
  for (const io::StoredFrame& frame : frames)
    if (std::abs(frame.time - time) < std::abs(nearest->time - time))
      nearest = &frame;
  return *nearest;
}

Snapshot read_snapshot(const fs::path& folder, const std::string& which) {
  const std::vector<io::StoredFrame> frames = io::read_series(folder);
  const fs::path file = chosen_frame(frames, which).file;
  Snapshot snapshot{file, io::read_frame(file), io::read_cloud(folder / "cloud.vtp")};
  require(snapshot.frame.x.size() == snapshot.cloud.X.size(),
          fmt::format("the frame has {} particles, the folder's cloud.vtp {}", snapshot.frame.x.size(),
                      snapshot.cloud.X.size()),
          file.string(), "run the case again");
  return snapshot;
}

io::StoredField field_of(const Snapshot& snapshot, const std::string& name) {
  const auto dot = name.rfind('.');
  const std::string whole = name.substr(0, dot);
  const auto& fields = snapshot.frame.fields;
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const io::StoredField& field) { return field.name == whole; });
  const std::vector<std::string> there = names_of(fields);
  const std::string nearest = nearest_name(whole, there);
  require(found != fields.end(), fmt::format("no field '{}'", whole), snapshot.file.string(),
          fmt::format("{}it has: {}", nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest),
                      fmt::join(there, ", ")));
  if (dot == std::string::npos && (found->components == 1 || found->components == 3))
    return *found;
  const auto& parts = component_names(found->components);
  const auto part =
      dot == std::string::npos ? parts.end() : std::find(parts.begin(), parts.end(), name.substr(dot + 1));
  require(part != parts.end(), fmt::format("field '{}' is neither a number nor a vector", name),
          snapshot.file.string(),
          parts.empty() ? fmt::format("'{}' has no components", whole)
                        : fmt::format("name a component: {}.{}", whole, fmt::join(parts, ", .")));
  return component(*found, name, static_cast<std::size_t>(part - parts.begin()));
}

std::vector<std::optional<solver::Sampling>> samplings(const Snapshot& snapshot, std::span<const Vec3> points,
                                                       Configuration configuration) {
  return samplings(snapshot.cloud,
                   configuration == Configuration::reference ? snapshot.cloud.X : snapshot.frame.x, points);
}

std::vector<std::optional<solver::Sampling>> samplings(const ParticleCloud& cloud, std::span<const Vec3> x,
                                                       std::span<const Vec3> points) {
  const double volume = std::accumulate(cloud.V.begin(), cloud.V.end(), 0.0);
  const double pitch = std::pow(volume / static_cast<double>(x.size()), 1.0 / cloud.dimension);
  const PointGrid grid(x, 2 * pitch);
  std::vector<std::optional<solver::Sampling>> out(points.size());
  for_each_uneven(static_cast<std::int64_t>(points.size()), [&](std::int64_t i) {
    const auto p = static_cast<std::size_t>(i);
    out[p] = cloud.dimension == 3 ? sampling_at<3>(points[p], x, cloud, grid, pitch)
                                  : sampling_at<2>(points[p], x, cloud, grid, pitch);
  });
  return out;
}

Eigen::VectorXd value_at(const io::StoredField& field, const solver::Sampling& point) {
  return point([&](std::int32_t b) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(field.values.data() + std::ptrdiff_t{b} * field.components,
                                             field.components);
  });
}

} // namespace tessera::post
