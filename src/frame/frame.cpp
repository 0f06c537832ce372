// SPDX-License-Identifier: MIT
#include "frame/frame.hpp"

#include <algorithm>
#include <optional>

#include "frame/sun.hpp"
#include "gpu/imports.hpp"
#include "gpu/read_back.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/light/exposure.hpp"
#include "techniques/raster/raster.hpp"
#include "techniques/screen/screen.hpp"
#include "techniques/surface/surface.hpp"

namespace estampe::frame {
namespace {

raster::Batch batch(const pose::Range& range, bool masked = false)
{
    return {
        .first_triangle = range.first, .triangle_count = range.count, .masked = masked, .plain = range.plain};
}

/// What hides what is behind it.
std::vector<raster::Batch> solid_batches(const pose::MeshData& layout, bool with_ground)
{
    std::vector<raster::Batch> batches{batch(layout.opaque), batch(layout.masked, true)};
    if (with_ground) {
        batches.push_back(batch(layout.ground));
    }
    return batches;
}

} // namespace

void declare_frame(gpu::Graph& graph, const pose::MeshData& layout, FrameResources& resources,
                   const FramePlan& plan, const StyleTables& style)
{
    pose::MeshBuffers& meshes = resources.meshes;
    const auto frame = gpu::import_whole(graph, "frame", resources.frame_globals);
    const auto lighting = gpu::import_whole(graph, "lighting", resources.light_globals);
    const auto lights = gpu::import_whole(graph, "lights", resources.lights);
    const auto triangles = gpu::import_whole(graph, "triangles", meshes.triangles);
    const auto draws = gpu::import_whole(graph, "draws", meshes.draws);
    const auto rest_vertices = gpu::import_whole(graph, "rest vertices", meshes.rest_vertices);
    const auto materials = gpu::import_whole(graph, "materials", resources.materials.materials);
    const auto textures = surface::import_textures(graph, resources.materials);
    const glm::uvec2 size_px = plan.size_px;
    const shared::ToneConstants tone = light::tone_constants(style.tone);

    // Pose: whatever moves writes vertices.
    const auto posed_vertices = plan.pose_moved
                                    ? pose::add_pose(graph, meshes, layout, draws, rest_vertices)
                                    : gpu::import_whole(graph, "posed vertices", meshes.posed_vertices[0]);

    // Visibility: rasterisation only writes identities.
    const raster::RasterInputs raster_inputs{.triangles = triangles,
                                             .posed_vertices = posed_vertices,
                                             .draws = draws,
                                             .rest_vertices = rest_vertices,
                                             .materials = materials,
                                             .textures = textures,
                                             .texture_classes = plan.needs.texture_classes};
    const auto visibility =
        raster::add_visibility(graph, "visibility", raster_inputs, solid_batches(layout, plan.ground_drawn),
                               {.clip_from_anchor = plan.clip_from_anchor,
                                .size_px = size_px,
                                .path = plan.raster_path,
                                .tuning = plan.raster});

    // Surface: what is seen at each pixel.
    const auto surface = surface::add_resolve(
        graph,
        {.frame = frame,
         .visibility = visibility,
         .triangles = triangles,
         .posed_vertices = posed_vertices,
         .draws = draws,
         .rest_vertices = rest_vertices,
         .stroke_coordinates = gpu::import_whole(graph, "stroke coordinates", meshes.stroke_coordinates),
         .stroke_kinds = gpu::import_whole(graph, "stroke kinds", resources.stroke_kinds),
         .form_coordinates = gpu::import_whole(graph, "form coordinates", resources.form_coordinates),
         .materials = materials,
         .textures = textures,
         .needs = plan.needs,
         .strokes_present = plan.strokes.present,
         .strokes_per_m = static_cast<float>(1.0 / layout.stroke_unit_m),
         .size_px = size_px});

    // Motion: where it stood at another moment, for what looks back.
    if (plan.motion && plan.accumulation.sample_index == 0) {
        const auto vertices_before =
            plan.motion->pose_moved ? gpu::import_whole(graph, "vertices before", meshes.posed_vertices[1])
                                    : posed_vertices;
        declare_motion(graph,
                       {.frame = frame,
                        .visibility = visibility,
                        .triangles = triangles,
                        .posed_vertices = posed_vertices,
                        .posed_vertices_before = vertices_before,
                        .clip_from_anchor = plan.motion->clip_from_anchor,
                        .clip_from_anchor_before = plan.motion->clip_from_anchor_before,
                        .size_px = size_px},
                       resources.motion);
    }

    // Screen: what is looked through.
    const bool has_screen = layout.blended.count > 0;
    const auto screen =
        !has_screen
            ? screen::add_no_screen(graph)
            : screen::add_screen(
                  graph, {.frame = frame,
                          .solid_visibility = visibility,
                          .layers = raster::add_layers(
                              graph, "screen", raster_inputs, {batch(layout.blended, true)},
                              {.clip_from_anchor = plan.clip_from_anchor,
                               .size_px = size_px,
                               .path = plan.raster_path,
                               .tuning = plan.raster},
                              std::min(layout.blended_sheets, static_cast<uint32_t>(style.screen.layers))),
                          .triangles = triangles,
                          .posed_vertices = posed_vertices,
                          .draws = draws,
                          .rest_vertices = rest_vertices,
                          .materials = materials,
                          .textures = textures,
                          .texture_classes = plan.needs.texture_classes,
                          .size_px = size_px});

    // Shadow: how far the sun sees, drawn only when it moved or something did. The ground receives but does
    // not throw.
    const auto shadow_map =
        add_sun_map(graph, raster_inputs, caster_batches(layout, plan.sun_casters), plan, meshes.vertex_count,
                    gpu::import_whole(graph, "shadow", resources.shadow_map));

    // Local shadows: how far lamps and spots see. Maps are kept; what is out of date is drawn in one go.
    const auto local_maps = add_local_maps(graph,
                                           {.raster = raster_inputs,
                                            .layout = layout,
                                            .views = plan.local_views,
                                            .path = plan.raster_path,
                                            .tuning = plan.raster},
                                           resources.local_shadows);

    // Lightmap: what is known ahead of the light there.
    std::optional<gpu::ImageId> lightmap;
    if (resources.lightmaps != nullptr) {
        lightmap = lightmap::add_lightmap(graph,
                                          {.frame = frame,
                                           .visibility = visibility,
                                           .triangles = triangles,
                                           .posed_vertices = posed_vertices,
                                           .scale = plan.lightmap_scale,
                                           .size_px = size_px},
                                          *resources.lightmaps);
    }

    // Light: what arrives there.
    const light::LitPixels lit = light::add_light(
        graph,
        {.frame = frame,
         .lighting = lighting,
         .lights = lights,
         .draw = surface.draw,
         .depth = surface.depth,
         .normal = surface.normal,
         .draws = draws,
         .materials = materials,
         .sun_map = shadow_map,
         .sun_shadow = gpu::import_whole(graph, "sun", resources.sun_shadow),
         .coordinate = surface.coordinate,
         .footprint = surface.footprint,
         .edge_look = gpu::import_whole(graph, "edges", resources.edge_look),
         .shadow_variant = plan.shadow_variant,
         .local_shadows = gpu::import_whole(graph, "lights' shadows", resources.local_shadows.shadows),
         .local_maps = local_maps,
         .has_local_shadows = plan.has_local_shadows,
         .lightmap = lightmap,
         .has_shadow = plan.shadow_size > 0,
         .local_count = plan.local_light_count,
         .has_emissive = plan.needs.emissive,
         .keeps_strongest = plan.follows_local_light,
         .keeps_sun = plan.lines_shadows || (resources.deep != nullptr && resources.deep->has_layers()),
         .has_links = plan.has_light_links,
         .size_px = size_px});
    const gpu::ImageId light =
        plan.meters_page
            ? light::add_exposure(graph, {.light = lit.light,
                                          .draw = surface.draw,
                                          .state = gpu::import_whole(graph, "exposure", resources.exposure),
                                          .adapts = plan.accumulation.sample_index == 0,
                                          .compensation_stops = style.light.exposure_stops,
                                          .most_change_stops = plan.adapt_stops,
                                          .size_px = size_px})
                  .light
            : lit.light;

    // Hatch: light becomes strokes.
    const hatch::HatchInputs hatch_inputs{
        .frame = frame,
        .draw = surface.draw,
        .depth = surface.depth,
        .normal = surface.normal,
        .color = surface.color,
        .coordinate = surface.coordinate,
        .footprint = surface.footprint,
        .light = light,
        .screen = screen.color,
        .has_screen = has_screen,
        .tone = tone,
        .strokes_present = plan.strokes.present,
        .strongest_light = plan.follows_local_light ? std::optional(lit.strongest) : std::nullopt,
        .towards_light = plan.towards_sun,
        .map =
            resources.map != nullptr ? std::optional(hatch::import_map(graph, *resources.map)) : std::nullopt,
        .pixels_per_mm = plan.pixels_per_mm,
        .size_px = size_px};
    const auto hatch = hatch::add_hatch(graph, hatch_inputs, style.hatch);

    // Contour: lines where surfaces end, meet or fold.
    const bool has_chains = resources.line_mesh != nullptr;
    const bool lines_move =
        plan.pose_moved || resources.line_history.clip_from_anchor_before() != plan.clip_from_anchor;
    const contour::ContourInputs contour_inputs{.frame = frame,
                                                .visibility = visibility,
                                                .triangles = triangles,
                                                .posed_vertices = posed_vertices,
                                                .draws = draws,
                                                .materials = materials,
                                                .own_outlines = plan.needs.own_outlines,
                                                .draw = surface.draw,
                                                .depth = surface.depth,
                                                .normal = surface.normal,
                                                .coordinate = surface.coordinate,
                                                .light = light,
                                                .sun = plan.lines_shadows ? std::optional(lit.sun)
                                                                          : std::nullopt,
                                                .screen_draw = screen.draw,
                                                .has_screen = has_screen && !has_chains,
                                                .only_cut = has_chains,
                                                .on_processor = plan.on_processor,
                                                .is_moving = lines_move,
                                                .brushes = resources.brushes,
                                                .pixels_per_mm = plan.pixels_per_mm,
                                                .pixel_m_at_one = plan.pixel.at_one_m,
                                                .size_px = size_px};
    if (resources.lists != nullptr) {
        declare_stroke_lists(graph, hatch_inputs, contour_inputs, resources.line_mesh, style,
                             *resources.lists);
        return;
    }
    const std::optional<gpu::ImageId> page_lines =
        !has_chains || layout.masked.count > 0
            ? std::optional(contour::add_contours(graph, contour_inputs, style.contour))
            : std::nullopt;
    const gpu::ImageId lines =
        has_chains ? contour::add_chain_contours(graph, contour_inputs, *resources.line_mesh,
                                                 plan.remembers_lines ? &resources.line_history : nullptr,
                                                 style.contour, page_lines)
                   : *page_lines;

    // Bleed: ink of strokes and lines runs together.
    const auto ink = bleed::add_bleed(
        graph, {.hatch = hatch, .lines = lines, .pixels_per_mm = plan.pixels_per_mm, .size_px = size_px},
        style.bleed);

    // Sky and wash: colour, flat.
    const auto sky = sky::add_sky(graph,
                                  {.frame = frame,
                                   .towards_sun = plan.towards_sun,
                                   .daylight_rad = plan.daylight_rad,
                                   .pixels_per_mm = plan.pixels_per_mm,
                                   .drawn = plan.sky_drawn,
                                   .size_px = size_px},
                                  style.sky);
    const auto wash = wash::add_wash(graph,
                                     {.frame = frame,
                                      .draw = surface.draw,
                                      .depth = surface.depth,
                                      .color = surface.color,
                                      .light = light,
                                      .draws = draws,
                                      .materials = materials,
                                      .screen = screen.color,
                                      .has_screen = has_screen,
                                      .background = sky.wash,
                                      .has_background = plan.sky_drawn,
                                      .tone = tone,
                                      .size_px = size_px},
                                     style.wash);

    // Compose: the layers on paper.
    const paper::ComposeInputs layers{.frame = frame,
                                      .wash = wash,
                                      .hatch = ink,
                                      .lines = lines,
                                      .sky_ink = sky.ink,
                                      .has_sky = plan.sky_drawn,
                                      .light = light,
                                      .size_px = size_px};
    const auto picture = paper::add_compose(graph, layers, style.paper);
    const auto developed = paper::add_develop(
        graph, picture, paper::import_sums(graph, resources.sums, plan.accumulation),
        graph.buffer("pixels", {.size_bytes = 4ULL * size_px.x * size_px.y}), size_px, plan.accumulation);

    // Deep page: the same in floats, where they are asked for.
    if (resources.deep != nullptr) {
        declare_deep_page(graph, {.layers = layers, .draw = surface.draw, .sun = lit.sun}, style.paper,
                          plan.accumulation, *resources.deep);
    }

    // Read-back: the picture for the processor.
    gpu::add_read_back(graph, "read back", developed.pixels, resources.pixels);
}

} // namespace estampe::frame
