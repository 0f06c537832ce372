// SPDX-License-Identifier: MIT
#include "techniques/shadow/clipmap.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace estampe::shadow {
namespace {

const glm::dvec3 towards_sun = glm::normalize(glm::dvec3(0.4, 0.7, -0.3));

Clipmap clipmap_over(double radius_m, uint32_t size = 128)
{
    const Bounds casters{.min = glm::dvec3(-radius_m, 0, -radius_m),
                         .max = glm::dvec3(radius_m, 30, radius_m)};
    return fit_clipmap(sun_view(casters, {}, towards_sun, size), size, 0.03, casters.radius());
}

glm::dvec2 texel_at(const Clipmap& clipmap, uint32_t level, const glm::dvec3& point)
{
    return glm::dvec2(glm::dot(point, glm::dvec3(clipmap.view.right)),
                      glm::dot(point, glm::dvec3(clipmap.view.down))) /
           std::ldexp(clipmap.finest_m, static_cast<int>(level));
}

TEST(Clipmap, HasLevelsFromTheFinestToOneThatCoversAllCasters)
{
    for (const double radius_m : {1.0, 60.0, 900.0, 5000.0}) {
        const Clipmap clipmap = clipmap_over(radius_m);
        EXPECT_GE(clipmap.level_count, 1U);
        EXPECT_LE(clipmap.level_count, most_levels);
        if (clipmap.level_count < most_levels) {
            EXPECT_LE(clipmap.finest_m, 0.03);
            EXPECT_GT(clipmap.finest_m, 0.015);
        }
        for (const glm::dvec3 eye : {glm::dvec3(0.0), glm::dvec3(0.9 * radius_m, 3.0, -0.7 * radius_m)}) {
            const uint32_t last = clipmap.level_count - 1;
            const glm::ivec2 low = windows_about(clipmap, eye)[last];
            for (const double x : {-1.0, 1.0}) {
                for (const double z : {-1.0, 1.0}) {
                    const glm::dvec2 at =
                        texel_at(clipmap, last, {x * radius_m, 0.0, z * radius_m}) - glm::dvec2(low);
                    EXPECT_TRUE(at.x > 0 && at.y > 0 && at.x < clipmap.size && at.y < clipmap.size);
                }
            }
        }
    }
}

TEST(Clipmap, CoversAllCastersFromFarAwayToo)
{
    const Clipmap clipmap = clipmap_over(40.0);
    const uint32_t last = clipmap.level_count - 1;
    const glm::ivec2 low = windows_about(clipmap, {500.0, 900.0, -2000.0})[last];
    for (const double x : {-40.0, 40.0}) {
        for (const double z : {-40.0, 40.0}) {
            const glm::dvec2 at = texel_at(clipmap, last, {x, 0.0, z}) - glm::dvec2(low);
            EXPECT_TRUE(at.x > 0 && at.y > 0 && at.x < clipmap.size && at.y < clipmap.size);
        }
    }
}

TEST(Clipmap, MovesByWholeStepsAndKeepsTheEyeInTheMiddle)
{
    const Clipmap clipmap = clipmap_over(300.0);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 eye(0.13 * i, 1.7, -0.07 * i);
        const Windows windows = windows_about(clipmap, eye);
        for (uint32_t level = 0; level < clipmap.level_count; ++level) {
            EXPECT_EQ(windows[level] % 8, glm::ivec2(0));
            const glm::dvec2 off = texel_at(clipmap, level, eye) - glm::dvec2(windows[level]) - 64.0;
            EXPECT_LE(std::max(std::abs(off.x), std::abs(off.y)), 4.0 + 1e-6);
        }
    }
}

/// Texels of a level that are held, as the map holds them: modulo its size.
using Held = std::vector<std::vector<glm::ivec2>>;

/// Puts the texels of a piece where the map has them.
void put_home(const Clipmap& clipmap, const Piece& piece, Held& held)
{
    size_t count = 0;
    for (const PieceHome& home : homes(clipmap, piece)) {
        for (uint32_t y = 0; y < home.size.y; ++y) {
            for (uint32_t x = 0; x < home.size.x; ++x) {
                const size_t place = home.texel + y * clipmap.size + x;
                const size_t level_texels = size_t{clipmap.size} * clipmap.size;
                held.at(place / level_texels).at(place % level_texels) =
                    piece.low + glm::ivec2(home.from + glm::uvec2(x, y));
                ++count;
            }
        }
    }
    EXPECT_EQ(count, size_t{piece.size.x} * piece.size.y);
}

TEST(Clipmap, WhatIsUncoveredIsDrawnAndNothingElseIsNeeded)
{
    const Clipmap clipmap = clipmap_over(300.0, 64);
    const auto size = static_cast<int>(clipmap.size);
    Held held(clipmap.level_count, std::vector(static_cast<size_t>(size * size), glm::ivec2(-1 << 20)));
    Windows before;
    size_t drawn = 0;
    size_t quiet = 0;
    for (int i = 0; i < 120; ++i) {
        const glm::dvec3 eye(0.11 * i, 1.7, i < 60 ? 0.05 * i : 40.0 - 0.09 * i);
        const Windows now = windows_about(clipmap, eye);
        const auto pieces = uncovered(clipmap, before, now);
        quiet += pieces.empty() ? 1U : 0U;
        for (const Piece& piece : pieces) {
            drawn += static_cast<size_t>(piece.size.x) * piece.size.y;
            EXPECT_EQ(piece.size.x & (piece.size.x - 1), 0U);
            EXPECT_EQ(piece.size.y & (piece.size.y - 1), 0U);
            put_home(clipmap, piece, held);
        }
        for (uint32_t level = 0; level < clipmap.level_count; ++level) {
            for (int y = 0; y < size; ++y) {
                for (int x = 0; x < size; ++x) {
                    const glm::ivec2 texel = now[level] + glm::ivec2(x, y);
                    const glm::ivec2 place = texel & (size - 1);
                    ASSERT_EQ(held[level][static_cast<size_t>(place.y * size + place.x)], texel);
                }
            }
        }
        before = now;
    }
    EXPECT_GT(quiet, 10U);
    EXPECT_LT(drawn, 24U * clipmap.level_count * clipmap.size * clipmap.size);
}

} // namespace
} // namespace estampe::shadow
