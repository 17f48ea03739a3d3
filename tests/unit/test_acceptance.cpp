// The comparison with a paper: verdicts, and its table for runs that are made up.

#include "known_flows.hpp"
#include "studies/acceptance.hpp"
#include "studies/lagrone2019.hpp"
#include "studies/paper_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace skein {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Acceptance, NumbersRangesAndWordsHaveVerdicts) {
  EXPECT_EQ(compare_number(10.9, 10.99, 0.1).verdict, Verdict::agrees);
  EXPECT_EQ(compare_number(10.9, 11.01, 0.1).verdict, Verdict::differs);
  EXPECT_EQ(compare_number(10.9, 11.01, 0.1).difference, "+0.11");
  EXPECT_EQ(compare_number(10.9, nan, 0.1).verdict, Verdict::not_reached);
  EXPECT_EQ(compare_range(1.0, 5.0, 5.0).verdict, Verdict::agrees);
  EXPECT_EQ(compare_range(1.0, 5.0, 0.9).verdict, Verdict::differs);
  EXPECT_EQ(compare_range(1.0, std::numeric_limits<double>::infinity(), 1e9).paper, ">= 1");
  EXPECT_EQ(compare_range(1.0, 5.0, nan).verdict, Verdict::not_reached);
  EXPECT_EQ(compare_word("S", "S").verdict, Verdict::agrees);
  EXPECT_EQ(compare_word("S", "snake").verdict, Verdict::differs);
  EXPECT_EQ(compare_word("S", "").verdict, Verdict::not_reached);
}

TEST(Acceptance, TheTableIsAlignedAndCounted) {
  AcceptanceRow agrees = compare_number(1.0, 1.0, 0.1), differs = compare_word("a \"quoted\" word", "other");
  agrees.quantity = "a long name of a quantity";
  const std::string text = describe_rows({agrees, differs});
  EXPECT_NE(text.find("2 rows: 1 agree, 1 differ, 0 not reached"), std::string::npos);
  const auto column = text.find("verdict");
  const auto second_line = text.find('\n') + 1;
  EXPECT_EQ(text.substr(second_line + column, 6), "agrees");
  EXPECT_EQ(worst({agrees, differs}), Verdict::differs);
  EXPECT_EQ(worst({agrees, AcceptanceRow{}}), Verdict::not_reached);
  EXPECT_EQ(worst({agrees}), Verdict::agrees);
  EXPECT_NE(describe_rows_as_json({differs}).find("\"a \\\"quoted\\\" word\""), std::string::npos);
}

TEST(PaperTable, NeedsNoRunsForGeometry) {
  const auto rows = compare_with_paper(Figure::table1, {}, {});
  EXPECT_EQ(rows.size(), 14u);
  for (const AcceptanceRow& row : rows) EXPECT_EQ(row.verdict, Verdict::agrees) << row.quantity << " " << row.skein;
}

TEST(PaperTable, RunsThatAreNotThereAreNotReached) {
  for (const PaperFigure& figure : list_paper_figures()) {
    if (figure.figure == Figure::table1) continue;
    const auto rows = compare_with_paper(figure.figure, {}, {});
    EXPECT_FALSE(rows.empty()) << figure.name;
    for (const AcceptanceRow& row : rows) {
      EXPECT_EQ(row.verdict, Verdict::not_reached) << row.quantity;
      EXPECT_EQ(row.figure, figure.name);
      EXPECT_FALSE(row.source.empty()) << row.quantity;
    }
  }
}

/// A rigid rod on its orbit (Jeffery 1922), half turn of the given duration.
RunAnalysis make_rigid_run(const double half_period, const double end) {
  RunAnalysis analysis;
  analysis.scene = make_paper_scene(80, end);
  analysis.fibers = make_fibers(analysis.scene.fibers);
  const Fiber& fiber = analysis.fibers[0];
  analysis.histories.emplace_back(fiber, make_flow_frame(shear_gradient), 0.4);
  const double sum = 2.5 * half_period / std::numbers::pi;  // r + 1/r
  const double ratio = 0.5 * (sum + std::sqrt(sum * sum - 4.0));
  for (int i = 0; 0.05 * i <= end; ++i) {
    const double phase = 2.5 * 0.05 * i / sum;
    const Vec3 along{std::cos(phase) * ratio, -std::sin(phase), 0.0};
    std::vector<Vec3> line;
    for (int s = 0; s < fiber.config.sections; ++s)
      line.push_back((s - 0.5 * (fiber.config.sections - 1)) * fiber.spacing() / norm(along) * along);
    analysis.time.push_back(0.05 * i);
    analysis.histories[0].add(0.05 * i, line);
  }
  return analysis;
}

TEST(PaperTable, ARigidRodHasTheOrbitButNotTheBends) {
  PaperRuns runs;
  runs.emplace("L0139", make_rigid_run(10.9, 12.0));
  int n_angles = 0;
  for (const AcceptanceRow& row : compare_with_paper(Figure::figure2, runs, {})) {
    const bool is_angle = row.quantity.find("0.139: angle") != std::string::npos ||
                          row.quantity.find("0.139: half period") != std::string::npos;
    n_angles += is_angle;
    if (is_angle) {
      EXPECT_EQ(row.verdict, Verdict::agrees) << row.quantity << ": " << row.skein;
    } else if (row.quantity.find("slight bends") != std::string::npos ||
               row.quantity.find("compression") != std::string::npos) {
      EXPECT_EQ(row.verdict, Verdict::differs) << row.quantity << ": " << row.skein;
    } else if (row.quantity.find("0.196") != std::string::npos) {
      EXPECT_EQ(row.verdict, Verdict::not_reached) << row.quantity;
    }
  }
  EXPECT_EQ(n_angles, 6);
  // A run that has not come far enough yet.
  runs.clear();
  runs.emplace("L0139", make_rigid_run(10.9, 5.0));
  const auto rows = compare_with_paper(Figure::figure2, runs, {});
  EXPECT_EQ(rows[0].verdict, Verdict::agrees);
  EXPECT_EQ(rows[2].verdict, Verdict::not_reached);
}

TEST(PaperTimings, TheCrossoverLiesBetweenTheSizesByAPowerLaw) {
  // direct = (n / 1000)^2 ms, fmm = n / 500 ms: equal at 2000 nodes.
  std::vector<SumTiming> timings;
  for (const int n : {500, 1500, 4500, 13500}) timings.push_back({n, 1e-9 * n * n, 2e-6 * n, 1e-5});
  EXPECT_NEAR(find_crossover(timings), 2000.0, 1e-6);
  // A size that is slower once more moves it up.
  timings[2].fmm_seconds = 2.0 * timings[2].direct_seconds;
  EXPECT_GT(find_crossover(timings), 4500.0);
  timings.back().fmm_seconds = 1.0;
  EXPECT_TRUE(std::isnan(find_crossover(timings)));
  EXPECT_EQ(find_crossover({{700, 2.0, 1.0, 0.0}}), 700.0);
  EXPECT_TRUE(std::isnan(find_crossover({})));
}

TEST(PaperTimings, RowsOfFigure8) {
  const auto rows = compare_with_paper(Figure::figure8, {}, {{10000, 1.0, 1.5, 1e-5}, {23634, 5.0, 3.5, 2e-4}});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].verdict, Verdict::agrees);   // below 17 000, by interpolation
  EXPECT_EQ(rows[1].verdict, Verdict::differs);  // 1.43 times
  EXPECT_EQ(rows[2].verdict, Verdict::differs);
}

TEST(PaperTable, ASlowRodDiffers) {
  PaperRuns runs;
  runs.emplace("L0139", make_rigid_run(12.0, 13.0));
  const auto rows = compare_with_paper(Figure::figure2, runs, {});
  EXPECT_EQ(rows[0].verdict, Verdict::differs);
}

}  // namespace
}  // namespace skein
