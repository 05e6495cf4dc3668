#include "solver/scene/conditions.hpp"

#include "core/error.hpp"
#include "solver/boundary/cavity.hpp"

#include <fmt/format.h>

#include <numeric>

namespace tessera::solver {
namespace {

using Kind = BoundaryCondition::Kind;

GivenVector given(const std::vector<Expression>& values) {
  bool uniform = true;
  for (const Expression& value : values)
    uniform &= value.uniform();
  return {[values](const Vec3& X, double t) {
            Vec3 v = Vec3::Zero();
            for (std::size_t i = 0; i < values.size(); ++i)
              v[static_cast<Eigen::Index>(i)] = values[i](X, t);
            return v;
          },
          uniform};
}

std::vector<std::int32_t> particles_of(const std::string& on, const ParticleCloud& cloud) {
  if (on != "all")
    return cloud.set(on).particles;
  std::vector<std::int32_t> all(cloud.X.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

const ParticleSet& surface_of(const std::string& on, const ParticleCloud& cloud) {
  const ParticleSet& set = cloud.set(on);
  double area = 0;
  for (const Vec3& A : set.area)
    area += A.norm();
  require(area > 0, fmt::format("the set '{}' has no surface of the body", on), "boundary",
          "name a face of the geometry, or a plane that one lies in");
  return set;
}

/// Outward unit normals of a surface, one a particle of the set. A particle that is counted to a flat surface
/// without owning any of it has the surface's normal.
std::vector<Vec3> normals_of(const ParticleSet& surface) {
  Vec3 sum = Vec3::Zero();
  double total = 0;
  for (const Vec3& A : surface.area) {
    sum += A;
    total += A.norm();
  }
  const bool flat = sum.norm() > 0.999 * total;
  std::vector<Vec3> normals;
  for (std::size_t i = 0; i < surface.area.size(); ++i) {
    const double area = surface.area[i].norm();
    const bool owns = area > 1e-9 * total;
    require(
        owns || flat,
        fmt::format("particle {} of the set '{}' owns none of its surface, so that its normal is not known",
                    surface.particles[i], surface.name),
        "boundary", "name a face of the geometry instead");
    normals.push_back(flat ? sum.normalized() : Vec3(surface.area[i] / area));
  }
  return normals;
}

/// Unit vectors that span what is perpendicular to n.
template <int D>
std::vector<Vec<D>> across(const Vec3& n) {
  if constexpr (D == 2) {
    return {Vec<2>(-n[1], n[0])};
  } else {
    const Vec3 one = n.unitOrthogonal();
    return {one, n.cross(one)};
  }
}

template <int D>
VelocityCondition<D> velocity_condition(const BoundaryCondition& c, const ParticleCloud& cloud) {
  VelocityCondition<D> condition;
  condition.support = c.on;
  if (c.kind == Kind::velocity)
    condition.velocity = given(c.values);
  if (c.kind == Kind::fixed || c.kind == Kind::velocity) {
    std::vector<Vec<D>> directions;
    for (int i = 0; i < D; ++i)
      if (c.component[static_cast<std::size_t>(i)])
        directions.push_back(Vec<D>::Unit(i));
    for (std::int32_t a : particles_of(c.on, cloud))
      condition.held.push_back({a, directions});
    return condition;
  }
  const ParticleSet& surface = surface_of(c.on, cloud);
  const std::vector<Vec3> normals = normals_of(surface);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec<D> n = normals[i].head<D>();
    condition.held.push_back(
        {surface.particles[i], c.kind == Kind::sliding ? std::vector<Vec<D>>{n} : across<D>(normals[i])});
  }
  return condition;
}

template <int D>
std::unique_ptr<Load<D>> load(const BoundaryCondition& c, const ParticleCloud& cloud) {
  if (c.kind == Kind::body_force)
    return std::make_unique<BodyForce<D>>(particles_of(c.on, cloud), given(c.values));
  const ParticleSet& surface = surface_of(c.on, cloud);
  if (c.kind == Kind::pressure)
    return std::make_unique<FollowingPressure<D>>(surface.particles, surface.area, given(c.values));
  std::vector<double> area;
  for (const Vec3& A : surface.area)
    area.push_back(A.norm());
  return std::make_unique<Traction<D>>(surface.particles, std::move(area), given(c.values));
}

template <int D>
std::vector<Wall<D>> contact_walls(const SceneSpec& scene, const ParticleCloud& cloud, double modulus,
                                   double smallest) {
  std::vector<Wall<D>> walls;
  for (const WallSpec& spec : scene.walls) {
    const auto shape = on_the_bodys_side(spec.shape, cloud.X);
    for (std::size_t a = 0; a < cloud.X.size(); ++a)
      require(
          shape->gap(cloud.X[a]).distance > -0.5 * cloud.spacing,
          fmt::format("the body begins behind a wall: particle {} is on the far side of {}", a, spec.name),
          "", "move the wall, or turn its free side to the body");
    const ContactLaw law{spec.method, spec.friction, spec.restitution,
                         spec.stiffness * modulus / (smallest * smallest)};
    walls.emplace_back(spec.name, shape, law, spec.velocity.head<D>(), cloud.X.size());
  }
  return walls;
}

} // namespace

template <int D>
Conditions<D> make_conditions(const SceneSpec& scene, const ParticleCloud& cloud, double modulus,
                              double smallest) {
  Conditions<D> conditions;
  std::vector<VelocityCondition<D>> held;
  for (const BoundaryCondition& c : scene.boundary)
    if (c.kind == Kind::traction || c.kind == Kind::pressure || c.kind == Kind::body_force)
      conditions.loads.push_back(load<D>(c, cloud));
    else
      held.push_back(velocity_condition<D>(c, cloud));
  conditions.held = HeldVelocities<D>(held, cloud.X);
  conditions.walls = contact_walls<D>(scene, cloud, modulus, smallest);
  if (!conditions.loads.empty())
    conditions.X = cloud.X;
  return conditions;
}

template <int D>
std::vector<Vec<D>> initial_momenta(const SceneSpec& scene, const ParticleCloud& cloud) {
  std::vector<Vec<D>> p(cloud.X.size(), Vec<D>::Zero());
  for (const InitialCondition& initial : scene.initial)
    if (initial.velocity)
      for (std::int32_t a : particles_of(initial.on, cloud))
        for (int c = 0; c < D; ++c)
          p[a][c] = scene.material.density * (*initial.velocity)[c](cloud.X[a]);
  return p;
}

template <int D>
std::vector<Vec<D>> initial_positions(const SceneSpec& scene, const ParticleCloud& cloud) {
  std::vector<Vec<D>> x;
  for (const InitialCondition& initial : scene.initial) {
    if (!initial.displacement)
      continue;
    if (x.empty())
      for (const Vec3& X : cloud.X)
        x.push_back(X.head<D>());
    for (std::int32_t a : particles_of(initial.on, cloud))
      for (int c = 0; c < D; ++c)
        x[a][c] = cloud.X[a][c] + (*initial.displacement)[c](cloud.X[a]);
  }
  return x;
}

template <int D>
std::vector<Mat<D>> initial_gradients(const SceneSpec& scene, const ParticleCloud& cloud) {
  const InitialCondition* last = nullptr;
  for (const InitialCondition& initial : scene.initial)
    if (initial.displacement)
      last = &initial;
  if (!last || last->on != "all" || scene.scheme == "thesis")
    return {};
  // Differences of sixth order: truncation and rounding are both far below the operators' errors.
  const double h = 1e-2 * cloud.spacing;
  constexpr double weight[] = {3. / 4, -3. / 20, 1. / 60};
  std::vector<Mat<D>> gradients(cloud.X.size(), Mat<D>::Identity());
  try {
    for (std::size_t a = 0; a < gradients.size(); ++a)
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
          for (int k = 1; k <= 3; ++k) {
            const Vec3 away = k * h * Vec3::Unit(j);
            const Expression& u = (*last->displacement)[i];
            gradients[a](i, j) += weight[k - 1] / h * (u(cloud.X[a] + away) - u(cloud.X[a] - away));
          }
  } catch (const InputError&) {
    return {}; // a formula need not mean anything beside the body
  }
  return gradients;
}

template Conditions<2> make_conditions<2>(const SceneSpec&, const ParticleCloud&, double, double);
template Conditions<3> make_conditions<3>(const SceneSpec&, const ParticleCloud&, double, double);
template std::vector<Vec<2>> initial_momenta<2>(const SceneSpec&, const ParticleCloud&);
template std::vector<Vec<3>> initial_momenta<3>(const SceneSpec&, const ParticleCloud&);
template std::vector<Vec<2>> initial_positions<2>(const SceneSpec&, const ParticleCloud&);
template std::vector<Vec<3>> initial_positions<3>(const SceneSpec&, const ParticleCloud&);
template std::vector<Mat<2>> initial_gradients<2>(const SceneSpec&, const ParticleCloud&);
template std::vector<Mat<3>> initial_gradients<3>(const SceneSpec&, const ParticleCloud&);

} // namespace tessera::solver
