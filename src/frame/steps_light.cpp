// SPDX-License-Identifier: MIT
// Steps of a frame that compute shadows, the light of lightmaps, and direct light.
#include <algorithm>

#include "frame/steps.hpp"
#include "gpu/resources.hpp"
#include "techniques/light/exposure/exposure.hpp"
#include "techniques/occlusion/occlusion.hpp"
#include "techniques/subsurface/subsurface.hpp"

namespace estampe::frame {
namespace {

std::optional<gpu::ImageId> add_ground_shadow(const FrameContext& context, const PosedScene& scene,
                                              const surface::Surface& surface)
{
    if (!context.loaded.terrain || !context.plan.sun.ground.is_thrown) {
        return std::nullopt;
    }
    // If there are several samples or tiles, the terrain's shadow is computed only for the first sample or
    // tile, and then reused.
    const SamplePlan& sample = context.sample;
    const bool is_picture = sample.accumulation.sample_count == 1 && sample.size_px == context.plan.page_px;
    return context.features.shadows.ground().record(
        context.graph, *context.loaded.terrain,
        {.plan = context.plan.sun.ground,
         .texels = *scene.terrain_texels,
         .frame = scene.frame,
         .depth = surface.depth,
         .size_px = sample.size_px,
         .clip_from_anchor = is_picture ? std::optional(sample.clip_from_anchor) : std::nullopt});
}

/// Returns the share of sunlight that is not blocked by terrain, clouds and smoke. The sun's shadow map does
/// not contain terrain, clouds and smoke.
std::optional<gpu::ImageId> add_sun_share(const FrameContext& context, const PosedScene& scene,
                                          const surface::Surface& surface,
                                          const std::optional<smoke::Volume>& volume)
{
    gpu::Graph& graph = context.graph;
    const FramePlan& plan = context.plan;
    std::optional<gpu::ImageId> share = add_ground_shadow(context, scene, surface);
    if (!plan.sun.shines) {
        return share;
    }
    const float of_clouds = context.style.clouds.shadow;
    if (plan.clouds && plan.clouds->globals.puff_layer_count > 0 && of_clouds > 0.0F) {
        share = sky::add_cloud_shadow(graph,
                                      {.frame = scene.frame,
                                       .clouds = context.features.clouds.import(graph),
                                       .depth = surface.depth,
                                       .share = share,
                                       .size_px = context.sample.size_px},
                                      of_clouds);
    }
    if (volume && context.style.smoke.shadow > 0.0F) {
        share = smoke::add_thrown(
            graph, *volume, context.style.smoke,
            {.view = context.features.smoke.view(graph, scene.frame, surface.depth, context.sample.size_px),
             .share = share,
             .towards_sun = plan.sun.towards});
    }
    return share;
}

gpu::ImageId add_exposed(const FrameContext& context, gpu::ImageId light, gpu::ImageId draw)
{
    return light::add_exposure(context.graph,
                               {.light = light,
                                .draw = draw,
                                .state = gpu::import_whole(context.graph, "exposure",
                                                           context.features.lighting.exposure().buffer()),
                                .adapts = context.sample.is_first,
                                .compensation_stops = context.style.light.exposure_stops,
                                .most_change_stops = context.plan.light.adapt_stops,
                                .size_px = context.sample.size_px})
        .light;
}

} // namespace

light::LightInputs light_inputs(const FrameContext& context, const PosedScene& scene,
                                const surface::Surface& surface, const light::ShadowMaps& maps)
{
    gpu::Graph& graph = context.graph;
    const LightPlan& plan = context.plan.light;
    return {.frame = scene.frame,
            .lighting = gpu::import_whole(graph, "lighting", context.features.lighting.globals()),
            .lights = gpu::import_whole(graph, "lights", context.features.lighting.lights()),
            .draw = surface.draw,
            .depth = surface.depth,
            .normal = surface.normal,
            .draws = scene.meshes.draws,
            .materials = scene.meshes.materials,
            .coordinate = surface.coordinate,
            .footprint = surface.footprint,
            .shadows = maps,
            .local_count = plan.local_count,
            .has_links = plan.has_links,
            .size_px = context.sample.size_px};
}

namespace {

/// Computes how light spreads below surfaces, in a texture atlas that covers all surfaces. The atlas is lit
/// with `to_light`. Returns the page's `light` with the spread light added.
gpu::ImageId spread_in_map(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility,
                           light::LightInputs to_light, gpu::ImageId light)
{
    gpu::Graph& graph = context.graph;
    features::SurfaceMap& map = context.loaded.surface_maps.at(*context.plan.scatter_texels);
    float most_m = 0.0F;
    for (const shared::SubsurfaceParameters& parameters : context.plan.subsurface->parameters) {
        most_m = std::max({most_m, parameters.scatter_m.x, parameters.scatter_m.y, parameters.scatter_m.z});
    }
    const subsurface::TextureInputs in{
        .map_texels = gpu::import_whole(graph, "texels of surfaces", map.texels),
        .map_corners = gpu::import_whole(graph, "corners in the map", map.corners),
        .triangles = scene.meshes.triangles,
        .posed_vertices = scene.meshes.posed_vertices,
        .draws = scene.meshes.draws,
        .materials = scene.meshes.materials,
        .parameters =
            gpu::import_whole(graph, "subsurface parameters", context.buffers.subsurface_parameters),
        .variant_of_draw = variant_of_draw(context),
        .size = map.size,
        .most_spread_tx = most_m * map.texels_per_m};
    const subsurface::TextureSurface surface = subsurface::add_texture_surface(graph, in);
    to_light.frame = gpu::import_whole(graph, "frame of the map", context.buffers.map_frame_globals);
    to_light.draw = surface.draw;
    to_light.depth = surface.points;
    to_light.normal = surface.normal;
    to_light.points = surface.points;
    to_light.has_emissive = context.plan.needs.emissive;
    to_light.size_px = glm::uvec2(map.size);
    const subsurface::TextureLight spread =
        subsurface::add_texture_scatter(graph, in, surface, light::add_light(graph, to_light).light);
    return subsurface::add_texture_page(graph, in, spread, scene.frame, visibility, light,
                                        context.sample.size_px);
}

/// Adds subsurface scattering to `light`.
gpu::ImageId add_subsurface(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility,
                            const surface::Surface& surface, const light::ShadowMaps& maps,
                            gpu::ImageId light)
{
    if (!context.plan.subsurface) {
        return light;
    }
    gpu::Graph& graph = context.graph;
    const SubsurfacePlan& plan = *context.plan.subsurface;
    const subsurface::SubsurfaceInputs inputs = subsurface_inputs(context, scene, surface);
    const bool has_map = context.plan.scatter_texels.has_value();
    if (has_map) {
        light = spread_in_map(context, scene, visibility, light_inputs(context, scene, surface, maps), light);
    }
    std::optional<subsurface::Through> through;
    if (!plan.bodies.empty()) {
        const gpu::BufferId behind =
            raster::add_visibility(graph, "subsurface/behind", scene.meshes, plan.bodies,
                                   {.clip_from_anchor = context.sample.clip_from_anchor,
                                    .size_px = context.sample.size_px,
                                    .cull_back_faces = false,
                                    .path = context.plan.raster.paths.maps,
                                    .tuning = context.plan.raster.tuning,
                                    .behind = visibility,
                                    .second_from = inputs.second_from()});
        const subsurface::FarSide far_side = subsurface::add_far_side(
            graph, inputs, behind, scene.meshes.triangles, scene.meshes.posed_vertices);
        light::LightInputs far_inputs = light_inputs(context, scene, surface, maps);
        far_inputs.frame =
            gpu::import_whole(graph, "frame of the half page", context.buffers.half_frame_globals);
        far_inputs.size_px = inputs.half_px();
        far_inputs.draw = far_side.draw;
        far_inputs.depth = far_side.depth;
        far_inputs.normal = far_side.normal;
        far_inputs.tiles = far_side.tiles;
        through = {.far_side = far_side, .light = light::add_light(graph, far_inputs).light};
    }
    const bool spreads = plan.scatters && !has_map;
    return spreads || through ? subsurface::add_scatter(graph, inputs, light, through, spreads) : light;
}

} // namespace

subsurface::SubsurfaceInputs subsurface_inputs(const FrameContext& context, const PosedScene& scene,
                                               const surface::Surface& surface)
{
    return {.frame = scene.frame,
            .draw = surface.draw,
            .depth = surface.depth,
            .normal = surface.normal,
            .parameters = gpu::import_whole(context.graph, "subsurface parameters",
                                            context.buffers.subsurface_parameters),
            .variant_of_draw = variant_of_draw(context),
            .reach_mm = context.style.subsurface.reach_mm,
            .pixels_per_mm = context.plan.page.pixels_per_mm,
            .size_px = context.sample.size_px,
            .from_px = glm::uvec2(context.sample.from_px),
            .execution = context.device.execution(),
            .in_perspective = !context.plan.page.pixel.is_parallel};
}

light::ShadowMaps add_shadow_maps(const FrameContext& context, const PosedScene& scene)
{
    const FramePlan& plan = context.plan;
    return context.features.shadows.record(context.graph,
                                           {.raster = scene.meshes,
                                            .layout = context.loaded.layout,
                                            .still = context.loaded.still_casters,
                                            .cluster_bounds = scene.cluster_bounds,
                                            .path = plan.raster.paths.maps,
                                            .tuning = plan.raster.tuning},
                                           {.sun = plan.sun.map,
                                            .of_sun = context.sample.sun_map,
                                            .local = plan.local_shadows,
                                            .draws_local = context.sample.is_first});
}

std::optional<gpu::ImageId> add_lightmap_light(const FrameContext& context, const PosedScene& scene,
                                               gpu::BufferId visibility)
{
    if (!context.loaded.baked) {
        return std::nullopt;
    }
    return lightmap::add_lightmap(context.graph,
                                  {.frame = scene.frame,
                                   .visibility = visibility,
                                   .triangles = scene.meshes.triangles,
                                   .posed_vertices = scene.meshes.posed_vertices,
                                   .scale = context.plan.light.lightmap_scale,
                                   .size_px = context.sample.size_px},
                                  context.loaded.baked->maps);
}

std::optional<occlusion::AmbientOcclusion> add_occlusion(const FrameContext& context, const PosedScene& scene,
                                                         gpu::BufferId visibility,
                                                         const surface::Surface& surface)
{
    const occlusion::OcclusionStyle& style = context.style.occlusion;
    const bool is_layer_alone = style.feeds == occlusion::Feeds::layer;
    const bool has_layers = context.job.linear != nullptr && context.job.linear->has_layers();
    if (!style.enabled || (is_layer_alone && !has_layers)) {
        return std::nullopt;
    }
    occlusion::PosedSurfaces surfaces{.visibility = visibility,
                                      .triangles = scene.meshes.triangles,
                                      .posed_vertices = scene.meshes.posed_vertices,
                                      .map = std::nullopt};
    if (occlusion::needs_behind(style)) {
        raster::View view = eye_view(context);
        view.cull_back_faces = false;
        view.behind = visibility;
        // The ground is an open sheet, which ends no body.
        surfaces.behind = raster::add_visibility(
            context.graph, "occlusion/behind", scene.meshes,
            solid_batches(context.loaded.layout, false, context.style.transparency), view);
    }
    if (context.plan.occlusion_texels) {
        features::SurfaceMap& map = context.loaded.surface_maps.at(*context.plan.occlusion_texels);
        surfaces.map = {.texels = gpu::import_whole(context.graph, "texels of surfaces", map.texels),
                        .corners = gpu::import_whole(context.graph, "corners in the map", map.corners),
                        .size = map.size};
    }
    return context.features.occlusion.record(context.graph,
                                             {.frame = scene.frame,
                                              .depth = surface.depth,
                                              .normal = surface.normal,
                                              .surfaces = surfaces,
                                              .radius_m = context.plan.occlusion_radius_m,
                                              .pixels_per_mm = context.plan.page.pixels_per_mm,
                                              .size_px = context.sample.size_px,
                                              .from_px = glm::uvec2(context.sample.from_px)},
                                             style);
}

std::optional<smoke::Volume> add_smoke_volume(const FrameContext& context, const PosedScene& scene,
                                              const light::ShadowMaps& maps)
{
    if (!context.plan.smoke) {
        return std::nullopt;
    }
    features::RisingSmoke& smoke = context.features.smoke;
    return context.sample.is_first ? smoke.record(context.graph, context.style.smoke, scene.frame, maps)
                                   : smoke.volume(context.graph);
}

light::LitPixels add_light(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility,
                           const surface::Surface& surface, const LightBefore& before)
{
    const FramePlan& plan = context.plan;
    const occlusion::Feeds feeds = context.style.occlusion.feeds;
    light::LightInputs inputs = light_inputs(context, scene, surface, before.maps);
    inputs.shadows.variant |= plan.shadow_edges.variant;
    inputs.lightmap = before.lightmap;
    inputs.sun_share = add_sun_share(context, scene, surface, before.smoke);
    if (before.occlusion && feeds != occlusion::Feeds::layer) {
        inputs.occlusion = before.occlusion->visibility;
        inputs.bounced = before.occlusion->bounced;
    }
    inputs.occludes_all = feeds == occlusion::Feeds::tone;
    inputs.has_emissive = plan.needs.emissive;
    inputs.keeps_strongest = plan.light.leads_strokes;
    inputs.keeps_sun = plan.lines.of_shadows || plan.toon.has_steps ||
                       (plan.strokes.has_causes && plan.sun.shines) ||
                       (context.job.linear != nullptr && context.job.linear->has_layers());
    light::LitPixels lit = light::add_light(context.graph, inputs);
    lit.light = add_subsurface(context, scene, visibility, surface, before.maps, lit.light);
    if (plan.light.meters_page) {
        lit.light = add_exposed(context, lit.light, surface.draw);
    }
    return lit;
}

} // namespace estampe::frame
