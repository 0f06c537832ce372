// SPDX-License-Identifier: MIT
// Shadows, light known ahead, and the light that arrives.
#include "frame/steps.hpp"
#include "gpu/imports.hpp"
#include "techniques/light/exposure.hpp"
#include "techniques/occlusion/discs.hpp"
#include "techniques/occlusion/occlusion.hpp"

namespace estampe::frame {
namespace {

gpu::BufferId sun_map_of(const Making& making, const PosedScene& scene)
{
    const FramePlan& plan = making.plan;
    // The ground receives but does not throw.
    const std::vector<raster::Batch> casters = caster_batches(making.layout, plan.sun.casters);
    return add_sun_map(making.graph,
                       {.raster = scene.meshes,
                        .casters = casters,
                        .plan = plan.sun.map,
                        .work = making.sample.sun_map,
                        .path = plan.raster.path,
                        .tuning = plan.raster.tuning,
                        .vertex_count = making.resources.meshes.vertex_count},
                       gpu::import_whole(making.graph, "shadow", making.resources.shadow_map));
}

gpu::BufferId local_maps_of(const Making& making, const PosedScene& scene)
{
    const FramePlan& plan = making.plan;
    const LocalMapViews none;
    return add_local_maps(making.graph,
                          {.raster = scene.meshes,
                           .layout = making.layout,
                           .views = making.sample.is_first ? plan.local_shadows.views : none,
                           .path = plan.raster.path,
                           .tuning = plan.raster.tuning},
                          making.resources.local_shadows);
}

std::optional<gpu::ImageId> add_ground_shadow(const Making& making, const PosedScene& scene,
                                              const surface::Surface& surface)
{
    if (making.resources.terrain == nullptr || !making.plan.sun.ground.is_thrown) {
        return std::nullopt;
    }
    return making.resources.ground_shadow.add_share(making.graph, *making.resources.terrain,
                                                    {.plan = making.plan.sun.ground,
                                                     .texels = *scene.terrain_texels,
                                                     .frame = scene.frame,
                                                     .depth = surface.depth,
                                                     .size_px = making.sample.size_px});
}

gpu::ImageId add_exposed(const Making& making, gpu::ImageId light, gpu::ImageId draw)
{
    return light::add_exposure(
               making.graph, {.light = light,
                              .draw = draw,
                              .state = gpu::import_whole(making.graph, "exposure", making.resources.exposure),
                              .adapts = making.sample.is_first,
                              .compensation_stops = making.style.light.exposure_stops,
                              .most_change_stops = making.plan.light.adapt_stops,
                              .size_px = making.sample.size_px})
        .light;
}

/// What light needs wherever it falls in the scene, set up for what is seen.
light::LightInputs common_inputs(const Making& making, const PosedScene& scene,
                                 const surface::Surface& surface, const ShadowMaps& maps)
{
    gpu::Graph& graph = making.graph;
    FrameResources& resources = making.resources;
    const FramePlan& plan = making.plan;
    return {.frame = scene.frame,
            .lighting = gpu::import_whole(graph, "lighting", resources.light_globals),
            .lights = gpu::import_whole(graph, "lights", resources.lights),
            .draw = surface.draw,
            .depth = surface.depth,
            .normal = surface.normal,
            .draws = scene.meshes.draws,
            .materials = scene.meshes.materials,
            .sun_map = maps.sun,
            .sun_shadow = gpu::import_whole(graph, "sun", resources.sun_shadow),
            .coordinate = surface.coordinate,
            .footprint = surface.footprint,
            .edge_look = gpu::import_whole(graph, "edges", resources.edge_look),
            .shadow_variant = plan.sun.map.variant | plan.local_shadows.variant,
            .local_shadows = gpu::import_whole(graph, "lights' shadows", resources.local_shadows.shadows),
            .local_maps = maps.local,
            .has_local_shadows = plan.local_shadows.is_there,
            .has_shadow = plan.sun.map.size > 0,
            .local_count = plan.light.local_count,
            .has_links = plan.light.has_links,
            .size_px = making.sample.size_px};
}

std::optional<gpu::ImageId> add_disc_occlusion(const Making& making, const PosedScene& scene,
                                               gpu::BufferId visibility)
{
    occlusion::DiscBuffers& discs = making.resources.discs;
    if (discs.empty()) {
        return std::nullopt;
    }
    discs.is_found = discs.is_found && !making.sample.pose_moved;
    const gpu::BufferId open = occlusion::add_discs(making.graph, discs, scene.meshes.posed_vertices,
                                                    making.plan.occlusion_radius_m);
    return occlusion::add_disc_page(making.graph,
                                    {.frame = scene.frame,
                                     .visibility = visibility,
                                     .triangles = scene.meshes.triangles,
                                     .posed_vertices = scene.meshes.posed_vertices,
                                     .open = open,
                                     .vertex_count = discs.vertex_count,
                                     .size_px = making.sample.size_px},
                                    making.style.occlusion.strength);
}

/// `light` with what of it goes into things and comes out elsewhere.
gpu::ImageId add_subsurface(const Making& making, const PosedScene& scene, gpu::BufferId visibility,
                            const surface::Surface& surface, const ShadowMaps& maps, gpu::ImageId light)
{
    if (!making.plan.subsurface) {
        return light;
    }
    gpu::Graph& graph = making.graph;
    const SubsurfacePlan& plan = *making.plan.subsurface;
    const subsurface::SubsurfaceInputs inputs{
        .frame = scene.frame,
        .draw = surface.draw,
        .depth = surface.depth,
        .normal = surface.normal,
        .looks = gpu::import_whole(graph, "subsurface looks", making.resources.subsurface_looks),
        .look_of_draw = look_of_draw(making),
        .reach_mm = making.style.subsurface.reach_mm,
        .pixels_per_mm = making.plan.page.pixels_per_mm,
        .size_px = making.sample.size_px,
        .from_px = glm::uvec2(making.sample.from_px)};
    if (!plan.bodies.empty()) {
        const gpu::BufferId behind =
            raster::add_visibility(graph, "subsurface/behind", scene.meshes, plan.bodies,
                                   {.clip_from_anchor = making.sample.clip_from_anchor,
                                    .size_px = making.sample.size_px,
                                    .cull_back_faces = false,
                                    .path = making.plan.raster.path,
                                    .tuning = making.plan.raster.tuning,
                                    .behind = visibility});
        const subsurface::FarSide far_side = subsurface::add_far_side(
            graph, inputs, behind, scene.meshes.triangles, scene.meshes.posed_vertices);
        light::LightInputs far_inputs = common_inputs(making, scene, surface, maps);
        far_inputs.draw = far_side.draw;
        far_inputs.depth = far_side.depth;
        far_inputs.normal = far_side.normal;
        const gpu::ImageId far_light = light::add_light(graph, far_inputs).light;
        light = subsurface::add_through(graph, inputs, far_side, far_light, light);
    }
    return plan.scatters ? subsurface::add_scatter(graph, inputs, light) : light;
}

} // namespace

ShadowMaps add_shadow_maps(const Making& making, const PosedScene& scene)
{
    const gpu::BufferId sun = sun_map_of(making, scene);
    return {.sun = sun, .local = local_maps_of(making, scene)};
}

std::optional<gpu::ImageId> add_known_light(const Making& making, const PosedScene& scene,
                                            gpu::BufferId visibility)
{
    if (making.resources.lightmaps == nullptr) {
        return std::nullopt;
    }
    return lightmap::add_lightmap(making.graph,
                                  {.frame = scene.frame,
                                   .visibility = visibility,
                                   .triangles = scene.meshes.triangles,
                                   .posed_vertices = scene.meshes.posed_vertices,
                                   .scale = making.plan.light.lightmap_scale,
                                   .size_px = making.sample.size_px},
                                  *making.resources.lightmaps);
}

std::optional<gpu::ImageId> add_occlusion(const Making& making, const PosedScene& scene,
                                          gpu::BufferId visibility, const surface::Surface& surface)
{
    const occlusion::OcclusionStyle& style = making.style.occlusion;
    const bool is_layer_alone = style.feeds == occlusion::Feeds::layer;
    const bool has_layers = making.resources.deep != nullptr && making.resources.deep->has_layers();
    if (!style.drawn || (is_layer_alone && !has_layers)) {
        return std::nullopt;
    }
    const float radius_m = making.plan.occlusion_radius_m;
    if (style.method == occlusion::Method::discs) {
        return add_disc_occlusion(making, scene, visibility);
    }
    const occlusion::OcclusionInputs inputs{.frame = scene.frame,
                                            .depth = surface.depth,
                                            .normal = surface.normal,
                                            .radius_m = radius_m,
                                            .pixels_per_mm = making.plan.page.pixels_per_mm,
                                            .size_px = making.sample.size_px,
                                            .from_px = glm::uvec2(making.sample.from_px)};
    return style.method == occlusion::Method::unsharp ? occlusion::add_unsharp(making.graph, inputs, style)
                                                      : occlusion::add_horizon(making.graph, inputs, style);
}

light::LitPixels add_light(const Making& making, const PosedScene& scene, gpu::BufferId visibility,
                           const surface::Surface& surface, const LightBefore& before)
{
    const FramePlan& plan = making.plan;
    const occlusion::Feeds feeds = making.style.occlusion.feeds;
    light::LightInputs inputs = common_inputs(making, scene, surface, before.maps);
    inputs.shadow_variant |= plan.shadow_edges.variant;
    inputs.lightmap = before.known;
    inputs.ground_share = add_ground_shadow(making, scene, surface);
    inputs.occlusion = feeds == occlusion::Feeds::layer ? std::nullopt : before.open;
    inputs.occludes_all = feeds == occlusion::Feeds::tone;
    inputs.has_emissive = plan.needs.emissive;
    inputs.keeps_strongest = plan.light.leads_strokes;
    inputs.keeps_sun =
        plan.lines.of_shadows || (making.resources.deep != nullptr && making.resources.deep->has_layers());
    light::LitPixels lit = light::add_light(making.graph, inputs);
    lit.light = add_subsurface(making, scene, visibility, surface, before.maps, lit.light);
    if (plan.light.meters_page) {
        lit.light = add_exposed(making, lit.light, surface.draw);
    }
    return lit;
}

} // namespace estampe::frame
