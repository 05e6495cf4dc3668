/// How errors fall as particles draw nearer.
#pragma once

#include "app/study/results.hpp"

#include <map>
#include <string>
#include <vector>

namespace tessera::app {

/// Runs that differ in their size only, coarse to fine.
struct Convergence {
  std::map<std::string, std::string> labels; ///< by axis, all but that of the sizes
  std::vector<double> spacing, error;        ///< m; relative
  double order = Row::none; ///< slope of the best line through the logarithms of the three finest
};

/// Of three sizes or more on an axis that sets the number or the distance of particles; empty where the study
/// has no such axis, or no other to tell curves apart has three runs with an error.
std::vector<Convergence> convergence(const Study& study, const Results& results);

} // namespace tessera::app
