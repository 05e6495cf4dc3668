/// A body as people look at it: frames, energies, momenta, extremes.
#pragma once

#include "core/frame.hpp"
#include "core/parallel.hpp"
#include "solver/physics/body.hpp"
#include "solver/physics/derived_fields.hpp"
#include "solver/physics/stress_measures.hpp"
#include "solver/scene/probe_values.hpp"
#include "solver/scene/scene.hpp"
#include "solver/time/step.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace tessera::solver {

/// Arrays of a frame, kept from one to the next; three components in plane strain too.
class FrameArrays {
 public:
  /// `derived`: names of derived_fields() that frames hold beside the usual ones.
  explicit FrameArrays(const std::vector<std::string>& derived) {
    for (const std::string& name : derived)
      derived_.push_back({find_derived_field(name), {}});
  }

  template <class Body>
  void fill(const Body& body, const ParticleCloud& cloud) {
    constexpr int D = Body::dimension;
    const auto n = static_cast<std::size_t>(body.size());
    for (auto* vector : {&displacement_, &velocity_})
      vector->assign(3 * n, 0.0);
    for (auto* scalar : {&pressure_, &von_mises_, &plastic_strain_, &jacobian_, &id_})
      scalar->resize(n);
    stress_.resize(6 * n);
    for_each(body.size(), [&](std::int64_t a) {
      for (int c = 0; c < D; ++c) {
        displacement_[3 * a + c] = body.U.x[a][c] - cloud.X[a][c];
        velocity_[3 * a + c] = body.velocity(a)[c];
      }
      // The law is asked again for all nine components: in plane strain the body keeps only those of the
      // plane.
      const Strain strain = body.strain(a);
      const Mat3 sigma = cauchy(body.material->piola(strain, a), strain.F, strain.J);
      pressure_[a] = tessera::solver::pressure(sigma);
      von_mises_[a] = tessera::solver::von_mises(sigma);
      plastic_strain_[a] = body.material->equivalent_plastic_strain(a);
      jacobian_[a] = strain.J;
      id_[a] = static_cast<double>(a);
      const double components[6] = {sigma(0, 0), sigma(1, 1), sigma(2, 2),
                                    sigma(0, 1), sigma(1, 2), sigma(0, 2)};
      std::copy(components, components + 6, stress_.begin() + 6 * a);
    });
  }

  /// The derived fields, which nothing but frames wants.
  template <class Body>
  void derive(const Body& body) {
    for (Derived& derived : derived_) {
      const DerivedField& field = *derived.field;
      derived.values.resize(static_cast<std::size_t>(field.components * body.size()));
      for_each(body.size(), [&](std::int64_t a) {
        const Strain strain = body.strain(a);
        const Mat3 sigma = cauchy(body.material->piola(strain, a), strain.F, strain.J);
        field.compute({strain.F, sigma, body.material->energy(strain, a), body.wave[a]},
                      derived.values.data() + field.components * a);
      });
    }
  }

  Frame frame(double time, std::int64_t step, const ParticleCloud& cloud) const {
    Frame frame{time,
                step,
                cloud.X,
                {{"Displacement", 3, displacement_},
                 {"Velocity", 3, velocity_},
                 {"Pressure", 1, pressure_},
                 {"VonMises", 1, von_mises_},
                 {"PlasticStrain", 1, plastic_strain_},
                 {"Stress", 6, stress_},
                 {"J", 1, jacobian_},
                 {"id", 1, id_}}};
    for (const Derived& derived : derived_)
      frame.fields.push_back({std::string(derived.field->name), derived.field->components, derived.values});
    return frame;
  }

  ProbeFields probe_fields(const ParticleCloud& cloud) const {
    return {cloud.X, displacement_, velocity_, plastic_strain_, von_mises_, pressure_, jacobian_};
  }

  /// Widens the largest and smallest values seen so far to these fields.
  void widen(Extremes& extremes) const {
    const auto largest = [](double so_far, const std::vector<double>& values) {
      return std::max(so_far, *std::max_element(values.begin(), values.end()));
    };
    extremes.equivalent_plastic_strain = largest(extremes.equivalent_plastic_strain, plastic_strain_);
    extremes.von_mises = largest(extremes.von_mises, von_mises_);
    extremes.pressure = largest(extremes.pressure, pressure_);
    const auto smallest = [](double so_far, const std::vector<double>& values) {
      return std::min(so_far, *std::min_element(values.begin(), values.end()));
    };
    extremes.smallest_pressure = smallest(extremes.smallest_pressure, pressure_);
    extremes.jacobian = smallest(extremes.jacobian, jacobian_);
    for (std::size_t a = 0; a < jacobian_.size(); ++a)
      extremes.displacement =
          std::max(extremes.displacement,
                   std::hypot(displacement_[3 * a], displacement_[3 * a + 1], displacement_[3 * a + 2]));
  }

  /// Corners of the box around the current positions, m.
  void extent(const ParticleCloud& cloud, Vec3& lower, Vec3& upper) const {
    for (std::size_t a = 0; a < cloud.X.size(); ++a) {
      const Vec3 x =
          cloud.X[a] + Vec3(displacement_[3 * a], displacement_[3 * a + 1], displacement_[3 * a + 2]);
      lower = a == 0 ? x : Vec3(lower.cwiseMin(x));
      upper = a == 0 ? x : Vec3(upper.cwiseMax(x));
    }
  }

 private:
  struct Derived {
    const DerivedField* field;
    std::vector<double> values;
  };

  std::vector<Derived> derived_;
  std::vector<double> displacement_, velocity_, pressure_, von_mises_, plastic_strain_, stress_, jacobian_,
      id_;
};

/// Energies of the body and of the ledger. `total` is what must stay as it was: kinetic + internal + plastic
/// + dissipated - external.
template <class Body>
Energies energies(const Body& body, const Step<Body>& ledger) {
  using Sums = Eigen::Vector3d;
  const Sums sums = sum(body.size(), Sums(Sums::Zero()), [&](std::int64_t a) -> Sums {
    return body.V[a] * Sums(body.U.p[a].squaredNorm() / (2 * body.density),
                            body.material->energy(body.strain(a), a), body.material->plastic_work(a));
  });
  return {sums[0], sums[1], sums[2], ledger.dissipated(), ledger.external(), 0};
}

inline double total(const Energies& e) {
  return e.kinetic + e.internal + e.plastic + e.dissipated - e.external;
}

/// Linear momentum sum V p (kg m/s) and angular momentum sum V x cross p about the origin (kg m^2/s).
struct Momenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

template <class Body>
Momenta momenta(const Body& body) {
  using Sums = Eigen::Matrix<double, 6, 1>;
  const Sums sums = sum(body.size(), Sums(Sums::Zero()), [&](std::int64_t a) -> Sums {
    Vec3 x = Vec3::Zero(), p = Vec3::Zero();
    x.template head<Body::dimension>() = body.U.x[a];
    p.template head<Body::dimension>() = body.U.p[a];
    Sums s;
    s.template head<3>() = p;
    s.template tail<3>() = x.cross(p);
    return body.V[a] * s;
  });
  return {sums.head<3>(), sums.tail<3>()};
}

} // namespace tessera::solver
