#include "preprocess/cloud/boundary_areas.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <span>

namespace tessera::preprocess {
namespace {

using Vec4 = Eigen::Matrix<double, 4, 1>;
using Mat43 = Eigen::Matrix<double, 4, 3>; ///< row 0: of the constant; rows 1 to 3: of the coordinates

/// A particle's share of a surface while it is balanced.
struct Part {
  Vec3 at;     ///< where it acts, m
  Vec3 normal; ///< the direction it keeps; zero: any
  Vec3 area;   ///< m^2
  double weight;
};

/// Coordinates of order one about the middle of the parts, with the constant in front.
class Frame {
 public:
  Frame(int dimension, std::span<const Part> parts) : dimension_(dimension) {
    const auto n = static_cast<std::int64_t>(parts.size());
    const double total = sum(n, 0.0, [&](std::int64_t i) { return parts[i].weight; });
    middle_ = sum(n, Vec3(Vec3::Zero()),
                  [&](std::int64_t i) -> Vec3 { return parts[i].weight / total * parts[i].at; });
    const double reach = max_of(n, 0, [&](std::int64_t i) { return (parts[i].at - middle_).norm(); });
    size_ = reach > 0 ? reach : 1;
  }
  Vec4 operator()(const Vec3& X) const {
    const Vec3 x = (X - middle_) / size_;
    return {1, x[0], x[1], dimension_ == 3 ? x[2] : 0};
  }
  double size() const { return size_; }

 private:
  int dimension_;
  Vec3 middle_;
  double size_;
};

Mat43 moments(const Frame& frame, std::span<const Part> parts) {
  return sum(static_cast<std::int64_t>(parts.size()), Mat43(Mat43::Zero()),
             [&](std::int64_t i) -> Mat43 { return frame(parts[i].at) * parts[i].area.transpose(); });
}

Mat3 admissible(const Part& part) {
  return part.normal.isZero() ? Mat3(Mat3::Identity()) : Mat3(part.normal * part.normal.transpose());
}

/// The smallest change, sum |change|^2 / weight, after which the parts' moments are `wanted`, as far as they
/// can. Directions in which the parts hardly reach stay as they are. Returns the largest |change| / weight.
double correct(const Frame& frame, const Mat43& wanted, std::span<Part> parts) {
  using Vec12 = Eigen::Matrix<double, 12, 1>;
  using Mat12 = Eigen::Matrix<double, 12, 12>;
  constexpr double hardly = 1e-8;
  // Each change is weight N (c + m x), N the directions it may take: row 4 c + t of the unknowns is what
  // coordinate t has in component c.
  const auto n = static_cast<std::int64_t>(parts.size());
  const Mat12 system = sum(n, Mat12(Mat12::Zero()), [&](std::int64_t i) -> Mat12 {
    const Vec4 x = frame(parts[i].at);
    const Eigen::Matrix4d xx = parts[i].weight * x * x.transpose();
    const Mat3 N = admissible(parts[i]);
    Mat12 term;
    for (int c = 0; c < 3; ++c)
      for (int d = 0; d < 3; ++d)
        term.block<4, 4>(4 * c, 4 * d) = N(c, d) * xx;
    return term;
  });
  const Eigen::SelfAdjointEigenSolver<Mat12> modes(system);
  double largest = 0;
  for (int round = 0; round < 2; ++round) { // the second takes away what rounding left of the first
    const Mat43 lack = wanted - moments(frame, parts);
    const Vec12 share = modes.eigenvectors().transpose() * lack.reshaped();
    Vec12 scaled = Vec12::Zero();
    for (int k = 0; k < 12; ++k)
      if (modes.eigenvalues()[k] > hardly * modes.eigenvalues()[11])
        scaled[k] = share[k] / modes.eigenvalues()[k];
    const Vec12 solution = modes.eigenvectors() * scaled;
    const Mat43 factors = solution.reshaped(4, 3);
    const auto relative = [&](std::int64_t i) -> Vec3 {
      const Vec3 change = factors.transpose() * frame(parts[i].at);
      return parts[i].normal.isZero() ? change : Vec3(parts[i].normal.dot(change) * parts[i].normal);
    };
    largest += max_of(n, 0.0, [&](std::int64_t i) { return relative(i).norm(); });
    for_each(n, [&](std::int64_t i) { parts[i].area += parts[i].weight * relative(i); });
  }
  return largest;
}

/// Makes a change unless it would more than halve a part or turn it around.
void correct_gently(const Frame& frame, const Mat43& wanted, std::vector<Part>& parts) {
  std::vector<Part> changed = parts;
  if (correct(frame, wanted, changed) < 0.5)
    parts = std::move(changed);
}

/// A CAD surface as its facets have it.
struct Surface {
  std::vector<Vec3> centroid, area; ///< by facet
  Vec3 normal = Vec3::Zero();       ///< where flat
};

std::vector<Surface> surfaces_of(const Domain& domain) {
  std::vector<Surface> surfaces(domain.surfaces.size());
  for (const auto& facet : domain.facets) {
    if (facet.surface == Domain::lid)
      continue;
    const Vec3 &a = domain.vertices[facet.vertices[0]], &b = domain.vertices[facet.vertices[1]],
               &c = domain.vertices[facet.vertices[2]];
    Surface& surface = surfaces[facet.surface];
    surface.centroid.emplace_back((a + b + c) / 3);
    surface.area.emplace_back((b - a).cross(c - a) / 2);
  }
  constexpr double flat = 1e-6; // radians its facets may differ by
  for (Surface& surface : surfaces) {
    Vec3 total = Vec3::Zero();
    for (const Vec3& area : surface.area)
      total += area;
    if (domain.dimension == 2)
      total[2] = 0;
    const double norm = total.norm(); // zero around a hole
    const Vec3 normal = total / (norm > 0 ? norm : 1);
    if (std::all_of(surface.area.begin(), surface.area.end(), [&](const Vec3& area) {
          return area.dot(normal) > 0 && (area - area.dot(normal) * normal).norm() <= flat * area.norm();
        }))
      surface.normal = normal;
  }
  return surfaces;
}

/// The integrals of n and x (x) n over a surface, exactly.
Mat43 integrals(const Frame& frame, const Surface& surface) {
  Mat43 result = Mat43::Zero();
  for (std::size_t f = 0; f < surface.area.size(); ++f)
    result += frame(surface.centroid[f]) * surface.area[f].transpose();
  return result;
}

/// A share on its way through the balance.
struct Place {
  std::int32_t particle;
  std::size_t index; ///< among the particle's shares
};

/// The parts of one surface, in its plane where it is flat.
std::vector<Part> parts_of(const Surface& surface, const std::vector<Place>& places,
                           const std::vector<Vec3>& X, const Shares& shares) {
  std::vector<Part> parts;
  for (const Place& place : places) {
    Part part{X[place.particle], surface.normal, shares[place.particle][place.index].area, 0};
    if (!surface.normal.isZero()) {
      part.area = surface.normal.dot(part.area) * surface.normal;
      part.at += surface.normal.dot(surface.centroid.front() - part.at) * surface.normal;
    }
    part.weight = part.area.norm();
    parts.push_back(part);
  }
  return parts;
}

Mat43 body_moments(const Frame& frame, int dimension, double volume) {
  Mat43 wanted = Mat43::Zero();
  for (int j = 0; j < dimension; ++j)
    wanted(1 + j, j) = volume / frame.size();
  return wanted;
}

} // namespace

double balance_areas(const Domain& domain, ParticleCloud& cloud, Shares& shares) {
  const std::vector<Surface> surfaces = surfaces_of(domain);
  std::vector<std::vector<Place>> places(surfaces.size());
  for (std::int32_t i = 0; i < cloud.size(); ++i)
    for (std::size_t k = 0; k < shares[i].size(); ++k)
      places[shares[i][k].surface].push_back({i, k});

  std::vector<Part> all;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (places[s].empty())
      continue;
    std::vector<Part> parts = parts_of(surfaces[s], places[s], cloud.X, shares);
    const Frame frame(cloud.dimension, parts);
    correct_gently(frame, integrals(frame, surfaces[s]), parts);
    for (std::size_t k = 0; k < parts.size(); ++k)
      parts[k].at = cloud.X[places[s][k].particle];
    all.insert(all.end(), parts.begin(), parts.end());
  }

  constexpr double rounding = 1e-13, balanced = 1e-10;
  const Frame frame(cloud.dimension, all);
  const double volume = sum(cloud.size(), 0.0, [&](std::int64_t i) { return cloud.V[i]; });
  const double surface =
      sum(static_cast<std::int64_t>(all.size()), 0.0, [&](std::int64_t i) { return all[i].area.norm(); });
  const Mat43 wanted = body_moments(frame, cloud.dimension, volume);
  const auto left = [&] { return (wanted - moments(frame, all)).norm() / surface; };
  if (left() > rounding)
    correct_gently(frame, wanted, all);
  if (left() > rounding) {
    for (Part& part : all)
      part.normal.setZero();
    correct(frame, wanted, all);
  }
  require(left() < balanced, "the particles that own boundary lie in one plane", "particles",
          "choose a spacing well below the body's size");

  double change = 0;
  auto part = all.begin();
  cloud.A.assign(cloud.X.size(), Vec3::Zero());
  for (const auto& of_surface : places)
    for (const Place& place : of_surface) {
      Vec3& area = shares[place.particle][place.index].area;
      change += (part->area - area).norm();
      area = part->area;
      cloud.A[place.particle] += area;
      ++part;
    }
  return change / surface;
}

double area_imbalance(const ParticleCloud& cloud) {
  std::vector<Part> parts;
  for (std::int64_t i = 0; i < cloud.size(); ++i)
    parts.push_back({cloud.X[i], Vec3::Zero(), cloud.A[i], cloud.A[i].norm()});
  const Frame frame(cloud.dimension, parts);
  const double area = sum(cloud.size(), 0.0, [&](std::int64_t i) { return cloud.A[i].norm(); });
  const double volume = sum(cloud.size(), 0.0, [&](std::int64_t i) { return cloud.V[i]; });
  const Mat43 lack = body_moments(frame, cloud.dimension, volume) - moments(frame, parts);
  return std::max(lack.row(0).norm() / area, lack.bottomRows(3).norm() * frame.size() / volume);
}

} // namespace tessera::preprocess
