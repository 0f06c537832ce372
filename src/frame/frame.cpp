// SPDX-License-Identifier: MIT
#include "frame/frame.hpp"

#include "frame/steps.hpp"

namespace estampe::frame {

void declare_frame(const FrameContext& context)
{
    const FramePlan& plan = context.plan;

    // Steps that find the visible surfaces.
    const PosedScene scene = add_posed_scene(context);
    const gpu::BufferId visibility = add_visibility(context, scene);
    const surface::Surface surface = add_surface(context, scene, visibility);
    add_motion(context, scene, visibility);
    SeenThrough screen = add_transparency(context, scene, visibility);
    screen.bent = add_refraction(context, scene, surface, screen);

    // Steps that light the surfaces.
    const light::ShadowMaps maps = add_shadow_maps(context, scene);
    const std::optional<gpu::ImageId> lightmap = add_lightmap_light(context, scene, visibility);
    const auto occlusion = add_occlusion(context, scene, visibility, surface);
    const std::optional<smoke::Volume> volume = add_smoke_volume(context, scene, maps);
    const light::LitPixels lit =
        add_light(context, scene, visibility, surface,
                  {.maps = maps, .smoke = volume, .lightmap = lightmap, .occlusion = occlusion});

    // Steps that draw ink strokes, as paths or as images.
    const std::optional<gpu::ImageId> halo = add_halo(context, scene, surface);
    const hatch::HatchInputs hatching = hatch_inputs(context, scene, surface, lit, screen, halo);
    const contour::ContourInputs outlining = contour_inputs(context, scene, visibility, surface, lit, screen);
    if (context.job.surface != nullptr) {
        // The graph leaves out the passes above whose results nothing reads, such as light.
        declare_surface_reading(context.graph, surface, *context.job.surface);
        return;
    }
    if (context.job.lists != nullptr) {
        declare_stroke_lists(
            context.graph,
            {hatching, context.features.hatching.variants(context.graph, plan.variants.styles)},
            {outlining, context.features.lines.mesh()}, plan.variants, stroke_haze(context, scene, surface),
            *context.job.lists);
        return;
    }
    if (context.job.linked_out != nullptr) {
        context.features.lines.record_linked(context.graph, context.device, outlining, plan.variants.lines,
                                             *context.job.linked_out);
        return;
    }
    const gpu::ImageId hatched = hatch::add_hatch(
        context.graph, hatching, context.features.hatching.variants(context.graph, plan.variants.styles));
    const gpu::ImageId all_lines = add_bent_lines(context, outlining, screen, add_lines(context, outlining));
    const auto [strokes, lines] = add_spared_lines(context, {hatched, all_lines});
    const gpu::ImageId ink =
        bleed::add_bleed(context.graph,
                         {.hatch = strokes,
                          .lines = lines,
                          .strokes_run = context.style.hatch.strokes != hatch::Strokes::dots,
                          .pixels_per_mm = plan.page.pixels_per_mm,
                          .size_px = context.sample.size_px},
                         context.style.bleed);

    // Steps that compute the colour under the ink, and that compose colour and ink on paper.
    const std::optional<gpu::BufferId> far_tiles = add_far_tiles(context, scene, surface);
    const auto shade = add_shade(context, scene, visibility, surface, lit.sun);
    Colors colors = add_colors(context, scene, surface, {lit.light, shade}, screen, far_tiles, halo);
    colors = add_seen_through(context, scene, visibility, surface, maps, screen, colors);
    haze::HazeLayers faded = add_haze(context, scene, surface, colors.sky_wash, far_tiles,
                                      {.wash = colors.wash, .hatch = ink, .lines = lines});
    faded.lines = add_drift(context, scene, surface, faded.lines);
    faded = add_particles(context, scene, surface, colors.sky_wash, faded);
    faded = add_pigment(context, faded);
    // Flowing ink is emitted from the sharp drawing, so it runs before lens and motion blur.
    const auto flowing = add_flowing_ink(context, scene, visibility, surface, lit.light, faded);
    const auto cover = add_cover(context, scene, visibility, surface, faded, colors);
    const lens::LensLayers focused = add_lens(context, surface, faded, colors);
    colors.has_sky_ink = colors.has_sky_ink && !focused.holds_sky;
    faded = {.wash = focused.wash, .hatch = focused.hatch, .lines = focused.lines};
    const motion_blur::MotionBlurLayers exposed =
        add_motion_blur(context, scene, visibility, surface, faded, colors);
    colors.has_sky_ink = colors.has_sky_ink && !exposed.holds_sky;
    faded = {.wash = exposed.wash, .hatch = exposed.hatch, .lines = add_focus_lines(context, exposed.lines)};
    const auto smoke = add_smoke(context, scene, surface, volume, colors.sky_wash, faded.lines);
    const paper::ComposeInputs layers =
        page_layers(context, scene, faded, colors, {.ink = flowing, .smoke = smoke}, cover, lit.light);
    declare_page(context.graph, layers, context.style.paper, context.sample.accumulation,
                 context.buffers.page, context.job.target);
    if (context.job.linear != nullptr) {
        declare_linear_page(context.graph,
                            {.layers = layers,
                             .draw = surface.draw,
                             .sun = lit.sun,
                             .occlusion = occlusion ? std::optional(occlusion->visibility) : std::nullopt,
                             .cloud_cover = colors.cloud_cover},
                            context.style.paper, context.sample.accumulation, *context.job.linear);
    }
}

} // namespace estampe::frame
