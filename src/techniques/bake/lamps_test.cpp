// SPDX-License-Identifier: MIT
// Kinds of lamps, their falloff, light groups and shadow groups, against the formulas.
#include <gtest/gtest.h>

#include "techniques/bake/test_support.hpp"

namespace estampe::bake {
namespace {

using testing::baked;
using testing::light_at;

constexpr float height_m = 2.0F;
constexpr float half_floor_m = 2.0F;

BakeSettings direct(std::vector<Lamp> lamps)
{
    for (Lamp& lamp : lamps) {
        lamp.baked = true;
    }
    return {.size = 256, .samples = 8, .bounces = 0, .lamps = std::move(lamps), .smooth = false};
}

/// A floor of 4 x 4 m.
Scene plain_floor()
{
    return test::scene_of(shapes::plane(2.0F * half_floor_m, 2.0F * half_floor_m));
}

/// The light of the map at a place of the floor, whose triangles come first.
float on_floor(const Scene& scene, const Lightmap& map, const glm::vec2& place)
{
    const StaticTriangles triangles = static_triangles(scene);
    const glm::vec3 anchor(triangles.anchor);
    for (size_t i = 0; i < 2; ++i) {
        const auto corner = [&](size_t k) {
            const glm::vec3 at = triangles.positions[3 * i + k] + anchor;
            return glm::vec2(at.x, at.z);
        };
        const glm::mat2 edges(corner(1) - corner(0), corner(2) - corner(0));
        const glm::vec2 w = glm::inverse(edges) * (place - corner(0));
        if (w.x >= -1e-4F && w.y >= -1e-4F && w.x + w.y <= 1.0001F) {
            const glm::vec2* at = &map.corners[3 * i];
            return light_at(map.light, at[0] + w.x * (at[1] - at[0]) + w.y * (at[2] - at[0])).y;
        }
    }
    ADD_FAILURE() << "not on the floor";
    return 0.0F;
}

/// A lamp above the middle of the floor, shining down, in the space of the map.
Lamp hanging(LampKind kind, const Scene& scene)
{
    Lamp lamp{.kind = kind,
              .position = glm::vec3(glm::dvec3(0.0, height_m, 0.0) - static_triangles(scene).anchor),
              .direction = {0.0F, -1.0F, 0.0F},
              .color = glm::vec3(4.0F),
              .range_m = 50.0F};
    const float inner = std::cos(0.3F);
    const float outer = std::cos(0.6F);
    lamp.cone_scale = 1.0F / (inner - outer);
    lamp.cone_offset = -outer * lamp.cone_scale;
    return lamp;
}

/// saturate((cos a - cos outer) / (cos inner - cos outer))^2, where a is the angle from the beam.
double cone_at(double angle_rad)
{
    const double cone = (std::cos(angle_rad) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6));
    return std::pow(std::clamp(cone, 0.0, 1.0), 2.0);
}

/// `expected` is a function of distance, cosine, and the angles from the beam in the planes of both axes.
template <class Expected>
void expect_everywhere(const Scene& scene, const Lightmap& map, double tolerance, const Expected& expected)
{
    for (float x = -1.85F; x < 1.9F; x += 0.185F) {
        for (float z = -1.85F; z < 1.9F; z += 0.185F) {
            const double distance = std::sqrt(static_cast<double>(x * x + z * z + height_m * height_m));
            const double wanted = expected(distance, static_cast<double>(height_m) / distance,
                                           static_cast<double>(x), static_cast<double>(z));
            EXPECT_NEAR(on_floor(scene, map, {x, z}), wanted, tolerance) << x << " " << z;
        }
    }
}

TEST(BakeLamps, APyramidIsSquareOnTheFloor)
{
    const Scene scene = plain_floor();
    for (const float turn_rad : {0.0F, 0.5F}) {
        Lamp lamp = hanging(LampKind::pyramid, scene);
        lamp.side = {std::cos(turn_rad), 0.0F, std::sin(turn_rad)};
        const Lightmap map = baked(scene, direct({lamp}));
        EXPECT_EQ(map.baked_lights, static_cast<uint32_t>(baked_spot));
        expect_everywhere(scene, map, 0.02, [&](double distance, double cosine, double x, double z) {
            const double c = std::cos(static_cast<double>(turn_rad));
            const double s = std::sin(static_cast<double>(turn_rad));
            const double aside = std::max(std::abs(c * x + s * z), std::abs(-s * x + c * z));
            const double range = std::pow(distance / 50.0, 4.0);
            return 4.0 * cosine / (distance * distance) * (1.0 - range) *
                   cone_at(std::atan(aside / static_cast<double>(height_m)));
        });
    }
}

TEST(BakeLamps, AConeIsRound)
{
    const Scene scene = plain_floor();
    const Lightmap map = baked(scene, direct({hanging(LampKind::spot, scene)}));
    expect_everywhere(scene, map, 0.02, [&](double distance, double cosine, double /*x*/, double /*z*/) {
        return 4.0 * cosine / (distance * distance) * cone_at(std::acos(cosine));
    });
}

TEST(BakeLamps, AUnitVolumeWeakensByOneMinusTheSquare)
{
    const Scene scene = plain_floor();
    for (const float range_m : {2.3F, 6.0F}) {
        Lamp lamp = hanging(LampKind::point, scene);
        lamp.unit_volume = true;
        lamp.range_m = range_m;
        lamp.color = glm::vec3(1.0F);
        const Lightmap map = baked(scene, direct({lamp}));
        expect_everywhere(scene, map, 0.004, [&](double distance, double cosine, double /*x*/, double /*z*/) {
            return cosine * std::max(1.0 - std::pow(distance / static_cast<double>(range_m), 2.0), 0.0);
        });
    }
}

/// A floor, and two boards; each blocks a lamp above one half of the floor.
Scene two_boards()
{
    Scene scene = plain_floor();
    for (const double x : {-1.0, 1.0}) {
        test::add_object(scene, shapes::box({0.5F, 0.05F, 0.5F}), glm::vec3(0.5F), {x, 1.0, 0.0});
    }
    return scene;
}

/// A lamp over the left or the right board.
Lamp over(const Scene& scene, float x)
{
    Lamp lamp = hanging(LampKind::point, scene);
    lamp.position.x += x;
    return lamp;
}

TEST(BakeLamps, ALampIsBlockedByItsCastersAlone)
{
    Scene scene = two_boards();
    scene.nodes[1].links.casts_for = 0b01;
    scene.nodes[2].links.casts_for = 0b10;
    Lamp left = over(scene, -1.0F);
    const auto under_left = [&](Groups casters) {
        left.casters = casters;
        return on_floor(scene, baked(scene, direct({left})), {-1.0F, 0.0F});
    };
    const auto open = static_cast<float>(4.0 / 4.0);
    EXPECT_EQ(under_left(all_groups), 0.0F);
    EXPECT_EQ(under_left(0b01), 0.0F);
    EXPECT_NEAR(under_left(0b10), open, 0.01F);
    EXPECT_NEAR(under_left(0), open, 0.01F);
    scene.nodes[1].links = {};
    EXPECT_EQ(under_left(0b10), 0.0F);
    scene.materials[1].links.casts_for = 0;
    EXPECT_NEAR(under_left(all_groups), open, 0.01F);
    scene.materials[1].links = {};
    scene.nodes[0].links.receives_shadows = false;
    EXPECT_NEAR(under_left(all_groups), open, 0.01F);
}

TEST(BakeLamps, ALampLightsItsGroupsAlone)
{
    Scene scene = plain_floor();
    scene.nodes[0].links.lit_by = 0b01;
    Lamp first = over(scene, 0.0F);
    first.groups = 0b01;
    Lamp second = first;
    second.groups = 0b10;
    const auto middle = [&](const std::vector<Lamp>& lamps) {
        return on_floor(scene, baked(scene, direct(lamps)), {0.0F, 0.0F});
    };
    EXPECT_NEAR(middle({first}), 1.0F, 0.01F);
    EXPECT_EQ(middle({second}), 0.0F);
    EXPECT_NEAR(middle({first, second}), 1.0F, 0.01F);
    scene.materials[0].links.lit_by = 0b10;
    EXPECT_EQ(middle({first, second}), 0.0F);
}

TEST(BakeLamps, WhatALampDoesNotLightThrowsNoneOfItOn)
{
    // A floor next to a wall that reflects light to it; the lamp's group either lights the wall or not.
    Scene scene = plain_floor();
    test::add_object(scene, shapes::box({0.1F, 2.0F, 4.0F}), glm::vec3(0.8F), {-2.05, 0.0, 0.0});
    BakeSettings settings = direct({over(scene, 0.0F)});
    settings.lamps[0].baked = false;
    settings.lamps[0].groups = 0b01;
    settings.samples = 64;
    settings.bounces = 1;
    EXPECT_GT(on_floor(scene, baked(scene, settings), {-1.5F, 0.0F}), 0.02F);
    scene.nodes[1].links.lit_by = 0b10;
    EXPECT_EQ(on_floor(scene, baked(scene, settings), {-1.5F, 0.0F}), 0.0F);
}

} // namespace
} // namespace estampe::bake
