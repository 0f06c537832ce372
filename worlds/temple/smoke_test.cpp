// SPDX-License-Identifier: MIT
// Smoke over the fires of the great halls.
#include "temple/lamps.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace temple {
namespace {

TEST(TempleSmoke, RisesFromTwoFiresOfEachGreatHallOfEveryTemple)
{
    for (uint64_t seed = 1; seed <= 20; ++seed) {
        const Plan plan = make_plan(seed);
        const std::vector<Plume> plumes = find_plumes(plan, seed);
        for (const int room : {0, plan.last_room}) {
            EXPECT_EQ(std::ranges::count(plumes, room, &Plume::room), 2) << seed;
        }
        for (const Plume& plume : plumes) {
            const Room& room = plan.rooms[static_cast<size_t>(plume.room)];
            const glm::vec2 place_m(plume.foot_m.x, plume.foot_m.z);
            EXPECT_TRUE(glm::all(glm::greaterThan(place_m, room.low_m() + 1.0F))) << seed;
            EXPECT_TRUE(glm::all(glm::lessThan(place_m, room.high_m() - 1.0F))) << seed;
            EXPECT_GT(plume.foot_m.y, floor_m + 1.0F) << "over the bowl";
            EXPECT_LT(plume.foot_m.y, floor_m + 0.5F * room.height_m);
        }
    }
}

TEST(TempleSmoke, IsNowhereWhereItCannotBeSeen)
{
    const Plan plan = make_plan(1);
    const std::vector<Plume> plumes = find_plumes(plan, 1);
    const glm::dvec3 eye_m = glm::dvec3(plumes.front().foot_m) + glm::dvec3(2.0, 0.0, 0.0);
    const auto is_there = [&](const glm::dvec3& from_m, const std::vector<bool>& in_sight) {
        const std::vector<estampe::NodePlace> places = smoke_places(7, plumes, from_m, in_sight);
        EXPECT_EQ(places.size(), plumes.size());
        EXPECT_EQ(places.front().node, 7U);
        return places.front().transform.scale.x > 0.0;
    };
    std::vector<bool> in_sight(plan.rooms.size(), false);
    EXPECT_FALSE(is_there(eye_m, in_sight));
    in_sight[static_cast<size_t>(plumes.front().room)] = true;
    EXPECT_TRUE(is_there(eye_m, in_sight));
    EXPECT_FALSE(is_there(eye_m + glm::dvec3(0.0, 0.0, 80.0), in_sight));
}

} // namespace
} // namespace temple
