// Comparison of runs: kept runs, marks, and the chart.
#include "measure/convergence/convergence_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace blush::test::TEST_FILE {
namespace {

using Kind = ConvergencePoint::Kind;
using Origin = ConvergenceRun::Origin;

ConvergencePoint at(int64_t spp, Kind kind = Kind::estimated, double scale = 1) {
    const double relmse = scale / double(spp);
    return {kind,
            0.1 * double(spp),
            spp,
            {true, std::sqrt(relmse), 0.9 * std::sqrt(relmse), 1.1 * std::sqrt(relmse)},
            {true, relmse, relmse / 2, relmse * 2}};
}

void record(ConvergenceRuns& runs, int points) {
    for (int i = 0; i < points; ++i) runs.live()->record.add(at(int64_t(1) << i));
}

std::vector<std::string> names(const ConvergenceRuns& runs) {
    std::vector<std::string> all;
    for (const ConvergenceRun& r : runs.all()) all.push_back(r.record.name);
    return all;
}

TEST(ConvergenceRuns, AnEditEndsARunWithAMarkAndBeginsAnother) {
    ConvergenceRuns runs;
    EXPECT_FALSE(runs.live());
    const int first = runs.begin("Opened");
    record(runs, 6);
    const int second = runs.begin("Change light sun");
    EXPECT_EQ(runs.live()->id, second);
    ASSERT_TRUE(runs.find(first));
    EXPECT_EQ(runs.find(first)->origin, Origin::earlier);
    ASSERT_EQ(runs.find(first)->record.marks().size(), 1u);
    EXPECT_EQ(runs.find(first)->record.marks()[0].label, "Change light sun");
    EXPECT_EQ(runs.find(first)->record.marks()[0].spp, 32) << "where it ended";
    EXPECT_NE(runs.find(first)->color, runs.find(second)->color);
}

TEST(ConvergenceRuns, EditsThatKeepTheRunAddAMark) {
    ConvergenceRuns runs;
    runs.begin("Opened");
    runs.mark("too early");
    record(runs, 3);
    runs.mark("Change display settings");
    EXPECT_EQ(runs.all().size(), 1u);
    ASSERT_EQ(runs.live()->record.marks().size(), 1u) << "no mark before the first point";
    EXPECT_EQ(runs.live()->record.marks()[0].spp, 4);
}

TEST(ConvergenceRuns, RunsOfADragAreDropped) {
    ConvergenceRuns runs;
    const int first = runs.begin("Opened");
    record(runs, 8);
    for (int i = 0; i < 50; ++i) {
        runs.begin("Change light sun");
        record(runs, i % int(ConvergenceRuns::min_points));
    }
    record(runs, 8);
    EXPECT_EQ(names(runs), (std::vector<std::string>{"Opened", "Change light sun"}));
    EXPECT_EQ(runs.find(first)->record.marks().size(), 1u);
}

TEST(ConvergenceRuns, OldestRunsAreRemovedUnlessKept) {
    ConvergenceRuns runs;
    runs.begin("0");
    record(runs, 8);
    runs.live()->kept = true;
    for (int i = 1; i <= 6; ++i) {
        runs.begin(std::to_string(i));
        record(runs, 8);
    }
    ConvergenceRecord stored;
    stored.name = "stored";
    runs.add_stored(stored);
    EXPECT_EQ(names(runs), (std::vector<std::string>{"0", "2", "3", "4", "5", "6", "stored"}));
    runs.begin("7");
    EXPECT_EQ(names(runs).back(), "stored") << "behind the live one";
    std::set<size_t> colors;
    for (const ConvergenceRun& r : runs.all()) colors.insert(r.color);
    EXPECT_EQ(colors.size(), runs.all().size());
    const int live = runs.live()->id;
    runs.remove(live);
    EXPECT_TRUE(runs.live()) << "the live run cannot be removed";
    runs.remove(runs.all().front().id);
    EXPECT_EQ(names(runs).front(), "3");
    runs.clear();
    EXPECT_EQ(names(runs), (std::vector<std::string>{"stored"}));
}

// Names must be unique, since a table identifies runs by name.
TEST(ConvergenceRuns, NamesAreUnique) {
    ConvergenceRuns runs;
    ConvergenceRecord stored;
    stored.name = "a";
    runs.add_stored(stored);
    runs.add_stored(stored);
    runs.begin("a");
    record(runs, 8);
    runs.begin("a");
    EXPECT_EQ(names(runs), (std::vector<std::string>{"a 3", "a 4", "a", "a 2"}));
    const int live = runs.live()->id;
    runs.rename(live, "a 2");
    EXPECT_EQ(runs.live()->record.name, "a 2 2");
    runs.rename(live, "a 2 2");
    runs.rename(live, "");
    EXPECT_EQ(runs.live()->record.name, "a 2 2");
}

TEST(ConvergencePlot, HasACurveForEachKindOfEachShownRunAndTheGuide) {
    ConvergenceRuns runs;
    EXPECT_TRUE(convergence_plot(runs, {}).plot.curves.empty());
    runs.begin("Opened");
    for (int i = 0; i < 6; ++i) runs.live()->record.add(at(int64_t(1) << i, Kind::estimated, 3));
    const int second = runs.begin("Change light sun");
    record(runs, 6);
    runs.live()->record.add(at(4, Kind::denoised, 0.1));
    runs.live()->record.add({Kind::measured, 0.4, 4, {true, 0.5, 0.4, 0.6}, {}}); // relmse unknown
    const ConvergencePlot p = convergence_plot(runs, {ErrorMetric::rmse, ProgressAxis::spp, 0.01, false});
    ASSERT_EQ(p.plot.curves.size(), 5u);
    ASSERT_EQ(p.sources.size(), 4u);
    for (size_t i = 0; i < p.sources.size(); ++i) EXPECT_EQ(p.sources[i].points.size(), p.plot.curves[i].points.size());
    EXPECT_EQ(p.plot.curves[0].name, "Opened");
    EXPECT_EQ(p.plot.curves[3].name, "Change light sun, denoised");
    EXPECT_EQ(p.plot.curves[1].color, p.plot.curves[3].color) << "one run, one colour";
    EXPECT_NE(p.plot.curves[0].color, p.plot.curves[1].color);
    EXPECT_EQ(p.plot.marks.size(), 1u);
    EXPECT_EQ(p.plot.marks[0].x, 32);
    EXPECT_EQ(p.plot.levels.size(), 1u);
    const PlotCurve& guide = p.plot.curves.back();
    EXPECT_NEAR(guide.points[0].y, 1, 1e-9) << "through the live run's first point";
    EXPECT_NEAR(guide.points[1].y, std::pow(32, -0.5), 1e-9);
    const ConvergencePlot relative = convergence_plot(runs, {ErrorMetric::relmse, ProgressAxis::seconds, 0, true});
    EXPECT_EQ(relative.plot.curves.size(), 4u) << "no relMSE, no curve";
    EXPECT_NEAR(relative.plot.curves.back().points[1].y / relative.plot.curves.back().points[0].y, 1.0 / 32, 1e-9);
    EXPECT_TRUE(relative.plot.levels.empty());
    runs.find(second)->shown = false;
    EXPECT_EQ(convergence_plot(runs, {}).plot.curves.size(), 2u);
}

} // namespace
} // namespace blush::test::TEST_FILE
