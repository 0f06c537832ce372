// SPDX-License-Identifier: MIT
#include "features/shadows/ground_shadow.hpp"

#include "gpu/imports.hpp"

namespace estampe::features {

GroundShadowPlan plan_ground_shadow(const GroundShadowScene& scene, const shadow::ShadowStyle& style)
{
    constexpr double texel_m = 0.125; // a power of two, or patterns that repeat would have others far off
    constexpr uint32_t small_page_px = 540;
    const uint32_t size = scene.page_height_px <= small_page_px ? 256 : 512;
    const glm::dvec3& eye = scene.camera.eye;
    return {.is_thrown = scene.is_thrown,
            .towards_sun = scene.towards_sun,
            .sun_radius_rad = glm::radians(style.sun_radius_deg),
            .size = size,
            .levels = shadow::ground_levels_about({eye.x, eye.z}, {scene.anchor.x, scene.anchor.z},
                                                  scene.towards_sun, size, texel_m),
            .method = scene.execution.sweeps() ? shadow::HeightMethod::sweep : shadow::HeightMethod::pyramid,
            .relief_m = scene.relief_m};
}

void GroundShadow::ensure(gpu::Device& device, const GroundShadowPlan& plan)
{
    const uint64_t size_bytes = sizeof(uint32_t) * shared::ground_levels * plan.size * plan.size;
    if (kept_.empty() || kept_.size_bytes() != size_bytes) {
        kept_ = gpu::Buffer(device, "ground shadow", size_bytes, gpu::MemoryUse::device);
        held_.reset();
    }
}

bool GroundShadow::is_held(const GroundShadowPlan& plan, uint32_t level, uint64_t form) const
{
    return stands(plan, level) && !is_in_part_ && held_->form == form &&
           held_->plan.towards_sun == plan.towards_sun && held_->plan.sun_radius_rad == plan.sun_radius_rad;
}

bool GroundShadow::stands(const GroundShadowPlan& plan, uint32_t level) const
{
    return held_ && held_->plan.levels[level].origin_m == plan.levels[level].origin_m;
}

gpu::ImageId GroundShadow::add_share(gpu::Graph& graph, terrain::TerrainBuffers& terrain,
                                     const GroundShadowInputs& in)
{
    const GroundShadowPlan& plan = in.plan;
    gpu::BufferId kept = gpu::import_whole(graph, "ground shadow", kept_);
    shadow::LevelNumbers stale;
    terrain::HeightFields fields;
    bool changes = held_ && (held_->form != terrain.form() || held_->plan.towards_sun != plan.towards_sun);
    for (uint32_t number = 0; number < shared::ground_levels; ++number) {
        if (!is_held(plan, number, terrain.form())) {
            changes = changes && stands(plan, number);
            stale.push_back(number);
            fields.push_back(
                {.origin_m = plan.levels[number].origin_m, .texel_m = plan.levels[number].texel_m});
        }
    }
    if (!stale.empty()) {
        is_in_part_ = changes && in.clip_from_anchor && plan.method == shadow::HeightMethod::pyramid;
        shared::FieldSector wanted{};
        if (is_in_part_) {
            wanted = shadow::seen_sector({.clip_from_anchor = *in.clip_from_anchor,
                                          .towards_sun = plan.towards_sun,
                                          .relief_m = plan.relief_m},
                                         plan.levels, stale);
        }
        const gpu::ImageId height = terrain.add_heights(graph, fields, glm::uvec2(plan.size), in.texels,
                                                        shadow::sunward_of(wanted, plan.towards_sun));
        kept = shadow::add_ground_fields(graph,
                                         {.height = height,
                                          .numbers = stale,
                                          .levels = plan.levels,
                                          .size = plan.size,
                                          .method = plan.method,
                                          .wanted = wanted,
                                          .sun_radius_rad = plan.sun_radius_rad},
                                         plan.towards_sun, kept);
    }
    return shadow::add_ground_share(graph, {.frame = in.frame,
                                            .depth = in.depth,
                                            .kept = kept,
                                            .levels = plan.levels,
                                            .size = plan.size,
                                            .towards_sun = plan.towards_sun,
                                            .sun_radius_rad = plan.sun_radius_rad,
                                            .size_px = in.size_px});
}

void GroundShadow::drawn(const GroundShadowPlan& plan, const terrain::TerrainBuffers& terrain)
{
    held_ = {.plan = plan, .form = terrain.form()};
}

} // namespace estampe::features
