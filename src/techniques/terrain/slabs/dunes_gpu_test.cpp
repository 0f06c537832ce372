// SPDX-License-Identifier: MIT
// Slabs form dunes: tests their slopes, their crests and their movement.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "techniques/terrain/slabs/slabs.hpp"

namespace estampe::terrain {
namespace {

constexpr int dunes_side = 128;

/// Heights in metres of a field that repeats, one metre per cell.
class DuneField {
public:
    explicit DuneField(std::vector<float> heights_m)
        : heights_m_(std::move(heights_m)),
          mean_m_(std::accumulate(heights_m_.begin(), heights_m_.end(), 0.0) / (dunes_side * dunes_side))
    {
    }

    [[nodiscard]] double at(int x, int y) const
    {
        return static_cast<double>(
            heights_m_[static_cast<size_t>((y & (dunes_side - 1)) * dunes_side + (x & (dunes_side - 1)))]);
    }

    [[nodiscard]] glm::dvec2 gradient(int x, int y) const
    {
        return 0.5 * glm::dvec2(at(x + 1, y) - at(x - 1, y), at(x, y + 1) - at(x, y - 1));
    }

    /// Mean product of the deviations of heights here and those of `other` at an offset in cells.
    [[nodiscard]] double correlation(const DuneField& other, glm::ivec2 away) const
    {
        double sum = 0.0;
        for (int i = 0; i < dunes_side * dunes_side; ++i) {
            const glm::ivec2 there = glm::ivec2(i % dunes_side, i / dunes_side) + away;
            sum +=
                (at(i % dunes_side, i / dunes_side) - mean_m_) * (other.at(there.x, there.y) - other.mean_m_);
        }
        return sum / (dunes_side * dunes_side);
    }

private:
    std::vector<float> heights_m_;
    double mean_m_;
};

/// A field that is simulated step by step.
class Growing {
public:
    explicit Growing(const SlabStyle& style) : style_(style), field_(test::shared_device(), style, dunes_side)
    {
    }

    Growing(const SlabStyle& style, const std::vector<float>& start)
        : style_(style), field_(test::shared_device(), style, dunes_side, start)
    {
    }

    DuneField after(uint32_t steps)
    {
        constexpr uint32_t at_once = 20;
        for (; steps > at_once; steps -= at_once) {
            gpu::Graph graph;
            static_cast<void>(test::run_and_read_as<float>(graph, field_.add_steps(graph, style_, at_once)));
        }
        gpu::Graph graph;
        return DuneField(test::run_and_read_as<float>(graph, field_.add_steps(graph, style_, steps)));
    }

private:
    SlabStyle style_;
    SlabField field_;
};

/// Distance in cells at which the autocorrelation has halved.
int correlation_length(const DuneField& ground, glm::ivec2 towards)
{
    const double half = 0.5 * ground.correlation(ground, {0, 0});
    int cells = 1;
    while (cells < dunes_side / 2 && ground.correlation(ground, cells * towards) > half) {
        ++cells;
    }
    return cells;
}

/// The offset within `reach` cells at which `later` correlates best with `ground`.
glm::ivec2 moved_between(const DuneField& ground, const DuneField& later, int reach)
{
    glm::ivec2 best(0);
    for (int i = 0; i < (2 * reach + 1) * (2 * reach + 1); ++i) {
        const glm::ivec2 cells(i % (2 * reach + 1) - reach, i / (2 * reach + 1) - reach);
        if (ground.correlation(later, cells) > ground.correlation(later, best)) {
            best = cells;
        }
    }
    return best;
}

struct Slopes {
    std::vector<int> lee = std::vector<int>(91); ///< number of cells that fall downwind, by whole degrees
    double too_steep = 0.0;                      ///< share of all cells that are steeper than 34 degrees
};

Slopes slopes_of(const DuneField& ground)
{
    Slopes slopes;
    for (int i = 0; i < dunes_side * dunes_side; ++i) {
        const glm::dvec2 gradient = ground.gradient(i % dunes_side, i / dunes_side);
        const double deg = glm::degrees(std::atan(glm::length(gradient)));
        slopes.too_steep += deg > 34.0 ? 1.0 / (dunes_side * dunes_side) : 0.0;
        slopes.lee[static_cast<size_t>(deg)] += gradient.x < 0.0 ? 1 : 0;
    }
    return slopes;
}

TEST(SlabDunes, GrowWithSlipFacesAndCrestsAcrossTheWindAndWanderWithIt)
{
    Growing growing({.depth_m = 4.0F, .speedup_per_m = 0.02F, .smooth_cells = 0});
    const DuneField young = growing.after(100);
    const DuneField grown = growing.after(1100);
    const double roughness_m = std::sqrt(grown.correlation(grown, {0, 0}));
    EXPECT_GT(roughness_m, 5.0 * std::sqrt(young.correlation(young, {0, 0})));
    EXPECT_GT(roughness_m, 1.5);
    EXPECT_GT(correlation_length(grown, {0, 1}), 1.3 * correlation_length(grown, {1, 0}));

    const Slopes slopes = slopes_of(grown);
    EXPECT_LE(slopes.too_steep, 0.01);
    const auto most = std::max_element(slopes.lee.begin(), slopes.lee.end());
    EXPECT_GE(most - slopes.lee.begin(), 30);
    EXPECT_LT(most - slopes.lee.begin(), 34);
    const int slip_face = std::accumulate(slopes.lee.begin() + 30, slopes.lee.begin() + 34, 0);
    EXPECT_GT(slip_face, 2 * std::accumulate(slopes.lee.begin() + 20, slopes.lee.begin() + 24, 0));

    const glm::ivec2 moved = moved_between(grown, growing.after(60), 8);
    EXPECT_GE(moved.x, 2);
    EXPECT_LE(moved.x, 7);
    EXPECT_LE(std::abs(moved.y), 1);
}

/// A ridge across the wind, with a given initial height of its crest.
struct Ridge {
    double crest_m = 0.0;
    double celerity_m = 0.0; ///< speed per step
};

Ridge wandering_ridge(float crest_m)
{
    const SlabStyle style{.wind_spread_deg = 0.0F, .speedup_per_m = 0.0F, .stay_on_rock = 0.6F};
    std::vector<float> start;
    for (int i = 0; i < dunes_side * dunes_side; ++i) {
        const float x = static_cast<float>(i % dunes_side) - 3.0F * crest_m;
        start.push_back(std::max(x < 0.0F ? crest_m + x / 3.0F : crest_m - x / 1.5F, 0.0F));
    }
    Growing growing(style, start);
    Ridge ridge;
    // The phase of the wave with the field's length gives the ridge's position, finer than a cell.
    const auto place = [&](const DuneField& ground) {
        glm::dvec2 wave(0.0);
        ridge.crest_m = 0.0;
        for (int x = 0; x < dunes_side; ++x) {
            double height = 0.0;
            for (int y = 0; y < dunes_side; ++y) {
                height += ground.at(x, y) / dunes_side;
            }
            const double angle = 2.0 * std::numbers::pi * x / dunes_side;
            wave += height * glm::dvec2(std::cos(angle), std::sin(angle));
            ridge.crest_m = std::max(ridge.crest_m, height);
        }
        return std::atan2(wave.y, wave.x) * dunes_side / (2.0 * std::numbers::pi);
    };
    constexpr int steps = 200;
    const double before = place(growing.after(200));
    ridge.celerity_m = std::fmod(place(growing.after(steps)) - before + dunes_side, dunes_side) / steps;
    return ridge;
}

TEST(SlabDunes, HighOnesWanderSlowlierAsTheirFluxSays)
{
    // Flux of sand that reaches a crest: slabs are lifted and hop until they stay.
    const double flux_m2 = 0.4 * 0.1 * 5.0 / 0.6;
    const Ridge low = wandering_ridge(6.0F);
    const Ridge high = wandering_ridge(9.0F);
    EXPECT_GT(high.crest_m, 1.5 * low.crest_m);
    EXPECT_NEAR(low.celerity_m * low.crest_m / flux_m2, 0.9, 0.1);
    EXPECT_NEAR(high.celerity_m * high.crest_m / flux_m2, 0.9, 0.1);
    EXPECT_NEAR(low.celerity_m / high.celerity_m, high.crest_m / low.crest_m,
                0.15 * high.crest_m / low.crest_m);
}

} // namespace
} // namespace estampe::terrain
