/// A validated scene and the run of it: the only place where formulation and law are chosen at run time.
#pragma once

#include "core/frame.hpp"
#include "core/particle_cloud.hpp"
#include "core/progress.hpp"
#include "solver/boundary/plane.hpp"
#include "solver/boundary/wall.hpp"
#include "solver/scene/expression.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tessera::solver {

/// SI units throughout.
struct PlasticitySpec {
  double yield = 0;     ///< initial yield stress, Pa
  double hardening = 0; ///< linear isotropic hardening modulus, Pa
};

struct MaterialSpec {
  std::string law = "hencky"; ///< of the catalogue, which says which of the constants below it goes by
  double density = 0;         ///< kg/m^3
  double young = 0;           ///< Pa
  double poisson = 0;
  std::optional<PlasticitySpec> plasticity;
  double c1 = 0, c2 = 0;             ///< of mooney_rivlin, Pa
  std::vector<double> mu{}, alpha{}; ///< of ogden, one a term; Pa, -
  double bulk = 0;                   ///< of mooney_rivlin and ogden, Pa
};

/// v(X) at time zero on a set ("all": every particle); later entries overwrite earlier ones.
struct InitialVelocity {
  std::string on = "all";
  std::array<Expression, 3> velocity; ///< m/s
};

/// Velocity components held at zero on a set: clamped holds all three.
struct FixedCondition {
  std::string on;
  std::array<bool, 3> component = {true, true, true};
};

/// A rigid tool the body cannot pass. A channel is two of them.
struct WallSpec {
  std::string name = "wall";
  /// Where it is at time zero; null until the surface's file is read.
  std::shared_ptr<const RigidShape> shape = std::make_shared<Plane>();
  double friction = 0;    ///< Coulomb's coefficient
  double restitution = 0; ///< 0: normal velocity is lost on contact, 1: it is reflected
  ContactMethod method = ContactMethod::reflection;
  double stiffness = 1;         ///< of the penalty: force per volume and depth over modulus / distance^2
  Vec3 velocity = Vec3::Zero(); ///< m/s
};

/// One number of the deformed body followed in time: a column of history.csv and an entry of summary.json.
struct Probe {
  std::string name;
  std::string quantity; ///< x y z radius (current position, radius about the Z axis; m) ux uy uz (m) vx vy vz
                        ///< (m/s) plastic_strain von_mises pressure (Pa)
  std::string reduce;   ///< max, min, mean, extent (max - min) over the set
  std::string on = "all";
};

struct SceneSpec {
  MaterialSpec material;
  std::string formulation = "auto"; ///< auto, pF
  std::string scheme = "thesis";    ///< thesis
  std::string kernel = "wendland";  ///< wendland
  /// Kernel radius over the spacing, the same for all particles; absent: 2.2 on lattices, elsewhere each
  /// particle's own radius that holds `neighbours` of them.
  std::optional<double> support;
  int neighbours = 0;    ///< 0: 30 in space, 14 in the plane
  double jst4 = 1.0 / 8; ///< kappa4 of (3.85)
  double cfl = 0.3;      ///< sigma of (3.93)
  bool momentum_projection = true;
  double end_time = 0; ///< s
  std::vector<InitialVelocity> initial;
  std::vector<FixedCondition> fixed;
  std::vector<WallSpec> walls;
  std::vector<Probe> probes;
  int frames = 20;         ///< equally spaced in time, besides the one at time zero
  int history_rows = 1000; ///< equally spaced in time, besides the one at time zero
};

struct Energies {
  double kinetic = 0, internal = 0, plastic = 0, dissipated = 0, external = 0; ///< J
  double balance_error = 0; ///< |what is unaccounted for| / largest total so far; the worst in a Summary
};

/// Largest and smallest values over the particles and over the run, as far as its history rows saw them.
struct Extremes {
  double equivalent_plastic_strain = 0;
  double von_mises = 0;                                       ///< Pa
  double pressure = -std::numeric_limits<double>::infinity(); ///< Pa, positive in tension
  double displacement = 0;                                    ///< m
  double jacobian = std::numeric_limits<double>::infinity();  ///< the smallest
};

/// What a run came to; keys of summary.json carry the same names.
struct Summary {
  std::string formulation, scheme;
  std::int64_t particles = 0;
  double neighbours_mean = 0;
  double support = 0; ///< largest kernel radius, m
  std::int64_t steps = 0;
  double time = 0, dt_min = 0, dt_max = 0; ///< s
  double wall_seconds = 0, us_per_particle_step = 0;
  int threads = 0;
  double bytes_per_particle = 0;
  Energies energy;
  double linear_drift = 0;  ///< |P(t) - P(0)| / sum |V p(0)|, only meaningful on free bodies
  double angular_drift = 0; ///< the same for the angular momentum
  Extremes extremes;
  Vec3 extent_min = Vec3::Zero(), extent_max = Vec3::Zero(); ///< of the last positions, m
  std::vector<std::pair<std::string, double>> probes;        ///< last value of each
};

/// What a scene would need, found without running it.
struct Forecast {
  double mass = 0;        ///< kg
  double wave_speed = 0;  ///< pressure wave, undeformed, m/s
  double dt = 0;          ///< first step, s
  std::int64_t steps = 0; ///< end_time / dt: more when the body is compressed
  double neighbours_mean = 0;
  double bytes_per_particle = 0;
  double seconds = 0; ///< estimated from a few steps actually taken
  std::vector<std::string> modelled, left_out;
};

struct Outputs {
  std::function<void(const Frame&)> frame;
  /// Once before the first row.
  std::function<void(const std::vector<std::string>& columns)> history_columns;
  std::function<void(const std::vector<double>& row)> history_row;
};

/// Checks that needs no cloud: ranges and names. `where(key)` turns a key such as "material.poisson" into
/// file:line:column for the message. InputError.
void validate(const SceneSpec& scene, const std::function<std::string(const std::string&)>& where);

/// Runs the scene to its end time. Fields of the frames: Displacement (3), Velocity (3), Pressure, VonMises,
/// PlasticStrain, Stress (6, Cauchy), J, id.
/// Throws InputError (set unknown, support too small) before the first step; RunError on J <= 0 or a
/// non-finite value (naming particle, step and time) or on interruption, after handing out the last good
/// frame.
Summary run(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs, Progress& progress);

Forecast forecast(const SceneSpec& scene, const ParticleCloud& cloud);

} // namespace tessera::solver
