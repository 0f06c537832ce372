// SPDX-License-Identifier: MIT
// From triangles to what is seen at each pixel.
#include <algorithm>

#include "frame/steps.hpp"
#include "gpu/imports.hpp"

namespace estampe::frame {
namespace {

raster::Batch batch(const pose::Range& range, bool masked = false)
{
    return {
        .first_triangle = range.first, .triangle_count = range.count, .masked = masked, .plain = range.plain};
}

bool wants_cluster_bounds(const Making& making)
{
    const RasterPlan& plan = making.plan.raster;
    return (making.sample.is_first && !making.plan.local_shadows.views.empty()) ||
           (plan.paths.page == RasterPath::compute &&
            making.layout.opaque.count >= plan.tuning.clusters_from);
}

/// What lies behind thick clear bodies, where there are such, for colour and for lines.
void add_backgrounds(const Making& making, const PosedScene& scene, SeenThrough& screen)
{
    const std::optional<SubsurfacePlan>& plan = making.plan.subsurface;
    if (!plan || plan->clear.empty()) {
        return;
    }
    const raster::View view = eye_view(making);
    screen.background =
        raster::add_visibility(making.graph, "subsurface/background", scene.meshes, plan->others, view);
    if (plan->lines_show) {
        screen.line_hiders = screen.background;
    } else if (!plan->line_hiders.empty()) {
        screen.line_hiders =
            raster::add_visibility(making.graph, "contour/hiders", scene.meshes, plan->line_hiders, view);
    }
}

} // namespace

Few<raster::Batch, 3> solid_batches(const pose::MeshData& layout, bool with_ground)
{
    Few<raster::Batch, 3> batches;
    batches.push_back(batch(layout.opaque));
    batches.push_back(batch(layout.masked, true));
    if (with_ground) {
        batches.push_back(batch(layout.ground));
    }
    return batches;
}

raster::View eye_view(const Making& making)
{
    return {.clip_from_anchor = making.sample.clip_from_anchor,
            .size_px = making.sample.size_px,
            .path = making.plan.raster.paths.page,
            .tuning = making.plan.raster.tuning};
}

PosedScene add_posed_scene(const Making& making)
{
    gpu::Graph& graph = making.graph;
    pose::MeshBuffers& meshes = making.resources.meshes;
    const auto draws = gpu::import_whole(graph, "draws", meshes.draws);
    const auto rest_vertices = gpu::import_whole(graph, "rest vertices", meshes.rest_vertices);
    const std::span<const uint32_t> sheets_drawn =
        making.resources.cloth != nullptr ? making.resources.cloth->draws() : std::span<const uint32_t>();
    terrain::TerrainBuffers::Posed posed{
        .vertices = making.sample.pose_moved
                        ? pose::add_pose_of_moved(graph, meshes, making.layout, making.resources.pose,
                                                  sheets_drawn, draws, rest_vertices)
                        : gpu::import_whole(graph, "posed vertices", meshes.posed_vertices[0]),
        .before = gpu::import_whole(graph, "vertices before", meshes.posed_vertices[1]),
        .stroke_coordinates = gpu::import_whole(graph, "stroke coordinates", meshes.stroke_coordinates)};
    if (making.resources.cloth != nullptr && making.sample.pose_moved) {
        cloth::Cloths& sheets = making.resources.cloth->sheets();
        cloth::Cloths::Handles handles = sheets.import(graph);
        if (making.resources.cloth_steps != nullptr) {
            making.resources.cloth->add_steps(graph, handles, *making.resources.cloth_steps,
                                              making.resources.pose, making.layout.anchor, posed.vertices);
        }
        posed.vertices = sheets.add_vertices(graph, handles, posed.vertices);
        posed.before = sheets.add_vertices_before(graph, handles, posed.before);
    }
    std::optional<gpu::BufferId> terrain_texels;
    if (making.resources.terrain != nullptr) {
        terrain_texels = making.resources.terrain->add_texels(graph);
    }
    if (making.sample.terrain_moved) {
        posed = making.resources.terrain->add_vertices(graph, posed, *terrain_texels);
    }
    PosedScene scene{
        .frame = gpu::import_whole(graph, "frame", making.resources.frame_globals),
        .stroke_coordinates = posed.stroke_coordinates,
        .vertices_before = posed.before,
        .terrain_texels = terrain_texels,
        .meshes = {.triangles = gpu::import_whole(graph, "triangles", meshes.triangles),
                   .posed_vertices = posed.vertices,
                   .draws = draws,
                   .rest_vertices = rest_vertices,
                   .materials = gpu::import_whole(graph, "materials", making.resources.materials.materials),
                   .textures = surface::import_textures(graph, making.resources.materials),
                   .texture_classes = making.plan.needs.texture_classes}};
    if (wants_cluster_bounds(making)) {
        scene.cluster_bounds =
            making.resources.cluster_boxes.add(graph, making.resources.device, scene.meshes,
                                               static_cast<uint32_t>(making.layout.triangles.size()));
    }
    return scene;
}

gpu::BufferId add_visibility(const Making& making, const PosedScene& scene, const char* name)
{
    raster::View view = eye_view(making);
    view.cluster_bounds = scene.cluster_bounds;
    return raster::add_visibility(making.graph, name, scene.meshes,
                                  solid_batches(making.layout, making.plan.page.has_ground), view);
}

surface::Surface add_surface(const Making& making, const PosedScene& scene, gpu::BufferId visibility)
{
    gpu::Graph& graph = making.graph;
    FrameResources& resources = making.resources;
    surface::Surface surface = surface::add_resolve(
        graph, {.frame = scene.frame,
                .visibility = visibility,
                .triangles = scene.meshes.triangles,
                .posed_vertices = scene.meshes.posed_vertices,
                .draws = scene.meshes.draws,
                .rest_vertices = scene.meshes.rest_vertices,
                .stroke_coordinates = scene.stroke_coordinates,
                .stroke_kinds = gpu::import_whole(graph, "stroke kinds", resources.stroke_kinds),
                .form_coordinates = gpu::import_whole(graph, "form coordinates", resources.form_coordinates),
                .materials = scene.meshes.materials,
                .textures = scene.meshes.textures,
                .needs = making.plan.needs,
                .strokes_present = making.plan.strokes.present,
                .strokes_per_m = static_cast<float>(1.0 / making.layout.stroke_unit_m),
                .size_px = making.sample.size_px});
    const std::optional<terrain::TrailImage> trails =
        making.resources.trodden != nullptr ? making.resources.trodden->add_image(graph) : std::nullopt;
    if (trails) {
        surface.normal = terrain::add_trail_relief(
            graph,
            {.frame = scene.frame,
             .draw = surface.draw,
             .depth = surface.depth,
             .normal = surface.normal,
             .size_px = making.sample.size_px,
             .terrain_draw = making.layout.draw_of_vertex.at(*making.layout.foreign_vertex),
             .anchor_m = {making.layout.anchor.x, making.layout.anchor.z},
             .towards_sun = making.plan.sun.towards},
            *trails);
    }
    if (making.plan.ripples) {
        surface.normal = terrain::add_ripples(graph,
                                              {.frame = scene.frame,
                                               .draw = surface.draw,
                                               .depth = surface.depth,
                                               .normal = surface.normal,
                                               .size_px = making.sample.size_px},
                                              *making.plan.ripples);
    }
    return surface;
}

void add_motion(const Making& making, const PosedScene& scene, gpu::BufferId visibility)
{
    const std::optional<MotionPlan>& motion = making.plan.motion;
    if (!motion || !making.sample.is_first) {
        return;
    }
    const bool has_moved = motion->pose_moved || making.resources.terrain != nullptr;
    const auto vertices_before = has_moved ? scene.vertices_before : scene.meshes.posed_vertices;
    declare_motion(making.graph,
                   {.frame = scene.frame,
                    .visibility = visibility,
                    .triangles = scene.meshes.triangles,
                    .posed_vertices = scene.meshes.posed_vertices,
                    .posed_vertices_before = vertices_before,
                    .clip_from_anchor = motion->clip_from_anchor,
                    .clip_from_anchor_before = motion->clip_from_anchor_before,
                    .size_px = making.sample.size_px},
                   making.resources.motion);
}

screen::ScreenInputs screen_inputs(const Making& making, const PosedScene& scene, gpu::BufferId visibility,
                                   const std::vector<gpu::BufferId>& layers)
{
    return {.frame = scene.frame,
            .solid_visibility = visibility,
            .layers = layers,
            .triangles = scene.meshes.triangles,
            .posed_vertices = scene.meshes.posed_vertices,
            .draws = scene.meshes.draws,
            .rest_vertices = scene.meshes.rest_vertices,
            .materials = scene.meshes.materials,
            .textures = scene.meshes.textures,
            .texture_classes = scene.meshes.texture_classes,
            .size_px = making.sample.size_px};
}

SeenThrough add_screen(const Making& making, const PosedScene& scene, gpu::BufferId visibility)
{
    const pose::MeshData& layout = making.layout;
    const auto with_backgrounds = [&](SeenThrough seen) {
        add_backgrounds(making, scene, seen);
        return seen;
    };
    if (layout.blended.count == 0) {
        return with_backgrounds({.images = screen::add_no_screen(making.graph), .layers = {}});
    }
    const screen::ScreenStyle& style = making.style.screen;
    const uint32_t most =
        style.mode == screen::Mode::sorted ? screen::most_sorted_layers : screen::most_layers;
    const uint32_t wanted = std::min({layout.blended_sheets, static_cast<uint32_t>(style.layers), most});
    const raster::Batch blended = batch(layout.blended, true);
    const auto layers =
        raster::add_layers(making.graph, "screen", scene.meshes, {&blended, 1}, eye_view(making), wanted);
    screen::ScreenInputs inputs = screen_inputs(making, scene, visibility, layers);
    if (making.plan.raster.on_processor) {
        inputs.tiles = raster::add_seen_tiles(making.graph, "screen", layers.front(), making.sample.size_px);
    }
    return with_backgrounds(
        {.images = screen::add_screen(making.graph, inputs), .layers = layers, .is_there = true});
}

} // namespace estampe::frame
