// SPDX-License-Identifier: MIT
#include "features/shadows/shadows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "core/color.hpp"
#include "gpu/resources.hpp"
#include "techniques/raster/views/views.hpp"
#include "techniques/shadow/shadow_style.hpp"

namespace estampe::features {

namespace {

shadow::HeightMethod height_method(shadow::GroundMethod method, const gpu::ExecutionProfile& execution)
{
    switch (method) {
    case shadow::GroundMethod::sweep:
        return shadow::HeightMethod::sweep;
    case shadow::GroundMethod::pyramid:
        return shadow::HeightMethod::pyramid;
    case shadow::GroundMethod::march:
        return shadow::HeightMethod::march;
    case shadow::GroundMethod::above:
        return shadow::HeightMethod::above;
    case shadow::GroundMethod::automatic:
        break;
    }
    return execution.sweeps() ? shadow::HeightMethod::sweep : shadow::HeightMethod::pyramid;
}

} // namespace

GroundShadowPlan plan_ground_shadow(const GroundShadowScene& scene, const shadow::ShadowStyle& style)
{
    // Size of a texel of the height field. The texel size is a power of two, so that a periodic terrain is
    // sampled at equal points even far from the origin.
    constexpr double texel_m = 0.125;
    constexpr uint32_t small_page_px = 540;
    const uint32_t size = scene.page_height_px <= small_page_px ? 256 : 512;
    const glm::dvec3& eye = scene.camera.eye;
    return {.is_thrown = scene.is_thrown,
            .towards_sun = scene.towards_sun,
            .sun_radius_rad = glm::radians(style.sun_radius_deg),
            .size = size,
            .levels = shadow::ground_levels_about({eye.x, eye.z}, {scene.anchor.x, scene.anchor.z},
                                                  scene.towards_sun, size, texel_m),
            .style = {.method = height_method(style.ground, scene.execution), .blur_m = style.ground_blur_m},
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
           held_->plan.towards_sun == plan.towards_sun && held_->plan.sun_radius_rad == plan.sun_radius_rad &&
           held_->plan.style == plan.style;
}

bool GroundShadow::stands(const GroundShadowPlan& plan, uint32_t level) const
{
    return held_ && held_->plan.levels[level].origin_m == plan.levels[level].origin_m;
}

gpu::ImageId GroundShadow::record(gpu::Graph& graph, terrain::TerrainBuffers& terrain,
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
        is_in_part_ = changes && in.clip_from_anchor && plan.style.method == shadow::HeightMethod::pyramid;
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
                                          .style = plan.style,
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
                                            .method = plan.style.method,
                                            .size_px = in.size_px});
}

void GroundShadow::drawn(const GroundShadowPlan& plan, const terrain::TerrainBuffers& terrain)
{
    held_ = {.plan = plan, .form = terrain.form()};
}

namespace {

constexpr float range_steps = 4.0F; // Number of range steps for each doubling of a light's range

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
    // The resolution of a lamp's shadow map is chosen for shadows at half the light's range, or at half the
    // scene's radius.
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

std::vector<raster::Batch> caster_batches(const pose::MeshData& layout, Groups groups, Casters which)
{
    std::vector<raster::Batch> batches;
    list_casters(layout, groups, which, batches);
    return batches;
}

gpu::BufferId add_local_maps(gpu::Graph& graph, const ShadowScene& scene, const LocalMapViews& views,
                             LocalShadowBuffers& buffers)
{
    auto maps = gpu::import_whole(graph, "local shadows", buffers.maps);
    if (views.empty()) {
        return maps;
    }
    const auto depth_views = [&](const std::vector<shared::RasterView>& list, const char* name,
                                 gpu::Buffer& records) {
        return raster::DepthViews{.list = list,
                                  .records = gpu::import_whole(graph, name, records),
                                  .bounds = *scene.cluster_bounds,
                                  .path = scene.path,
                                  .tuning = scene.tuning};
    };
    const auto draw = [&](const char* name, Casters which, const raster::DepthViews& drawn,
                          gpu::BufferId target) {
        return raster::add_depth_views(graph, name, scene.raster,
                                       caster_batches(scene.layout, all_groups, which), drawn, target);
    };
    if (!views.whole.empty()) {
        maps = draw("local shadows", Casters::all,
                    depth_views(views.whole, "local views", buffers.views.whole), maps);
    }
    if (!views.moving.empty()) {
        auto layers = gpu::import_whole(graph, "local layers", buffers.layers);
        if (!views.still.empty()) {
            layers = draw("local shadows/still", Casters::still,
                          depth_views(views.still, "local views/still", buffers.views.still), layers);
        }
        const raster::DepthViews moving =
            depth_views(views.moving, "local views/moving", buffers.views.moving);
        maps = draw("local shadows/moving", Casters::moving, moving, maps);
        maps = raster::add_merged_views(graph, "local shadows/merge", moving, layers, maps);
    }
    return maps;
}

void Shadows::invalidate(Event event)
{
    const bool is_sun_outdated =
        event == Event::scene_replaced || event == Event::lights_changed || event == Event::anchor_moved;
    if (is_sun_outdated) {
        sun_.forget();
    }
    if (event == Event::scene_replaced || event == Event::anchor_moved) {
        ground_.forget();
    }
    if (is_sun_outdated || event == Event::ground_replaced) {
        local_.forget();
    }
}

void Shadows::move(std::span<const Bounds> places)
{
    sun_.move(places);
    moved_.insert(moved_.end(), places.begin(), places.end());
}

LocalMapPlan Shadows::ensure_local_maps(gpu::Device& device, light::Lighting& lighting,
                                        const LocalMapScene& scene, std::vector<std::string>& notes)
{
    const auto planned = [&]() -> const LocalShadowPlan& {
        return local_.plan(lighting, moved_, scene.page, scene.style, scene.casters);
    };
    const LocalShadowPlan* plan = &planned();
    moved_.clear();
    gpu::Buffer& maps = local_buffers_.maps;
    const uint64_t needed_bytes = std::max<uint64_t>(sizeof(uint32_t) * plan->texel_count, 16);
    if (maps.empty() || maps.size_bytes() < needed_bytes) {
        maps = gpu::Buffer(device, "local shadow maps", needed_bytes, gpu::MemoryUse::device);
        local_.forget();
        plan = &planned();
        local_buffers_.layers = {};
    }
    gpu::upload_items(device, "local shadows", plan->shadows, local_buffers_.shadows);
    LocalViewBuffers& views = local_buffers_.views;
    gpu::upload_items(device, "local views", plan->views.whole, views.whole);
    gpu::upload_items(device, "local views/still", plan->views.still, views.still);
    gpu::upload_items(device, "local views/moving", plan->views.moving, views.moving);
    if (!plan->views.still.empty() && local_buffers_.layers.empty()) {
        local_buffers_.layers =
            gpu::Buffer(device, "local shadow layers", maps.size_bytes(), gpu::MemoryUse::device);
    }
    if (plan->without > 0 && scene.style.local_lights > 0) {
        notes.push_back(fmt::format("{} of the scene's lamps and spots throw no shadow: shadow.local_lights "
                                    "and shadow.local_megatexels allow {}",
                                    plan->without, plan->shadows.size()));
    }
    return {.is_there = !plan->shadows.empty(),
            .variant = shadow::lamps_variant(plan->shadows),
            .views = plan->views};
}

light::ShadowMaps Shadows::record(gpu::Graph& graph, const ShadowScene& scene, const ShadowMapWork& work)
{
    const LocalMapViews none;
    return {.sun = sun_.record(graph, scene, work.sun, work.of_sun),
            .sun_globals = gpu::import_whole(graph, "sun", sun_globals_),
            .local = add_local_maps(graph, scene, work.draws_local ? work.local.views : none, local_buffers_),
            .local_shadows = gpu::import_whole(graph, "lights' shadows", local_buffers_.shadows),
            .edge_profile = gpu::import_whole(graph, "edges", edge_profile_),
            .has_sun = work.sun.size > 0,
            .has_local = work.local.is_there,
            .variant = work.sun.variant | work.local.variant};
}

void Shadows::upload(gpu::Device& device, const shared::EdgeProfile& edges, const shared::SunShadow& sun)
{
    gpu::upload_items(device, "edges", std::span(&edges, 1), edge_profile_);
    gpu::upload_items(device, "sun", std::span(&sun, 1), sun_globals_);
}

} // namespace estampe::features
