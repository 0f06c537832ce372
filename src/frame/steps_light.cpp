// SPDX-License-Identifier: MIT
// Shadows, light known ahead, and the light that arrives.
#include <algorithm>

#include "frame/steps.hpp"
#include "gpu/imports.hpp"
#include "techniques/light/exposure/exposure.hpp"
#include "techniques/occlusion/discs/disc_map.hpp"
#include "techniques/occlusion/occlusion.hpp"
#include "techniques/subsurface/texture/texture.hpp"

namespace estampe::frame {
namespace {

gpu::BufferId sun_map_of(const Making& making, const PosedScene& scene)
{
    const FramePlan& plan = making.plan;
    // The ground receives but does not throw.
    std::vector<raster::Batch>& casters = making.resources.frame_lists.casters;
    list_casters(making.layout, plan.sun.casters, plan.sun.map.clipmap ? Casters::moving : Casters::all,
                 casters);
    const SunMapWork& work = making.sample.sun_map;
    const auto import = [&](bool is_there, const char* name, gpu::Buffer& buffer) {
        return is_there ? std::optional(gpu::import_whole(making.graph, name, buffer)) : std::nullopt;
    };
    const SunMaps maps{
        .map = gpu::import_whole(making.graph, "shadow", making.resources.shadow_map),
        .still = import(work.has_still, "shadow of what stands", making.resources.still_shadow_map),
        .views = import(!work.views.empty(), "sun views", making.resources.sun_views),
        .pictures = import(work.has_still, "shadow of what moves", making.resources.sun_pictures),
        .tiles = import(work.has_still, "tiles that change", making.resources.sun_tiles)};
    return add_sun_map(making.graph,
                       {.raster = scene.meshes,
                        .casters = casters,
                        .still = making.resources.still_casters,
                        .groups = plan.sun.casters,
                        .anchor = making.layout.anchor,
                        .plan = plan.sun.map,
                        .work = work,
                        .path = plan.raster.paths.maps,
                        .tuning = plan.raster.tuning,
                        .vertex_count = making.resources.meshes.vertex_count,
                        .triangle_count = static_cast<uint32_t>(making.layout.triangles.size())},
                       maps);
}

gpu::BufferId local_maps_of(const Making& making, const PosedScene& scene)
{
    const FramePlan& plan = making.plan;
    const LocalMapViews none;
    return add_local_maps(making.graph,
                          {.raster = scene.meshes,
                           .layout = making.layout,
                           .views = making.sample.is_first ? plan.local_shadows.views : none,
                           .cluster_bounds = scene.cluster_bounds,
                           .path = plan.raster.paths.maps,
                           .tuning = plan.raster.tuning},
                          making.resources.local_shadows);
}

std::optional<gpu::ImageId> add_ground_shadow(const Making& making, const PosedScene& scene,
                                              const surface::Surface& surface)
{
    if (making.resources.terrain == nullptr || !making.plan.sun.ground.is_thrown) {
        return std::nullopt;
    }
    // Of a picture of several samples or tiles what one has found serves the others.
    const SamplePlan& sample = making.sample;
    const bool is_picture = sample.accumulation.sample_count == 1 && sample.size_px == making.plan.page_px;
    return making.resources.ground_shadow.add_share(
        making.graph, *making.resources.terrain,
        {.plan = making.plan.sun.ground,
         .texels = *scene.terrain_texels,
         .frame = scene.frame,
         .depth = surface.depth,
         .size_px = sample.size_px,
         .clip_from_anchor = is_picture ? std::optional(sample.clip_from_anchor) : std::nullopt});
}

/// How much of the sun is left where that is not known by its map: by terrain, clouds and smoke.
std::optional<gpu::ImageId> add_sun_share(const Making& making, const PosedScene& scene,
                                          const surface::Surface& surface,
                                          const std::optional<smoke::Volume>& volume)
{
    gpu::Graph& graph = making.graph;
    const FramePlan& plan = making.plan;
    std::optional<gpu::ImageId> share = add_ground_shadow(making, scene, surface);
    if (!plan.sun.shines) {
        return share;
    }
    const float of_clouds = making.style.clouds.shadow;
    if (plan.clouds && plan.clouds->globals.puff_layer_count > 0 && of_clouds > 0.0F) {
        CloudBuffers& buffers = making.resources.clouds;
        share = sky::add_cloud_shadow(graph,
                                      {.frame = scene.frame,
                                       .globals = gpu::import_whole(graph, "clouds", buffers.globals),
                                       .starts = gpu::import_whole(graph, "cloud cells", buffers.starts),
                                       .puffs = gpu::import_whole(graph, "puffs", buffers.puffs),
                                       .depth = surface.depth,
                                       .share = share,
                                       .size_px = making.sample.size_px},
                                      of_clouds);
    }
    if (volume && making.style.smoke.shadow > 0.0F) {
        share = smoke::add_thrown(
            graph, *volume, making.style.smoke,
            {.view = {.frame = scene.frame,
                      .globals = gpu::import_whole(graph, "smoke", making.resources.smoke.globals()),
                      .depth = surface.depth,
                      .size_px = making.sample.size_px},
             .share = share,
             .towards_sun = plan.sun.towards});
    }
    return share;
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

light::LightInputs light_inputs(const Making& making, const PosedScene& scene,
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

namespace {

occlusion::OpenPage add_disc_map_occlusion(const Making& making, const PosedScene& scene,
                                           gpu::BufferId visibility, const occlusion::DiscSettings& settings)
{
    SurfaceMap& map = *making.resources.occlusion_map;
    const gpu::BufferId found = occlusion::add_disc_map(
        making.graph, making.resources.discs, making.resources.disc_map,
        {.map_texels = gpu::import_whole(making.graph, "texels of surfaces", map.texels),
         .triangles = scene.meshes.triangles,
         .posed_vertices = scene.meshes.posed_vertices},
        settings);
    return occlusion::add_disc_map_page(
        making.graph,
        {.frame = scene.frame,
         .visibility = visibility,
         .triangles = scene.meshes.triangles,
         .posed_vertices = scene.meshes.posed_vertices,
         .map_corners = gpu::import_whole(making.graph, "corners in the map", map.corners),
         .found = found,
         .map_size = map.size,
         .throws = settings.throws,
         .size_px = making.sample.size_px},
        making.style.occlusion);
}

std::optional<occlusion::OpenPage> add_disc_occlusion(const Making& making, const PosedScene& scene,
                                                      gpu::BufferId visibility,
                                                      const occlusion::OcclusionInputs& inputs)
{
    const occlusion::OcclusionStyle& style = making.style.occlusion;
    occlusion::DiscBuffers& discs = making.resources.discs;
    if (discs.empty()) {
        return std::nullopt;
    }
    if (style.method == occlusion::Method::splats) {
        return occlusion::add_disc_splats(making.graph, discs, scene.meshes.posed_vertices, inputs, style);
    }
    const occlusion::DiscSettings settings{.radius_m = making.plan.occlusion_radius_m,
                                           .throws = style.bleeding > 0.0F};
    if (style.method == occlusion::Method::uv) {
        return add_disc_map_occlusion(making, scene, visibility, settings);
    }
    const occlusion::OpenVertices found =
        occlusion::add_discs(making.graph, discs, scene.meshes.posed_vertices, settings);
    return occlusion::add_disc_page(making.graph,
                                    {.frame = scene.frame,
                                     .visibility = visibility,
                                     .triangles = scene.meshes.triangles,
                                     .posed_vertices = scene.meshes.posed_vertices,
                                     .found = found,
                                     .vertex_count = discs.vertex_count,
                                     .size_px = making.sample.size_px},
                                    style);
}

/// `light`, the page's, spread in a map that lies on all surfaces; `to_light` is how that is lit.
gpu::ImageId spread_in_map(const Making& making, const PosedScene& scene, gpu::BufferId visibility,
                           light::LightInputs to_light, gpu::ImageId light)
{
    gpu::Graph& graph = making.graph;
    SurfaceMap& map = *making.resources.scatter_map;
    float most_m = 0.0F;
    for (const shared::SubsurfaceLook& look : making.plan.subsurface->looks) {
        most_m = std::max({most_m, look.scatter_m.x, look.scatter_m.y, look.scatter_m.z});
    }
    const subsurface::TextureInputs in{
        .map_texels = gpu::import_whole(graph, "texels of surfaces", map.texels),
        .map_corners = gpu::import_whole(graph, "corners in the map", map.corners),
        .triangles = scene.meshes.triangles,
        .posed_vertices = scene.meshes.posed_vertices,
        .draws = scene.meshes.draws,
        .materials = scene.meshes.materials,
        .looks = gpu::import_whole(graph, "subsurface looks", making.resources.subsurface_looks),
        .look_of_draw = look_of_draw(making),
        .size = map.size,
        .most_spread_tx = most_m * map.texels_per_m};
    const subsurface::TextureSurface surface = subsurface::add_texture_surface(graph, in);
    to_light.frame = gpu::import_whole(graph, "frame of the map", making.resources.map_frame);
    to_light.draw = surface.draw;
    to_light.depth = surface.points;
    to_light.normal = surface.normal;
    to_light.points = surface.points;
    to_light.has_emissive = making.plan.needs.emissive;
    to_light.size_px = glm::uvec2(map.size);
    const subsurface::TextureLight spread =
        subsurface::add_texture_scatter(graph, in, surface, light::add_light(graph, to_light).light);
    return subsurface::add_texture_page(graph, in, spread, scene.frame, visibility, light,
                                        making.sample.size_px);
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
    const subsurface::SubsurfaceInputs inputs = subsurface_inputs(making, scene, surface);
    const bool has_map = making.resources.scatter_map != nullptr;
    if (has_map) {
        light = spread_in_map(making, scene, visibility, light_inputs(making, scene, surface, maps), light);
    }
    std::optional<subsurface::Through> through;
    if (!plan.bodies.empty()) {
        const gpu::BufferId behind =
            raster::add_visibility(graph, "subsurface/behind", scene.meshes, plan.bodies,
                                   {.clip_from_anchor = making.sample.clip_from_anchor,
                                    .size_px = making.sample.size_px,
                                    .cull_back_faces = false,
                                    .path = making.plan.raster.paths.maps,
                                    .tuning = making.plan.raster.tuning,
                                    .behind = visibility,
                                    .second_from = inputs.second_from()});
        const subsurface::FarSide far_side = subsurface::add_far_side(
            graph, inputs, behind, scene.meshes.triangles, scene.meshes.posed_vertices);
        light::LightInputs far_inputs = light_inputs(making, scene, surface, maps);
        far_inputs.frame = gpu::import_whole(graph, "frame of the half page", making.resources.half_frame);
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

subsurface::SubsurfaceInputs subsurface_inputs(const Making& making, const PosedScene& scene,
                                               const surface::Surface& surface)
{
    return {.frame = scene.frame,
            .draw = surface.draw,
            .depth = surface.depth,
            .normal = surface.normal,
            .looks = gpu::import_whole(making.graph, "subsurface looks", making.resources.subsurface_looks),
            .look_of_draw = look_of_draw(making),
            .reach_mm = making.style.subsurface.reach_mm,
            .pixels_per_mm = making.plan.page.pixels_per_mm,
            .size_px = making.sample.size_px,
            .from_px = glm::uvec2(making.sample.from_px),
            .on_processor = making.plan.raster.on_processor,
            .in_perspective = !making.plan.page.pixel.is_parallel};
}

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

std::optional<occlusion::OpenPage> add_occlusion(const Making& making, const PosedScene& scene,
                                                 gpu::BufferId visibility, const surface::Surface& surface)
{
    const occlusion::OcclusionStyle& style = making.style.occlusion;
    const bool is_layer_alone = style.feeds == occlusion::Feeds::layer;
    const bool has_layers = making.resources.deep != nullptr && making.resources.deep->has_layers();
    if (!style.drawn || (is_layer_alone && !has_layers)) {
        return std::nullopt;
    }
    const occlusion::OcclusionInputs inputs{.frame = scene.frame,
                                            .depth = surface.depth,
                                            .normal = surface.normal,
                                            .radius_m = making.plan.occlusion_radius_m,
                                            .pixels_per_mm = making.plan.page.pixels_per_mm,
                                            .size_px = making.sample.size_px,
                                            .from_px = glm::uvec2(making.sample.from_px)};
    if (occlusion::has_discs(style.method)) {
        return add_disc_occlusion(making, scene, visibility, inputs);
    }
    return occlusion::OpenPage{.open = style.method == occlusion::Method::unsharp
                                           ? occlusion::add_unsharp(making.graph, inputs, style)
                                           : occlusion::add_horizon(making.graph, inputs, style),
                               .thrown = std::nullopt};
}

std::optional<smoke::Volume> add_smoke_volume(const Making& making, const PosedScene& scene,
                                              const ShadowMaps& maps)
{
    if (!making.plan.smoke) {
        return std::nullopt;
    }
    gpu::Graph& graph = making.graph;
    FrameResources& resources = making.resources;
    if (!making.sample.is_first) {
        return resources.smoke.volume().import(graph);
    }
    smoke::Fields fields = resources.smoke.fields(graph);
    if (making.style.smoke.shaded) {
        fields.shadows = {.frame = scene.frame,
                          .sun_map = maps.sun,
                          .sun_shadow = gpu::import_whole(graph, "sun", resources.sun_shadow),
                          .local_shadows =
                              gpu::import_whole(graph, "lights' shadows", resources.local_shadows.shadows),
                          .local_maps = maps.local,
                          .variant = making.plan.sun.map.variant};
    }
    return smoke::add_volume(graph, resources.smoke.volume(), making.style.smoke, fields);
}

light::LitPixels add_light(const Making& making, const PosedScene& scene, gpu::BufferId visibility,
                           const surface::Surface& surface, const LightBefore& before)
{
    const FramePlan& plan = making.plan;
    const occlusion::Feeds feeds = making.style.occlusion.feeds;
    light::LightInputs inputs = light_inputs(making, scene, surface, before.maps);
    inputs.shadow_variant |= plan.shadow_edges.variant;
    inputs.lightmap = before.known;
    inputs.sun_share = add_sun_share(making, scene, surface, before.smoke);
    if (before.open && feeds != occlusion::Feeds::layer) {
        inputs.occlusion = before.open->open;
        inputs.thrown = before.open->thrown;
    }
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
