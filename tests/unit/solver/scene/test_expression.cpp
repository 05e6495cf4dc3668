#include "solver/scene/expression.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

using namespace tessera;
using namespace tessera::solver;

TEST(Expression, EvaluatesAtThePosition) {
  const Expression f("10*Z/6 + sin(_pi*X/2) - Y^2");
  EXPECT_DOUBLE_EQ(f(Vec3(1, 2, 3)), 10 * 3.0 / 6 + 1 - 4);
  EXPECT_EQ(Expression("-227")(Vec3::Zero()), -227);
}

TEST(Expression, AFaultIsReportedWithItsPosition) {
  try {
    Expression("10*Q");
    FAIL() << "parsed";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"10*Q\" cannot be read at position 4"), std::string::npos)
        << error.what();
  }
  EXPECT_THROW(Expression("1+"), InputError);
  EXPECT_THROW(Expression(""), InputError);
}

TEST(Expression, AnInfiniteValueIsRefused) {
  EXPECT_THROW(Expression("1/X")(Vec3::Zero()), InputError);
}

TEST(Expression, AnInfiniteValueNamesThePlaceItIsWrittenAt) {
  try {
    Expression("1/t", "boundary.0.pressure, case.toml:3:4")(Vec3::Zero());
    FAIL() << "finite";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(", boundary.0.pressure, case.toml:3:4, "), std::string::npos)
        << error.what();
  }
}

TEST(Expression, KnowsTheTimeAndWhetherThePlaceMatters) {
  EXPECT_EQ(Expression("-10*min(t/0.1, 1)")(Vec3::Zero(), 0.05), -5);
  EXPECT_EQ(Expression("t")(Vec3::Zero()), 0);
  EXPECT_TRUE(Expression("sin(t) + 2").uniform());
  EXPECT_FALSE(Expression("t*Y").uniform());
}
