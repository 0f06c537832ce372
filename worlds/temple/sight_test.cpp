// SPDX-License-Identifier: MIT
// What is reported as out of sight is really invisible, as rays through the temple's triangles confirm.
#include "temple/prison.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "support/embree_scene.hpp"
#include "temple/temple.hpp"

namespace temple {
namespace {

TEST(TempleSight, NothingThatIsSeenIsSaidToBeHidden)
{
    for (const uint64_t seed : {1U, 2U, 5U}) {
        const Plan plan = make_plan(seed);
        const estampe::Scene scene = build_temple(seed);
        const estampe::test::EmbreeScene stone(scene, 0.0);
        std::mt19937 chance(static_cast<uint32_t>(seed));
        const auto between = [&](float low, float high) {
            return std::uniform_real_distribution<float>(low, high)(chance);
        };
        size_t hidden = 0;
        size_t rays = 0;
        for (int i = 0; i < 400; ++i) {
            // Inside the prison, or in front of it.
            const bool is_inside = i % 4 != 0;
            const glm::vec3 eye(between(-24.0F, 24.0F), floor_m + 1.7F,
                                is_inside ? between(-62.0F, -28.0F) : between(-26.0F, 20.0F));
            const std::vector<bool> seen = rooms_in_sight(plan, eye);
            for (size_t room = 0; room < plan.rooms.size(); ++room) {
                if (seen[room]) {
                    continue;
                }
                ++hidden;
                for (int ray = 0; ray < 24; ++ray) {
                    const glm::vec2 in(0.7F);
                    const glm::vec2 low = plan.rooms[room].low_m() + in;
                    const glm::vec2 high = plan.rooms[room].high_m() - in;
                    const glm::vec3 there(between(low.x, high.x), floor_m + between(0.3F, 2.6F),
                                          between(low.y, high.y));
                    ++rays;
                    ASSERT_TRUE(stone.is_between(glm::dvec3(eye), glm::dvec3(there)))
                        << "seed " << seed << ", room " << room << " from " << eye.x << ", " << eye.z;
                }
            }
        }
        EXPECT_GT(hidden, size_t{400} * plan.rooms.size() / 2) << "walls hide something";
        EXPECT_GT(rays, 1000U);
    }
}

TEST(TempleSight, OnesOwnRoomAndWhatItsDoorsShow)
{
    const Plan plan = make_plan(1);
    for (size_t room = 0; room < plan.rooms.size(); ++room) {
        const glm::vec2 middle = plan.rooms[room].middle_m();
        const std::vector<bool> seen = rooms_in_sight(plan, {middle.x, floor_m + 1.7F, middle.y});
        EXPECT_TRUE(seen[room]);
    }
    // From directly before the portal one sees into it. From the far end of the dunes one sees through the
    // gate, but not into cells.
    const glm::vec2 portal = plan.doors.front().place_m;
    EXPECT_TRUE(rooms_in_sight(plan, {portal.x, floor_m + 1.7F, portal.y + 4.0F}).front());
    EXPECT_TRUE(rooms_in_sight(plan, {portal.x, floor_m + 20.0F, portal.y + 4.0F}).back())
        << "holes are seen from above";
}

} // namespace
} // namespace temple
