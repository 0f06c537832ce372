// SPDX-License-Identifier: MIT
// Compares baked light of lamps with the light that a frame computes itself.
#include "frame/baking.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "features/lighting/lighting.hpp"
#include "scene/static_triangles.hpp"
#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace estampe::frame {
namespace {

constexpr glm::uvec2 size_px(120, 90);

/// A floor with a box on it, and a spot and a lamp over it.
Scene lit_floor()
{
    Scene scene = test::scene_of(shapes::plane(4.0F, 4.0F));
    test::add_object(scene, shapes::box({0.6F, 0.6F, 0.6F}), glm::vec3(1.0F), {0.5, 0.0, 0.3});
    scene.nodes[1].name = "Box";
    const auto add_light = [&](Light light, const glm::dvec3& place) {
        scene.lights.push_back(std::move(light));
        scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
        scene.nodes.push_back(
            {.name = scene.lights.back().name,
             .transform = {.translation = place, .rotation = glm::angleAxis(-1.2, glm::dvec3(1.0, 0.0, 0.0))},
             .light = static_cast<Index>(scene.lights.size() - 1)});
    };
    add_light({.name = "Spot",
               .type = LightType::spot,
               .intensity = 6.0F,
               .range_m = 9.0F,
               .inner_cone_rad = 0.3F,
               .outer_cone_rad = 0.7F},
              {0.0, 2.5, 1.0});
    add_light({.name = "Lamp", .type = LightType::point, .intensity = 1.5F, .range_m = 7.0F},
              {-1.2, 1.6, -0.8});
    return scene;
}

/// The map's light at a place of the floor, whose triangles come first.
float on_floor(const StaticTriangles& still, const Lightmap& map, const glm::dvec3& place)
{
    for (size_t i = 0; i < 2; ++i) {
        const auto corner = [&](size_t k) {
            const glm::dvec3 at = glm::dvec3(still.positions[3 * i + k]) + still.anchor;
            return glm::dvec2(at.x, at.z);
        };
        const glm::dmat2 edges(corner(1) - corner(0), corner(2) - corner(0));
        const glm::vec2 w(glm::inverse(edges) * (glm::dvec2(place.x, place.z) - corner(0)));
        if (w.x >= 0.0F && w.y >= 0.0F && w.x + w.y <= 1.0F) {
            const glm::vec2* at = &map.corners[3 * i];
            const glm::vec2 texel =
                (at[0] + w.x * (at[1] - at[0]) + w.y * (at[2] - at[0])) * static_cast<float>(map.light.width);
            return map.light
                .texels[static_cast<size_t>(texel.y) * map.light.width + static_cast<size_t>(texel.x)]
                .y;
        }
    }
    return -1.0F;
}

struct Likeness {
    size_t compared = 0;
    size_t off = 0; ///< pixels that differ by more than 0.04
    double mean_off = 0.0;
    double mean = 0.0;
};

/// Bakes the lamps' own light, and lights a page by the same style.
Likeness compare(const Scene& plain, const std::vector<std::string>& changes)
{
    features::StyleTables style;
    for (const std::string& change : changes) {
        features::style_schema().set(style, change);
    }
    style.light.ambient = 0.0F;
    style.light.falloff = 1.0F;
    const Scene scene = features::lit_by_style(plain, style);
    bake::BakeSettings settings{.size = 256, .samples = 32, .bounces = 0, .smooth = false};
    set_light(settings, scene, style, {.direct = baked_point | baked_spot});
    bake::Bake bake(scene, settings);
    while (bake.work(1.0)) {
    }
    const Lightmap map = bake.map();

    const Camera camera{.eye = {0.0, 5.0, 4.0}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.75};
    test::Drawing drawing(scene, camera, size_px);
    const ScenePose pose = pose_scene(scene, 0.0);
    light::Lighting lighting =
        light::gather_lights(scene, pose, drawing.layout.bounds, drawing.layout.anchor, style.light);
    const auto light = drawing.light({.records = lighting.records,
                                      .directional_count = lighting.directional_count,
                                      .local_shadow_size = 512,
                                      .has_links = true});
    const auto surface = drawing.surface();
    const StaticTriangles still = static_triangles(scene);
    Likeness result;
    for (size_t i = 0; i < light.size(); ++i) {
        const glm::dvec3 point = drawing.point_seen(i, surface.depth[i]) + drawing.layout.anchor;
        if (surface.draw[i] == 0 || std::abs(point.y) > 1e-3 || std::abs(point.x) > 1.9 ||
            std::abs(point.z) > 1.9) {
            continue;
        }
        const double off = std::abs(static_cast<double>(light[i].y - on_floor(still, map, point)));
        ++result.compared;
        result.off += off > 0.04 ? 1U : 0U;
        result.mean_off += off;
        result.mean += static_cast<double>(light[i].y);
    }
    result.mean_off /= static_cast<double>(result.compared);
    result.mean /= static_cast<double>(result.compared);
    return result;
}

TEST(Baking, LampsAreWhatTheFrameMakesOfThem)
{
    const Scene scene = lit_floor();
    const std::vector<std::vector<std::string>> kinds{
        {},
        {"object.Spot.light.spot_volume=pyramid", "object.Lamp.light.enabled=false"},
        {"object.Spot.light.spot_volume=pyramid", "light.attenuation=unit_volume",
         "object.Spot.light.range_m=4", "object.Spot.light.intensity=0.1", "object.Lamp.light.range_m=3"},
        {"object.Spot.light.shadow_groups=2", "object.Lamp.light.shadows=false",
         "object.Box.light.shadow_groups=1"},
        {"object.Spot.light.groups=2", "object.Lamp.light.groups=1", "object.Box.light.shadows=false"},
    };
    for (const std::vector<std::string>& changes : kinds) {
        const Likeness found = compare(scene, changes);
        fmt::print("{:160} mean {:.3f} off by {:.4f}, {} of {} by more than 0.04\n", fmt::join(changes, " "),
                   found.mean, found.mean_off, found.off, found.compared);
        EXPECT_GT(found.mean, 0.05);
        EXPECT_LT(found.mean_off, 0.02 * found.mean + 0.002);
        // Shadow edges and places that the box occludes may differ.
        EXPECT_LT(found.off, found.compared / 40);
        EXPECT_GT(found.compared, 3000U);
    }
}

} // namespace
} // namespace estampe::frame
