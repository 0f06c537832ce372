// SPDX-License-Identifier: MIT
// The test for places far above heights, as the shaders compute it.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/glsl.hpp"
#include "techniques/cloth/cloth.glsl.h"

namespace estampe::cloth {
namespace below {

using namespace test::glsl;
using namespace shared; // NOLINT(google-build-using-namespace): as the shader has it

std::vector<float> numbers;

float grid_number(int at)
{
    return numbers.at(static_cast<size_t>(at));
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#include "techniques/cloth/solids/cloth_heights.glsl"
#pragma GCC diagnostic pop

} // namespace below

namespace {

constexpr glm::uvec2 nodes(33, 25);
constexpr glm::vec3 half_m(4.0F, 1.0F, 2.4F); // cells of 25 and 20 cm
constexpr float steps_m = 0.12F;              // largest step between nodes, except at a cliff
constexpr float highest_m = 2.0F * steps_m;

/// Uneven ground, with a cliff beyond x = 2.
void lay_ground()
{
    below::numbers = {
        static_cast<float>(nodes.x), 1.0F, static_cast<float>(nodes.y), half_m.x, half_m.y, half_m.z};
    std::mt19937 random(5);
    std::uniform_real_distribution<float> heights_m(highest_m - steps_m, highest_m);
    for (uint32_t i = 0; i < nodes.x * nodes.y; ++i) {
        below::numbers.push_back(i % nodes.x > 24 ? -1e4F : heights_m(random));
    }
}

float random_in(std::mt19937& random, float least, float most)
{
    return std::uniform_real_distribution<float>(least, most)(random);
}

TEST(ClothHeights, NoWayInABallThatTheyAreFarBelowMeetsThem)
{
    lay_ground();
    std::mt19937 random(7);
    size_t far = 0;
    for (int i = 0; i < 40000; ++i) {
        const glm::vec3 middle(random_in(random, -5.0F, 5.0F), random_in(random, 0.0F, 1.5F),
                               random_in(random, -3.0F, 3.0F));
        const float radius_m = random_in(random, 0.002F, 0.3F);
        const float near_m = random_in(random, 0.001F, 0.02F);
        if (!below::are_far_below(0, half_m, glm::vec4(middle, radius_m), near_m)) {
            continue;
        }
        ++far;
        for (int k = 0; k < 20; ++k) {
            const glm::vec3 way(random_in(random, -1.0F, 1.0F), random_in(random, -1.0F, 0.2F),
                                random_in(random, -1.0F, 1.0F));
            const glm::vec3 place = middle + radius_m * way / std::max(glm::length(way), 1e-3F);
            ASSERT_GE(below::heights_at(0, half_m, place).w, (2.0F * radius_m + near_m) * (1.0F - 1e-5F))
                << place.x << ' ' << place.y << ' ' << place.z << ", " << radius_m;
        }
    }
    EXPECT_GE(far, 5000U);
}

TEST(ClothHeights, AreFarBelowWhatHangsAMetreUp)
{
    lay_ground();
    for (float x_m = -6.0F; x_m < 1.6F; x_m += 0.05F) {
        for (float z_m = -4.0F; z_m < 4.0F; z_m += 0.05F) {
            const glm::vec3 middle(x_m, highest_m + 1.0F, z_m);
            ASSERT_TRUE(below::are_far_below(0, half_m, glm::vec4(middle, 0.1F), 0.01F)) << x_m << ' ' << z_m;
            ASSERT_FALSE(below::are_far_below(0, half_m, glm::vec4(middle, 1.0F), 0.01F))
                << x_m << ' ' << z_m;
        }
    }
    // Beside a cliff heights_at() is small, however high the place is.
    EXPECT_FALSE(below::are_far_below(0, half_m, {2.1F, highest_m + 1.0F, 0.0F, 0.1F}, 0.01F));
}

} // namespace
} // namespace estampe::cloth
