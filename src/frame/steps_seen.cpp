// SPDX-License-Identifier: MIT
// Steps of a frame that turn triangles into the visible surface at each pixel. They also draw clear bodies
// (such as glass) that blur what lies behind them, transparent surfaces, and pixel coverage for a transparent
// background.
#include <algorithm>
#include <vector>

#include "frame/steps.hpp"
#include "gpu/resources.hpp"
#include "techniques/subsurface/subsurface.hpp"

namespace estampe::frame {
namespace {

raster::Batch batch(const pose::Range& range, bool masked = false)
{
    return {
        .first_triangle = range.first, .triangle_count = range.count, .masked = masked, .plain = range.plain};
}

bool wants_cluster_bounds(const FrameContext& context)
{
    const RasterPlan& plan = context.plan.raster;
    return (context.sample.is_first && !context.plan.local_shadows.views.empty()) ||
           (plan.paths.page == RasterPath::compute &&
            (context.loaded.layout.opaque.count >= plan.tuning.clusters_from || context.plan.culls_cells));
}

/// Draws the surfaces behind clear bodies, for colour and for lines, if the scene has clear bodies such as
/// glass.
void add_backgrounds(const FrameContext& context, const PosedScene& scene, SeenThrough& screen)
{
    const std::optional<SubsurfacePlan>& plan = context.plan.subsurface;
    if (!plan || plan->clear.empty()) {
        return;
    }
    raster::View view = eye_view(context);
    screen.background =
        raster::add_visibility(context.graph, "subsurface/background", scene.meshes, plan->others, view);
    if (plan->lines_show) {
        screen.line_hiders = screen.background;
    } else if (!plan->line_hiders.empty()) {
        screen.line_hiders =
            raster::add_visibility(context.graph, "contour/hiders", scene.meshes, plan->line_hiders, view);
    }
    view.cull_back_faces = false;
    screen.inside = raster::add_layers(context.graph, "subsurface/inside", scene.meshes, plan->clear, view,
                                       subsurface::inside_layers);
}

} // namespace

InlineVector<raster::Batch, 4> solid_batches(const pose::MeshData& layout, bool with_ground,
                                             const transparency::TransparencyStyle& style)
{
    InlineVector<raster::Batch, 4> batches;
    batches.push_back(batch(layout.opaque));
    batches.push_back(batch(layout.masked, true));
    if (transparency::has_opaque_parts(style) && layout.blended.count > 0) {
        raster::Batch opaque_parts = batch(layout.blended, true);
        opaque_parts.least_alpha = style.opaque_above;
        batches.push_back(opaque_parts);
    }
    if (with_ground) {
        batches.push_back(batch(layout.ground));
    }
    return batches;
}

raster::View eye_view(const FrameContext& context)
{
    return {.clip_from_anchor = context.sample.clip_from_anchor,
            .size_px = context.sample.size_px,
            .path = context.plan.raster.paths.page,
            .tuning = context.plan.raster.tuning};
}

PosedScene add_posed_scene(const FrameContext& context)
{
    gpu::Graph& graph = context.graph;
    pose::MeshBuffers& meshes = context.loaded.meshes;
    const auto draws = gpu::import_whole(graph, "draws", meshes.draws);
    const auto rest_vertices = gpu::import_whole(graph, "rest vertices", meshes.rest_vertices);
    terrain::TerrainBuffers::Posed posed{
        .vertices = context.sample.pose_moved
                        ? pose::add_pose_of_moved(graph, meshes, context.loaded.layout, *context.loaded.pose,
                                                  context.features.cloth.draws(), draws, rest_vertices)
                        : gpu::import_whole(graph, "posed vertices", meshes.posed_vertices[0]),
        .before = gpu::import_whole(graph, "vertices before", meshes.posed_vertices[1]),
        .stroke_coordinates = gpu::import_whole(graph, "stroke coordinates", meshes.stroke_coordinates)};
    if (context.sample.pose_moved) {
        context.features.cloth.record(graph, *context.loaded.pose, context.loaded.layout.anchor,
                                      posed.vertices, posed.before);
    }
    std::optional<gpu::BufferId> terrain_texels;
    if (context.loaded.terrain != nullptr) {
        terrain_texels = context.loaded.terrain->add_texels(graph);
    }
    if (context.sample.terrain_moved) {
        posed = context.loaded.terrain->add_vertices(graph, posed, *terrain_texels);
    }
    PosedScene scene{
        .frame = gpu::import_whole(graph, "frame", context.buffers.frame_globals),
        .stroke_coordinates = posed.stroke_coordinates,
        .vertices_before = posed.before,
        .terrain_texels = terrain_texels,
        .meshes = {.triangles = gpu::import_whole(graph, "triangles", meshes.triangles),
                   .posed_vertices = posed.vertices,
                   .draws = draws,
                   .rest_vertices = rest_vertices,
                   .materials = gpu::import_whole(graph, "materials", context.loaded.materials.materials),
                   .textures = surface::import_textures(graph, context.loaded.materials),
                   .texture_classes = context.plan.needs.texture_classes}};
    if (wants_cluster_bounds(context)) {
        scene.cluster_bounds = context.loaded.cluster_boxes.add(
            graph, context.device, scene.meshes,
            static_cast<uint32_t>(context.loaded.layout.triangles.size()), context.plan.raster.tuning);
    }
    if (context.plan.culls_cells) {
        scene.seen_clusters =
            context.features.culling.record(graph, context.device,
                                            {.scene = context.loaded.scene,
                                             .layout = context.loaded.layout,
                                             .clip_from_anchor = context.sample.clip_from_anchor,
                                             .size_px = context.sample.size_px});
    }
    return scene;
}

gpu::BufferId add_visibility(const FrameContext& context, const PosedScene& scene, const char* name)
{
    raster::View view = eye_view(context);
    view.cluster_bounds = scene.cluster_bounds;
    view.seen_clusters = scene.seen_clusters;
    return raster::add_visibility(
        context.graph, name, scene.meshes,
        solid_batches(context.loaded.layout, context.plan.page.has_ground, context.style.transparency), view);
}

surface::Surface add_surface(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility)
{
    gpu::Graph& graph = context.graph;
    surface::Surface surface = surface::add_resolve(
        graph, {.frame = scene.frame,
                .visibility = visibility,
                .triangles = scene.meshes.triangles,
                .posed_vertices = scene.meshes.posed_vertices,
                .draws = scene.meshes.draws,
                .rest_vertices = scene.meshes.rest_vertices,
                .stroke_coordinates = scene.stroke_coordinates,
                .stroke_kinds = gpu::import_whole(graph, "stroke kinds", context.features.hatching.kinds()),
                .form_coordinates = gpu::import_whole(graph, "form coordinates",
                                                      context.features.hatching.form_coordinates()),
                .materials = scene.meshes.materials,
                .textures = scene.meshes.textures,
                .needs = context.plan.needs,
                .strokes_present = context.plan.strokes.present,
                .strokes_per_m = static_cast<float>(1.0 / context.loaded.layout.stroke_unit_m),
                .size_px = context.sample.size_px});
    const std::optional<terrain::TrailImage> trails =
        context.loaded.footprints != nullptr ? context.loaded.footprints->add_image(graph) : std::nullopt;
    if (trails) {
        surface.normal = terrain::add_trail_relief(
            graph,
            {.frame = scene.frame,
             .draw = surface.draw,
             .depth = surface.depth,
             .normal = surface.normal,
             .size_px = context.sample.size_px,
             .terrain_draw = context.loaded.layout.draw_of_vertex.at(*context.loaded.layout.foreign_vertex),
             .anchor_m = {context.loaded.layout.anchor.x, context.loaded.layout.anchor.z},
             .towards_sun = context.plan.sun.towards},
            *trails);
    }
    if (context.plan.ripples) {
        surface.normal = terrain::add_ripples(graph,
                                              {.frame = scene.frame,
                                               .draw = surface.draw,
                                               .depth = surface.depth,
                                               .normal = surface.normal,
                                               .size_px = context.sample.size_px},
                                              *context.plan.ripples);
    }
    return surface;
}

gpu::BufferId vertices_before(const FrameContext& context, const PosedScene& scene,
                              const features::MotionPlan& moved)
{
    // A static scene has a single set of vertices, so the previous vertices are the current ones.
    const bool has_moved = moved.pose_moved || context.loaded.terrain != nullptr;
    return has_moved ? scene.vertices_before : scene.meshes.posed_vertices;
}

motion::MotionInputs motion_inputs(const FrameContext& context, const PosedScene& scene,
                                   gpu::BufferId visibility, const features::MotionPlan& moved)
{
    return {.frame = scene.frame,
            .visibility = visibility,
            .triangles = scene.meshes.triangles,
            .posed_vertices = scene.meshes.posed_vertices,
            .posed_vertices_before = vertices_before(context, scene, moved),
            .clip_from_anchor = moved.clip_from_anchor,
            .clip_from_anchor_before = moved.clip_from_anchor_before,
            .size_px = context.sample.size_px};
}

void add_motion(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility)
{
    const std::optional<features::MotionPlan>& motion = context.plan.motion;
    if (motion && context.sample.is_first) {
        features::declare_motion(context.graph, motion_inputs(context, scene, visibility, *motion),
                                 context.buffers.motion_pixels);
    }
}

transparency::TransparencyInputs transparency_inputs(const FrameContext& context, const PosedScene& scene,
                                                     gpu::BufferId visibility,
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
            .size_px = context.sample.size_px};
}

SeenThrough add_transparency(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility)
{
    const pose::MeshData& layout = context.loaded.layout;
    const auto with_backgrounds = [&](SeenThrough seen) {
        add_backgrounds(context, scene, seen);
        return seen;
    };
    if (layout.blended.count == 0) {
        return with_backgrounds({.images = transparency::add_no_transparency(context.graph), .layers = {}});
    }
    const transparency::TransparencyStyle& style = context.style.transparency;
    const uint32_t most = style.mode == transparency::Mode::sorted ? transparency::most_sorted_layers
                                                                   : transparency::most_layers;
    const uint32_t wanted = std::min({layout.blended_sheets, static_cast<uint32_t>(style.layers), most});
    raster::Batch blended = batch(layout.blended, true);
    if (transparency::has_opaque_parts(style)) {
        blended.alpha_below = style.opaque_above;
    }
    const auto layers =
        raster::add_layers(context.graph, "screen", scene.meshes, {&blended, 1}, eye_view(context), wanted);
    transparency::TransparencyInputs inputs = transparency_inputs(context, scene, visibility, layers);
    if (context.device.execution().lists_tiles()) {
        inputs.tiles =
            raster::add_seen_tiles(context.graph, "screen", layers.front(), context.sample.size_px);
    }
    return with_backgrounds({.images = transparency::add_transparency(context.graph, inputs),
                             .layers = layers,
                             .is_there = true});
}

std::optional<gpu::ImageId> add_refraction(const FrameContext& context, const PosedScene& scene,
                                           const surface::Surface& surface, const SeenThrough& screen)
{
    if (!bends_light(context) || !screen.background) {
        return std::nullopt;
    }
    return subsurface::add_refraction(context.graph, {.common = subsurface_inputs(context, scene, surface),
                                                      .inside = screen.inside,
                                                      .background = *screen.background,
                                                      .triangles = scene.meshes.triangles,
                                                      .posed_vertices = scene.meshes.posed_vertices,
                                                      .most_mm = context.style.subsurface.refraction_mm});
}

namespace {

/// Lights and paints a visibility buffer in the same way as the first visible surface, without subsurface
/// scattering.
gpu::ImageId add_painted(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility,
                         const light::ShadowMaps& maps, const std::optional<gpu::ImageId>& background)
{
    const surface::Surface surface = add_surface(context, scene, visibility);
    light::LightInputs inputs = light_inputs(context, scene, surface, maps);
    inputs.has_emissive = context.plan.needs.emissive;
    inputs.keeps_sun = context.plan.toon.has_steps;
    const light::LitPixels lit = light::add_light(context.graph, inputs);
    const auto shade = add_shade(context, scene, visibility, surface, lit.sun);
    return add_paint(context, scene, surface, {lit.light, shade}, background);
}

gpu::ImageId add_behind(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility,
                        const surface::Surface& surface, const light::ShadowMaps& maps,
                        const SeenThrough& screen, const Colors& colors)
{
    const gpu::BufferId background = *screen.background;
    const subsurface::BehindInputs inputs{
        .common = subsurface_inputs(context, scene, surface),
        .visibility = visibility,
        .inside = screen.inside,
        .background = background,
        .triangles = scene.meshes.triangles,
        .posed_vertices = scene.meshes.posed_vertices,
        .color = surface.color,
        .painted = add_painted(context, scene, background, maps,
                               context.plan.page.shows_sky ? std::optional(colors.sky_wash) : std::nullopt),
        .bent = screen.bent};
    return subsurface::add_behind(context.graph, inputs, colors.wash);
}

} // namespace

Colors add_seen_through(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility,
                        const surface::Surface& surface, const light::ShadowMaps& maps,
                        const SeenThrough& screen, Colors colors)
{
    if (screen.background) {
        colors.wash = add_behind(context, scene, visibility, surface, maps, screen, colors);
    }
    if (!screen.is_there || context.style.transparency.mode != transparency::Mode::sorted) {
        return colors;
    }
    const transparency::TransparencyInputs inputs =
        transparency_inputs(context, scene, visibility, screen.layers);
    const std::vector<gpu::BufferId> farthest_first(screen.layers.rbegin(), screen.layers.rend());
    for (const gpu::BufferId& layer : farthest_first) {
        const gpu::ImageId painted = add_painted(context, scene, layer, maps, std::nullopt);
        colors.wash = transparency::add_sheet(context.graph, inputs, layer, painted, colors.wash);
    }
    return colors;
}

std::optional<gpu::ImageId> add_cover(const FrameContext& context, const PosedScene& scene,
                                      gpu::BufferId visibility, const surface::Surface& surface,
                                      const haze::HazeLayers& layers, const Colors& colors)
{
    const motion_blur::Mode mode = context.style.motion_blur.mode;
    const bool is_blurred =
        context.plan.motion_blur && context.style.motion_blur.enabled && mode != motion_blur::Mode::velocity;
    const bool has_lens = context.plan.lens && context.style.lens.mode != lens::Mode::circles;
    if (context.style.paper.transparent != paper::Transparency::background || (!has_lens && !is_blurred)) {
        return std::nullopt;
    }
    const paper::CoverLayers copied =
        paper::add_cover(context.graph, {.wash = layers.wash, .hatch = layers.hatch, .lines = layers.lines},
                         context.sample.size_px);
    const lens::LensLayers focused = add_lens(
        context, surface, {.wash = copied.wash, .hatch = copied.hatch, .lines = copied.lines}, colors);
    if (!is_blurred) {
        return focused.wash;
    }
    return add_motion_blur(context, scene, visibility, surface,
                           {.wash = focused.wash, .hatch = focused.hatch, .lines = focused.lines}, colors)
        .wash;
}

} // namespace estampe::frame
