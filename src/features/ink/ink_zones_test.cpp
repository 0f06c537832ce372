// SPDX-License-Identifier: MIT
// Ink masks and ink zones of single objects, chosen by name.
#include "features/ink/flowing_ink.hpp"
#include "features/ink/ink_zones.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "features/common/style_tables.hpp"
#include "features/common/view.hpp"
#include "support/scenes.hpp"

namespace estampe::features {
namespace {

constexpr glm::uvec2 size_px(200, 100);

/// A box whose parent is a post, and two nodes without a mesh: one in the middle of the page, turned to the
/// right, and one behind the eye.
Scene hung_box()
{
    Scene scene = test::scene_of(shapes::box(glm::vec3(1.0F)));
    scene.nodes[0].name = "post";
    const Index box = test::add_object(scene, shapes::box(glm::vec3(0.5F)), glm::vec3(1.0F));
    scene.nodes[box].name = "box";
    scene.nodes[box].parent = 0;
    scene.nodes[0].children.push_back(box);
    scene.roots.pop_back();
    const Index other =
        test::add_object(scene, shapes::box(glm::vec3(0.5F)), glm::vec3(1.0F), {2.0, 0.0, 0.0});
    scene.nodes[other].name = "other";
    for (const double z : {0.0, 20.0}) {
        Node node{.name = "fan"};
        node.matrix = glm::dmat4(glm::dvec4(0.0, 0.0, -0.5, 0.0), glm::dvec4(0.0, 0.5, 0.0, 0.0),
                                 glm::dvec4(-0.5, 0.0, 0.0, 0.0), glm::dvec4(0.0, 0.0, z, 1.0));
        scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
        scene.nodes.push_back(node);
    }
    return scene;
}

InkZones shaped_zones_of(const std::vector<std::string>& assignments)
{
    StyleTables style;
    for (const std::string& assignment : assignments) {
        style_schema().set(style, assignment);
    }
    const Scene scene = hung_box();
    const Camera camera{.eye = {0.0, 0.0, 10.0}, .target = {0.0, 0.0, 0.0}};
    const auto page =
        frame_globals(camera, {}, glm::dvec3(0.0), {.size_px = size_px, .page_height_mm = 50.0});
    return ink_zones(
        {.scene = scene, .pose = pose_scene(scene, 0.0), .anchor = glm::dvec3(0.0), .page = page}, style);
}

std::vector<shared::InkZone> zones_of(const std::vector<std::string>& assignments)
{
    return shaped_zones_of(assignments).zones;
}

TEST(InkMask, NamesObjectsAndWhatHangsOnThem)
{
    const Scene scene = hung_box();
    const pose::MeshData meshes = pose::build_meshes(scene, 0);
    std::vector<std::string> notes;
    EXPECT_TRUE(ink_mask(meshes, scene, "*", notes).empty()) << "all give ink";
    const auto named = [&](const char* patterns) {
        const std::vector<uint32_t> mask = ink_mask(meshes, scene, patterns, notes);
        std::vector<std::string> names;
        for (size_t draw = 0; draw < meshes.sources.size(); ++draw) {
            if (mask[draw] != 0) {
                names.push_back(scene.nodes[meshes.sources[draw].node].name);
            }
        }
        EXPECT_EQ(mask.back(), 0U) << "the blank ground";
        std::ranges::sort(names);
        return names;
    };
    EXPECT_EQ(named("po*"), (std::vector<std::string>{"box", "post"}));
    EXPECT_EQ(named("box, other"), (std::vector<std::string>{"box", "other"}));
    EXPECT_TRUE(notes.empty());
    EXPECT_TRUE(named("nobody").empty());
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("nobody"), std::string::npos);
}

TEST(InkZones, StandOnThePageWhereTheirObjectsAre)
{
    const auto zones =
        zones_of({"object.fan.ink.zone.blow_mm_per_s=20", "object.f*.ink.zone.turn_deg_per_s=90",
                  "object.fan.ink.zone.give=0.5", "ink.zone.amount=0.25"});
    ASSERT_EQ(zones.size(), 1U) << "one of the two is behind the eye";
    EXPECT_NEAR(zones[0].middle_mm.x, 50.0F, 1e-3F);
    EXPECT_NEAR(zones[0].middle_mm.y, 25.0F, 1e-3F);
    const double mm_per_m = 25.0 / (10.0 * std::tan(0.5 * Camera().vertical_fov_rad));
    EXPECT_NEAR(zones[0].radius_mm, 0.5 * mm_per_m, 0.05);
    EXPECT_NEAR(zones[0].velocity_mm_per_s.x, 20.0F, 1e-2F) << "along its -z";
    EXPECT_NEAR(zones[0].velocity_mm_per_s.y, 0.0F, 1e-2F);
    EXPECT_NEAR(zones[0].turn_rad_s, 1.5708F, 1e-3F);
    EXPECT_EQ(zones[0].gives, 0.5F);
    EXPECT_EQ(zones[0].amount, 0.25F);
}

/// A zone of a sphere or of a ring in the middle of the page, which the camera sees from 10 m.
InkZones zone_of(const Primitive& primitive)
{
    Scene scene = test::scene_of(primitive);
    scene.nodes[0].name = "orb";
    scene.nodes[0].matrix = glm::dmat4(1.0);
    StyleTables style;
    style_schema().set(style, "object.orb.ink.zone.give=1");
    const Camera camera{.eye = {0.0, 10.0, 0.0}, .target = {0.0, 0.0, 0.0}, .up = {0.0, 0.0, -1.0}};
    const auto page =
        frame_globals(camera, {}, glm::dvec3(0.0), {.size_px = size_px, .page_height_mm = 50.0});
    return ink_zones(
        {.scene = scene, .pose = pose_scene(scene, 0.0), .anchor = glm::dvec3(0.0), .page = page}, style);
}

/// The value of the zone's field at the node nearest to a place of the page.
float depth_at(const InkZones& found, glm::vec2 place_mm)
{
    const shared::InkZone& zone = found.zones.at(0);
    constexpr auto last = static_cast<float>(shared::ink_shape_side - 1);
    const glm::uvec2 node(glm::round((place_mm - zone.shape_min_mm) / zone.shape_size_mm * last));
    return found.shapes.at((zone.shape - 1) * shared::ink_shape_side * shared::ink_shape_side +
                           node.y * shared::ink_shape_side + node.x);
}

TEST(InkZones, OfAMeshHaveItsShape)
{
    const double mm_per_m = 25.0 / (10.0 * std::tan(0.5 * Camera().vertical_fov_rad));
    const InkZones ball = zone_of(shapes::sphere(1.5F, 64, 32));
    ASSERT_EQ(ball.zones.size(), 1U);
    ASSERT_EQ(ball.zones[0].shape, 1U);
    EXPECT_NEAR(ball.zones[0].middle_mm.x, 50.0F, 0.1F);
    EXPECT_NEAR(ball.zones[0].middle_mm.y, 25.0F, 0.1F);
    // The outline of a sphere seen from 10 m is slightly larger than its radius.
    const double radius_mm = mm_per_m * 10.0 * std::tan(std::asin(1.5 / 10.0));
    EXPECT_NEAR(ball.zones[0].radius_mm, radius_mm, 0.02 * radius_mm);
    for (const float share : {0.0F, 0.25F, 0.5F, 0.75F}) {
        for (const float angle : {0.0F, 0.7F, 2.1F, 4.4F}) {
            const glm::vec2 away =
                share * static_cast<float>(radius_mm) * glm::vec2(std::cos(angle), std::sin(angle));
            EXPECT_NEAR(depth_at(ball, ball.zones[0].middle_mm + away), share, 0.05F)
                << share << ' ' << angle;
        }
    }
    const InkZones ring = zone_of(shapes::torus(1.5F, 0.4F));
    ASSERT_EQ(ring.zones.size(), 1U);
    EXPECT_EQ(depth_at(ring, {50.0F, 25.0F}), 1.0F) << "the hole is outside";
    EXPECT_LT(depth_at(ring, {50.0F + 1.5F * static_cast<float>(mm_per_m), 25.0F}), 0.2F);
    EXPECT_NEAR(ring.zones[0].middle_mm.x, 50.0F, 0.1F);
}

TEST(InkZones, AreOnlyWhereAnOverrideNamesThem)
{
    EXPECT_TRUE(zones_of({"ink.zone.give=1", "object.fan.wash.strength=0.5"}).empty());
    EXPECT_TRUE(zones_of({"object.nothing.ink.zone.give=1"}).empty());
    EXPECT_EQ(zones_of({"object.post.ink.zone.give=1"}).size(), 1U) << "without its child";
    EXPECT_THROW(static_cast<void>(zones_of({"material.fan.ink.zone.give=1"})), Error);
    EXPECT_THROW(static_cast<void>(zones_of({"object.fan.ink.zone.shine=1"})), Error);
    EXPECT_THROW(static_cast<void>(zones_of({"object.fan.ink.zone.give=nan"})), Error);
}

} // namespace
} // namespace estampe::features
