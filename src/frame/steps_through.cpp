// SPDX-License-Identifier: MIT
// What is seen through: thick bodies that blur what lies behind them, and see-through surfaces one by one.
#include "frame/steps.hpp"

#include <vector>

#include "gpu/imports.hpp"
#include "techniques/subsurface/behind.hpp"

namespace estampe::frame {
namespace {

/// A visibility lit and painted as what is seen first is, without what lies in things.
gpu::ImageId add_painted(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility,
                         const ShadowMaps& maps, const std::optional<gpu::ImageId>& background)
{
    const surface::Surface surface = add_surface(context, scene, visibility);
    light::LightInputs inputs = light_inputs(context, scene, surface, maps);
    inputs.has_emissive = context.plan.needs.emissive;
    return add_paint(context, scene, surface, light::add_light(context.graph, inputs).light, background);
}

gpu::ImageId add_behind(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility,
                        const surface::Surface& surface, const ShadowMaps& maps, gpu::BufferId background,
                        const Colors& colors)
{
    gpu::Graph& graph = context.graph;
    const SubsurfacePlan& plan = *context.plan.subsurface;
    raster::View view = eye_view(context);
    view.cull_back_faces = false;
    const subsurface::BehindInputs inputs{
        .common = subsurface_inputs(context, scene, surface),
        .visibility = visibility,
        .inside = raster::add_layers(graph, "subsurface/inside", scene.meshes, plan.clear, view,
                                     subsurface::inside_layers),
        .background = background,
        .triangles = scene.meshes.triangles,
        .posed_vertices = scene.meshes.posed_vertices,
        .color = surface.color,
        .painted = add_painted(context, scene, background, maps,
                               context.plan.page.shows_sky ? std::optional(colors.sky_wash) : std::nullopt)};
    return subsurface::add_behind(graph, inputs, colors.wash);
}

} // namespace

Colors add_seen_through(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility,
                        const surface::Surface& surface, const ShadowMaps& maps, const SeenThrough& screen,
                        Colors colors)
{
    if (screen.background) {
        colors.wash = add_behind(context, scene, visibility, surface, maps, *screen.background, colors);
    }
    if (!screen.is_there || context.style.transparency.mode != transparency::Mode::sorted) {
        return colors;
    }
    const transparency::TransparencyInputs inputs =
        transparency_inputs(context, scene, visibility, screen.layers);
    const std::vector<gpu::BufferId> farthest_first(screen.layers.rbegin(), screen.layers.rend());
    for (const gpu::BufferId& layer : farthest_first) {
        const gpu::ImageId painted = add_painted(context, scene, layer, maps, std::nullopt);
        colors.wash = transparency::add_sheet(context.graph, inputs, layer, painted, colors.wash);
    }
    return colors;
}

} // namespace estampe::frame
