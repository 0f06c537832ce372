// SPDX-License-Identifier: MIT
#include "frame/frame.hpp"

#include "frame/steps.hpp"

namespace estampe::frame {

void declare_frame(gpu::Graph& graph, const pose::MeshData& layout, FrameResources& resources,
                   const FramePlan& plan, const SamplePlan& sample, const features::StyleTables& style)
{
    const Making making{.graph = graph,
                        .layout = layout,
                        .resources = resources,
                        .plan = plan,
                        .sample = sample,
                        .style = style};

    // What is seen.
    const PosedScene scene = add_posed_scene(making);
    const gpu::BufferId visibility = add_visibility(making, scene);
    const surface::Surface surface = add_surface(making, scene, visibility);
    add_motion(making, scene, visibility);
    const SeenThrough screen = add_screen(making, scene, visibility);

    // What light falls on it.
    const ShadowMaps maps = add_shadow_maps(making, scene);
    const std::optional<gpu::ImageId> known = add_known_light(making, scene, visibility);
    const std::optional<occlusion::OpenPage> open = add_occlusion(making, scene, visibility, surface);
    const std::optional<smoke::Volume> volume = add_smoke_volume(making, scene, maps);
    const light::LitPixels lit = add_light(making, scene, visibility, surface,
                                           {.maps = maps, .smoke = volume, .known = known, .open = open});

    // What ink that is: as paths, or as layers.
    const hatch::HatchInputs hatching = hatch_inputs(making, scene, surface, lit, screen);
    const contour::ContourInputs outlining = contour_inputs(making, scene, visibility, surface, lit, screen);
    if (resources.lists != nullptr) {
        declare_stroke_lists(graph, {hatching, hatch_looks(making)}, {outlining, resources.line_mesh},
                             plan.looks, stroke_haze(making, scene, surface), *resources.lists);
        return;
    }
    if (resources.strung_into != nullptr) {
        add_strung_lines(making, outlining);
        return;
    }
    const gpu::ImageId strokes = hatch::add_hatch(graph, hatching, hatch_looks(making));
    const gpu::ImageId lines = add_lines(making, outlining);
    const gpu::ImageId ink = bleed::add_bleed(graph,
                                              {.hatch = strokes,
                                               .lines = lines,
                                               .pixels_per_mm = plan.page.pixels_per_mm,
                                               .size_px = sample.size_px},
                                              style.bleed);

    // What colour lies under it, and all of it on paper.
    const std::optional<gpu::BufferId> far_tiles = add_far_tiles(making, scene, surface);
    Colors colors = add_colors(making, scene, surface, lit.light, screen, far_tiles);
    colors = add_seen_through(making, scene, visibility, surface, maps, screen, colors);
    haze::HazeLayers faded = add_haze(making, scene, surface, colors.sky_wash, far_tiles,
                                      {.wash = colors.wash, .hatch = ink, .lines = lines});
    faded.lines = add_drift(making, scene, surface, faded.lines);
    faded = add_particles(making, scene, surface, colors.sky_wash, faded);
    // Ink runs out of what was drawn, whatever lens and shutter make of it.
    const auto flowing = add_flowing_ink(making, scene, visibility, surface, lit.light, faded);
    const auto cover = add_cover(making, scene, visibility, surface, faded, colors);
    const lens::LensLayers focused = add_lens(making, surface, faded, colors);
    colors.has_sky_ink = colors.has_sky_ink && !focused.holds_sky;
    faded = {.wash = focused.wash, .hatch = focused.hatch, .lines = focused.lines};
    const motion_blur::MotionBlurLayers exposed =
        add_motion_blur(making, scene, visibility, surface, faded, colors);
    colors.has_sky_ink = colors.has_sky_ink && !exposed.holds_sky;
    faded = {.wash = exposed.wash, .hatch = exposed.hatch, .lines = add_focus_lines(making, exposed.lines)};
    const auto smoke = add_smoke(making, scene, surface, volume, colors.sky_wash, faded.lines);
    const paper::ComposeInputs layers =
        page_layers(making, scene, faded, colors, {.ink = flowing, .smoke = smoke}, cover, lit.light);
    add_picture(making, layers);
    add_deep_picture(
        making, layers, surface, lit,
        {.open = open ? std::optional(open->open) : std::nullopt, .cloud_cover = colors.cloud_cover});
}

} // namespace estampe::frame
