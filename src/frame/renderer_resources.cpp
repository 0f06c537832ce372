// SPDX-License-Identifier: MIT
// What a frame reads beside the scene, brought to the device: shadows of lamps, strokes, looks, lights.
#include "frame/renderer_impl.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "features/hatching/form_strokes.hpp"
#include "gpu/mapped_buffer.hpp"
#include "gpu/upload.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "techniques/light/daylight.hpp"

namespace estampe {

features::LocalMapPlan Renderer::Impl::provide_local_shadows(const frame::PagePlan& page_plan,
                                                             light::Lighting& lighting, const Camera& camera,
                                                             const features::StyleTables& tables)
{
    shadow::ShadowStyle style = tables.shadow;
    style.local_lights = tables.light.shadows ? style.local_lights : 0;
    const features::PageView page_view{.eye_anchor = glm::vec3(camera.eye - loaded->layout.anchor),
                                       .pixel = page_plan.pixel,
                                       .scene_radius_m = static_cast<float>(loaded->layout.bounds.radius()),
                                       .longer_side_px = std::max(page_plan.size_px.x, page_plan.size_px.y)};
    const features::CasterKinds casters = features::caster_kinds(loaded->layout);
    const features::LocalShadowPlan* plan = &local_shadows.plan(lighting, moved, page_view, style, casters);
    moved.clear();
    gpu::Buffer& maps = local_shadow_buffers.maps;
    const uint64_t needed_bytes = std::max<uint64_t>(sizeof(uint32_t) * plan->texel_count, 16);
    if (maps.empty() || maps.size_bytes() < needed_bytes) {
        maps = gpu::Buffer(device, "local shadow maps", needed_bytes, gpu::MemoryUse::device);
        local_shadows.forget();
        plan = &local_shadows.plan(lighting, {}, page_view, style, casters);
        local_shadow_buffers.layers = {};
    }
    const features::LocalShadowPlan& local = *plan;
    gpu::refill(device, "local shadows", local.shadows, local_shadow_buffers.shadows);
    features::LocalViewBuffers& views = local_shadow_buffers.views;
    gpu::refill(device, "local views", local.views.whole, views.whole);
    gpu::refill(device, "local views/still", local.views.still, views.still);
    gpu::refill(device, "local views/moving", local.views.moving, views.moving);
    if (!local.views.still.empty() && local_shadow_buffers.layers.empty()) {
        local_shadow_buffers.layers =
            gpu::Buffer(device, "local shadow layers", maps.size_bytes(), gpu::MemoryUse::device);
    }
    if (local.without > 0 && style.local_lights > 0) {
        notes.push_back(fmt::format("{} of the scene's lamps and spots throw no shadow: shadow.local_lights "
                                    "and shadow.local_megatexels allow {}",
                                    local.without, local.shadows.size()));
    }
    return {.is_there = !local.shadows.empty(),
            .variant = shadow::lamps_variant(local.shadows),
            .views = local.views};
}

void Renderer::Impl::provide_strokes(const features::StrokePlan& strokes)
{
    if (loaded->stroke_kinds == strokes.kind_of_draw) {
        return;
    }
    stroke_kinds = gpu::upload_buffer(device, "stroke kinds", strokes.kind_of_draw);
    form_coordinates = gpu::upload_buffer(device, "form coordinates",
                                          strokes.has(shared::strokes_form)
                                              ? features::form_coordinates(loaded->layout, strokes)
                                              : std::vector<glm::vec2>());
    loaded->stroke_kinds = strokes.kind_of_draw;
}

void Renderer::Impl::provide_looks(const frame::FramePlan& plan)
{
    tonal_maps.provide(device, plan.looks.styles);
    if (!plan.focus.lines.empty()) {
        gpu::refill(device, "focus lines", plan.focus.lines, focus_lines);
    }
    if (plan.clouds) {
        features::refill_clouds(device, *plan.clouds, clouds);
    }
    if (const occlusion::OcclusionStyle& style = plan.looks.styles.front().occlusion;
        style.drawn && occlusion::has_discs(style.method) && loaded->discs.empty()) {
        loaded->discs = frame::discs_of(device, *loaded);
    }
    provide_surface_maps(plan);
    if (plan.motion_blur && plan.looks.styles.front().motion_blur.mode == motion_blur::Mode::stretched &&
        loaded->together.empty()) {
        loaded->together =
            motion_blur::upload_together(device, motion_blur::list_together(loaded->layout.stroke_coordinates,
                                                                            loaded->layout.draw_of_vertex));
    }
    if (plan.motion_blur && plan.looks.styles.front().motion_blur.smear && !loaded->smear_seeds.is_made) {
        loaded->smear_seeds = frame::smear_seeds_of(device, loaded->layout);
    }
    if (plan.subsurface) {
        gpu::refill(device, "subsurface looks", plan.subsurface->looks, subsurface_looks);
    }
    if (plan.looks.has_several()) {
        const std::vector<uint32_t>& looks = plan.looks.look_of_draw;
        gpu::refill(device, "looks", looks, look_of_draw);
    }
}

void Renderer::Impl::provide_surface_maps(const frame::FramePlan& plan)
{
    const std::array<std::optional<uint32_t>, 2> wanted{plan.occlusion_texels, plan.scatter_texels};
    std::erase_if(loaded->surface_maps, [&](const auto& map) {
        return std::ranges::find(wanted, std::optional(map.first)) == wanted.end();
    });
    for (const std::optional<uint32_t>& size : wanted) {
        if (size && !loaded->surface_maps.contains(*size)) {
            loaded->surface_maps.emplace(
                *size,
                features::upload_surface_map(device, features::make_surface_map(loaded->layout, *size)));
        }
        if (size && loaded->surface_maps.at(*size).cut_draws > 0) {
            const std::string note = fmt::format("{} of the scene's objects have no coordinates of their own "
                                                 "that lay each place by itself: for "
                                                 "maps of surfaces they were cut into charts",
                                                 loaded->surface_maps.at(*size).cut_draws);
            if (std::ranges::find(notes, note) == notes.end()) {
                notes.push_back(note);
            }
        }
    }
    if (plan.occlusion_texels && loaded->disc_map.size != *plan.occlusion_texels) {
        loaded->disc_map = occlusion::make_disc_map(device, *plan.occlusion_texels);
    }
}

void Renderer::Impl::provide_pixel_sizes(const frame::FramePlan& plan, const features::StyleTables& tables)
{
    gpu::refill(device, "edges", std::span(&plan.shadow_edges.look, 1), edge_look);
    const shared::SunShadow sun = features::sun_globals(plan.sun.map, plan.page.pixel, tables.shadow);
    gpu::refill(device, "sun", std::span(&sun, 1), sun_shadow);
    if (plan.looks.has_several()) {
        std::vector<shared::LineLook> lines;
        for (const features::StyleTables& style : plan.looks.styles) {
            lines.push_back(contour::line_look(style.contour, plan.page.pixels_per_mm));
        }
        gpu::refill(device, "line looks", lines, line_looks);
    }
}

void Renderer::Impl::provide_lighting(const frame::FramePlan& plan, const light::Lighting& lighting,
                                      const features::StyleTables& tables)
{
    const pose::MeshData& layout = loaded->layout;
    const light::Paling paling =
        light::ground_paling(layout.bounds, layout.anchor, lighting.towards_sun, tables.light.paling);
    const light::SkyAndGround ambient = light::sky_and_ground(lighting.ambient);
    const shared::LightGlobals globals{.sky_ambient = ambient.sky,
                                       .ground_ambient = ambient.ground,
                                       .directional_count = lighting.directional_count,
                                       .local_count = plan.light.local_count,
                                       .falloff = tables.light.falloff,
                                       .paling = paling.share_per_m,
                                       .paling_at_anchor = paling.share_at_anchor};
    gpu::refill(device, "lighting", std::span(&globals, 1), light_globals);
    provide_pixel_sizes(plan, tables);
    gpu::refill(device, "lights", lighting.records, lights);
}

} // namespace estampe
