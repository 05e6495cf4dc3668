#include "core/error.hpp"

#include <gtest/gtest.h>

using namespace tessera;

TEST(Error, IsOneLineOfWhatWhereAndRemedy) {
  const InputError error("density is -1", "case.toml:3:1", "it must be\npositive");
  EXPECT_STREQ(error.what(), "density is -1, case.toml:3:1, it must be positive");
  EXPECT_EQ(error.status(), ExitStatus::bad_input);
}

TEST(Error, LeavesOutEmptyParts) {
  EXPECT_STREQ(RunError("interrupted", "", "").what(), "interrupted");
  EXPECT_EQ(RunError("interrupted", "", "").status(), ExitStatus::run_failed);
}

TEST(Error, RequireThrowsOnlyWhenTheConditionFails) {
  EXPECT_NO_THROW(require(true, "a", "b", "c"));
  EXPECT_THROW(require(false, "a", "b", "c"), InputError);
}
