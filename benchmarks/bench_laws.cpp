/// Cost of the constitutive laws: nanoseconds per stress and per wave modulus of a particle, on one thread.
#include "solver/physics/law.hpp"
#include "solver/physics/materials/hencky.hpp"
#include "solver/physics/materials/linear_elastic.hpp"
#include "solver/physics/materials/mooney_rivlin.hpp"
#include "solver/physics/materials/neo_hookean.hpp"
#include "solver/physics/materials/ogden.hpp"
#include "solver/physics/materials/saint_venant_kirchhoff.hpp"
#include "solver/physics/plasticity/hardening.hpp"
#include "solver/physics/plasticity/von_mises.hpp"

#include <benchmark/benchmark.h>

#include <random>
#include <vector>

using namespace tessera;
using namespace tessera::solver;

namespace {

constexpr std::size_t particles = 4096; // in cache: the arithmetic is timed, not the memory
constexpr double near = 1e-3, far = 0.3;

/// I + e with e random within +-size.
Mat3 some_gradient(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> number(-size, size);
  Mat3 F = Mat3::Identity();
  for (int k = 0; k < 9; ++k)
    F.data()[k] += number(random);
  return F;
}

std::vector<Mat3> some_gradients(double size) {
  std::mt19937 random(1);
  std::vector<Mat3> F;
  while (F.size() < particles)
    if (const Mat3 next = some_gradient(random, size); next.determinant() > 0.3)
      F.push_back(next);
  return F;
}

void per_evaluation(benchmark::State& state) {
  state.counters["ns/evaluation"] = benchmark::Counter(
      particles * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// What a stage of a step asks of a law for every particle: the histories stay as they are.
template <class L>
void stresses(benchmark::State& state, const L& law, const std::vector<Mat3>& F,
              const std::vector<typename L::History>& histories) {
  std::vector<Mat3> P(particles);
  for (auto _ : state) {
    for (std::size_t a = 0; a < particles; ++a) {
      typename L::History trial = histories[a];
      P[a] = law.piola(Strain::of(F[a]), trial);
      benchmark::DoNotOptimize(&trial); // a history that flows is written down
    }
    benchmark::ClobberMemory();
  }
  per_evaluation(state);
}

template <class L>
void piola(benchmark::State& state, const L& law, double size) {
  stresses(state, law, some_gradients(size), std::vector<typename L::History>(particles));
}

template <class L>
void wave(benchmark::State& state, const L& law, double size) {
  const std::vector<Mat3> F = some_gradients(size);
  std::vector<double> moduli(particles);
  for (auto _ : state) {
    for (std::size_t a = 0; a < particles; ++a)
      moduli[a] = step_wave_modulus(law, Strain::of(F[a]));
    benchmark::ClobberMemory();
  }
  per_evaluation(state);
}

/// Far strained and flown before, then by another 0.5 % that either flows or, for a yield stress raised
/// since, does not.
template <class Hardening>
void metal(benchmark::State& state, const VonMises<Hardening>& law, bool flowing) {
  using Law = VonMises<Hardening>;
  std::vector<Mat3> F = some_gradients(far);
  std::vector<typename Law::History> histories(particles);
  std::mt19937 random(2);
  for (std::size_t a = 0; a < particles; ++a) {
    law.piola(Strain::of(F[a]), histories[a]);
    F[a] = some_gradient(random, 0.005) * F[a];
  }
  Law harder = law;
  if constexpr (std::is_same_v<Hardening, LinearHardening>)
    harder.hardening.yield *= 100;
  else
    harder.hardening.coefficient *= 100;
  stresses(state, flowing ? law : harder, F, histories);
}

constexpr ElasticConstants rubber = ElasticConstants::from(17e6, 0.45);
constexpr Hencky copper{ElasticConstants::from(117e9, 0.35)};
const Ogden ogden{{{0.63e6, 1.3}, {0.0012e6, 5}, {-0.01e6, -2}}, 8e6};
const VonMises<LinearHardening> linear{copper, {0.4e9, 0.1e9}};
const VonMises<PowerHardening> power{copper, {0.6e9, 0.02, 0.27}};

} // namespace

#define LAW(name, law)                                                                                       \
  BENCHMARK_CAPTURE(piola, name##_near, law, near);                                                          \
  BENCHMARK_CAPTURE(piola, name##_far, law, far);                                                            \
  BENCHMARK_CAPTURE(wave, name##_near, law, near);                                                           \
  BENCHMARK_CAPTURE(wave, name##_far, law, far)

LAW(linear_elastic, LinearElastic{rubber});
LAW(saint_venant_kirchhoff, SaintVenantKirchhoff{rubber});
LAW(neo_hookean, NeoHookean{rubber});
LAW(mooney_rivlin, (MooneyRivlin{2e6, 0.7e6, 30e6}));
LAW(ogden, ogden);
LAW(hencky, Hencky{rubber});
BENCHMARK_CAPTURE(metal, von_mises_linear_elastic, linear, false);
BENCHMARK_CAPTURE(metal, von_mises_linear_flowing, linear, true);
BENCHMARK_CAPTURE(metal, von_mises_power_elastic, power, false);
BENCHMARK_CAPTURE(metal, von_mises_power_flowing, power, true);
BENCHMARK_CAPTURE(wave, von_mises_linear_far, linear, far);
