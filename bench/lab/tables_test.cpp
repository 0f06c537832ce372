// SPDX-License-Identifier: MIT
#include "lab/tables.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <estampe/error.hpp>
#include <gtest/gtest.h>

namespace estampe::lab {
namespace {

BenchPoint point(double amount, double cost_ms, double noise_ms = 0.0)
{
    const Spread cost{.low = cost_ms - noise_ms, .median = cost_ms, .high = cost_ms + noise_ms};
    return {.amount = amount,
            .gpu_ms = cost,
            .wall_ms = {1.0, 2.0, 3.0},
            .memory_bytes = 1U << 20U,
            .techniques = {{"light", 0.5 * cost_ms}, {"hatch", 0.25 * cost_ms}}};
}

BenchResult result(std::vector<BenchPoint> points)
{
    return {.device = "a device",
            .driver = "its driver",
            .width = 64,
            .height = 36,
            .frames = 3,
            .series = {{.name = "lamps", .work = "lamps", .points = std::move(points)}}};
}

TEST(Bench, SpreadsAreQuartiles)
{
    const Spread spread = spread_of({5.0, 1.0, 4.0, 2.0, 3.0});
    EXPECT_EQ(spread.low, 2.0);
    EXPECT_EQ(spread.median, 3.0);
    EXPECT_EQ(spread.high, 4.0);
    EXPECT_EQ(spread_of({7.0}).high, 7.0);
}

TEST(Bench, GrowthIsThePowerOfTheWork)
{
    const BenchResult measured =
        result({point(10, 1.0), point(100, 10.0), point(1000, 1000.0), point(2000, 1000.0)});
    const BenchSeries& series = measured.series.front();
    EXPECT_EQ(growth(series, 0, false), 0.0);
    EXPECT_NEAR(growth(series, 1, false), 1.0, 1e-12);
    EXPECT_NEAR(growth(series, 2, false), 2.0, 1e-12);
    EXPECT_NEAR(growth(series, 3, false), 0.0, 1e-12);
    EXPECT_NEAR(growth(series, 3, true), 0.0, 1e-12) << "of wall time";
}

TEST(Bench, ComeBackFromJsonAsTheyWere)
{
    const auto file = std::filesystem::temp_directory_path() / "estampe_bench_test.json";
    const BenchResult written = result({point(10, 1.5, 0.25), point(100, 3.0)});
    std::ofstream(file) << json_of(written);
    const BenchResult read = read_bench_json(file.string());
    EXPECT_EQ(json_of(read), json_of(written));
    EXPECT_EQ(text_of(read), text_of(written));
    EXPECT_EQ(csv_of(read), csv_of(written));
    std::ofstream(file) << "{\"device\": 3}";
    EXPECT_THROW(static_cast<void>(read_bench_json(file.string())), Error);
    std::filesystem::remove(file);
    EXPECT_THROW(static_cast<void>(read_bench_json(file.string())), Error);
}

TEST(Bench, ComparisonsKnowWhatIsNoise)
{
    const BenchResult before = result({point(10, 1.0, 0.1), point(100, 1.0, 0.01)});
    const std::string same = comparison_of(before, result({point(10, 1.1, 0.1)}));
    EXPECT_EQ(same.find("slower"), std::string::npos) << same;
    const std::string slower = comparison_of(before, result({point(100, 1.1, 0.01)}));
    EXPECT_NE(slower.find("1.100"), std::string::npos) << slower;
    EXPECT_NE(slower.find("slower"), std::string::npos) << slower;
    EXPECT_NE(comparison_of(before, result({point(100, 0.9, 0.01)})).find("faster"), std::string::npos);
    EXPECT_THROW(static_cast<void>(comparison_of(before, result({point(7, 1.0)}))), Error);
}

TEST(Bench, PlotsHoldTheirLine)
{
    const BenchResult measured = result({point(10, 1.0), point(100, 10.0), point(1000, 100.0)});
    const std::string svg = plot_of(measured.series.front(), measured);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_NE(svg.find(">1.00</text>"), std::string::npos) << "grows as the work does";
    EXPECT_EQ(std::ranges::count(svg, '<'), std::ranges::count(svg, '>'));
}

TEST(Bench, SeriesBeginSmallAndGrow)
{
    for (const Series& series : all_series()) {
        EXPECT_TRUE(std::ranges::is_sorted(series.amounts)) << series.name;
        EXPECT_GE(series.amounts.size(), 3U) << series.name;
        EXPECT_GE(series.most_on_processor, series.amounts.front()) << series.name;
    }
    const Scene field = field_of_balls(1e6);
    const size_t of_a_ball = field.meshes.back().primitives.front().indices.size() / 3;
    EXPECT_NEAR(static_cast<double>(64 * of_a_ball), 1e6, 5e4);
}

} // namespace
} // namespace estampe::lab
