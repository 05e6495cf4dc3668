#include "app/study/convergence.hpp"
#include "app/study/map.hpp"
#include "app/study/measure.hpp"
#include "app/study/pareto.hpp"
#include "app/study/results.hpp"
#include "core/error.hpp"
#include "tests/unit/app/case_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace tessera::app {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Pareto, FrontIsWhatNoneBeats) {
  const std::vector<CostAndError> runs{{1, 0.5}, {2, 0.6}, {2, 0.1},  {3, 0.1},
                                       {nan, 0}, {4, nan}, {5, 0.01}, {1, 0.7}};
  EXPECT_EQ(pareto_front(runs), (std::vector<std::size_t>{0, 2, 6}));
  EXPECT_EQ(cheapest_within(runs, 0.5), 0U);
  EXPECT_EQ(cheapest_within(runs, 0.2), 2U);
  EXPECT_EQ(cheapest_within(runs, 0.001), std::nullopt);
  EXPECT_TRUE(pareto_front({}).empty());
  const std::vector<CostAndError> alike{{1, 1}, {1, 1}};
  EXPECT_EQ(pareto_front(alike), std::vector<std::size_t>{0});
}

TEST(Pareto, FrontOfManyAgreesWithItsDefinition) {
  std::mt19937 random(5);
  std::vector<CostAndError> runs;
  for (int i = 0; i < 300; ++i)
    runs.push_back({static_cast<double>(random() % 50), static_cast<double>(random() % 50)});
  const std::vector<std::size_t> front = pareto_front(runs);
  const auto beats = [](const CostAndError& a, const CostAndError& b) {
    return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
  };
  for (std::size_t i = 0; i < runs.size(); ++i) {
    bool beaten = false, stands_for = false;
    for (const CostAndError& other : runs)
      beaten |= beats(other, runs[i]);
    for (const std::size_t f : front)
      stands_for |= runs[f].cost == runs[i].cost && runs[f].error == runs[i].error;
    EXPECT_EQ(stands_for, !beaten) << i;
  }
}

TEST(HistoryError, LargestRootMeanSquareAndLast) {
  // Truth sin(t) on [0, pi]; the run is 0.1 (1 + t) off and has other times.
  TimeSeries truth, run;
  for (int i = 0; i <= 2000; ++i) {
    truth.time.push_back(3.2 * i / 2000);
    truth.value.push_back(std::sin(truth.time.back()));
  }
  for (int i = 0; i <= 1500; ++i) {
    run.time.push_back(3 * i / 1500.0);
    run.value.push_back(std::sin(run.time.back()) + 0.1 * (1 + run.time.back()));
  }
  EXPECT_NEAR(history_error(run, truth, ErrorMeasure::Norm::worst), 0.4, 1e-3);
  // Integrals over [0, 3]: 0.01 ((1 + t)^3 / 3) and (t - sin t cos t) / 2.
  const double squares = 0.01 * (64 - 1) / 3.0, norm = 0.5 * (3 - std::sin(3.0) * std::cos(3.0));
  EXPECT_NEAR(history_error(run, truth, ErrorMeasure::Norm::rms), std::sqrt(squares / norm), 1e-3);
  EXPECT_NEAR(history_error(run, truth, ErrorMeasure::Norm::end), 0.4 / std::sin(3.0), 0.02);
}

TEST(HistoryError, TimesThatDoNotMeetAreRefused) {
  const TimeSeries run{{0, 1}, {0, 1}}, later{{2, 3}, {1, 1}};
  EXPECT_THROW(history_error(run, later, ErrorMeasure::Norm::worst), InputError);
  const TimeSeries broken{{0, 1}, {0, nan}}, truth{{0, 1}, {1, 1}};
  EXPECT_TRUE(std::isnan(history_error(broken, truth, ErrorMeasure::Norm::worst)));
}

/// A store with one finished run, one failed and one that was never run.
class StudyResults : public testing::Test {
 protected:
  StudyResults() : store(folder.path()) {
    study.title = "three";
    study.axes = {{"size", {{"1", {}}, {"2, large", {}}, {"3", {}}}}};
    study.colour = study.marker = "size";
    study.error.name = "velocity";
    study.error.targets = {0.1, 0.001};
    study.map.inaccurate = 0.1;
    for (const char* id : {"a", "b", "c"})
      plan.runs.push_back({{study.axes[0].values[plan.runs.size()].label}, id, id, "", 1});
    std::filesystem::create_directories(store.run("a"));
    std::filesystem::create_directories(folder.path() / "cases");
    folder.file("runs/a/summary.json",
                R"({"particles": 8, "spacing": 0.25, "steps": 4, "cpu_seconds": 0.5, "setup_seconds": 2,
      "peak_bytes": 3000000, "error": {"l2_velocity_relative": 0.01}})");
    folder.file("runs/a/history.csv", "time_s,total_J,dissipated_J,external_J\n0,16,0,0\n1,17,1,0\n");
    store.keep_failure("b", "blew up");
  }
  CaseFolder folder;
  RunStore store;
  Study study;
  Plan plan;
};

TEST_F(StudyResults, StoreKnowsWhatIsMissing) {
  EXPECT_FALSE(store.missing("a"));
  EXPECT_FALSE(store.missing("b"));
  EXPECT_EQ(store.failure("b"), "blew up");
  EXPECT_TRUE(store.missing("c"));
  store.forget_failure("b");
  EXPECT_TRUE(store.missing("b"));
}

TEST_F(StudyResults, FailedRunIsARow) {
  const Results results = collect_results(study, plan, store, {{"c", "no memory"}});
  ASSERT_EQ(results.rows.size(), 3U);
  EXPECT_EQ(results.rows[0].error, 0.01);
  EXPECT_EQ(results.rows[1].failure, "blew up");
  EXPECT_EQ(results.rows[2].failure, "no memory");
  EXPECT_EQ(results.front, std::vector<std::size_t>{0});
  EXPECT_EQ(results_csv(study, results), "size,particles,spacing_m,steps,error,cpu_seconds,setup_seconds,"
                                         "peak_bytes,spurious_energy,verdict,front,run,"
                                         "failure\n"
                                         "1,8,0.25,4,0.01,0.5,2,3000000,0.0625,stable,1,runs/a,\n"
                                         "\"2, large\",,,,,,,,,unstable,0,runs/b,blew up\n"
                                         "3,,,,,,,,,,0,runs/c,no memory\n");
  EXPECT_EQ(
      recommendations_text(study, results),
      (std::vector<std::string>{"for 10 % velocity error: 1 (8 particles) costs 0.5 s, and 2 s of set-up; "
                                "its error is 1 %",
                                "for 0.1 % velocity error: no run reaches it"}));
  const std::string report = post::markdown(results_report(study, results, {folder.path() / "pareto.png"}));
  for (const char* piece :
       {"# three", "](pareto.png)", "| 2, large | blew up |", "| * | 1 | 8 | 4 | 1 % | 0.5 | 2 | 3 |",
        "| size | 10 % | 0.1 % |\n|:--|:--|:--|\n| 1 | 0.5 s | - |\n| 2, large | - | - |"})
    EXPECT_NE(report.find(piece), std::string::npos) << piece << "\n" << report;
  const std::string json = results_json(study, results);
  EXPECT_NE(json.find("\"failure\": \"no memory\""), std::string::npos) << json;
}

/// Errors of h^2 on lattices and h on others, h = 1/2, 1/4, 1/8, in a disorder, and one too coarse to count.
TEST(Convergence, OrderOfEachCurveOfAtLeastThreeSizes) {
  Study study;
  study.axes = {{"cloud", {{"lattice", {}}, {"raw", {}}, {"few", {}}}},
                {"size",
                 {{"2", {"particles.count=8"}},
                  {"8", {"particles.count=512"}},
                  {"4", {"particles.count=64"}},
                  {"1", {"particles.count=1"}}}}};
  study.colour = study.marker = "cloud";
  Results results;
  for (const auto& [cloud, order] : {std::pair{"lattice", 2}, {"raw", 1}})
    for (const double n : {2., 8., 1., 4.}) {
      Row& row = results.rows.emplace_back();
      row.labels = {cloud, std::to_string(static_cast<int>(n))};
      row.spacing = 1 / n;
      row.error = n == 1 ? 100 : 3 * std::pow(row.spacing, order);
    }
  results.rows.push_back(results.rows.front());
  results.rows.back().labels = {"few", "2"};
  const std::vector<Convergence> all = convergence(study, results);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].labels, (std::map<std::string, std::string>{{"cloud", "lattice"}}));
  EXPECT_EQ(all[0].spacing, (std::vector{1., 0.5, 0.25, 0.125}));
  EXPECT_NEAR(all[0].order, 2, 1e-12);
  EXPECT_NEAR(all[1].order, 1, 1e-12);
  study.colour = study.marker = "size";
  EXPECT_TRUE(convergence(study, results).empty());
}

TEST(Verdict, OfErrorEnergyAndEnd) {
  const MapLayout layout{true, "a", "b", 0.1, 0.05};
  Row row;
  EXPECT_EQ(verdict(row, layout), Verdict::none) << "not run";
  row.error = 0.1;
  EXPECT_EQ(verdict(row, layout), Verdict::stable) << "energy is not always known";
  row.spurious_energy = 0.05;
  EXPECT_EQ(verdict(row, layout), Verdict::stable);
  row.error = 0.11;
  EXPECT_EQ(verdict(row, layout), Verdict::inaccurate);
  row.spurious_energy = 0.06;
  EXPECT_EQ(verdict(row, layout), Verdict::unstable);
  row = {};
  row.gave_up = true;
  EXPECT_EQ(verdict(row, layout), Verdict::unstable);
}

TEST_F(StudyResults, SpuriousEnergyIsHeldAgainstWhatWasGiven) {
  const auto history = [&](const std::string& rows) {
    folder.file("runs/a/history.csv", "time_s,total_J,dissipated_J,external_J\n" + rows);
    return spurious_energy(folder.path() / "runs/a");
  };
  // However much there is later: a body that blows up is not excused by its size.
  EXPECT_DOUBLE_EQ(history("0,4,0,0\n1,4.5,900,6\n2,3.8,1000,-3\n"), 0.05);
  EXPECT_DOUBLE_EQ(history("0,4,0,0\n1,4,-1,0\n2,4,2,0\n"), 0.25) << "dissipation that adds";
  EXPECT_TRUE(std::isnan(history("0,0,0,0\n1,0,0,0\n"))) << "nothing was given";
  EXPECT_TRUE(std::isnan(spurious_energy(folder.path())));
  history("0,4,0,0\n1,5,0,0\n");
  const Row row = collect_results(study, plan, store, {}).rows[0];
  EXPECT_DOUBLE_EQ(row.spurious_energy, 0.25);
  study.map.unbalanced = 0.1;
  EXPECT_EQ(verdict(row, study.map), Verdict::unstable);
}

TEST_F(StudyResults, DamagedSummaryIsARowToo) {
  folder.file("runs/a/summary.json", "{");
  const Results results = collect_results(study, plan, store, {});
  EXPECT_NE(results.rows[0].failure.find("damaged"), std::string::npos) << results.rows[0].failure;
  EXPECT_TRUE(results.front.empty());
}

} // namespace
} // namespace tessera::app
