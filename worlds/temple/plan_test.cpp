// SPDX-License-Identifier: MIT
// Checks rooms, paths, columns and walls of a hundred temples, without rendering.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "temple/lamps.hpp"
#include "temple/plan.hpp"
#include "temple/sand.hpp"
#include "temple/site.hpp"
#include "temple/wall.hpp"

namespace temple {
namespace {

constexpr uint64_t seed_count = 100;

/// Distance between two rectangles given by centre and half size; negative if they overlap.
float gap_m(const glm::vec2& a, const glm::vec2& half_a, const glm::vec2& b, const glm::vec2& half_b)
{
    const glm::vec2 off = glm::abs(a - b) - half_a - half_b;
    return std::max(off.x, off.y);
}

TEST(TemplePlan, EveryModuleIsInOneRoom)
{
    for (uint64_t seed = 0; seed < seed_count; ++seed) {
        const Plan plan = make_plan(seed);
        for (int z = 0; z < modules_z; ++z) {
            for (int x = 0; x < modules_x; ++x) {
                const auto holds = [&](const Room& room) {
                    return x >= room.first.x && x < room.last.x && z >= room.first.y && z < room.last.y;
                };
                ASSERT_EQ(std::ranges::count_if(plan.rooms, holds), 1) << seed << ": " << x << ", " << z;
            }
        }
    }
}

TEST(TemplePlan, AWalkerComesFromThePortalToTheLastHall)
{
    for (uint64_t seed = 0; seed < seed_count; ++seed) {
        const Plan plan = make_plan(seed);
        const std::vector<glm::vec2> way = find_way(plan);
        ASSERT_FALSE(way.empty()) << seed;
        EXPECT_GT(way.front().y, front_z_m) << seed;
        EXPECT_LT(glm::distance(way.back(), plan.rooms[static_cast<size_t>(plan.last_room)].middle_m()), 0.5F)
            << seed;
        for (size_t i = 0; i + 1 < way.size(); ++i) {
            ASSERT_LT(glm::distance(way[i], way[i + 1]), 0.26F) << seed;
            for (const PlacedColumn& column : plan.columns) {
                ASSERT_GT(gap_m(way[i], {}, column.place_m, glm::vec2(foot_half_m(column.column))), 0.2F)
                    << seed;
            }
        }
    }
}

TEST(TemplePlan, NoWayLeadsThroughAShutDoor)
{
    Plan plan = make_plan(3);
    for (Door& door : plan.doors) {
        door.is_barred = door.a == plan.last_room || door.b == plan.last_room;
    }
    EXPECT_TRUE(find_way(plan).empty());
    EXPECT_TRUE(find_way(make_plan(3), 1.2F).empty()) << "a giant gets through a door";
}

TEST(TemplePlan, ColumnsStandClearOfEachOtherAndOfWalls)
{
    for (uint64_t seed = 0; seed < seed_count; ++seed) {
        const Plan plan = make_plan(seed);
        for (size_t i = 0; i < plan.columns.size(); ++i) {
            const PlacedColumn& column = plan.columns[i];
            const glm::vec2 half(foot_half_m(column.column));
            for (size_t k = 0; k < i; ++k) {
                ASSERT_GT(gap_m(column.place_m, half, plan.columns[k].place_m,
                                glm::vec2(foot_half_m(plan.columns[k].column))),
                          0.8F)
                    << seed;
            }
            for (const WallRun& wall : plan.walls) {
                const glm::vec2 wall_half = 0.5F * (glm::abs(wall.to_m - wall.from_m) + wall.thickness_m);
                ASSERT_GT(gap_m(column.place_m, half, 0.5F * (wall.from_m + wall.to_m), wall_half), 0.8F)
                    << seed;
            }
        }
        const std::vector<StandingColumn> outside_columns = stand_columns(seed);
        for (size_t i = 0; i < outside_columns.size(); ++i) {
            for (size_t k = 0; k < i; ++k) {
                const StandingColumn& a = outside_columns[i];
                const StandingColumn& b = outside_columns[k];
                // Their tops lean, in the worst case towards each other.
                const float lean = std::sin(glm::radians(a.column.lean_deg)) * a.column.height_m +
                                   std::sin(glm::radians(b.column.lean_deg)) * b.column.height_m;
                ASSERT_GT(gap_m(a.place_m, glm::vec2(foot_half_m(a.column)), b.place_m,
                                glm::vec2(foot_half_m(b.column))),
                          lean)
                    << seed;
            }
        }
    }
}

TEST(TemplePlan, NoTwoColumnsAreAlike)
{
    const Plan plan = make_plan(1);
    for (size_t i = 0; i < plan.columns.size(); ++i) {
        for (size_t k = 0; k < i; ++k) {
            EXPECT_NE(plan.columns[i].column.chance, plan.columns[k].column.chance);
        }
    }
}

TEST(TemplePlan, LampsAreManyAndFewThrowShadows)
{
    for (uint64_t seed = 0; seed < seed_count; ++seed) {
        const Plan plan = make_plan(seed);
        const std::vector<PlacedLight> lights = hang_lamps(plan, seed).lights;
        EXPECT_GE(lights.size(), 30U) << seed;
        const auto shadowed =
            std::ranges::count_if(lights, [](const PlacedLight& lamp) { return lamp.light.casters != 0; });
        EXPECT_GE(shadowed, 3) << seed;
        EXPECT_LE(shadowed, 8) << seed;
        for (const PlacedLight& lamp : lights) { // spots hang above the roof, over its holes
            const bool is_spot = lamp.light.type == estampe::LightType::spot;
            for (const PlacedColumn& column : plan.columns) {
                ASSERT_GT(gap_m({lamp.place_m.x, lamp.place_m.z}, {}, column.place_m,
                                glm::vec2(foot_half_m(column.column))),
                          is_spot ? 0.0F : 0.2F)
                    << seed;
            }
        }
    }
}

/// Share of a stone's width that lies on stones of the course below, or on an arch that stands.
float carried_share(const Wall& wall, const Laid& laid, size_t course, const Stone& stone)
{
    constexpr int samples = 64;
    int carried = 0;
    for (int i = 0; i < samples; ++i) {
        const float share = (static_cast<float>(i) + 0.5F) / samples;
        const float x = glm::mix(stone.left_m, stone.right_m, share);
        bool is_carried = std::ranges::any_of(laid.courses[course - 1], [&](const Stone& below) {
            return below.left_m <= x && x <= below.right_m;
        });
        for (size_t k = 0; k < wall.arches.size(); ++k) {
            const Arch& arch = wall.arches[k];
            is_carried =
                is_carried || (laid.is_whole[k] && std::abs(x - arch.x_m) < arch.half_m + arch.ring_m &&
                               stone.low_m > arch.springing_m - 0.01F);
        }
        carried += is_carried ? 1 : 0;
    }
    return static_cast<float>(carried) / samples;
}

TEST(TempleWalls, NoStoneFloats)
{
    size_t stones = 0;
    size_t broken = 0;
    for (uint64_t seed = 0; seed < seed_count; ++seed) {
        Dice dice(seed, 99);
        Wall wall{.length_m = 30.0F, .height_m = 8.0F};
        for (float x = 3.0F; x < 28.0F; x += 5.6F) {
            wall.arches.push_back(
                {.x_m = x, .half_m = 1.8F, .springing_m = 3.5F, .ring_m = dice.chance(0.8F) ? 0.6F : 0.0F});
        }
        const float phase = 6.0F * dice.share();
        wall.top_m = [=](float x) { return 5.0F + 4.0F * std::sin(0.4F * x + phase); };
        const Laid laid = lay(wall, dice);
        for (size_t course = 1; course < laid.courses.size(); ++course) {
            for (const Stone& stone : laid.courses[course]) {
                ASSERT_GT(carried_share(wall, laid, course, stone), 0.45F) << seed << ", course " << course;
                ++stones;
            }
        }
        // A stone of a broken arch remains only next to its pier or to another remaining stone.
        for (const Voussoir& voussoir : laid.voussoirs) {
            if (laid.is_whole[static_cast<size_t>(voussoir.arch)]) {
                continue;
            }
            ++broken;
            const bool is_on_right = voussoir.from_rad < 0.01F;
            const bool is_on_left = voussoir.to_rad > 3.13F;
            const bool follows = std::ranges::any_of(laid.voussoirs, [&](const Voussoir& other) {
                return other.arch == voussoir.arch && (std::abs(other.to_rad - voussoir.from_rad) < 1e-3F ||
                                                       std::abs(other.from_rad - voussoir.to_rad) < 1e-3F);
            });
            ASSERT_TRUE(is_on_right || is_on_left || follows) << seed;
        }
    }
    EXPECT_GT(stones, 5000U);
    EXPECT_GT(broken, 50U);
}

TEST(TempleSand, BuriesTheFeetOfWhatStandsOnIt)
{
    for (uint64_t seed = 0; seed < seed_count; ++seed) {
        const Plan plan = make_plan(seed);
        for (const StandingColumn& standing : stand_columns(seed)) {
            if (!standing.is_on_floor) {
                EXPECT_LE(standing.foot_m, 0.0F) << seed;
            }
        }
        // Sand lies below every floor except where it came in through a gap, and never reaches the sills of
        // roofs.
        for (const Room& room : plan.rooms) {
            const float level = sand_level_m(plan, seed, room.middle_m());
            if (room.kind == RoomKind::fallen) {
                EXPECT_GT(level, floor_m) << seed;
            } else if (room.kind != RoomKind::entrance) {
                EXPECT_LT(level, floor_m - 0.5F) << seed;
            }
        }
        // The entrance is not blocked.
        EXPECT_LT(sand_level_m(plan, seed, plan.doors.front().place_m), floor_m + 0.6F) << seed;
        EXPECT_LT(sand_level_m(plan, seed, {0.0F, court_south_m}), 1.0F) << seed;
    }
}

} // namespace
} // namespace temple
