// SPDX-License-Identifier: MIT
#include "techniques/shadow/sun/sun_map.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace estampe::shadow {
namespace {

const glm::dvec3 towards_clipmap_sun = glm::normalize(glm::dvec3(0.4, 0.7, -0.3));

Clipmap clipmap_over(double radius_m, uint32_t size = 128)
{
    const Bounds casters{.min = glm::dvec3(-radius_m, 0, -radius_m),
                         .max = glm::dvec3(radius_m, 30, radius_m)};
    return fit_clipmap(sun_view(casters, {}, towards_clipmap_sun, size), size, 0.03, casters.radius());
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

/// Texels of each level that are stored, at their wrapped positions in the map.
using Held = std::vector<std::vector<glm::ivec2>>;

/// Stores the texels of a piece at their positions in the map.
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

/// Range of a level's texels that a box covers in the sun's view.
std::pair<glm::ivec2, glm::ivec2> covered(const Clipmap& clipmap, uint32_t level, const Bounds& place)
{
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner((i & 1) != 0 ? place.max.x : place.min.x,
                                (i & 2) != 0 ? place.max.y : place.min.y,
                                (i & 4) != 0 ? place.max.z : place.min.z);
        low = glm::min(low, texel_at(clipmap, level, corner));
        high = glm::max(high, texel_at(clipmap, level, corner));
    }
    return {glm::ivec2(glm::floor(low)), glm::ivec2(glm::floor(high))};
}

Bounds cube_at(const glm::dvec3& middle, double half_m)
{
    return {.min = middle - half_m, .max = middle + half_m};
}

/// The listed tiles of a level. Texels wrap around the level; each tile must be listed once, inside its
/// square.
class ListedTiles {
public:
    ListedTiles(const Clipmap& clipmap, const std::vector<Piece>& squares, const std::vector<uint32_t>& tiles)
        : clipmap_(clipmap), squares_(squares)
    {
        for (const Piece& square : squares) {
            listed_.emplace_back(square.size.x / 64, std::vector(square.size.x / 64, false));
        }
        for (const uint32_t tile : tiles) {
            auto place = listed_.at(tile >> 16U).at(tile >> 8U & 255U).at(tile & 255U);
            EXPECT_FALSE(place) << tile;
            place = true;
        }
    }

    /// Number of these texels that are in a square but in no listed tile.
    [[nodiscard]] size_t missed(uint32_t level, const glm::ivec2& low, const glm::ivec2& last) const
    {
        size_t count = 0;
        for (size_t i = 0; i < squares_.size(); ++i) {
            const Piece& square = squares_[i];
            if (square.level != level) {
                continue;
            }
            const auto side = static_cast<int>(square.size.x);
            const bool is_whole = square.size.x == clipmap_.size;
            for (int y = std::max(low.y, square.low.y); y <= std::min(last.y, square.low.y + side - 1); ++y) {
                for (int x = std::max(low.x, square.low.x); x <= std::min(last.x, square.low.x + side - 1);
                     ++x) {
                    const glm::uvec2 at =
                        glm::uvec2(glm::ivec2(x, y) - (is_whole ? glm::ivec2(0) : square.low)) &
                        glm::uvec2(square.size.x - 1);
                    count += listed_[i][at.y / 64][at.x / 64] ? 0U : 1U;
                }
            }
        }
        return count;
    }

private:
    const Clipmap& clipmap_;
    const std::vector<Piece>& squares_;
    std::vector<std::vector<std::vector<bool>>> listed_; ///< square, row, column
};

TEST(Clipmap, ListsTheTilesOfAllThatMoves)
{
    const Clipmap clipmap = clipmap_over(300.0, 512); // the clipmap's windows move by half a tile
    const std::vector<std::vector<Bounds>> cases{
        {cube_at({1.0, 1.0, 0.5}, 0.3)},
        {cube_at({-2.0, 1.0, 0.5}, 0.3), cube_at({2.5, 2.0, -2.0}, 0.2), cube_at({150.0, 3.0, -80.0}, 4.0)},
        {{.min = {-1.0, 0.0, -200.0}, .max = {-0.9, 0.1, 200.0}}},
        {{.min = glm::dvec3(-1e6), .max = glm::dvec3(1e6)}}};
    std::vector<uint32_t> tiles;
    Windows before = windows_about(clipmap, {});
    for (size_t i = 0; i < 4 * cases.size(); ++i) {
        const std::vector<Bounds>& places = cases[i / 4];
        // The eye stands still, then moves on.
        const size_t step = i / 2;
        const Windows now = windows_about(clipmap, {0.9 * static_cast<double>(step), 1.0, 0.0});
        const auto pieces = uncovered(clipmap, before, now);
        const auto squares = squares_about(clipmap, now, places, pieces);
        list_tiles(clipmap, squares, places, pieces, tiles);
        const ListedTiles listed(clipmap, squares, tiles);
        for (uint32_t level = 0; level < clipmap.level_count; ++level) {
            for (const Bounds& place : places) {
                const auto [low, last] = covered(clipmap, level, place);
                EXPECT_EQ(listed.missed(level, low - 1, last + 1), 0U) << i << ", level " << level;
            }
        }
        for (const Piece& piece : pieces) {
            EXPECT_EQ(listed.missed(piece.level, piece.low, piece.low + glm::ivec2(piece.size) - 1), 0U) << i;
        }
        before = now;
    }
}

TEST(Clipmap, ListsFewTilesOfWhatIsFarApart)
{
    const Clipmap clipmap = clipmap_over(300.0, 2048);
    const std::vector<Bounds> places{cube_at({-12.0, 1.0, 3.0}, 0.3), cube_at({11.0, 2.0, -9.0}, 0.3)};
    const auto squares = squares_about(clipmap, windows_about(clipmap, {}), places, {});
    std::vector<uint32_t> tiles;
    list_tiles(clipmap, squares, places, {}, tiles);
    size_t all = 0;
    size_t most = 0;
    for (const Piece& square : squares) {
        all += size_t{square.size.x} / 64 * (square.size.y / 64);
        for (const Bounds& place : places) {
            const auto [low, last] = covered(clipmap, square.level, place);
            const glm::ivec2 across = (last - low + 4) / 64 + 2;
            most += static_cast<size_t>(across.x * across.y);
        }
    }
    EXPECT_GT(all, 1000U);
    EXPECT_LE(tiles.size(), most);
    EXPECT_LT(20 * tiles.size(), all);
}

} // namespace
} // namespace estampe::shadow
