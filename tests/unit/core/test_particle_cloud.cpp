#include "core/particle_cloud.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

#include <limits>

using namespace tessera;

namespace {

ParticleCloud two_particles() {
  ParticleCloud cloud;
  cloud.X = {Vec3(0, 0, 0), Vec3(1, 0, 0)};
  cloud.V = {0.5, 0.5};
  cloud.A = {Vec3(-1, 0, 0), Vec3(1, 0, 0)};
  cloud.centroid = cloud.X;
  cloud.cad_dimension = {2, 2};
  cloud.sets = {{"base", {0}, {Vec3(-1, 0, 0)}}, {"top", {1}, {}}};
  return cloud;
}

std::string message(const ParticleCloud& cloud) {
  try {
    cloud.validate("cloud.vtp");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

} // namespace

TEST(ParticleCloud, AGoodOneIsValid) {
  EXPECT_EQ(message(two_particles()), "");
}

TEST(ParticleCloud, AnUnknownSetIsAnsweredWithTheNearestAndTheList) {
  try {
    two_particles().set("bsae");
    FAIL() << "found";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "no particle set is named 'bsae', did you mean 'base'? the cloud has: base, top");
  }
}

TEST(ParticleCloud, BadValuesAreNamed) {
  ParticleCloud cloud = two_particles();
  cloud.V[1] = -1;
  EXPECT_EQ(message(cloud),
            "particle 1 has subvolume -1, cloud.vtp, subvolumes must be positive: prepare the cloud again");
  cloud = two_particles();
  cloud.X[0][2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message(cloud).find("particle 0 has a value that is not finite"), std::string::npos);
  cloud = two_particles();
  cloud.sets[0].particles[0] = 2;
  EXPECT_NE(message(cloud).find("set 'base' names particle 2"), std::string::npos);
  cloud = two_particles();
  cloud.A.pop_back();
  EXPECT_NE(message(cloud).find("arrays differ in length"), std::string::npos);
  EXPECT_NE(message(ParticleCloud{}).find("no particles"), std::string::npos);
}

TEST(NearestName, FindsSlipsAndRefusesStrangers) {
  const std::vector<std::string> names = {"density", "young", "poisson"};
  EXPECT_EQ(nearest_name("yuong", names), "young");
  EXPECT_EQ(nearest_name("poison", names), "poisson");
  EXPECT_EQ(nearest_name("temperature", names), "");
  EXPECT_EQ(nearest_name("x", {}), "");
}
