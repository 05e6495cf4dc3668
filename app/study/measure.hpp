/// How far finished runs are from what a study holds them against.
#pragma once

#include "app/study/study_file.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tessera::app {

/// A number as it changes in time, s.
struct TimeSeries {
  std::vector<double> time, value;
};

/// Relative difference of `run` from `truth` at those times of `truth` that the run reached, between its rows
/// interpolated: the largest over the largest true magnitude, the root of the squares' integrals, or the
/// last. InputError where these times are fewer than two.
double history_error(const TimeSeries& run, const TimeSeries& truth, ErrorMeasure::Norm norm);

/// Share of the energy a run was given, at its start and by work from outside, that its ledger cannot account
/// for or that the dissipation, which should only take, has added: the worst over history.csv. NaN without
/// that file, and where nothing was given. InputError when it cannot be read.
double spurious_energy(const std::filesystem::path& folder);

class Measure {
 public:
  /// `column`: of history.csv, where a probe is measured. `finer`: folder of the finished finer run, where
  /// there is one. InputError when the reference cannot be read.
  Measure(const ErrorMeasure& measure, std::string column, const std::filesystem::path& finer);

  /// Relative error of the run in `folder`; NaN where it is none. InputError when its files cannot be read.
  double operator()(const std::filesystem::path& folder) const;

 private:
  double of_field(const std::filesystem::path& folder) const;

  ErrorMeasure measure_;
  std::string column_;
  std::filesystem::path finer_;
  std::optional<TimeSeries> truth_;
};

} // namespace tessera::app
