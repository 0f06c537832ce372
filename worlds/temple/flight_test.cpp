// SPDX-License-Identifier: MIT
// The film's camera moves smoothly and never through stone or sand, as independent rays confirm.
#include "temple/cameras.hpp"

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

constexpr double frames_a_s = 24.0;

glm::dvec3 look_of(const estampe::Camera& camera)
{
    return glm::normalize(camera.target - camera.eye);
}

/// Directions all around, about 0.6 rad apart.
std::vector<glm::dvec3> around()
{
    std::vector<glm::dvec3> all;
    for (int x = -2; x <= 2; ++x) {
        for (int y = -2; y <= 2; ++y) {
            for (int z = -2; z <= 2; ++z) {
                if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == 2) {
                    all.push_back(glm::normalize(glm::dvec3(x, y, z)));
                }
            }
        }
    }
    return all;
}

TEST(TempleFlight, KeepsClearOfStoneAndSand)
{
    const uint64_t seeds = std::getenv("ESTAMPE_LONG") != nullptr ? 20 : 4;
    const std::vector<glm::dvec3> directions = around();
    for (uint64_t seed = 1; seed <= seeds; ++seed) {
        const estampe::Scene scene = build_temple(seed);
        const estampe::test::EmbreeScene stone(scene, 0.0, [&scene](const estampe::PosedPrimitive& posed) {
            return !scene.nodes[posed.node].cloth;
        });
        const Flight flight(scene, seed);
        glm::dvec3 before = flight.camera(0.0).eye;
        for (int frame = 0; frame <= static_cast<int>(Flight::length_s * frames_a_s); ++frame) {
            const glm::dvec3 eye = flight.camera(frame / frames_a_s).eye;
            ASSERT_FALSE(stone.is_between(before, eye)) << seed << ", frame " << frame;
            for (const glm::dvec3& direction : directions) {
                ASSERT_FALSE(stone.is_blocked(eye, direction, 0.3))
                    << "seed " << seed << ", frame " << frame << ": " << eye.x << ", " << eye.y << ", "
                    << eye.z;
            }
            ASSERT_GT(eye.y, scene.terrain->sample(eye.x, eye.z).height_m + 0.9)
                << seed << ", frame " << frame;
            before = eye;
        }
    }
}

TEST(TempleFlight, PassesDunesGateCourtAndHallsWithoutAJerk)
{
    for (const uint64_t seed : {1U, 2U, 3U}) {
        const estampe::Scene scene = build_temple(seed);
        const Plan plan = make_plan(seed);
        const Flight flight(scene, seed);
        const auto camera = [&](int frame) { return flight.camera(frame / frames_a_s); };
        const int last = static_cast<int>(Flight::length_s * frames_a_s);
        bool was_at_gate = false;
        bool was_in_court = false;
        bool was_at_portal = false;
        for (int frame = 1; frame < last; ++frame) {
            const glm::dvec3 eye = camera(frame).eye;
            const glm::dvec3 step = eye - camera(frame - 1).eye;
            const glm::dvec3 next = camera(frame + 1).eye - eye;
            // In metres per second and per second squared; likewise for degrees.
            ASSERT_LT(glm::length(step) * frames_a_s, 14.0) << seed << ", frame " << frame;
            ASSERT_LT(glm::length(next - step) * frames_a_s * frames_a_s, 9.0) << seed << ", frame " << frame;
            const double turn =
                std::acos(std::min(1.0, glm::dot(look_of(camera(frame)), look_of(camera(frame - 1)))));
            ASSERT_LT(glm::degrees(turn) * frames_a_s, 62.0) << seed << ", frame " << frame;
            ASSERT_LT(std::abs(look_of(camera(frame)).y), 0.5) << seed << ", frame " << frame;
            was_at_gate =
                was_at_gate || (std::abs(eye.x) < gate_half_m && std::abs(eye.z - court_south_m) < 1.0);
            was_in_court = was_in_court || (was_at_gate && std::abs(eye.x) < 27.0 && std::abs(eye.z) < 10.0);
            const glm::dvec2 off = glm::dvec2(eye.x, eye.z) - glm::dvec2(plan.doors.front().place_m);
            was_at_portal = was_at_portal || (was_in_court && glm::length(off) < 1.5);
        }
        EXPECT_TRUE(was_at_gate && was_in_court && was_at_portal) << seed;
        EXPECT_GT(camera(0).eye.z, 90.0) << "out in the dunes";
        const glm::vec2 middle = plan.rooms[static_cast<size_t>(plan.last_room)].middle_m();
        const glm::dvec3 end = camera(last).eye;
        EXPECT_LT(glm::distance(glm::dvec2(end.x, end.z), glm::dvec2(middle)), 3.0) << seed;
        EXPECT_LT(glm::distance(end, flight.camera(flight.arrives_s() + 1.0).eye), 0.2)
            << "it stands in the end";
        EXPECT_EQ(flight.camera(-3.0).eye, flight.camera(0.0).eye);
        EXPECT_EQ(flight.camera(99.0).eye, flight.camera(Flight::length_s).eye);
    }
}

TEST(TempleFlight, HasSomethingToSeeBeforeIt)
{
    for (const uint64_t seed : {1U, 2U, 3U}) {
        const estampe::Scene scene = build_temple(seed);
        const estampe::test::EmbreeScene stone(scene, 0.0, [&scene](const estampe::PosedPrimitive& posed) {
            return !scene.nodes[posed.node].cloth;
        });
        const Flight flight(scene, seed);
        // Share of a picture of 16 x 9 rays in which a wall is near.
        const auto near_share = [&](const estampe::Camera& camera) {
            const glm::dvec3 right = glm::normalize(glm::cross(look_of(camera), glm::dvec3(0.0, 1.0, 0.0)));
            const glm::dvec3 up = glm::cross(right, look_of(camera));
            const double tangent = std::tan(0.5 * camera.vertical_fov_rad);
            int near = 0;
            for (int y = -4; y <= 4; ++y) {
                for (int x = -8; x <= 7; ++x) {
                    const glm::dvec3 way =
                        look_of(camera) + tangent / 4.5 * ((x + 0.5) * right + static_cast<double>(y) * up);
                    near += stone.is_blocked(camera.eye, glm::normalize(way), 7.0) && way.y > -0.2 ? 1 : 0;
                }
            }
            return near / 144.0;
        };
        double most = 0.0;
        double sum = 0.0;
        int count = 0;
        for (int frame = 0; frame <= static_cast<int>(Flight::length_s * frames_a_s); frame += 4) {
            const double share = near_share(flight.camera(frame / frames_a_s));
            most = std::max(most, share);
            sum += share;
            ++count;
        }
        EXPECT_LT(most, 0.65) << seed;
        EXPECT_LT(sum / count, 0.17) << seed;
    }
}

} // namespace
} // namespace temple
