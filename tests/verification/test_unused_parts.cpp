// What a scene does not ask for is not there: the memory of the assembled body is counted allocation by
// allocation, and so are the calls of the law.

#include "solver/physics/plasticity/hardening.hpp"
#include "solver/physics/plasticity/von_mises.hpp"
#include "solver/scene/assemble.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <type_traits>

namespace {

std::atomic<std::size_t> live_bytes{0};

void* counted(void* p) {
  if (p == nullptr)
    throw std::bad_alloc();
  live_bytes += malloc_usable_size(p);
  return p;
}

void release(void* p) {
  if (p != nullptr)
    live_bytes -= malloc_usable_size(p);
  std::free(p);
}

} // namespace

void* operator new(std::size_t size) {
  return counted(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
void operator delete(void* p) noexcept {
  release(p);
}
void operator delete(void* p, std::size_t) noexcept {
  release(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  release(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  release(p);
}

namespace tessera::solver {
namespace {

class UnusedParts : public ::testing::Test {
 protected:
  void SetUp() override {
    mallopt(M_MMAP_THRESHOLD, 1 << 30); // no rounding to pages
    set_threads(1);
  }
};

struct Memory {
  double measured = 0, said = 0; ///< bytes a particle
};

/// Of a body that has taken a step.
template <class Formulation, class Dissipation>
Memory memory_of(const SceneSpec& scene, const ParticleCloud& cloud) {
  const std::size_t before = live_bytes;
  return assemble<Formulation, Dissipation>(scene, cloud, [&](auto& assembly) {
    const double dt = assembly.limit(assembly.body);
    assembly.step->start(assembly.body, dt);
    (*assembly.step)(assembly.body, 0, dt);
    return Memory{static_cast<double>(live_bytes - before) / static_cast<double>(cloud.size()),
                  bytes_of(scene, assembly)};
  });
}

ParticleCloud block() {
  return test::box_lattice(12, 12, 12, Vec3(1, 1, 1));
}

SceneSpec elastic() {
  SceneSpec scene;
  scene.material = {"hencky", 1100, 17e6, 0.3, std::nullopt};
  scene.end_time = 1;
  return scene;
}

/// Within 3 %.
void expect_said(const Memory& memory) {
  EXPECT_NEAR(memory.said / memory.measured, 1, 0.03)
      << memory.said << " said, " << memory.measured << " measured";
}

TEST_F(UnusedParts, TakeNoMemoryAndCheckSaysWhatIsTaken) {
  const ParticleCloud cloud = block();
  const SceneSpec scene = elastic();
  const Memory displacement = memory_of<Displacement<3>, NoDissipation<3>>(scene, cloud);
  const Memory pF = memory_of<PF<3>, NoDissipation<3>>(scene, cloud);
  const Memory pFJ = memory_of<PFJ<3>, NoDissipation<3>>(scene, cloud);
  const Memory pFHJ = memory_of<PFHJ<3>, NoDissipation<3>>(scene, cloud);
  const Memory residual = memory_of<PF<3>, ResidualDissipation<3>>(scene, cloud);
  for (const Memory& memory : {displacement, pF, pFJ, pFHJ, residual})
    expect_said(memory);
  constexpr double tensor = sizeof(Mat3), number = sizeof(double), slack = 1;
  // F is held twice (state, before the step) in place of once, J three times, H three times.
  EXPECT_NEAR(pF.measured - displacement.measured, tensor, slack);
  EXPECT_NEAR(pFJ.measured - pF.measured, 3 * number, slack);
  EXPECT_NEAR(pFHJ.measured - pFJ.measured, 3 * tensor, slack);
  EXPECT_GT(residual.measured, pF.measured + tensor);
}

TEST_F(UnusedParts, PlasticityAddsItsHistoryAndElasticLawsHaveNone) {
  const ParticleCloud cloud = block();
  SceneSpec scene = elastic();
  const Memory remembers_nothing = memory_of<PF<3>, NoDissipation<3>>(scene, cloud);
  scene.material.plasticity = LinearHardening{1e9, 1e6};
  const Memory remembers = memory_of<PF<3>, NoDissipation<3>>(scene, cloud);
  expect_said(remembers);
  EXPECT_NEAR(remembers.measured - remembers_nothing.measured, sizeof(VonMises<LinearHardening>::History), 1);
}

TEST_F(UnusedParts, WallsAndLoadsHaveArraysOnlyWhereThereAreSome) {
  const ParticleCloud cloud = block();
  const SceneSpec free = elastic();
  const Memory alone = memory_of<PF<3>, NoDissipation<3>>(free, cloud);
  SceneSpec scene = free;
  scene.walls.push_back({});
  const Memory wall = memory_of<PF<3>, NoDissipation<3>>(scene, cloud);
  expect_said(wall);
  EXPECT_NEAR(wall.measured - alone.measured, 2 * sizeof(Vec3), 1) << "impulses from outside and of the wall";
  scene.walls[0].friction = 0.1;
  scene.walls[0].restitution = 1;
  const Memory rough = memory_of<PF<3>, NoDissipation<3>>(scene, cloud);
  expect_said(rough);
  EXPECT_NEAR(rough.measured - wall.measured, sizeof(Vec3) + sizeof(double), 1);

  scene = free;
  scene.boundary = {
      {BoundaryCondition::Kind::traction, "top", {}, {Expression("1"), Expression("0"), Expression("0")}}};
  const Memory loaded = memory_of<PF<3>, NoDissipation<3>>(scene, cloud);
  expect_said(loaded);
  EXPECT_NEAR(loaded.measured - alone.measured, 3 * sizeof(Vec3), 8)
      << "impulses, forces, reference positions";

  scene.boundary = {{BoundaryCondition::Kind::fixed, "base"}};
  expect_said(memory_of<PF<3>, NoDissipation<3>>(scene, cloud));
}

TEST_F(UnusedParts, PlaneBodiesHoldVectorsAndTensorsOfThePlane) {
  const ParticleCloud cloud = test::box_lattice(40, 40, 1, Vec3(1, 1, 0));
  const SceneSpec scene = elastic();
  const Memory plane = memory_of<PF<2>, NoDissipation<2>>(scene, cloud);
  expect_said(plane);
  expect_said(memory_of<PFJ<2>, NoDissipation<2>>(scene, cloud));
  expect_said(memory_of<PF<2>, ResidualDissipation<2>>(scene, cloud));
  expect_said(memory_of<PF<2>, Jst<2>>(scene, cloud));
  using Inside = Body<PF<2>, NoDissipation<2>>;
  static_assert(sizeof(Inside::Pull) == 8 * sizeof(double) && sizeof(Inside::Field) == 2 * sizeof(double));
  static_assert(sizeof(Mat<2>) == 4 * sizeof(double) && sizeof(Vec<2>) == 2 * sizeof(double));
  static_assert(sizeof(Gradient<2>::Anchor) == 4 * sizeof(double));
  const Memory in_space = memory_of<PF<3>, NoDissipation<3>>(scene, block());
  EXPECT_LT(plane.measured, 0.6 * in_space.measured);
}

template <class Fields>
concept HasF = requires(Fields fields) {
  fields.F;
};
template <class Fields>
concept HasH = requires(Fields fields) {
  fields.H;
};
template <class Fields>
concept HasJ = requires(Fields fields) {
  fields.J;
};
static_assert(!HasF<Displacement<3>> && !HasH<PF<3>> && !HasJ<PF<3>> && !HasH<PFJ<3>> && HasJ<PFJ<3>>);
static_assert(std::is_empty_v<NoDissipation<3>> && std::is_empty_v<NoDissipation<3>::First> &&
              std::is_empty_v<NoDissipation<3>::Second>);
static_assert(std::is_empty_v<Hencky::History>);

/// How often a material is asked for something, by particles.
struct Calls {
  std::int64_t stresses = 0, commits = 0, differentials = 0, energies = 0;
};

class Counted final : public Material<3> {
 public:
  Counted(std::unique_ptr<Material<3>> inner, Calls& calls) : inner_(std::move(inner)), calls_(calls) {}

  void stresses(const StrainFields<3>& strains, std::int64_t first, std::span<Mat3> P) const override {
    calls_.stresses += std::ssize(P);
    inner_->stresses(strains, first, P);
  }
  void commit(const StrainFields<3>& strains, std::int64_t first, std::span<Mat3> P,
              std::span<double> moduli) override {
    calls_.commits += std::ssize(P);
    inner_->commit(strains, first, P, moduli);
  }
  void differentials(const StrainFields<3>& strains, std::span<const Mat3> grad_u, std::int64_t first,
                     std::span<Mat3> dP) const override {
    calls_.differentials += std::ssize(dP);
    inner_->differentials(strains, grad_u, first, dP);
  }
  ElasticConstants linearised() const override { return inner_->linearised(); }
  Mat3 piola(const Strain& strain, std::int64_t a) const override { return inner_->piola(strain, a); }
  double energy(const Strain& strain, std::int64_t a) const override {
    ++calls_.energies;
    return inner_->energy(strain, a);
  }
  double plastic_work(std::int64_t a) const override { return inner_->plastic_work(a); }
  double equivalent_plastic_strain(std::int64_t a) const override {
    return inner_->equivalent_plastic_strain(a);
  }
  std::size_t history_bytes() const override { return inner_->history_bytes(); }

 private:
  std::unique_ptr<Material<3>> inner_;
  Calls& calls_;
};

/// Of ten steps, without what looks for their length.
template <class Formulation, class Dissipation>
Calls calls_of(const SceneSpec& scene, const ParticleCloud& cloud) {
  return assemble<Formulation, Dissipation>(scene, cloud, [&](auto& assembly) {
    Calls calls;
    const double dt = assembly.limit(assembly.body);
    assembly.step->start(assembly.body, dt);
    assembly.body.material = std::make_unique<Counted>(std::move(assembly.body.material), calls);
    for (int i = 0; i < 10; ++i)
      (*assembly.step)(assembly.body, i * dt, dt);
    return calls;
  });
}

TEST_F(UnusedParts, AskNothingOfTheLaw) {
  const ParticleCloud cloud = block();
  SceneSpec scene = elastic();
  const Calls verlet = calls_of<PF<3>, NoDissipation<3>>(scene, cloud);
  EXPECT_EQ(verlet.commits, 10 * cloud.size());
  EXPECT_EQ(verlet.stresses + verlet.differentials + verlet.energies, 0);

  scene.scheme = "thesis";
  const Calls heun = calls_of<PF<3>, NoDissipation<3>>(scene, cloud);
  EXPECT_EQ(heun.commits, 10 * cloud.size());
  EXPECT_EQ(heun.stresses, 10 * cloud.size());
  EXPECT_EQ(heun.differentials + heun.energies, 0);

  scene.scheme = "consistent";
  const Calls with_J = calls_of<PFJ<3>, NoDissipation<3>>(scene, cloud);
  EXPECT_EQ(with_J.energies, 2 * 10 * cloud.size()) << "what the numerics do to J is in the ledger";
}

} // namespace
} // namespace tessera::solver
