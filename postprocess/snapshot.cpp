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

namespace tessera::post {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_of(const std::vector<io::StoredField>& fields) {
  std::vector<std::string> names;
  for (const io::StoredField& field : fields)
    names.push_back(field.name);
  return names;
}

/// F of the affine map that takes these particles nearest to where they are, in the least squares.
Mat3 affine_map(const std::vector<std::int32_t>& particles, const std::vector<Vec3>& X,
                const std::vector<Vec3>& x, int dimension) {
  Vec3 mean_X = Vec3::Zero(), mean_x = Vec3::Zero();
  for (const std::int32_t b : particles) {
    mean_X += X[b] / static_cast<double>(particles.size());
    mean_x += x[b] / static_cast<double>(particles.size());
  }
  Mat3 moved = Mat3::Zero(), spread = Mat3::Zero();
  for (const std::int32_t b : particles) {
    moved += (x[b] - mean_x) * (X[b] - mean_X).transpose();
    spread += (X[b] - mean_X) * (X[b] - mean_X).transpose();
  }
  if (dimension == 2)
    moved(2, 2) = spread(2, 2) = 1;
  return moved * spread.inverse();
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

/// At a place of the undeformed body, among the particles near it where they decide, else among all; nothing
/// outside.
template <int D>
std::optional<solver::Sampling> sampled_then(const ParticleCloud& cloud, const Vec3& point,
                                             const PointGrid& grid) {
  // Where a ball holds more than 2 D particles, thrice it holds all that the nearest one's surroundings are
  // made of.
  double ball = 1.2 * cloud.spacing;
  while (ball < 10 * cloud.spacing && within(grid, point, ball).size() <= 2 * D)
    ball *= 1.3;
  try {
    const auto near = within(grid, point, 3 * ball);
    solver::Sampling sampling = solver::build_sampling<D>(point, cloud.X, cloud.V, near, cloud.hidden);
    if (sampling.support <= 3 * ball)
      return sampling;
  } catch (const InputError&) { // nobody near, or hidden
  }
  try {
    return solver::build_sampling<D>(point, cloud.X, cloud.V, cloud.hidden);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// At a place of the deformed body. In one that is flattened or drawn out particles lie far closer in one
/// direction than in another, so that distances are taken after the deformation about the particle nearest to
/// the point is undone, and only between particles that were near to that one: what is folded onto them is
/// not theirs.
template <int D>
std::optional<solver::Sampling> sampled_now(const Snapshot& snapshot, const Vec3& point,
                                            const PointGrid& grid) {
  const ParticleCloud& cloud = snapshot.cloud;
  const std::vector<Vec3>& now = snapshot.frame.x;
  const auto nearest = std::min_element(now.begin(), now.end(), [&](const Vec3& a, const Vec3& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  });
  const Vec3& X = cloud.X[static_cast<std::size_t>(nearest - now.begin())];
  const std::optional<solver::Sampling> about = sampled_then<D>(cloud, X, grid);
  if (!about)
    return std::nullopt;
  const Mat3 F = affine_map(about->particle, cloud.X, now, D);
  if (!(F.determinant() > 0))
    return std::nullopt; // the particles lie in disorder
  const Mat3 undone = F.inverse();
  const std::vector<std::int32_t> near = within(grid, X, 4 * about->support);
  std::vector<Vec3> y(now.size(), Vec3::Zero());
  for (const std::int32_t b : near)
    y[b] = undone * (now[b] - point);
  try {
    return solver::build_sampling<D>(Vec3::Zero(), y, cloud.V, near, cloud.hidden);
  } catch (const InputError&) { // outside
    return std::nullopt;
  }
}

template <class Sampled>
std::vector<std::optional<solver::Sampling>>
each_sampled(const ParticleCloud& cloud, std::span<const Vec3> points, const Sampled& sampled) {
  const PointGrid grid(cloud.X, 2 * cloud.spacing);
  std::vector<std::optional<solver::Sampling>> out(points.size());
  for_each_uneven(static_cast<std::int64_t>(points.size()), [&](std::int64_t i) {
    const auto p = static_cast<std::size_t>(i);
    out[p] = sampled(points[p], grid);
  });
  return out;
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
  if (configuration == Configuration::reference)
    return samplings(snapshot.cloud, points);
  return each_sampled(snapshot.cloud, points, [&](const Vec3& point, const PointGrid& grid) {
    return snapshot.cloud.dimension == 3 ? sampled_now<3>(snapshot, point, grid)
                                         : sampled_now<2>(snapshot, point, grid);
  });
}

std::vector<std::optional<solver::Sampling>> samplings(const ParticleCloud& cloud,
                                                       std::span<const Vec3> points) {
  return each_sampled(cloud, points, [&](const Vec3& point, const PointGrid& grid) {
    return cloud.dimension == 3 ? sampled_then<3>(cloud, point, grid) : sampled_then<2>(cloud, point, grid);
  });
}

Eigen::VectorXd value_at(const io::StoredField& field, const solver::Sampling& point) {
  return point([&](std::int32_t b) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(field.values.data() + std::ptrdiff_t{b} * field.components,
                                             field.components);
  });
}

} // namespace tessera::post
