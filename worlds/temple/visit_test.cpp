// SPDX-License-Identifier: MIT
// Walks for ten minutes from the dunes to the last hall and back; rays that are independent of the walker's
// collision detection check the path.
#include "temple/visit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "support/embree_scene.hpp"
#include "temple/plan.hpp"
#include "temple/site.hpp"
#include "temple/temple.hpp"

namespace temple {
namespace {

bool is_long()
{
    return std::getenv("ESTAMPE_LONG") != nullptr;
}

/// Everything that blocks a walker; cloth and flames do not.
class Stone {
public:
    explicit Stone(const estampe::Scene& scene)
        : scene_(scene), rays_(scene, 0.0, [&scene](const estampe::PosedPrimitive& posed) {
              const estampe::Node& node = scene.nodes[posed.node];
              return !node.cloth && node.name != "flame";
          })
    {
    }

    [[nodiscard]] bool is_between(const glm::dvec3& a, const glm::dvec3& b, const char* but_for = "") const
    {
        const double far_m = glm::distance(a, b);
        if (far_m < 1e-9) {
            return false;
        }
        const auto hit = rays_.first_hit(a, (b - a) / far_m, far_m);
        return hit && scene_.nodes[hit->node].name != but_for;
    }

private:
    const estampe::Scene& scene_;
    estampe::test::EmbreeScene rays_;
};

/// Checks one step of a walker against stone and sand. Returns a description of the fault, or an empty
/// string.
std::string wrong_with(const Stone& stone, const estampe::Terrain& desert, const glm::dvec3& before,
                       const glm::dvec3& after, bool are_cells_open, double time_s)
{
    const char* but_for = are_cells_open ? "bars" : "";
    for (const double height_m : {0.5, 1.0, 1.7}) {
        const glm::dvec3 up(0.0, height_m, 0.0);
        if (stone.is_between(before + up, after + up, but_for)) {
            return "through stone at " + std::to_string(height_m) + " m";
        }
    }
    if (stone.is_between(after + glm::dvec3(0.0, 1.75, 0.0), after + glm::dvec3(0.0, 0.02, 0.0), but_for)) {
        return "stone in the body, or feet under a floor";
    }
    const double sand_m = desert.sample(after.x, after.z, time_s).height_m;
    return after.y < sand_m - 1e-6 ? "under the sand" : "";
}

TEST(TempleVisit, TenMinutesFromTheDunesToTheLastHallAndBack)
{
    const uint64_t seeds = is_long() ? 12 : 3;
    const double minutes = 10.0;
    for (uint64_t seed = 1; seed <= seeds; ++seed) {
        const estampe::Scene scene = build_temple(seed);
        const Stone stone(scene);
        Visit visit(scene, seed);
        Tour tour(visit, seed);
        ASSERT_GE(tour.halls(), 3U) << seed;
        double time_s = 0.0;
        double gone_m = 0.0;
        glm::dvec3 waited_at_m = visit.walker().feet_m();
        double waited_since_s = 0.0;
        const auto steps = static_cast<int>(std::lround(60.0 * minutes / walk::Walker::step_s));
        for (int i = 0; i < steps; ++i) {
            const glm::dvec3 before = visit.walker().feet_m();
            visit.go(tour.intent(), walk::Walker::step_s, time_s);
            const glm::dvec3& after = visit.walker().feet_m();
            const bool is_open = visit.since_arrival_s() && Ending::are_open(*visit.since_arrival_s());
            const std::string wrong = wrong_with(stone, *scene.terrain, before, after, is_open, time_s);
            ASSERT_EQ(wrong, "") << "seed " << seed << " at " << time_s << " s: " << after.x << ", "
                                 << after.y << ", " << after.z;
            time_s += walk::Walker::step_s;
            gone_m += glm::distance(before, after);
            if (glm::distance(waited_at_m, after) > 1.0) {
                waited_at_m = after;
                waited_since_s = time_s;
            }
            ASSERT_LT(time_s - waited_since_s, 4.0)
                << "seed " << seed << " is stuck at " << after.x << ", " << after.y << ", " << after.z;
        }
        EXPECT_GT(gone_m, 600.0 * 2.0) << seed;
        EXPECT_TRUE(visit.since_arrival_s()) << seed << ": the last hall was not reached";
        EXPECT_GE(tour.rounds(), 1U) << seed << ": not there and back";
    }
}

TEST(TempleVisit, TheLastHallChangesTheTempleAndStaysSo)
{
    const estampe::Scene scene = build_temple(2);
    const Ending ending(scene, 2);
    const Plan plan = make_plan(2);
    const glm::vec2 middle = plan.rooms[static_cast<size_t>(plan.last_room)].middle_m();
    EXPECT_TRUE(ending.begins_at({middle.x, floor_m, middle.y}));
    EXPECT_FALSE(ending.begins_at({middle.x + 3.0F, floor_m, middle.y}));
    EXPECT_FALSE(ending.begins_at({middle.x, floor_m + 8.0F, middle.y})) << "on the roof";
    EXPECT_FALSE(ending.begins_at({plan.doors.front().place_m.x, floor_m, plan.doors.front().place_m.y}));

    // Before the ending everything is as in the scene; after it nothing changes.
    const auto before = ending.lights(-1.0);
    const auto last = ending.lights(Ending::lasts_s);
    const auto later = ending.lights(100.0 * Ending::lasts_s);
    ASSERT_GE(before.size(), 30U);
    size_t fires = 0;
    size_t days = 0;
    for (size_t i = 0; i < before.size(); ++i) {
        const float own = scene.lights[before[i].light].intensity;
        EXPECT_EQ(before[i].intensity, own);
        EXPECT_EQ(last[i].intensity, later[i].intensity);
        EXPECT_GT(last[i].intensity, 0.0F) << "its shadow would be drawn anew";
        (last[i].intensity < own ? fires : days) += 1;
        // Brightness changes monotonically in between.
        float was = own;
        for (double s = 0.0; s < Ending::lasts_s; s += 0.1) {
            const float now = ending.lights(s)[i].intensity;
            EXPECT_TRUE(last[i].intensity < own ? now <= was : now >= was);
            EXPECT_LT(std::abs(now - was), 0.08F * std::max(own, last[i].intensity)) << "and no jump";
            was = now;
        }
    }
    EXPECT_GT(fires, 25U);
    EXPECT_GE(days, 1U);
    for (const estampe::NodePlace& moved : ending.nodes(-1.0)) {
        EXPECT_EQ(moved.transform.translation, scene.nodes[moved.node].transform.translation);
        EXPECT_EQ(moved.transform.scale, glm::dvec3(1.0));
    }
    EXPECT_EQ(scene.nodes[ending.gratings()].name, "bars");
}

/// A shut cell can be entered once the gratings are down.
TEST(TempleVisit, ShutCellsOpen)
{
    size_t opened = 0;
    for (uint64_t seed = 1; seed <= 4; ++seed) {
        const estampe::Scene scene = build_temple(seed);
        walk::Solids solids = solids_of(scene);
        const Ending ending(scene, seed);
        const double still_s = 0.0;
        const Plan plan = make_plan(seed);
        for (const WallRun& wall : plan.walls) {
            if (!wall.door || !plan.doors[*wall.door].is_barred) {
                continue;
            }
            const Door& door = plan.doors[*wall.door];
            const auto has_sand = [&](int room) {
                return plan.rooms[static_cast<size_t>(room)].kind == RoomKind::fallen;
            };
            if (has_sand(wall.a) || has_sand(wall.b)) {
                continue; // the place may lie in the doorway
            }
            const glm::dvec2 across = wall.is_along_x ? glm::dvec2(0.0, 1.0) : glm::dvec2(1.0, 0.0);
            const glm::dvec2 before = glm::dvec2(door.place_m) - 1.4 * across;
            const auto beyond_m = [&] {
                walk::Walker walker(walk::Place(solids, sand_of(*scene.terrain, still_s)), {},
                                    {before.x, static_cast<double>(floor_m), before.y});
                for (int i = 0; i < 240; ++i) {
                    walker.step({.way = across});
                }
                return glm::dot(glm::dvec2(walker.feet_m().x, walker.feet_m().z) - glm::dvec2(door.place_m),
                                across);
            };
            EXPECT_LT(beyond_m(), -0.25) << seed;
            solids.set_gone(ending.gratings(), true);
            EXPECT_GT(beyond_m(), 0.8) << seed;
            solids.set_gone(ending.gratings(), false);
            ++opened;
        }
    }
    EXPECT_GT(opened, 4U);
}

} // namespace
} // namespace temple
