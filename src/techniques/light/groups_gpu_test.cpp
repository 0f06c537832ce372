// SPDX-License-Identifier: MIT
// Light groups: lights, shadow casters and shadow receivers.
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace estampe::light {
namespace {

constexpr glm::uvec2 groups_px(192, 128);
const Camera high_camera{.eye = {0.0, 12.0, 0.1}, .vertical_fov_rad = 0.7};

/// Two floors side by side, each below a slab.
Scene two_stages()
{
    Scene scene;
    for (const double x : {-2.0, 2.0}) {
        test::add_object(scene, shapes::plane(3.0F, 3.0F), glm::vec3(1.0F), {x, 0.0, 0.0});
        test::add_object(scene, shapes::box({1.0F, 0.2F, 0.5F}), glm::vec3(1.0F), {x, 1.5, 0.0});
    }
    return scene;
}

struct Floors {
    std::vector<float> light[2];

    /// Number of pixels of a floor darker than `level`.
    [[nodiscard]] size_t dark(size_t floor, float level) const
    {
        return static_cast<size_t>(std::count_if(light[floor].begin(), light[floor].end(),
                                                 [level](float value) { return value < level; }));
    }
};

/// Light on the two floors, under an oblique sun.
Floors light_floors(const Scene& scene, const test::LightSetup& setup)
{
    test::Drawing drawing(scene, high_camera, groups_px);
    const auto light = drawing.light(setup);
    const auto surface = drawing.surface();
    Floors floors;
    for (size_t i = 0; i < light.size(); ++i) {
        const uint32_t draw = surface.draw[i] & ((1U << 26U) - 1U);
        if (draw == 1 || draw == 3) {
            floors.light[draw / 2].push_back(light[i].x);
        }
    }
    return floors;
}

test::LightSetup slanted_sun()
{
    shared::LightRecord sun{};
    sun.type = shared::light_directional;
    sun.direction = glm::normalize(glm::vec3(0.0F, 1.0F, 0.75F));
    sun.color = glm::vec3(1.0F);
    sun.groups = 0xffffffffU;
    return {.records = {sun}, .directional_count = 1, .shadow_size = 512, .has_links = true};
}

TEST(LightGroups, ALightLightsWhatSharesAGroup)
{
    Scene scene = two_stages();
    scene.nodes[0].links.lit_by = 0b01;
    scene.nodes[2].links.lit_by = 0b10;
    shared::LightRecord lamp{};
    lamp.type = shared::light_point;
    lamp.position = {0.0F, 3.0F, 0.0F};
    lamp.range_m = 100.0F;
    lamp.color = glm::vec3(9.0F);
    lamp.groups = 0b110;
    const Floors by_lamp = light_floors(scene, {.records = {lamp}, .has_links = true});
    ASSERT_GT(by_lamp.light[0].size(), 100U);
    EXPECT_EQ(by_lamp.dark(0, 1e-6F), by_lamp.light[0].size());
    EXPECT_EQ(by_lamp.dark(1, 0.05F), 0U);
    test::LightSetup setup = slanted_sun();
    setup.shadow_size = 0;
    setup.records[0].groups = 0b101;
    const Floors by_sun = light_floors(scene, setup);
    EXPECT_EQ(by_sun.dark(0, 0.5F), 0U);
    EXPECT_EQ(by_sun.dark(1, 1e-6F), by_sun.light[1].size());
}

TEST(LightGroups, ShadowsFallFromCastersOnReceivers)
{
    const size_t both = 60; // least number of pixels in a slab's shadow
    const Floors plain = light_floors(two_stages(), slanted_sun());
    EXPECT_GT(plain.dark(0, 0.3F), both);
    EXPECT_GT(plain.dark(1, 0.3F), both);
    Scene scene = two_stages();
    scene.nodes[1].links.casts_for = 0;
    const Floors one_casts = light_floors(scene, slanted_sun());
    EXPECT_EQ(one_casts.dark(0, 0.3F), 0U);
    EXPECT_EQ(one_casts.dark(1, 0.3F), plain.dark(1, 0.3F));
    scene = two_stages();
    scene.nodes[2].links.receives_shadows = false;
    const Floors one_receives = light_floors(scene, slanted_sun());
    EXPECT_EQ(one_receives.dark(0, 0.3F), plain.dark(0, 0.3F));
    EXPECT_EQ(one_receives.dark(1, 0.3F), 0U);
}

TEST(LightGroups, ASunIsBlockedByItsOwnCasters)
{
    Scene scene = two_stages();
    scene.nodes[1].links.casts_for = 0b01;
    scene.nodes[3].links.casts_for = 0b10;
    test::LightSetup setup = slanted_sun();
    setup.records[0].groups = 0xffffU | 0b10U << 16U;
    const Floors floors = light_floors(scene, setup);
    EXPECT_EQ(floors.dark(0, 0.3F), 0U);
    EXPECT_GT(floors.dark(1, 0.3F), 60U);
}

} // namespace
} // namespace estampe::light
