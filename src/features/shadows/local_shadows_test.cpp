// SPDX-License-Identifier: MIT
#include "features/shadows/shadows.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace estampe::features {
namespace {

shared::LightRecord lamp(const glm::vec3& position, float range_m)
{
    shared::LightRecord record{};
    record.type = shared::light_point;
    record.position = position;
    record.range_m = range_m;
    record.color = glm::vec3(1.0F);
    record.groups = 0xffffffffU;
    return record;
}

const PageView page{
    .eye_anchor = {0, 0, 8}, .pixel = {.at_one_m = 0.002F}, .scene_radius_m = 5.0F, .longer_side_px = 512};

TEST(LocalShadows, RedrawsOnlyTheLightsWithinWhoseReachSomethingMoved)
{
    light::Lighting lighting{.records = {lamp({-5, 2, 0}, 4.0F), lamp({5, 2, 0}, 4.0F)}};
    LocalShadows shadows;
    EXPECT_EQ(shadows.plan(lighting, {}, page, {}).views.whole.size(), 12U);
    EXPECT_EQ(lighting.records[0].shadow, 1U);
    EXPECT_EQ(lighting.records[1].shadow, 2U);
    EXPECT_TRUE(shadows.plan(lighting, {}, page, {}).views.whole.empty());
    const std::vector<Bounds> by_the_second{{.min = {6, 0, 0}, .max = {7, 1, 1}}};
    const auto plan = shadows.plan(lighting, by_the_second, page, {});
    ASSERT_EQ(plan.views.whole.size(), 6U);
    EXPECT_EQ(plan.views.whole[0].eye_anchor, glm::vec3(5, 2, 0));
    lighting.records[0].position.x -= 0.1F;
    EXPECT_EQ(shadows.plan(lighting, {}, page, {}).views.whole.size(), 6U);
    // A small change of brightness, as a moving scene's exposure causes, redraws nothing.
    lighting.records[0].range_m *= 0.99F;
    EXPECT_TRUE(shadows.plan(lighting, {}, page, {}).views.whole.empty());
    shadows.forget();
    EXPECT_EQ(shadows.plan(lighting, {}, page, {}).views.whole.size(), 12U);
}

TEST(LocalShadows, WhatStandsStillIsKeptInALayerOnceSomethingMoves)
{
    light::Lighting lighting{.records = {lamp({-5, 2, 0}, 4.0F), lamp({5, 2, 0}, 4.0F)}};
    const CasterKinds both{.moving = true, .still = true};
    const std::vector<Bounds> by_the_second{{.min = {6, 0, 0}, .max = {7, 1, 1}}};
    LocalShadows shadows;
    const auto plan = [&](std::span<const Bounds> moved, const CasterKinds& casters = {}) {
        return shadows.plan(lighting, moved, page, {}, casters).views;
    };
    EXPECT_EQ(plan({}, both).whole.size(), 12U);
    const LocalMapViews first = plan(by_the_second, both);
    EXPECT_TRUE(first.whole.empty());
    EXPECT_EQ(first.still.size(), 6U);
    EXPECT_EQ(first.moving.size(), 6U);
    EXPECT_EQ(first.moving[0].eye_anchor, glm::vec3(5, 2, 0));
    const LocalMapViews second = plan(by_the_second, both);
    EXPECT_TRUE(second.whole.empty());
    EXPECT_TRUE(second.still.empty());
    EXPECT_EQ(second.moving.size(), 6U);
    // A moved light is drawn from all casters and loses its layer.
    lighting.records[1].position.x += 0.1F;
    EXPECT_EQ(plan(by_the_second, both).whole.size(), 6U);
    EXPECT_EQ(plan(by_the_second, both).still.size(), 6U);
    shadows.forget();
    EXPECT_EQ(plan({}, both).whole.size(), 12U);
    // If all casters move, there is no static layer.
    EXPECT_EQ(plan(by_the_second, {.moving = true}).whole.size(), 6U);
}

TEST(LocalShadows, KeepALayerHoweverLittleOfTheBudgetTheirMapsLeave)
{
    light::Lighting lighting{.records = {lamp({5, 2, 0}, 4.0F)}};
    const std::vector<Bounds> near_it{{.min = {6, 0, 0}, .max = {7, 1, 1}}};
    LocalShadows shadows;
    shadow::ShadowStyle style;
    style.local_size = 256;
    style.local_megatexels = 1.01F * 6.0F * 256.0F * 256.0F / 1e6F;
    static_cast<void>(shadows.plan(lighting, {}, page, style, {.moving = true, .still = true}));
    const auto plan = shadows.plan(lighting, near_it, page, style, {.moving = true, .still = true});
    EXPECT_EQ(plan.texel_count, 6U * 256U * 256U);
    EXPECT_EQ(plan.views.whole.size(), 0U);
    EXPECT_EQ(plan.views.moving.size(), 6U);
}

TEST(LocalShadows, SomeLightsGoWithout)
{
    light::Lighting lighting{
        .records = {lamp({-5, 2, 0}, 4.0F), lamp({5, 2, 0}, 4.0F), lamp({0, 2, 0}, 4.0F)}};
    lighting.records[1].groups = 0x0000ffffU; // nothing blocks it
    LocalShadows shadows;
    shadow::ShadowStyle style;
    style.local_lights = 1;
    const auto plan = shadows.plan(lighting, {}, page, style);
    EXPECT_EQ(plan.shadows.size(), 1U);
    EXPECT_EQ(plan.without, 1U);
    EXPECT_EQ(lighting.records[1].shadow, 0U);
    EXPECT_EQ(lighting.records[2].shadow, 1U);
}

TEST(LocalShadows, ALightsOwnRadiusCountsBeforeTheStyles)
{
    light::Lighting lighting{.records = {lamp({-5, 2, 0}, 4.0F), lamp({5, 2, 0}, 4.0F)}};
    lighting.records[0].radius_m = -1.0F;
    lighting.records[1].radius_m = 0.0F;
    shadow::ShadowStyle style;
    style.lamp_radius_m = 0.3F;
    LocalShadows shadows;
    const auto plan = shadows.plan(lighting, {}, page, style);
    ASSERT_EQ(plan.shadows.size(), 2U);
    EXPECT_EQ(plan.shadows[0].radius_m, 0.3F);
    EXPECT_EQ(plan.shadows[1].radius_m, 0.0F);
    // The lamp's radius does not affect the maps.
    lighting.records[1].radius_m = 0.5F;
    EXPECT_TRUE(shadows.plan(lighting, {}, page, style).views.whole.empty());
}

TEST(LocalShadows, AskForTexelsByTheDistanceOnlyInPerspective)
{
    const shared::LightRecord record = lamp({0, 0, 0}, 4.0F);
    const auto wanted = [&](float distance_m, bool is_parallel) {
        const PageView view{.eye_anchor = {0, 0, distance_m},
                            .pixel = {.at_one_m = 0.02F, .is_parallel = is_parallel},
                            .scene_radius_m = 5.0F};
        return atlas_request(record, local_light(record), view, {}).wanted_size;
    };
    // At a distance of 2 m, the shadow map is 4 m wide.
    EXPECT_FLOAT_EQ(wanted(8.0F, false), 4.0F / (0.02F * 8.0F));
    EXPECT_FLOAT_EQ(wanted(80.0F, false), 4.0F / (0.02F * 80.0F));
    EXPECT_FLOAT_EQ(wanted(8.0F, true), 4.0F / 0.02F);
    EXPECT_FLOAT_EQ(wanted(80.0F, true), 4.0F / 0.02F);
}

TEST(LocalShadows, TakeTheConeOfASpot)
{
    shared::LightRecord record = lamp({0, 2, 0}, 4.0F);
    record.type = shared::light_spot;
    record.direction = {0, -1, 0};
    const float outer = std::cos(0.6F);
    record.cone_scale = 1.0F / (std::cos(0.2F) - outer);
    record.cone_offset = -outer * record.cone_scale;
    const shadow::LocalLight light = local_light(record);
    EXPECT_NEAR(light.half_angle_rad, 0.6F, 1e-5F);
    EXPECT_NEAR(glm::dot(light.side, light.beam), 0.0F, 1e-6F);
    EXPECT_GE(light.range_m, 4.0F);
    EXPECT_FALSE(light.is_cube());
    EXPECT_EQ(atlas_request(record, light, page, {}).map_count, 1U);
}

} // namespace
} // namespace estampe::features
