/// The same cloud bit for bit on any number of threads, in any build type and tomorrow.
///
/// The digests below are those of release, debug and sanitizer builds alike (all for the same processor
/// level). Whoever changes an algorithm of the preprocessor changes them, and says so in the changelog.
#include "core/parallel.hpp"
#include "preprocess/cloud/prepare.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/slabs.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <type_traits>

namespace tessera::preprocess {
namespace {

/// FNV-1a, 64 bits.
class Digest {
 public:
  template <class T>
  void add(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec3>);
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(T); ++i)
      value_ = (value_ ^ bytes[i]) * 0x100000001b3U;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

std::uint64_t digest(const ParticleCloud& cloud) {
  Digest digest;
  digest.add(cloud.X);
  digest.add(cloud.V);
  digest.add(cloud.A);
  digest.add(cloud.centroid);
  digest.add(cloud.sight);
  digest.add(cloud.hidden.pairs());
  for (const ParticleSet& set : cloud.sets) {
    digest.add(set.particles);
    digest.add(set.area);
  }
  return digest.value();
}

struct Bits {
  const char* name;
  bool plane;
  std::function<void(ParticleRequest&)> change;
  std::uint64_t digest;

  friend void PrintTo(const Bits& bits, std::ostream* out) { *out << bits.name; }
};

class CloudBits : public testing::TestWithParam<Bits> {};

TEST_P(CloudBits, AreThoseOnRecordOnAnyNumberOfThreads) {
  const Domain domain = GetParam().plane ? test::holed_slab(4, 0.7, Vec<2>(0.1, 0.2))
                                         : test::l_domain(2, 0.3, Vec3(0.1, 0.2, 0.3));
  ParticleRequest request;
  request.count = 900;
  GetParam().change(request);
  for (const int count : {1, 2, 5}) {
    set_threads(count);
    const std::uint64_t bits = digest(prepare(domain, request, Progress::silent()).cloud);
    EXPECT_EQ(bits, GetParam().digest) << std::hex << "0x" << bits << " on " << count << " threads";
  }
  set_threads(0);
}

void lattice(ParticleRequest& request) {
  request.arrangement = Arrangement::lattice;
}
void close_packed(ParticleRequest& request) {
  request.arrangement = Arrangement::lattice;
  request.lattice = LatticeKind::hexagonal;
}
void two_pass(ParticleRequest& request) {
  request.arrangement = Arrangement::voronoi;
}
void relaxed_and_graded(ParticleRequest& request) {
  request.arrangement = Arrangement::voronoi;
  request.relax_seeds = 3;
  request.relax = 3;
  request.refine = {{Vec3(0.4, 0.5, 0.3), 0.5, 0.05, 0.3}};
}
void poisson(ParticleRequest& request) {
  request.arrangement = Arrangement::poisson;
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, CloudBits,
    testing::Values(Bits{"Lattice", false, lattice, 0x8c9776c5e7491b9bU},
                    Bits{"ClosePacked", false, close_packed, 0x52935a8cbc6e3b32U},
                    Bits{"TwoPass", false, two_pass, 0x73c87afa84e6fd0cU},
                    Bits{"RelaxedAndGraded", false, relaxed_and_graded, 0x2b4749cbedcb6d5U},
                    Bits{"Poisson", false, poisson, 0xb3eed448f56250baU},
                    Bits{"PlaneTwoPass", true, two_pass, 0xd5ebf65d49bc2815U},
                    Bits{"PlaneRelaxedAndGraded", true, relaxed_and_graded, 0xbab9c68ab54c0e5U},
                    Bits{"PlanePoisson", true, poisson, 0x53ca4ea4b90c78e2U}),
    [](const auto& param) { return std::string(param.param.name); });

} // namespace
} // namespace tessera::preprocess
