// SPDX-License-Identifier: MIT
#include "support/drawing.hpp"

#include <algorithm>

#include <glm/gtc/packing.hpp>

#include "features/common/view.hpp"
#include "features/hatching/hatching.hpp"
#include "features/shadows/sun.hpp"
#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"

namespace estampe::test {
namespace {

/// Linear colour of what holds its root, alpha as it is.
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

surface::TexturePlan planned(const Scene& scene)
{
    return surface::plan_textures(scene, shared_device().limits().maxImageArrayLayers);
}

} // namespace

Drawing::Drawing(const Scene& scene, const Camera& camera, glm::uvec2 size, double time_s)
    : size_px(size), layout(pose::build_meshes(scene, static_cast<Index>(scene.materials.size()))),
      pose(pose::pose_meshes(layout, scene, pose_scene(scene, time_s))),
      globals(features::frame_globals(camera, layout.bounds, layout.anchor, {.size_px = size})),
      pixel_(features::pixel_size(camera, size.y)), meshes_(pose::upload_meshes(shared_device(), layout)),
      materials_(surface::upload_materials(shared_device(), scene, planned(scene))),
      needs_(surface::scene_needs(scene, planned(scene))),
      frame_(gpu::upload_buffer(shared_device(), "frame", std::vector{globals}))
{
    (void)pose::upload_pose(shared_device(), meshes_, layout, pose);
    const features::StrokePlan strokes = features::plan_strokes(layout, scene.materials, {.styles = {{}}});
    strokes_present_ = strokes.present;
    stroke_kinds_ = gpu::upload_buffer(shared_device(), "stroke kinds", strokes.kind_of_draw);
    form_coordinates_ = gpu::Buffer(shared_device(), "form coordinates", 0, gpu::MemoryUse::device);
}

gpu::BufferId Drawing::add_posed(gpu::Graph& graph)
{
    return pose::add_pose(graph, meshes_, layout, gpu::import_whole(graph, "draws", meshes_.draws),
                          gpu::import_whole(graph, "rest vertices", meshes_.rest_vertices));
}

raster::RasterInputs Drawing::raster_inputs(gpu::Graph& graph, gpu::BufferId posed)
{
    return {.triangles = gpu::import_whole(graph, "triangles", meshes_.triangles),
            .posed_vertices = posed,
            .draws = gpu::import_whole(graph, "draws", meshes_.draws),
            .rest_vertices = gpu::import_whole(graph, "rest vertices", meshes_.rest_vertices),
            .materials = gpu::import_whole(graph, "materials", materials_.materials),
            .textures = surface::import_textures(graph, materials_),
            .texture_classes = needs_.texture_classes};
}

raster::RasterInputs Drawing::raster_inputs(gpu::Graph& graph)
{
    return raster_inputs(graph, add_posed(graph));
}

std::vector<raster::Batch> Drawing::batches() const
{
    const auto batch = [](const pose::Range& range, bool masked) {
        return raster::Batch{range.first, range.count, masked, range.plain};
    };
    std::vector<raster::Batch> result{batch(layout.opaque, false), batch(layout.masked, true)};
    if (with_ground) {
        result.push_back(batch(layout.ground, false));
    }
    return result;
}

std::vector<raster::Batch> Drawing::caster_batches(const LightSetup& setup) const
{
    const uint32_t groups = setup.has_links ? setup.records.front().groups >> 16U : all_groups;
    std::vector<raster::Batch> result;
    for (const pose::CasterRun& run : layout.casters) {
        if ((run.groups & groups) != 0) {
            result.push_back({run.range.first, run.range.count, run.masked, run.range.plain});
        }
    }
    return result;
}

raster::View Drawing::raster_view() const
{
    return {.clip_from_anchor = globals.clip_from_anchor, .size_px = size_px, .path = path, .tuning = tuning};
}

gpu::BufferId Drawing::add_visibility(gpu::Graph& graph, gpu::BufferId posed)
{
    return raster::add_visibility(graph, "visibility", raster_inputs(graph, posed), batches(), raster_view());
}

Drawing::Stage Drawing::add_surface(gpu::Graph& graph)
{
    const gpu::BufferId frame = gpu::import_whole(graph, "frame", frame_);
    const raster::RasterInputs inputs = raster_inputs(graph, add_posed(graph));
    const gpu::BufferId visibility =
        raster::add_visibility(graph, "visibility", inputs, batches(), raster_view());
    const surface::Surface seen = surface::add_resolve(
        graph,
        {.frame = frame,
         .visibility = visibility,
         .triangles = inputs.triangles,
         .posed_vertices = inputs.posed_vertices,
         .draws = inputs.draws,
         .rest_vertices = inputs.rest_vertices,
         .stroke_coordinates = gpu::import_whole(graph, "stroke coordinates", meshes_.stroke_coordinates),
         .stroke_kinds = gpu::import_whole(graph, "stroke kinds", stroke_kinds_),
         .form_coordinates = gpu::import_whole(graph, "form coordinates", form_coordinates_),
         .materials = inputs.materials,
         .textures = inputs.textures,
         .needs = needs_,
         .strokes_present = strokes_present_,
         .strokes_per_m = static_cast<float>(1.0 / layout.stroke_unit_m),
         .size_px = size_px});
    return {.frame = frame,
            .triangles = inputs.triangles,
            .draws = inputs.draws,
            .posed = inputs.posed_vertices,
            .rest_vertices = inputs.rest_vertices,
            .materials = inputs.materials,
            .visibility = visibility,
            .surface = seen};
}

transparency::Transparency Drawing::add_transparency(gpu::Graph& graph)
{
    const gpu::BufferId posed = add_posed(graph);
    const raster::RasterInputs inputs = raster_inputs(graph, posed);
    const raster::Batch blended{layout.blended.first, layout.blended.count, true};
    return transparency::add_transparency(
        graph, {.frame = gpu::import_whole(graph, "frame", frame_),
                .solid_visibility = add_visibility(graph, posed),
                .layers = raster::add_layers(graph, "screen", inputs, {&blended, 1}, raster_view(),
                                             layout.blended_sheets),
                .triangles = inputs.triangles,
                .posed_vertices = posed,
                .draws = inputs.draws,
                .rest_vertices = inputs.rest_vertices,
                .materials = inputs.materials,
                .textures = inputs.textures,
                .texture_classes = needs_.texture_classes,
                .size_px = size_px});
}

light::LitPixels Drawing::add_light(gpu::Graph& graph, const Stage& stage, LightSetup setup)
{
    const gpu::BufferId local_maps = add_local_maps(graph, stage, setup);
    const glm::dvec3 towards_sun =
        setup.directional_count > 0 ? glm::dvec3(setup.records.front().direction) : glm::dvec3(0, 1, 0);
    const features::SunMapPlan plan = sun_plan(towards_sun, setup);
    const shared::LightGlobals lighting{.sky_ambient = setup.ambient,
                                        .ground_ambient = setup.ambient,
                                        .directional_count = setup.directional_count,
                                        .local_count = static_cast<uint32_t>(setup.records.size()) -
                                                       setup.directional_count,
                                        .falloff = setup.falloff};
    light_globals_ = gpu::upload_buffer(shared_device(), "lighting", std::vector{lighting});
    sun_shadow_ = gpu::upload_buffer(shared_device(), "sun",
                                     std::vector{features::sun_globals(plan, pixel_, setup.shadow)});
    edge_look_ = gpu::upload_buffer(shared_device(), "edges",
                                    std::vector{shadow::edge_look(setup.shadow, setup.lines, 1.0F)});
    lights_ = gpu::upload_buffer(shared_device(), "lights", setup.records);
    const gpu::BufferId shadow_map = add_sun_map(graph, stage, setup, plan);
    return light::add_light(
        graph,
        {.frame = stage.frame,
         .lighting = gpu::import_whole(graph, "lighting", light_globals_),
         .lights = gpu::import_whole(graph, "lights", lights_),
         .draw = stage.surface.draw,
         .depth = stage.surface.depth,
         .normal = stage.surface.normal,
         .draws = stage.draws,
         .materials = stage.materials,
         .sun_map = shadow_map,
         .sun_shadow = gpu::import_whole(graph, "sun", sun_shadow_),
         .coordinate = stage.surface.coordinate,
         .footprint = stage.surface.footprint,
         .edge_look = gpu::import_whole(graph, "edges", edge_look_),
         .shadow_variant = shadow::shadow_variant(setup.shadow, setup.lines) | plan.variant | lamps_variant_,
         .local_shadows = gpu::import_whole(graph, "local shadows", local_shadows_),
         .local_maps = local_maps,
         .has_local_shadows = setup.local_shadow_size > 0,
         .has_shadow = plan.size > 0,
         .local_count = lighting.local_count,
         .has_emissive = needs_.emissive,
         .keeps_strongest = setup.keeps_strongest,
         .keeps_sun = setup.keeps_sun,
         .counts_visits = setup.counts_visits,
         .looks_at_all = setup.looks_at_all,
         .has_links = setup.has_links,
         .size_px = size_px});
}

std::vector<shared::PosedVertex> Drawing::posed()
{
    gpu::Graph graph;
    return run_and_read_as<shared::PosedVertex>(graph, add_posed(graph));
}

std::vector<uint64_t> Drawing::visibility()
{
    gpu::Graph graph;
    auto words = run_and_read_as<uint64_t>(graph, add_visibility(graph, add_posed(graph)));
    words.resize(static_cast<size_t>(size_px.x) * size_px.y); // the buffer is whole groups of 16 bytes
    return words;
}

std::vector<float> Drawing::depth_alone()
{
    gpu::Graph graph;
    const uint64_t size_bytes = sizeof(float) * size_px.x * size_px.y;
    const auto target = graph.buffer("depths", {.size_bytes = (size_bytes + 15) / 16 * 16});
    auto depths = run_and_read_as<float>(graph, raster::add_depth(graph, "depths",
                                                                  raster_inputs(graph, add_posed(graph)),
                                                                  batches(), raster_view(), target));
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
    const raster::RasterInputs inputs = raster_inputs(graph, add_posed(graph));
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
    return run_and_read_as<uint32_t>(graph,
                                     raster::add_depth_views(graph, "depths", inputs, batches(), drawn,
                                                             gpu::import_whole(graph, "depths", target)));
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
    gpu::Graph for_draw;
    gpu::Graph for_color;
    ScreenPixels pixels;
    pixels.draw = run_and_read_as<uint32_t>(for_draw, add_transparency(for_draw).draw);
    pixels.color = unpack_roots(run_and_read_as<uint32_t>(for_color, add_transparency(for_color).color));
    return pixels;
}

std::vector<glm::vec4> Drawing::light(const LightSetup& setup)
{
    gpu::Graph graph;
    const Stage stage = add_surface(graph);
    std::vector<glm::vec4> result;
    for (const uint64_t packed : run_and_read_as<uint64_t>(graph, add_light(graph, stage, setup).light)) {
        result.push_back(glm::unpackHalf4x16(packed));
    }
    return result;
}

std::vector<glm::vec3> Drawing::strongest_light(LightSetup setup)
{
    setup.keeps_strongest = true;
    gpu::Graph graph;
    const Stage stage = add_surface(graph);
    std::vector<glm::vec3> result;
    for (const uint32_t packed : run_and_read_as<uint32_t>(graph, add_light(graph, stage, setup).strongest)) {
        result.push_back(packed == 0 ? glm::vec3(0.0F) : pose::unpack_normal(packed));
    }
    return result;
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

} // namespace estampe::test
