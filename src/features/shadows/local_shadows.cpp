// SPDX-License-Identifier: MIT
#include "features/shadows/local_shadows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/luminance.hpp"
#include "techniques/raster/views/views.hpp"

namespace estampe::features {
namespace {

constexpr float range_steps = 4.0F; // to a doubling

bool is_spot(const shared::LightRecord& record)
{
    return (record.type & shared::light_type_mask) >= shared::light_spot;
}

glm::vec3 any_side(const glm::vec3& beam)
{
    const glm::vec3 helper = std::abs(beam.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    return glm::normalize(glm::cross(beam, helper));
}

bool reaches(const shadow::LocalLight& light, const Bounds& place)
{
    const glm::dvec3 position(light.position);
    const glm::dvec3 gap = glm::max(glm::max(place.min - position, position - place.max), glm::dvec3(0.0));
    return glm::length(gap) <= static_cast<double>(light.range_m);
}

} // namespace

void add_views(std::vector<shared::RasterView>& list, const shadow::LocalLight& light,
               const shared::LocalShadow& shadow)
{
    for (const shadow::LocalView& view : shadow::local_views(light, shadow)) {
        list.push_back({.clip_from_anchor = view.clip_from_anchor,
                        .eye_anchor = light.position,
                        .reach_m = light.range_m,
                        .first_texel = view.first_texel,
                        .size_px = shadow.size,
                        .origin_px = glm::uvec2(0),
                        .groups = light.casters});
    }
}

shadow::LocalLight local_light(const shared::LightRecord& record)
{
    shadow::LocalLight light{.position = record.position,
                             .range_m =
                                 std::exp2(std::ceil(std::log2(record.range_m) * range_steps) / range_steps),
                             .casters = record.groups >> 16U};
    if (is_spot(record)) {
        const bool has_side = glm::dot(record.side, record.side) > 0.5F;
        light.beam = record.direction;
        light.side = has_side ? record.side : any_side(record.direction);
        light.half_angle_rad = std::acos(std::clamp(-record.cone_offset / record.cone_scale, -1.0F, 1.0F));
    }
    return light;
}

float radius_of(const shared::LightRecord& record, const shadow::ShadowStyle& style)
{
    return record.radius_m >= 0.0F ? record.radius_m : style.lamp_radius_m;
}

shadow::AtlasRequest atlas_request(const shared::LightRecord& record, const shadow::LocalLight& light,
                                   const PageView& page, const shadow::ShadowStyle& style)
{
    const uint32_t half_page = std::bit_ceil(std::max(page.longer_side_px, 2U)) / 2;
    const uint32_t largest = style.local_size > 0 ? static_cast<uint32_t>(style.local_size)
                             : light.is_cube()    ? std::clamp(half_page, 256U, 1024U)
                                                  : std::clamp(2 * half_page, 512U, 2048U);
    // What stands half as far as the light reaches, or the scene, tells how fine its shadow is seen.
    const float distance_m = std::max(glm::distance(light.position, page.eye_anchor), 1e-6F);
    const float throw_m = 0.5F * std::min(light.range_m, page.scene_radius_m);
    const float side_m = 2.0F * throw_m * (light.is_cube() ? 1.0F : std::tan(light.half_angle_rad));
    const float reach_share = std::min(light.range_m / distance_m, 1.0F);
    return {.map_count = light.map_count(),
            .wanted_size = side_m / page.pixel.at(std::max(distance_m, throw_m)),
            .largest_size = largest,
            .importance = reach_share * reach_share * luminance(record.color)};
}

const LocalShadowPlan& LocalShadows::plan(light::Lighting& lighting, std::span<const Bounds> moved,
                                          const PageView& page, const shadow::ShadowStyle& style,
                                          const CasterKinds& casters)
{
    LocalShadowPlan& plan = plan_;
    plan.shadows.clear();
    plan.views.clear();
    plan.without = 0;
    const std::span records = std::span(lighting.records).subspan(lighting.directional_count);
    lights_.clear();
    requests_.clear();
    for (shared::LightRecord& record : records) {
        record.shadow = 0;
        lights_.push_back(local_light(record));
        const bool throws_shadows = lights_.back().casters != 0 && luminance(record.color) > 0.0F;
        requests_.push_back(throws_shadows ? atlas_request(record, lights_.back(), page, style)
                                           : shadow::AtlasRequest{});
    }
    const auto budget_texels = static_cast<uint64_t>(style.local_megatexels * 1e6F);
    const std::vector<shadow::Allotment>& lots =
        atlas_.allot(requests_, {.texels = budget_texels, .lights = static_cast<size_t>(style.local_lights)});
    kept_.resize(records.size());
    const bool has_layers = casters.moving && casters.still;
    for (size_t i = 0; i < records.size(); ++i) {
        const shadow::Allotment& lot = lots[i];
        if (lot.size == 0) {
            plan.without += requests_[i].map_count > 0 ? 1U : 0U;
            kept_[i] = {};
            continue;
        }
        plan.shadows.push_back(
            shadow::local_shadow(lights_[i], lot.size, lot.first_texel, radius_of(records[i], style)));
        records[i].shadow = static_cast<uint32_t>(plan.shadows.size());
        const bool stands = kept_[i].light == lights_[i] && kept_[i].allotment == lot;
        const bool is_kept = stands && std::ranges::none_of(moved, [&](const Bounds& place) {
                                 return reaches(lights_[i], place);
                             });
        if (is_kept) {
            continue;
        }
        const bool in_layers = stands && has_layers;
        if (in_layers && !kept_[i].has_layer) {
            add_views(plan.views.still, lights_[i], plan.shadows.back());
        }
        add_views(in_layers ? plan.views.moving : plan.views.whole, lights_[i], plan.shadows.back());
        kept_[i] = {lights_[i], lot, in_layers};
    }
    raster::place_views(plan.views.whole);
    raster::place_views(plan.views.still);
    raster::place_views(plan.views.moving);
    plan.texel_count = atlas_.end_texel();
    return plan;
}

} // namespace estampe::features
