// SPDX-License-Identifier: MIT
// Shadows, light known ahead, and the light that arrives.
#include "frame/steps.hpp"
#include "gpu/imports.hpp"
#include "techniques/light/exposure.hpp"
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
                                          const surface::Surface& surface)
{
    if (!making.style.occlusion.drawn) {
        return std::nullopt;
    }
    return occlusion::add_horizon(making.graph,
                                  {.frame = scene.frame,
                                   .depth = surface.depth,
                                   .normal = surface.normal,
                                   .radius_m = making.plan.occlusion_radius_m,
                                   .pixels_per_mm = making.plan.page.pixels_per_mm,
                                   .size_px = making.sample.size_px,
                                   .from_px = glm::uvec2(making.sample.from_px)},
                                  making.style.occlusion);
}

light::LitPixels add_light(const Making& making, const PosedScene& scene, const surface::Surface& surface,
                           const ShadowMaps& maps, const std::optional<gpu::ImageId>& known,
                           const std::optional<gpu::ImageId>& open)
{
    gpu::Graph& graph = making.graph;
    FrameResources& resources = making.resources;
    const FramePlan& plan = making.plan;
    const occlusion::Feeds feeds = making.style.occlusion.feeds;
    light::LitPixels lit = light::add_light(
        graph,
        {.frame = scene.frame,
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
         .shadow_variant = plan.shadow_edges.variant | plan.sun.map.variant | plan.local_shadows.variant,
         .local_shadows = gpu::import_whole(graph, "lights' shadows", resources.local_shadows.shadows),
         .local_maps = maps.local,
         .has_local_shadows = plan.local_shadows.is_there,
         .lightmap = known,
         .ground_share = add_ground_shadow(making, scene, surface),
         .occlusion = feeds == occlusion::Feeds::layer ? std::nullopt : open,
         .occludes_all = feeds == occlusion::Feeds::tone,
         .has_shadow = plan.sun.map.size > 0,
         .local_count = plan.light.local_count,
         .has_emissive = plan.needs.emissive,
         .keeps_strongest = plan.light.leads_strokes,
         .keeps_sun = plan.lines.of_shadows || (resources.deep != nullptr && resources.deep->has_layers()),
         .has_links = plan.light.has_links,
         .size_px = making.sample.size_px});
    if (plan.light.meters_page) {
        lit.light = add_exposed(making, lit.light, surface.draw);
    }
    return lit;
}

} // namespace estampe::frame
