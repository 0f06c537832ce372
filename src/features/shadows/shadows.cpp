// SPDX-License-Identifier: MIT
#include "features/shadows/shadows.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "gpu/mapped_buffer.hpp"
#include "techniques/shadow/local/edge_look.hpp"

namespace estampe::features {

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

void Shadows::upload(gpu::Device& device, const shared::EdgeLook& edges, const shared::SunShadow& sun)
{
    gpu::upload_items(device, "edges", std::span(&edges, 1), edge_look_);
    gpu::upload_items(device, "sun", std::span(&sun, 1), sun_globals_);
}

} // namespace estampe::features
