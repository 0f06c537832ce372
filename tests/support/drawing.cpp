// SPDX-License-Identifier: MIT
#include "support/drawing.hpp"

#include <algorithm>

#include <glm/gtc/packing.hpp>

#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "techniques/shadow/sun/sun_map.hpp"

namespace estampe::test {
namespace {

/// Converts square roots of linear colour to linear colour. Alpha is unchanged.
std::vector<glm::vec4> unpack_roots(const std::vector<uint32_t>& packed)
{
    std::vector<glm::vec4> colors;
    for (const uint32_t word : packed) {
        const glm::vec4 root = glm::unpackUnorm4x8(word);
        colors.emplace_back(glm::vec3(root) * glm::vec3(root), root.w);
    }
    return colors;
}

void unpack_footprint(SurfacePixels& pixels, const std::vector<glm::uvec4>& packed)
{
    for (const glm::uvec4& word : packed) {
        float scale = 0.0F;
        std::memcpy(&scale, &word.w, sizeof(scale));
        const glm::vec2 a = glm::unpackSnorm2x16(word.x) * scale;
        const glm::vec2 b = glm::unpackSnorm2x16(word.y) * scale;
        const glm::vec2 c = glm::unpackSnorm2x16(word.z) * scale;
        pixels.footprint_dx.emplace_back(a.x, a.y, b.x);
        pixels.footprint_dy.emplace_back(b.y, c.x, c.y);
    }
}

} // namespace

Drawing::Drawing(const Scene& scene, const Camera& camera, glm::uvec2 size, double time_s)
    : loaded(std::make_unique<frame::LoadedScene>(
          frame::load_onto_device(shared_device(), scene, /*lightmap=*/nullptr))),
      size_px(size), layout(loaded->layout),
      pose(loaded->pose.emplace(pose::pose_meshes(layout, loaded->scene, pose_scene(loaded->scene, time_s)))),
      globals(features::frame_globals(camera, layout.bounds, layout.anchor, {.size_px = size}))
{
    (void)pose::upload_pose(shared_device(), loaded->meshes, layout, pose);
    buffers_.frame_globals = gpu::upload_buffer(shared_device(), "frame", std::vector{globals});
    plan_.page_px = size;
    plan_.page.size_px = size;
    plan_.page.pixel = features::pixel_size(camera, size.y);
    plan_.needs = loaded->needs;
    plan_.variants.styles = {style_};
    plan_.strokes = features::plan_strokes(layout, plan_.variants);
}

frame::FrameContext Drawing::context(gpu::Graph& graph)
{
    plan_.page.has_ground = with_ground;
    plan_.raster = {.paths = {.page = path, .maps = path}, .tuning = tuning};
    sample_.size_px = size_px;
    sample_.clip_from_anchor = globals.clip_from_anchor;
    features->hatching.ensure_strokes(shared_device(), layout, plan_.strokes);
    loaded->cluster_boxes.forget(); // tests change the layout and the pose between drawings
    features->invalidate(features::Event::pose_changed);
    return {.graph = graph,
            .device = shared_device(),
            .loaded = *loaded,
            .features = *features,
            .buffers = buffers_,
            .job = job_,
            .plan = plan_,
            .sample = sample_,
            .style = style_,
            .wash_variants = wash_variants_};
}

raster::RasterInputs Drawing::raster_inputs(gpu::Graph& graph)
{
    return frame::add_posed_scene(context(graph)).meshes;
}

Drawing::Stage Drawing::add_surface(gpu::Graph& graph)
{
    const frame::FrameContext in = context(graph);
    const frame::PosedScene scene = frame::add_posed_scene(in);
    const gpu::BufferId visibility = frame::add_visibility(in, scene);
    return {.context = in,
            .scene = scene,
            .visibility = visibility,
            .surface = frame::add_surface(in, scene, visibility)};
}

features::SunMapPlan Drawing::sun_plan(const LightSetup& setup) const
{
    const glm::dvec3 towards_sun =
        setup.directional_count > 0 ? glm::dvec3(setup.records.front().direction) : glm::dvec3(0, 1, 0);
    features::SunMapPlan plan{.size = setup.shadow_size,
                              .view = sun(towards_sun, std::max(setup.shadow_size, 4U))};
    if (setup.is_warped) {
        const shadow::SunMapFit fit = warped_sun(towards_sun, setup.shadow_size);
        plan.view = fit.view;
        plan.variant |= fit.variant;
    }
    if (setup.clipmap) {
        plan.clipmap = setup.clipmap;
        plan.size = setup.clipmap->size;
        plan.windows = shadow::windows_about(*plan.clipmap, glm::dvec3(globals.eye_anchor));
        plan.variant |= shared::light_has_sun_levels;
    }
    return plan;
}

void Drawing::prepare_light(const LightSetup& setup)
{
    const auto local_count = static_cast<uint32_t>(setup.records.size()) - setup.directional_count;
    light::Lighting lighting{.records = setup.records, .directional_count = setup.directional_count};
    if (setup.has_links && setup.directional_count > 0) {
        lighting.sun_casters = static_cast<Groups>(setup.records.front().groups >> 16U);
    }
    plan_.light = {
        .local_count = local_count, .leads_strokes = setup.keeps_strongest, .has_links = setup.has_links};
    plan_.lines.of_shadows = setup.keeps_sun;
    plan_.shadow_edges = {.profile = shadow::edge_profile(setup.shadow, setup.lines, 1.0F),
                          .variant = shadow::shadow_variant(setup.shadow, setup.lines)};
    plan_.sun.map = sun_plan(setup);
    features::Shadows& shadows = features->shadows;
    if (!setup.keeps_sun_map) {
        shadows.invalidate(features::Event::lights_changed);
    }
    sample_.sun_map = shadows.sun().ensure(
        shared_device(), plan_.sun.map,
        features::sun_casters(layout, loaded->layout_number, lighting.sun_casters, path));
    shadows.sun().drawn(plan_.sun.map);
    // Such tiny pixels make every light request the largest map.
    features::LocalMapScene local{.page = {.pixel = {.at_one_m = 1e-12F}},
                                  .style = setup.shadow,
                                  .casters = features::caster_kinds(layout)};
    local.style.local_size = static_cast<int>(setup.local_shadow_size);
    local.style.local_lights = setup.local_shadow_size > 0 ? static_cast<int>(local_count) : 0;
    local.style.local_megatexels = 1e4F;
    std::vector<std::string> notes;
    plan_.local_shadows = shadows.ensure_local_maps(shared_device(), lighting, local, notes);
    shadows.upload(shared_device(), plan_.shadow_edges.profile,
                   features::sun_globals(plan_.sun.map, plan_.page.pixel, setup.shadow));
    features->lighting.upload(shared_device(),
                              {.sky_ambient = setup.ambient,
                               .ground_ambient = setup.ambient,
                               .directional_count = setup.directional_count,
                               .local_count = local_count,
                               .falloff = setup.falloff},
                              lighting.records);
}

light::LitPixels Drawing::add_light(const Stage& stage, const LightSetup& setup)
{
    const light::ShadowMaps maps = frame::add_shadow_maps(stage.context, stage.scene);
    if (!setup.counts_visits && !setup.looks_at_all) {
        return frame::add_light(stage.context, stage.scene, stage.visibility, stage.surface,
                                {.maps = maps, .smoke = {}, .lightmap = {}, .occlusion = {}});
    }
    light::LightInputs inputs = frame::light_inputs(stage.context, stage.scene, stage.surface, maps);
    inputs.shadows.variant |= plan_.shadow_edges.variant;
    inputs.has_emissive = plan_.needs.emissive;
    inputs.counts_visits = setup.counts_visits;
    inputs.looks_at_all = setup.looks_at_all;
    return light::add_light(stage.context.graph, inputs);
}

std::vector<shared::PosedVertex> Drawing::posed()
{
    gpu::Graph graph;
    return run_and_read_as<shared::PosedVertex>(graph, raster_inputs(graph).posed_vertices);
}

std::vector<uint64_t> Drawing::visibility()
{
    gpu::Graph graph;
    const frame::FrameContext in = context(graph);
    auto words = run_and_read_as<uint64_t>(graph, frame::add_visibility(in, frame::add_posed_scene(in)));
    words.resize(static_cast<size_t>(size_px.x) * size_px.y); // the buffer's size is a multiple of 16 bytes
    return words;
}

std::vector<float> Drawing::depth_alone()
{
    gpu::Graph graph;
    const frame::FrameContext in = context(graph);
    const uint64_t size_bytes = sizeof(float) * size_px.x * size_px.y;
    auto depths = run_and_read_as<float>(
        graph, raster::add_depth(graph, "depths", frame::add_posed_scene(in).meshes,
                                 frame::solid_batches(layout, with_ground), frame::eye_view(in),
                                 graph.buffer("depths", {.size_bytes = (size_bytes + 15) / 16 * 16})));
    depths.resize(static_cast<size_t>(size_px.x) * size_px.y);
    return depths;
}

std::vector<uint32_t> Drawing::depth_views(const std::vector<shared::RasterView>& views, size_t texel_count,
                                           uint32_t before, const std::vector<uint32_t>& tiles)
{
    gpu::Buffer target =
        gpu::upload_buffer(shared_device(), "depths", std::vector<uint32_t>(texel_count, before));
    gpu::Buffer records = gpu::upload_buffer(shared_device(), "views", views);
    gpu::Buffer tile_list = gpu::upload_buffer(shared_device(), "tiles", tiles);
    const auto triangle_count = static_cast<uint32_t>(layout.triangles.size());
    gpu::Graph graph;
    const raster::RasterInputs inputs = raster_inputs(graph);
    const gpu::BufferId bounds = raster::add_cluster_bounds(
        graph, inputs, triangle_count,
        graph.buffer("bounds", {.size_bytes = raster::cluster_bounds_bytes(triangle_count)}));
    raster::DepthViews drawn{.list = views,
                             .records = gpu::import_whole(graph, "views", records),
                             .bounds = bounds,
                             .path = path,
                             .tuning = tuning};
    if (!tiles.empty()) {
        drawn.tiles = raster::ViewTiles{.list = gpu::import_whole(graph, "tiles", tile_list),
                                        .count = static_cast<uint32_t>(tiles.size())};
    }
    return run_and_read_as<uint32_t>(
        graph, raster::add_depth_views(graph, "depths", inputs, frame::solid_batches(layout, with_ground),
                                       drawn, gpu::import_whole(graph, "depths", target)));
}

SurfacePixels Drawing::surface()
{
    SurfacePixels pixels;
    const auto read = [this]<class T>(gpu::ImageId surface::Surface::*image, T /*texel*/) {
        gpu::Graph graph;
        const Stage stage = add_surface(graph);
        return run_and_read_as<T>(graph, stage.surface.*image);
    };
    pixels.draw = read(&surface::Surface::draw, uint32_t{});
    pixels.depth = read(&surface::Surface::depth, float{});
    for (const glm::uvec2& packed : read(&surface::Surface::normal, glm::uvec2{})) {
        pixels.shading_normal.push_back(pose::unpack_normal(packed.x));
        pixels.smooth_normal.push_back(pose::unpack_normal(packed.y));
    }
    pixels.color = unpack_roots(read(&surface::Surface::color, uint32_t{}));
    for (const glm::vec4& coordinate : read(&surface::Surface::coordinate, glm::vec4{})) {
        pixels.coordinate.emplace_back(coordinate);
    }
    unpack_footprint(pixels, read(&surface::Surface::footprint, glm::uvec4{}));
    return pixels;
}

ScreenPixels Drawing::screen()
{
    const auto read = [this](gpu::ImageId transparency::Transparency::*image) {
        gpu::Graph graph;
        const frame::FrameContext in = context(graph);
        const frame::PosedScene scene = frame::add_posed_scene(in);
        const frame::SeenThrough seen = frame::add_transparency(in, scene, frame::add_visibility(in, scene));
        return run_and_read_as<uint32_t>(graph, seen.images.*image);
    };
    return {.draw = read(&transparency::Transparency::draw),
            .color = unpack_roots(read(&transparency::Transparency::color))};
}

std::vector<glm::vec4> Drawing::light(const LightSetup& setup)
{
    prepare_light(setup);
    gpu::Graph graph;
    std::vector<glm::vec4> result;
    for (const uint64_t packed :
         run_and_read_as<uint64_t>(graph, add_light(add_surface(graph), setup).light)) {
        result.push_back(glm::unpackHalf4x16(packed));
    }
    return result;
}

std::vector<glm::vec3> Drawing::strongest_light(LightSetup setup)
{
    setup.keeps_strongest = true;
    prepare_light(setup);
    gpu::Graph graph;
    std::vector<glm::vec3> result;
    for (const uint32_t packed :
         run_and_read_as<uint32_t>(graph, add_light(add_surface(graph), setup).strongest)) {
        result.push_back(packed == 0 ? glm::vec3(0.0F) : pose::unpack_normal(packed));
    }
    return result;
}

std::vector<uint32_t> Drawing::sun_piece(const shadow::Clipmap& clipmap, const shadow::Piece& piece)
{
    gpu::Graph graph;
    raster::RasterInputs inputs = raster_inputs(graph);
    inputs.posed_vertices =
        shadow::add_sun_vertices(graph, inputs.posed_vertices, loaded->meshes.vertex_count, clipmap);
    const auto target = graph.buffer("depths", {.size_bytes = 4ULL * piece.size.x * piece.size.y});
    return run_and_read_as<uint32_t>(
        graph, raster::add_depth(graph, "piece", inputs, frame::solid_batches(layout, with_ground),
                                 {.clip_from_anchor = shadow::clip_from_sun(piece),
                                  .size_px = piece.size,
                                  .cull_back_faces = false,
                                  .path = path,
                                  .tuning = tuning},
                                 target));
}

glm::dvec3 Drawing::point_at(glm::dvec2 position_px, double depth) const
{
    const glm::dvec2 ndc = 2.0 * position_px / glm::dvec2(size_px) - 1.0;
    const glm::dvec4 p = glm::inverse(glm::dmat4(globals.clip_from_anchor)) * glm::dvec4(ndc, depth, 1.0);
    return glm::dvec3(p) / p.w;
}

glm::dvec3 Drawing::point_seen(size_t pixel, float depth) const
{
    const size_t row = pixel / size_px.x;
    const glm::dvec2 center(static_cast<double>(pixel % size_px.x) + 0.5, static_cast<double>(row) + 0.5);
    return point_at(center, static_cast<double>(std::max(depth, 1e-9F)));
}

shadow::SunView Drawing::sun(const glm::dvec3& towards_sun, uint32_t shadow_size) const
{
    return shadow::sun_view(pose.casters, layout.anchor, towards_sun, shadow_size);
}

shadow::SunMapFit Drawing::warped_sun(const glm::dvec3& towards_sun, uint32_t shadow_size) const
{
    return shadow::fit_sun_map({.casters = pose.casters,
                                .anchor = layout.anchor,
                                .towards_sun = towards_sun,
                                .floor_m = layout.bounds.min.y,
                                .nearest_m = 2.0,
                                .size = shadow_size,
                                .eye = globals},
                               {.sun_map = shadow::SunMapKind::warped});
}

} // namespace estampe::test
