// SPDX-License-Identifier: MIT
#include <algorithm>

#include "features/shadows/shadows.hpp"
#include "features/shadows/sun.hpp"
#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "techniques/shadow/sun/sun_map.hpp"

namespace estampe::test {

features::SunMapPlan Drawing::sun_plan(const glm::dvec3& towards_sun, const LightSetup& setup) const
{
    features::SunMapPlan plan{.size = setup.shadow_size,
                              .view = sun(towards_sun, std::max(setup.shadow_size, 4U))};
    if (setup.is_warped) {
        plan.view = warped_sun(towards_sun, setup.shadow_size);
        plan.variant |= shared::light_has_sun_warp;
    }
    if (setup.clipmap) {
        plan.clipmap = setup.clipmap;
        plan.size = setup.clipmap->size;
        plan.windows = shadow::windows_about(*plan.clipmap, glm::dvec3(globals.eye_anchor));
        plan.variant |= shared::light_has_sun_levels;
    }
    return plan;
}

shadow::SunView Drawing::warped_sun(const glm::dvec3& towards_sun, uint32_t shadow_size) const
{
    return shadow::fit_sun_map({.casters = pose.casters,
                                .anchor = layout.anchor,
                                .towards_sun = towards_sun,
                                .floor_m = layout.bounds.min.y,
                                .nearest_m = 2.0,
                                .size = shadow_size,
                                .eye = globals},
                               {.sun_map = shadow::SunMapKind::warped})
        .view;
}

gpu::BufferId Drawing::add_sun_map(gpu::Graph& graph, const Stage& stage, const LightSetup& setup,
                                   const features::SunMapPlan& plan)
{
    sun_map_ = {};
    features::SunMap& memory = setup.sun_memory != nullptr ? *setup.sun_memory : sun_map_;
    const features::SunMapWork work = memory.ensure(shared_device(), plan, {});
    const gpu::BufferId map = gpu::import_whole(graph, "shadow", memory.buffer());
    memory.drawn(plan);
    return features::add_sun_map(graph,
                                 {.raster = raster_inputs(graph, stage.posed),
                                  .casters = caster_batches(setup),
                                  .plan = plan,
                                  .work = work,
                                  .path = path,
                                  .tuning = tuning,
                                  .vertex_count = meshes_.vertex_count},
                                 {.map = map});
}

std::vector<uint32_t> Drawing::sun_piece(const shadow::Clipmap& clipmap, const shadow::Piece& piece)
{
    gpu::Graph graph;
    const gpu::BufferId posed_vertices = add_posed(graph);
    raster::RasterInputs inputs = raster_inputs(graph, posed_vertices);
    inputs.posed_vertices = shadow::add_sun_vertices(graph, posed_vertices, meshes_.vertex_count, clipmap);
    const auto target = graph.buffer("depths", {.size_bytes = 4ULL * piece.size.x * piece.size.y});
    return run_and_read_as<uint32_t>(graph,
                                     raster::add_depth(graph, "piece", inputs, batches(),
                                                       {.clip_from_anchor = shadow::clip_from_sun(piece),
                                                        .size_px = piece.size,
                                                        .cull_back_faces = false,
                                                        .path = path,
                                                        .tuning = tuning},
                                                       target));
}

gpu::BufferId Drawing::add_local_maps(gpu::Graph& graph, const Stage& stage, LightSetup& setup)
{
    std::vector<shared::LocalShadow> shadows;
    std::vector<shared::RasterView> views;
    uint32_t texel_count = 0;
    for (size_t i = setup.directional_count; i < setup.records.size() && setup.local_shadow_size > 0; ++i) {
        const shadow::LocalLight local = features::local_light(setup.records[i]);
        shadows.push_back(shadow::local_shadow(local, setup.local_shadow_size, texel_count,
                                               features::radius_of(setup.records[i], setup.shadow)));
        setup.records[i].shadow = static_cast<uint32_t>(shadows.size());
        features::add_views(views, local, shadows.back());
        texel_count = static_cast<uint32_t>(views.size()) * setup.local_shadow_size * setup.local_shadow_size;
    }
    raster::place_views(views);
    lamps_variant_ = shadow::lamps_variant(shadows);
    local_shadows_ = gpu::upload_buffer(shared_device(), "local shadows", shadows);
    local_views_ = gpu::upload_buffer(shared_device(), "local views", views);
    local_maps_ = gpu::Buffer(shared_device(), "local maps", 4ULL * texel_count, gpu::MemoryUse::device);
    const gpu::BufferId maps = gpu::import_whole(graph, "local maps", local_maps_);
    if (views.empty()) {
        return maps;
    }
    const auto triangle_count = static_cast<uint32_t>(layout.triangles.size());
    const raster::RasterInputs inputs = raster_inputs(graph, stage.posed);
    std::vector<raster::Batch> casters;
    for (const pose::CasterRun& run : layout.casters) {
        casters.push_back({run.range.first, run.range.count, run.masked, run.range.plain, run.groups});
    }
    const gpu::BufferId bounds = raster::add_cluster_bounds(
        graph, inputs, triangle_count,
        graph.buffer("bounds", {.size_bytes = raster::cluster_bounds_bytes(triangle_count)}));
    return raster::add_depth_views(graph, "local maps", inputs, casters,
                                   {.list = views,
                                    .records = gpu::import_whole(graph, "local views", local_views_),
                                    .bounds = bounds,
                                    .path = path,
                                    .tuning = tuning},
                                   maps);
}

} // namespace estampe::test
