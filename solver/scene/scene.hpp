/// A scene and the run of it: the only place where formulation and law are chosen at run time.
#pragma once

#include "core/frame.hpp"
#include "core/particle_cloud.hpp"
#include "core/progress.hpp"
#include "solver/boundary/plane.hpp"
#include "solver/boundary/wall.hpp"
#include "solver/physics/plastic_ramp.hpp"
#include "solver/physics/plasticity/hardening.hpp"
#include "solver/scene/expression.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace tessera::solver {

// SI units throughout.

/// Isotropic hardening of von Mises plasticity.
using PlasticitySpec = std::variant<LinearHardening, PowerHardening>;

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

/// Of a set ("all": every particle) at time zero; later entries overwrite earlier ones.
struct InitialCondition {
  std::string on = "all";
  std::optional<Formulas> velocity{};     ///< m/s
  std::optional<Formulas> displacement{}; ///< m; the strains follow from it
};

/// What holds or loads a set while the body moves: table 2.4 of the thesis, and body forces.
struct BoundaryCondition {
  enum class Kind {
    fixed,          ///< velocity components held at zero: clamped where all are
    sliding,        ///< no velocity along the surface's normal (symmetric)
    skew_symmetric, ///< none in the surface's plane
    velocity,       ///< velocity components as `values` say, m/s
    traction,       ///< Pa on the reference surface, in a direction that stays
    pressure,       ///< Pa on the surface as it deforms, pushing where positive
    body_force      ///< acceleration, m/s^2
  };
  Kind kind = Kind::fixed;
  std::string on;
  std::array<bool, 3> component = {true, true, true}; ///< of fixed and velocity
  std::vector<Expression> values{};                   ///< none, one (pressure) or three
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
                        ///< (m/s) angle (turned about the Z axis, degrees, beyond full turns) plastic_strain
                        ///< von_mises pressure (Pa) J
  std::string reduce;   ///< max, min, mean, extent (max - min) over the set
  std::string on = "all";
  std::optional<Vec3> at{};   ///< instead of a set: the body's point at this reference position, m
  Vec3 centre = Vec3::Zero(); ///< the axis of radius and angle passes through it, m
};

/// A closed form to measure a run by, as far as it is known.
struct ExactSolution {
  std::optional<Formulas> velocity{};     ///< m/s
  std::optional<Expression> pressure{};   ///< tr sigma / 3, Pa
  std::optional<Formulas> displacement{}; ///< m
};

/// Found by measurement (docs/theory.md). Metal that flows bears no shear waves that would want damping.
constexpr double usual_residual = 1, usual_residual_J = 1;
constexpr PlasticRamp usual_plastic_residual{0.5, 0.2, 0.5};

struct SceneSpec {
  MaterialSpec material;
  std::string formulation = "auto";  ///< auto, displacement, pF, pFJ, pFHJ
  std::string scheme = "consistent"; ///< thesis, consistent
  /// auto, jst, jst_symmetric, linear_residual: auto is the scheme's own, jst of "thesis" and linear_residual
  /// of "consistent".
  std::string dissipation = "auto";
  std::string kernel = "wendland"; ///< one of kernel_names()
  /// Kernel radius over the spacing, the same for all particles; absent: 2.2 on lattices (1.6 in the
  /// scheme "consistent"), elsewhere each particle's own radius that holds `neighbours` of them.
  std::optional<double> support;
  int neighbours = 0;                ///< 0: 30 in space, 14 in the plane
  std::optional<PlasticRamp> jst4{}; ///< kappa4 of (3.85), of both JST; absent: 1/8, none with displacements
  double jst2 = 0;                   ///< kappa2 of (3.84), of jst
  std::optional<double> jst4_J{};    ///< kappa4 of the volume map; absent: that of the momentum
  /// kappa of the residual dissipation; absent: usual_residual, usual_plastic_residual where the material
  /// flows, none with displacements.
  std::optional<PlasticRamp> residual{};
  std::optional<double> residual_J{}; ///< the same of the volume map; absent: usual_residual_J
  std::optional<double> involution{}; ///< xi: how hard J and H are held to det F and cof F; absent: 0.2; 4
                                      ///< jst4_J with jst, 3 with jst_symmetric
  std::string integrator = "auto";    ///< heun, verlet; auto: heun with the scheme "thesis", else verlet
  /// sigma of (3.93) with heun, the share of the critical step with verlet; absent: 0.3, 0.8
  std::optional<double> cfl{};
  bool momentum_projection = true;
  double end_time = 0; ///< s
  std::vector<InitialCondition> initial;
  std::vector<BoundaryCondition> boundary;
  std::vector<WallSpec> walls;
  std::vector<Probe> probes;
  std::optional<ExactSolution> exact;
  std::vector<std::string> fields{}; ///< derived_fields() that frames hold beside the usual ones
  int frames = 20;                   ///< equally spaced in time, besides the one at time zero
  int history_rows = 1000;           ///< equally spaced in time, besides the one at time zero
};

struct Energies {
  double kinetic = 0, internal = 0, plastic = 0, dissipated = 0, external = 0; ///< J
  double balance_error = 0; ///< |what is unaccounted for| / largest total so far; in a Summary the worst of
                            ///< the one over the largest of the other
};

/// Largest and smallest values over the particles and over the run, as far as its history rows saw them.
struct Extremes {
  double equivalent_plastic_strain = 0;
  double von_mises = 0;                                       ///< Pa
  double pressure = -std::numeric_limits<double>::infinity(); ///< Pa, positive in tension
  double smallest_pressure = std::numeric_limits<double>::infinity();
  double displacement = 0;                                   ///< m
  double jacobian = std::numeric_limits<double>::infinity(); ///< the smallest
};

/// Differences from the exact solution at the end, (5.3): L1 = sum V |e|, L2 = sqrt(sum V |e|^2). Zero of
/// fields it does not give.
struct ErrorNorms {
  double l1_displacement = 0, l2_displacement = 0; ///< m times m^3 and m^(3/2)
  double l2_displacement_relative = 0;             ///< over the norm of the exact displacement
  double l1_velocity = 0, l2_velocity = 0;         ///< m/s times m^3 and m^(3/2)
  double l2_velocity_relative = 0;                 ///< over the norm of the exact velocity
  double l2_velocity_thesis = 0;                   ///< sqrt(sum (V |e|)^2), which table 5.1 lists
  double l1_pressure = 0, l2_pressure = 0;         ///< Pa times m^3 and m^(3/2)
  double l2_pressure_relative = 0;
};

/// The two steps that the first step of a run is taken from, before either's share of them.
struct StepChoice {
  double by_wave = 0;  ///< smallest particle distance over the fastest wave, (3.93) with sigma = 1, s
  double critical = 0; ///< from which on the operators amplify some field, s
  std::string bound;   ///< which it was that gave the smaller step: "wave" or "critical"
  double frequency = 0, decay = 0; ///< of the field the critical step belongs to, rad/s and 1/s
};

/// What a run came to; keys of summary.json carry the same names.
struct Summary {
  std::string formulation, scheme, dissipation; ///< dissipation "none" where its constants are zero
  std::int64_t particles = 0;
  double neighbours_mean = 0;
  double support = 0; ///< largest kernel radius, m
  std::int64_t steps = 0;
  double time = 0, dt_min = 0, dt_max = 0; ///< s
  StepChoice step;
  double wall_seconds = 0, us_per_particle_step = 0;
  double cpu_seconds = 0;   ///< processor time of the steps, all threads together, without what is written
  double setup_seconds = 0; ///< processor time before the first step
  int threads = 0;
  double bytes_per_particle = 0;
  Energies energy;
  double linear_drift = 0;  ///< |P(t) - P(0)| / sum |V p(0)|, only meaningful on free bodies
  double angular_drift = 0; ///< the same for the angular momentum
  Extremes extremes;
  Vec3 extent_min = Vec3::Zero(), extent_max = Vec3::Zero(); ///< of the last positions, m
  std::vector<std::pair<std::string, double>> probes;        ///< last value of each
  std::optional<ErrorNorms> error;
};

struct Outputs {
  std::function<void(const Frame&)> frame;
  /// Once before the first row.
  std::function<void(const std::vector<std::string>& columns)> history_columns;
  std::function<void(const std::vector<double>& row)> history_row;
  /// Asked after every step; the run ends where it says so, and its Summary is of what there is.
  std::function<bool(double time, std::int64_t steps)> enough{};
};

/// The formulation a scene is run in: "auto" means {p, F}, and {p, F, J} from a Poisson's ratio of 0.49 on.
std::string chosen_formulation(const SceneSpec& scene);
/// The dissipation a scene is run with: "auto" means its scheme's own.
std::string chosen_dissipation(const SceneSpec& scene);

/// The method of time integration: "auto" means its scheme's own.
std::string chosen_integrator(const SceneSpec& scene);
/// Of the method: see SceneSpec::cfl.
double chosen_cfl(const SceneSpec& scene);

/// Keys of constants that are given but belong to a dissipation that is not chosen: a case may hold those of
/// several.
std::vector<std::string> resting_constants(const SceneSpec& scene);

/// Checks that needs no cloud: ranges and names. `where(key)` turns a key such as "material.poisson" into
/// file:line:column for the message. InputError.
void validate(const SceneSpec& scene, const std::function<std::string(const std::string&)>& where);

/// Runs the scene to its end time. Fields of the frames: Displacement (3), Velocity (3), Pressure, VonMises,
/// PlasticStrain, Stress (6, Cauchy), J, id and those the scene names.
/// Throws InputError (set unknown, support too small) before the first step; RunError on J <= 0, a
/// non-finite value or a step below 1e-4 of the first (naming particle, step and time) or on interruption,
/// after handing out the last good frame.
Summary run(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs, Progress& progress);

} // namespace tessera::solver
