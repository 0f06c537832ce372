// SPDX-License-Identifier: MIT
// Coverage of the sky by puffs, counted point by point, and the lists of puffs.
#include "techniques/sky/clouds/cover.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace estampe::sky {
namespace {

constexpr uint32_t cells = 64;

CoverField field_of(uint32_t seed, float turn = 0.0F)
{
    return cover_field({.cells = cells, .mass_cells = 6, .turn = turn, .seed = seed});
}

/// Vector from one place of the repeating tile to another, the shortest way.
float away(glm::vec2 a, glm::vec2 b)
{
    const glm::vec2 d = a - b;
    return glm::length(d - static_cast<float>(cells) * glm::round(d / static_cast<float>(cells)));
}

/// Share covered by puffs, counted on a grid of points independent of those that limit_for() uses.
double covered_share(std::span<const shared::CloudPuff> puffs)
{
    constexpr uint32_t side = 160;
    const PuffLists lists = list_puffs(puffs, cells);
    uint32_t covered = 0;
    for (uint32_t i = 0; i < side * side; ++i) {
        const glm::vec2 place = (glm::vec2(i % side, i / side) + 0.37F) * (static_cast<float>(cells) / side);
        const size_t cell = static_cast<size_t>(place.y) * cells + static_cast<size_t>(place.x);
        const auto in_cell =
            std::span(lists.puffs).subspan(lists.starts[cell], lists.starts[cell + 1] - lists.starts[cell]);
        covered += std::ranges::any_of(in_cell, [&](const shared::CloudPuff& puff) {
            return puff.centre.y == 0.0F &&
                   glm::distance(place, {puff.centre.x, puff.centre.z}) < puff.radius;
        });
    }
    return static_cast<double>(covered) / (side * side);
}

TEST(CloudCover, IsTheShareThatIsAskedFor)
{
    const PuffShape heaps{.levels = 4};
    const PuffShape flocks{.radius = 0.62F, .growth = 0.2F};
    for (const PuffShape& shape : {heaps, flocks}) {
        for (const uint32_t seed : {1U, 2U, 3U}) {
            const CoverField field = field_of(seed);
            double before = 0.0;
            for (const float share : {0.05F, 0.2F, 0.4F, 0.6F, 0.8F}) {
                const float limit = limit_for(field, shape, share, seed);
                const double covered = covered_share(puffs_of(field, shape, limit, seed));
                EXPECT_NEAR(covered, static_cast<double>(share), 0.015) << "seed " << seed;
                EXPECT_GT(covered, before);
                before = covered;
            }
        }
    }
}

TEST(CloudCover, OfStreaksIsTheMeanOfTheirDensity)
{
    const CoverField field = cover_field({.cells = 32, .mass_cells = 4, .seed = 5});
    for (const float share : {0.05F, 0.3F, 0.7F}) {
        const std::vector<float> density = streak_density(field, share);
        double sum = 0.0;
        for (const float value : density) {
            EXPECT_GE(value, 0.0F);
            EXPECT_LE(value, 1.0F);
            sum += static_cast<double>(value);
        }
        EXPECT_NEAR(sum / static_cast<double>(density.size()), static_cast<double>(share), 1e-3);
    }
}

TEST(CloudCover, ChangesSmoothlyKeepsItsSpreadAndComesBack)
{
    const auto spread = [](const CoverField& field) {
        double sum = 0.0;
        for (const float value : field.values) {
            sum += std::pow(static_cast<double>(value) - 0.5, 2.0);
        }
        return std::sqrt(sum / static_cast<double>(field.values.size()));
    };
    const auto difference = [](const CoverField& a, const CoverField& b) {
        float most = 0.0F;
        for (size_t i = 0; i < a.values.size(); ++i) {
            most = std::max(most, std::abs(a.values[i] - b.values[i]));
        }
        return most;
    };
    const CoverField first = field_of(7);
    EXPECT_LT(difference(first, field_of(7, 1.0F)), 1e-5F);
    EXPECT_GT(difference(first, field_of(7, 0.25F)), 0.5F) << "and becomes another in between";
    for (int i = 0; i < 16; ++i) {
        const float turn = static_cast<float>(i) / 16.0F;
        EXPECT_NEAR(spread(field_of(7, turn)), spread(first), 0.25 * spread(first)) << turn;
        EXPECT_LT(difference(field_of(7, turn), field_of(7, turn + 1e-3F)), 0.02F) << turn;
    }
}

TEST(CloudCover, ListsHaveEveryPuffThatAPlaceIsUnder)
{
    const CoverField field = field_of(3);
    const PuffShape shape{.levels = 4};
    const auto puffs = puffs_of(field, shape, limit_for(field, shape, 0.5F, 3), 3);
    const PuffLists lists = list_puffs(puffs, cells);
    ASSERT_EQ(lists.starts.size(), size_t{cells} * cells + 1);
    for (uint32_t i = 0; i < 600; ++i) {
        // Many puffs lie at the edge of the tile.
        const float x = i % 3 == 0 ? 0.02F : static_cast<float>(cells) * hashed(i, 1, 1);
        const glm::vec2 place(x, static_cast<float>(cells) * hashed(i, 2, 1));
        const size_t cell = static_cast<size_t>(place.y) * cells + static_cast<size_t>(place.x);
        const auto is_over = [&](const shared::CloudPuff& puff) {
            return away(place, {puff.centre.x, puff.centre.z}) < 1.15F * puff.radius;
        };
        const auto is_listed_over = [&](const shared::CloudPuff& puff) {
            return glm::distance(place, {puff.centre.x, puff.centre.z}) < 1.15F * puff.radius;
        };
        const auto in_cell =
            std::span(lists.puffs).subspan(lists.starts[cell], lists.starts[cell + 1] - lists.starts[cell]);
        EXPECT_EQ(std::ranges::count_if(in_cell, is_listed_over), std::ranges::count_if(puffs, is_over)) << i;
    }
}

TEST(CloudCover, HasEachPuffOnceByTheCellOfItsMiddle)
{
    const CoverField field = field_of(3);
    const PuffShape shape{.levels = 4};
    const auto puffs = puffs_of(field, shape, limit_for(field, shape, 0.5F, 3), 3);
    const PuffLists lists = list_homes(puffs, cells);
    ASSERT_EQ(lists.starts.size(), size_t{cells} * cells + 1);
    ASSERT_EQ(lists.puffs.size(), puffs.size());
    ASSERT_EQ(lists.starts.back(), puffs.size());
    for (uint32_t cell = 0; cell < cells * cells; ++cell) {
        for (uint32_t i = lists.starts[cell]; i < lists.starts[cell + 1]; ++i) {
            const glm::uvec2 home(lists.puffs[i].centre.x, lists.puffs[i].centre.z);
            EXPECT_EQ(home.y * cells + home.x, cell);
            EXPECT_TRUE(std::ranges::any_of(
                puffs, [&](const shared::CloudPuff& puff) { return puff.centre == lists.puffs[i].centre; }));
        }
    }
}

} // namespace
} // namespace estampe::sky
