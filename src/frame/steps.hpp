// SPDX-License-Identifier: MIT
#pragma once

// The steps of a frame: what each technique takes from the ones before it, and what it hands on. A step
// declares passes and draws nothing yet. Handles go in and come out by name; what was known before the frame
// was begun lies in FrameContext.

#include <optional>

#include "core/inline_vector.hpp"
#include "frame/frame.hpp"
#include "techniques/contour/contour.hpp"
#include "techniques/lens/lens.hpp"
#include "techniques/motion_blur/motion_blur.hpp"
#include "techniques/occlusion/occlusion.hpp"
#include "techniques/raster/raster.hpp"
#include "techniques/subsurface/subsurface.hpp"
#include "techniques/surface/surface.hpp"
#include "techniques/transparency/transparency.hpp"

namespace estampe::frame {

/// The camera, and the scene as it stands at this moment.
struct PosedScene {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::BufferId stroke_coordinates;
    gpu::BufferId vertices_before;               ///< posed as they were in the frame before
    std::optional<gpu::BufferId> terrain_texels; ///< what a terrain's graph looks up
    raster::RasterInputs meshes;
    std::optional<gpu::BufferId> cluster_bounds; ///< of their triangles, where anything looks at them
};

/// What is looked through, and whether there is any.
struct SeenThrough {
    transparency::Transparency images; ///< one texel each where there is none
    std::vector<gpu::BufferId> layers; ///< visibility, the nearest first
    bool is_there = false;
    std::optional<gpu::BufferId> background = {};  ///< visibility of what is solid but thick clear bodies
    std::optional<gpu::BufferId> line_hiders = {}; ///< the same but for those that show lines behind them
};

/// What lies under the ink.
struct Colors {
    gpu::ImageId wash;
    gpu::ImageId sky_ink;
    gpu::ImageId sky_wash;
    bool has_sky_ink = false;                     ///< else that ink is among the strokes, or there is none
    std::optional<gpu::ImageId> cloud_cover = {}; ///< of pictures in layers that have clouds
};

/// What goes on from picture to picture, where there is any.
struct MovingLayers {
    std::optional<gpu::ImageId> ink; ///< that flows
    std::optional<smoke::Layer> smoke;
};

/// Whatever moves writes vertices. In a scene that stands as it stood they are there already.
[[nodiscard]] PosedScene add_posed_scene(const FrameContext& context);

/// What hides what is behind it.
[[nodiscard]] InlineVector<raster::Batch, 3> solid_batches(const pose::MeshData& layout, bool with_ground);

/// All that the camera sees.
[[nodiscard]] raster::View eye_view(const FrameContext& context);

/// Rasterisation only writes identities: depth and triangle, 64 bits a pixel.
[[nodiscard]] gpu::BufferId add_visibility(const FrameContext& context, const PosedScene& scene,
                                           const char* name = "visibility");

/// What is seen at each pixel.
[[nodiscard]] surface::Surface add_surface(const FrameContext& context, const PosedScene& scene,
                                           gpu::BufferId visibility);

/// Where the scene's vertices were when it `moved` from there.
[[nodiscard]] gpu::BufferId vertices_before(const FrameContext& context, const PosedScene& scene,
                                            const features::MotionPlan& moved);

[[nodiscard]] motion::MotionInputs motion_inputs(const FrameContext& context, const PosedScene& scene,
                                                 gpu::BufferId visibility, const features::MotionPlan& moved);

/// Where that stood at another moment, for the processor, in the first sample of a picture that asks for it.
void add_motion(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility);

/// What see-through surfaces are made out from.
[[nodiscard]] transparency::TransparencyInputs transparency_inputs(const FrameContext& context,
                                                                   const PosedScene& scene,
                                                                   gpu::BufferId visibility,
                                                                   const std::vector<gpu::BufferId>& layers);

/// What see-through surfaces show, and what lies behind thick clear bodies.
[[nodiscard]] SeenThrough add_transparency(const FrameContext& context, const PosedScene& scene,
                                           gpu::BufferId visibility);

/// How far sun, lamps and spots see. Maps are kept, and drawn only where they are out of date.
[[nodiscard]] light::ShadowMaps add_shadow_maps(const FrameContext& context, const PosedScene& scene);

/// Light that is known ahead; none in a scene without lightmaps.
[[nodiscard]] std::optional<gpu::ImageId>
add_lightmap_light(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility);

/// How much of the light from everywhere arrives there, where the style wants it.
[[nodiscard]] std::optional<occlusion::AmbientOcclusion> add_occlusion(const FrameContext& context,
                                                                       const PosedScene& scene,
                                                                       gpu::BufferId visibility,
                                                                       const surface::Surface& surface);

/// Smoke, shaped and lit in the first sample, where there is any.
[[nodiscard]] std::optional<smoke::Volume>
add_smoke_volume(const FrameContext& context, const PosedScene& scene, const light::ShadowMaps& maps);

/// What keeps light from what is seen, or is known of it.
struct LightBefore {
    light::ShadowMaps maps;
    std::optional<smoke::Volume> smoke;
    std::optional<gpu::ImageId> lightmap;                 ///< by add_lightmap_light()
    std::optional<occlusion::AmbientOcclusion> occlusion; ///< by add_occlusion()
};

/// The light that arrives there and goes into things, exposed for the page where the style meters that.
[[nodiscard]] light::LitPixels add_light(const FrameContext& context, const PosedScene& scene,
                                         gpu::BufferId visibility, const surface::Surface& surface,
                                         const LightBefore& before);

/// What light needs wherever it falls in the scene, set up for what is seen.
[[nodiscard]] light::LightInputs light_inputs(const FrameContext& context, const PosedScene& scene,
                                              const surface::Surface& surface, const light::ShadowMaps& maps);

/// What is known of things that light goes into.
[[nodiscard]] subsurface::SubsurfaceInputs
subsurface_inputs(const FrameContext& context, const PosedScene& scene, const surface::Surface& surface);

/// The number of each draw's look, where surfaces differ.
[[nodiscard]] std::optional<gpu::BufferId> look_of_draw(const FrameContext& context);

/// What strokes are drawn from.
[[nodiscard]] hatch::HatchInputs hatch_inputs(const FrameContext& context, const PosedScene& scene,
                                              const surface::Surface& surface, const light::LitPixels& lit,
                                              const SeenThrough& screen);

/// What lines are found in.
[[nodiscard]] contour::ContourInputs contour_inputs(const FrameContext& context, const PosedScene& scene,
                                                    gpu::BufferId visibility, const surface::Surface& surface,
                                                    const light::LitPixels& lit, const SeenThrough& screen);

/// Lines where surfaces end, meet or fold: linked to chains, or found between pixels, which is also how what
/// a texture cuts gets its own.
[[nodiscard]] gpu::ImageId add_lines(const FrameContext& context, const contour::ContourInputs& in);

/// Sand in the air over the lines of the scene.
[[nodiscard]] gpu::ImageId add_drift(const FrameContext& context, const PosedScene& scene,
                                     const surface::Surface& surface, gpu::ImageId lines);

/// Particles over colour and ink.
[[nodiscard]] haze::HazeLayers add_particles(const FrameContext& context, const PosedScene& scene,
                                             const surface::Surface& surface, gpu::ImageId sky_wash,
                                             const haze::HazeLayers& layers);

/// What the lens makes of the layers, where there is one.
[[nodiscard]] lens::LensLayers add_lens(const FrameContext& context, const surface::Surface& surface,
                                        const haze::HazeLayers& layers, const Colors& colors);

/// What moves while the shutter is open, where any is wanted.
[[nodiscard]] motion_blur::MotionBlurLayers
add_motion_blur(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility,
                const surface::Surface& surface, const haze::HazeLayers& layers, const Colors& colors);

/// How much of each pixel things cover as lens and shutter see them, for a transparent background; nothing
/// where neither blurs anything, as the wash's alpha says it then. `layers` and `colors` are those that lens
/// and shutter are given; must be declared before these are drawn in place.
[[nodiscard]] std::optional<gpu::ImageId> add_cover(const FrameContext& context, const PosedScene& scene,
                                                    gpu::BufferId visibility, const surface::Surface& surface,
                                                    const haze::HazeLayers& layers, const Colors& colors);

/// Focus lines over those of the scene.
[[nodiscard]] gpu::ImageId add_focus_lines(const FrameContext& context, gpu::ImageId lines);

/// The tiles where sky shows, or haze lets it through; nothing where nobody asks, and on a GPU, which leaves
/// out the rest for less than the list takes.
[[nodiscard]] std::optional<gpu::BufferId> add_far_tiles(const FrameContext& context, const PosedScene& scene,
                                                         const surface::Surface& surface);

/// Colour, flat, and the sky behind it.
[[nodiscard]] Colors add_colors(const FrameContext& context, const PosedScene& scene,
                                const surface::Surface& surface, gpu::ImageId light,
                                const SeenThrough& screen, const std::optional<gpu::BufferId>& far_tiles);

/// Paints a surface of this light in its looks' colours, with `background` where there is none.
[[nodiscard]] gpu::ImageId add_paint(const FrameContext& context, const PosedScene& scene,
                                     const surface::Surface& surface, gpu::ImageId light,
                                     const std::optional<gpu::ImageId>& background,
                                     const SeenThrough* screen = nullptr);

/// `colors` with what is seen through thick bodies, and with see-through surfaces painted one by one over
/// what lies behind them, where the style wants either.
[[nodiscard]] Colors add_seen_through(const FrameContext& context, const PosedScene& scene,
                                      gpu::BufferId visibility, const surface::Surface& surface,
                                      const light::ShadowMaps& maps, const SeenThrough& screen,
                                      Colors colors);

/// What haze is worked out from.
[[nodiscard]] haze::HazeInputs haze_inputs(const FrameContext& context, const PosedScene& scene,
                                           const surface::Surface& surface);

/// Haze as strokes that are paths meet it; nothing where there is no haze.
[[nodiscard]] std::optional<StrokeHaze> stroke_haze(const FrameContext& context, const PosedScene& scene,
                                                    const surface::Surface& surface);

/// Colour and ink with what distance leaves of them.
[[nodiscard]] haze::HazeLayers add_haze(const FrameContext& context, const PosedScene& scene,
                                        const surface::Surface& surface, gpu::ImageId sky_wash,
                                        const std::optional<gpu::BufferId>& far_tiles,
                                        const haze::HazeLayers& layers);

/// Ink that flows out of these layers, where there is any.
[[nodiscard]] std::optional<gpu::ImageId> add_flowing_ink(const FrameContext& context,
                                                          const PosedScene& scene, gpu::BufferId visibility,
                                                          const surface::Surface& surface, gpu::ImageId light,
                                                          const haze::HazeLayers& layers);

/// Smoke before the scene, where there is any.
[[nodiscard]] std::optional<smoke::Layer> add_smoke(const FrameContext& context, const PosedScene& scene,
                                                    const surface::Surface& surface,
                                                    const std::optional<smoke::Volume>& volume,
                                                    gpu::ImageId sky_wash, gpu::ImageId lines);

/// What is laid on the paper.
[[nodiscard]] paper::ComposeInputs page_layers(const FrameContext& context, const PosedScene& scene,
                                               const haze::HazeLayers& layers, const Colors& colors,
                                               const MovingLayers& moving,
                                               const std::optional<gpu::ImageId>& cover, gpu::ImageId light);

} // namespace estampe::frame
