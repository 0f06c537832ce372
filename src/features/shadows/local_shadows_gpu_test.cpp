// SPDX-License-Identifier: MIT
// When the shadow maps of local lights are drawn, and by which passes.
#include <algorithm>

#include <estampe/shapes.hpp>
#include <estampe/style.hpp>
#include <gtest/gtest.h>

#include "features/shadows/shadows.hpp"
#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::features {
namespace {

constexpr RenderSettings small_page{.width = 96, .height = 64};

void add_lamp(Scene& scene, const glm::dvec3& place, float range_m)
{
    scene.lights.push_back({.type = LightType::point, .intensity = 5.0F, .range_m = range_m});
    scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back(
        {.transform = {.translation = place}, .light = static_cast<Index>(scene.lights.size() - 1)});
}

/// Two lamps ten metres apart, with a box next to each. The right box slides during the first animation.
Scene two_lamps()
{
    Scene scene = test::scene_of(shapes::plane(20.0F, 8.0F));
    test::add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), glm::vec3(1.0F), {-5.0, 0.0, 0.0});
    const Index mover =
        test::add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), glm::vec3(1.0F), {5.0, 0.0, 0.0});
    add_lamp(scene, {-5.0, 2.5, 1.0}, 4.0F);
    add_lamp(scene, {5.0, 2.5, 1.0}, 4.0F);
    Animation slide{.channels = {{.node = mover,
                                  .path = AnimatedPath::translation,
                                  .times_s = {0.0F, 1.0F},
                                  .values = {5.0F, 0.0F, 0.0F, 6.0F, 0.0F, 0.0F}}},
                    .duration_s = 1.0F};
    scene.animations.push_back(slide);
    return scene;
}

const Camera lamp_camera{.eye = {0.0, 5.0, 12.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.7};

bool drew(const Renderer& renderer, const std::string& pass)
{
    return std::ranges::any_of(renderer.timings(),
                               [&](const PassTiming& timing) { return timing.name.starts_with(pass); });
}

bool drew_maps(const Renderer& renderer)
{
    return drew(renderer, "local shadows");
}

TEST(LocalShadowMaps, AStillSceneDrawsNoMap)
{
    Renderer renderer(test::validated());
    renderer.set_scene(two_lamps());
    const Style style;
    const Image first = renderer.render(lamp_camera, style, small_page);
    EXPECT_TRUE(drew_maps(renderer));
    const Image second = renderer.render(lamp_camera, style, small_page);
    EXPECT_FALSE(drew_maps(renderer));
    EXPECT_EQ(first.rgba, second.rgba);
}

TEST(LocalShadowMaps, WhatMovesWithinReachIsDrawnAfresh)
{
    Renderer renderer(test::validated());
    renderer.set_scene(two_lamps());
    const Style style;
    RenderSettings later = small_page;
    later.time_s = 0.5;
    (void)renderer.render(lamp_camera, style, small_page);
    const Image kept = renderer.render(lamp_camera, style, later);
    EXPECT_TRUE(drew_maps(renderer));
    Renderer fresh(test::validated());
    fresh.set_scene(two_lamps());
    EXPECT_EQ(kept.rgba, fresh.render(lamp_camera, style, later).rgba);
}

TEST(LocalShadowMaps, OnlyWhatMovesIsDrawnAgain)
{
    for (const RasterPath path : {RasterPath::compute, RasterPath::hardware}) {
        RendererOptions options = test::validated();
        options.raster = path;
        Renderer renderer(options);
        renderer.set_scene(two_lamps());
        const Style style;
        RenderSettings moment = small_page;
        (void)renderer.render(lamp_camera, style, moment);
        EXPECT_FALSE(drew(renderer, "local shadows/moving"));
        for (const double time_s : {0.2, 0.4, 0.6}) {
            moment.time_s = time_s;
            const Image kept = renderer.render(lamp_camera, style, moment);
            EXPECT_TRUE(drew(renderer, "local shadows/moving"));
            EXPECT_EQ(drew(renderer, "local shadows/still"), time_s == 0.2);
            Renderer fresh(options);
            fresh.set_scene(two_lamps());
            EXPECT_EQ(kept.rgba, fresh.render(lamp_camera, style, moment).rgba) << time_s;
        }
    }
}

/// A post, a ball, and objects in front of each other. An animation moves half of them.
Scene half_moving()
{
    Scene scene = two_lamps();
    for (int i = 0; i < 6; ++i) {
        const Index node = test::add_object(scene, shapes::sphere(0.3F, 24, 12), glm::vec3(1.0F),
                                            {-1.0 + 0.9 * i, 0.2 * i, 0.3 * (i % 3)});
        scene.materials.back().alpha_mode = i == 3 ? AlphaMode::mask : AlphaMode::opaque;
        if (i % 2 == 0) {
            scene.animations[0].channels.push_back({.node = node,
                                                    .path = AnimatedPath::translation,
                                                    .times_s = {0.0F},
                                                    .values = {0.9F * static_cast<float>(i), 0.4F, 0.5F}});
        }
    }
    return scene;
}

std::vector<uint32_t> read_texels(gpu::Graph& graph, gpu::BufferId maps, size_t count)
{
    auto words = test::run_and_read_as<uint32_t>(graph, maps);
    words.resize(count);
    return words;
}

TEST(LocalShadowMaps, MapsInLayersAreThoseDrawnWholeBitForBit)
{
    constexpr uint32_t size = 128;
    const Scene scene = half_moving();
    test::Drawing drawing(scene, lamp_camera, {96, 64}, 0.3);
    shared::LightRecord record{};
    record.type = shared::light_point;
    record.position = glm::vec3(glm::dvec3(1.0, 2.5, 1.0) - drawing.layout.anchor);
    record.range_m = 9.0F;
    record.groups = 0xffffffffU;
    const shadow::LocalLight light = local_light(record);
    std::vector<shared::RasterView> list;
    for (const shadow::LocalView& view : shadow::local_views(light, shadow::local_shadow(light, size, 0))) {
        list.push_back({.clip_from_anchor = view.clip_from_anchor,
                        .eye_anchor = light.position,
                        .reach_m = light.range_m,
                        .first_texel = view.first_texel,
                        .size_px = size,
                        .origin_px = glm::uvec2(0),
                        .groups = light.casters});
    }
    raster::place_views(list);
    const size_t texel_count = 6 * size * size;
    const auto drawn = [&](RasterPath path, const LocalMapViews& views) {
        // The former content shows where the map is not overwritten.
        const std::vector<uint32_t> before(texel_count, 0x3f7fffffU);
        LocalShadowBuffers buffers;
        buffers.maps = gpu::upload_buffer(test::shared_device(), "maps", before);
        buffers.layers = gpu::upload_buffer(test::shared_device(), "layers", before);
        buffers.views.whole = gpu::upload_buffer(test::shared_device(), "views", views.whole);
        buffers.views.still = gpu::upload_buffer(test::shared_device(), "still", views.still);
        buffers.views.moving = gpu::upload_buffer(test::shared_device(), "moving", views.moving);
        gpu::Graph graph;
        const raster::RasterInputs inputs = drawing.raster_inputs(graph);
        raster::ClusterBoxes boxes;
        const gpu::BufferId maps = add_local_maps(
            graph,
            {.raster = inputs,
             .layout = drawing.layout,
             .cluster_bounds = boxes.add(graph, test::shared_device(), inputs,
                                         static_cast<uint32_t>(drawing.layout.triangles.size())),
             .path = path},
            views, buffers);
        return read_texels(graph, maps, texel_count);
    };
    for (const RasterPath path : {RasterPath::compute, RasterPath::hardware}) {
        const auto whole = drawn(path, {.whole = list});
        const auto layered = drawn(path, {.still = list, .moving = list});
        EXPECT_EQ(whole, layered);
        EXPECT_GT(std::ranges::count_if(whole, [](uint32_t texel) { return texel != 0; }), 1000);
    }
}

size_t triangle_count(const std::vector<raster::Batch>& batches)
{
    size_t sum = 0;
    for (const raster::Batch& batch : batches) {
        sum += batch.triangle_count;
    }
    return sum;
}

TEST(LocalShadowMaps, FewerTrianglesAreDrawnWhereFewMove)
{
    const Scene scene = half_moving();
    const pose::MeshData layout = pose::build_meshes(scene, static_cast<Index>(scene.materials.size()));
    const size_t all = triangle_count(caster_batches(layout, all_groups));
    const size_t moving = triangle_count(caster_batches(layout, all_groups, Casters::moving));
    const size_t still = triangle_count(caster_batches(layout, all_groups, Casters::still));
    EXPECT_EQ(moving + still, all);
    // The sliding box and three of six balls move; the other balls, the first box and the floor are static.
    const size_t ball = shapes::sphere(0.3F, 24, 12).indices.size() / 3;
    EXPECT_EQ(moving, 12U + 3U * ball);
    EXPECT_EQ(caster_kinds(layout).moving, true);
    EXPECT_EQ(caster_kinds(layout).still, true);
}

} // namespace
} // namespace estampe::features
