// SPDX-License-Identifier: MIT
#pragma once

// The steps of a frame. Each step passes inputs to a technique and returns the technique's outputs. A step
// declares passes; the passes run later. Resource handles are arguments and results of steps. FrameContext
// holds everything that is known before the frame begins.

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

/// The scene posed at the time of the frame, and the camera's FrameGlobals.
struct PosedScene {
    gpu::BufferId frame; ///< handle of the FrameGlobals buffer
    gpu::BufferId stroke_coordinates;
    gpu::BufferId vertices_before;               ///< vertices as posed in the previous frame
    std::optional<gpu::BufferId> terrain_texels; ///< textures that a terrain's height graph reads
    raster::RasterInputs meshes;
    /// Bounding boxes of clusters of triangles; only set if a pass reads them.
    std::optional<gpu::BufferId> cluster_bounds;
    /// Bits of the clusters in rooms that the eye sees; only set if the plan culls by cells. Valid for the
    /// page and for vertices at their places.
    std::optional<gpu::BufferId> seen_clusters;
};

/// Transparent surfaces of the frame, and clear bodies such as glass.
struct SeenThrough {
    /// Images of the transparent surfaces; one texel each if there are none.
    transparency::Transparency images;
    std::vector<gpu::BufferId> layers; ///< visibility buffers of the transparent surfaces, the nearest first
    bool is_there = false;
    /// Visibility buffer of solid surfaces without clear bodies (such as glass).
    std::optional<gpu::BufferId> background = {};
    /// Visibility buffer of the solid surfaces that hide lines.
    std::optional<gpu::BufferId> line_hiders = {};
    /// Visibility buffers of the clear bodies alone, the nearest surface first; empty without clear bodies.
    std::vector<gpu::BufferId> inside = {};
    /// Places of the background that are seen through clear bodies, if these bend what is seen.
    std::optional<gpu::ImageId> bent = {};
};

/// The colour layers of a frame, over which ink is drawn.
struct Colors {
    gpu::ImageId wash;
    gpu::ImageId sky_ink;
    gpu::ImageId sky_wash;
    bool has_sky_ink = false; ///< the sky contains ink that is drawn by the sky, not as strokes
    /// Image of the clouds' coverage; set if there are layers and clouds.
    std::optional<gpu::ImageId> cloud_cover = {};
};

/// Layers whose content is simulated from picture to picture.
struct MovingLayers {
    std::optional<gpu::ImageId> ink; ///< image of the flowing ink
    std::optional<smoke::Layer> smoke;
};

/// Adds the passes that pose moving vertices. In a scene without motion the vertices are already on the
/// device.
[[nodiscard]] PosedScene add_posed_scene(const FrameContext& context);

/// Returns the runs of triangles that hide what lies behind them, with the parts of transparent surfaces that
/// `style` draws as solid.
[[nodiscard]] InlineVector<raster::Batch, 4> solid_batches(const pose::MeshData& layout, bool with_ground,
                                                           const transparency::TransparencyStyle& style = {});

/// Returns the camera's view, for rasterisation.
[[nodiscard]] raster::View eye_view(const FrameContext& context);

/// Rasterises the visibility buffer: depth and triangle number, 64 bits per pixel.
[[nodiscard]] gpu::BufferId add_visibility(const FrameContext& context, const PosedScene& scene,
                                           const char* name = "visibility");

/// Computes the surface that is visible at each pixel.
[[nodiscard]] surface::Surface add_surface(const FrameContext& context, const PosedScene& scene,
                                           gpu::BufferId visibility);

/// Returns the vertices of the scene before the motion `moved`.
[[nodiscard]] gpu::BufferId vertices_before(const FrameContext& context, const PosedScene& scene,
                                            const features::MotionPlan& moved);

[[nodiscard]] motion::MotionInputs motion_inputs(const FrameContext& context, const PosedScene& scene,
                                                 gpu::BufferId visibility, const features::MotionPlan& moved);

/// Writes the motion of each pixel for reading back, in the first sample of a picture that asks for it.
void add_motion(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility);

/// Returns the inputs of the transparency technique.
[[nodiscard]] transparency::TransparencyInputs transparency_inputs(const FrameContext& context,
                                                                   const PosedScene& scene,
                                                                   gpu::BufferId visibility,
                                                                   const std::vector<gpu::BufferId>& layers);

/// Draws transparent surfaces, and the surfaces behind clear bodies such as glass.
[[nodiscard]] SeenThrough add_transparency(const FrameContext& context, const PosedScene& scene,
                                           gpu::BufferId visibility);

/// Whether clear bodies bend what is seen through them. Paths of strokes pass straight behind clear bodies.
[[nodiscard]] inline bool bends_light(const FrameContext& context)
{
    return context.plan.subsurface && context.plan.subsurface->refracts && context.job.lists == nullptr;
}

/// Finds which places of the background are seen through clear bodies that bend light. Returns none if the
/// style has no refraction, or if the picture consists of paths.
[[nodiscard]] std::optional<gpu::ImageId> add_refraction(const FrameContext& context, const PosedScene& scene,
                                                         const surface::Surface& surface,
                                                         const SeenThrough& screen);

/// Adds the shadow maps of sun, lamps and spotlights. Maps are kept between frames, and drawn only if they
/// are out of date.
[[nodiscard]] light::ShadowMaps add_shadow_maps(const FrameContext& context, const PosedScene& scene);

/// Adds the pass that reads the light of the scene's lightmap at each pixel; returns none in a scene without
/// lightmaps.
[[nodiscard]] std::optional<gpu::ImageId>
add_lightmap_light(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility);

/// Computes the ambient occlusion at each pixel, if the style asks for it.
[[nodiscard]] std::optional<occlusion::AmbientOcclusion> add_occlusion(const FrameContext& context,
                                                                       const PosedScene& scene,
                                                                       gpu::BufferId visibility,
                                                                       const surface::Surface& surface);

/// Adds the smoke of the scene, if any; smoke is shaped and lit only in the first sample of a picture.
[[nodiscard]] std::optional<smoke::Volume>
add_smoke_volume(const FrameContext& context, const PosedScene& scene, const light::ShadowMaps& maps);

/// Results of earlier steps that are needed to compute the light of the frame.
struct LightBefore {
    light::ShadowMaps maps;
    std::optional<smoke::Volume> smoke;
    std::optional<gpu::ImageId> lightmap; ///< light of the lightmap, from add_lightmap_light()
    std::optional<occlusion::AmbientOcclusion> occlusion; ///< ambient occlusion, from add_occlusion()
};

/// Computes direct and subsurface light at each pixel, and applies the exposure if the style measures it on
/// the page.
[[nodiscard]] light::LitPixels add_light(const FrameContext& context, const PosedScene& scene,
                                         gpu::BufferId visibility, const surface::Surface& surface,
                                         const LightBefore& before);

/// Returns the inputs of the light technique that do not depend on the lit surface, completed for the visible
/// surface.
[[nodiscard]] light::LightInputs light_inputs(const FrameContext& context, const PosedScene& scene,
                                              const surface::Surface& surface, const light::ShadowMaps& maps);

/// Returns the inputs of subsurface scattering.
[[nodiscard]] subsurface::SubsurfaceInputs
subsurface_inputs(const FrameContext& context, const PosedScene& scene, const surface::Surface& surface);

/// Returns the buffer with the style variant of each draw call; none if there is a single variant.
[[nodiscard]] std::optional<gpu::BufferId> variant_of_draw(const FrameContext& context);

/// Measures distances on the page to things, around which strokes of ground and sky thin out; none if no
/// strokes do.
[[nodiscard]] std::optional<gpu::ImageId> add_halo(const FrameContext& context, const PosedScene& scene,
                                                   const surface::Surface& surface);

/// Returns the inputs of hatching. `halo` is the result of add_halo().
[[nodiscard]] hatch::HatchInputs hatch_inputs(const FrameContext& context, const PosedScene& scene,
                                              const surface::Surface& surface, const light::LitPixels& lit,
                                              const SeenThrough& screen,
                                              const std::optional<gpu::ImageId>& halo);

/// Returns the inputs of line detection.
[[nodiscard]] contour::ContourInputs contour_inputs(const FrameContext& context, const PosedScene& scene,
                                                    gpu::BufferId visibility, const surface::Surface& surface,
                                                    const light::LitPixels& lit, const SeenThrough& screen);

/// Draws lines where surfaces end, meet or fold. Lines are either chains of linked mesh edges, or they are
/// found between pixels. Edges that come from a cut-out texture are always found between pixels.
[[nodiscard]] gpu::ImageId add_lines(const FrameContext& context, const contour::ContourInputs& in);

/// Leaves lines white in solid black, if the style does so.
[[nodiscard]] contour::InkImages add_spared_lines(const FrameContext& context, const contour::InkImages& ink);

/// Adds to `lines` the chains behind clear bodies that bend light. These chains are drawn without the clear
/// bodies, and read at the places that are seen through the bodies.
[[nodiscard]] gpu::ImageId add_bent_lines(const FrameContext& context, const contour::ContourInputs& in,
                                          const SeenThrough& screen, gpu::ImageId lines);

/// Draws wind-blown sand over the ink lines of the scene.
[[nodiscard]] gpu::ImageId add_drift(const FrameContext& context, const PosedScene& scene,
                                     const surface::Surface& surface, gpu::ImageId lines);

/// Moves pigment over the paper, if the style asks for it: soft edges and rubbed ink of dry strokes, paint
/// that strays and pools.
[[nodiscard]] haze::HazeLayers add_pigment(const FrameContext& context, const haze::HazeLayers& layers);

/// Draws particles over colour and ink.
[[nodiscard]] haze::HazeLayers add_particles(const FrameContext& context, const PosedScene& scene,
                                             const surface::Surface& surface, gpu::ImageId sky_wash,
                                             const haze::HazeLayers& layers);

/// Applies the blur of the lens to the layers, if the picture's plan has a lens.
[[nodiscard]] lens::LensLayers add_lens(const FrameContext& context, const surface::Surface& surface,
                                        const haze::HazeLayers& layers, const Colors& colors);

/// Applies motion blur to the layers, if the picture's plan has motion blur.
[[nodiscard]] motion_blur::MotionBlurLayers
add_motion_blur(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility,
                const surface::Surface& surface, const haze::HazeLayers& layers, const Colors& colors);

/// Computes the coverage of each pixel after lens and motion blur, for a transparent background. Returns none
/// if neither lens nor motion blur is used; the alpha of the wash layer is then the coverage. `layers` and
/// `colors` are the inputs of lens and motion blur; call this before they are modified in place.
[[nodiscard]] std::optional<gpu::ImageId> add_cover(const FrameContext& context, const PosedScene& scene,
                                                    gpu::BufferId visibility, const surface::Surface& surface,
                                                    const haze::HazeLayers& layers, const Colors& colors);

/// Draws focus lines over the ink lines of the scene.
[[nodiscard]] gpu::ImageId add_focus_lines(const FrameContext& context, gpu::ImageId lines);

/// Lists the blocks of pixels where the sky is visible, directly or through haze. Returns none if no pass
/// needs the list. Also returns none on a GPU, where testing each pixel takes less time than making the list.
[[nodiscard]] std::optional<gpu::BufferId> add_far_tiles(const FrameContext& context, const PosedScene& scene,
                                                         const surface::Surface& surface);

/// Light on visible surfaces, and the colours of the surfaces in the shade.
struct LightAndShade {
    gpu::ImageId light;
    std::optional<gpu::ImageId> shade; ///< from add_shade()
};

/// Computes the colours that surfaces have in the shade, from second textures; none if no surface has a
/// second texture. `sun` is LitPixels::sun of the surfaces.
[[nodiscard]] std::optional<gpu::ImageId> add_shade(const FrameContext& context, const PosedScene& scene,
                                                    gpu::BufferId visibility, const surface::Surface& surface,
                                                    gpu::ImageId sun);

/// Paints the flat colours of surfaces, and the sky behind the surfaces.
[[nodiscard]] Colors add_colors(const FrameContext& context, const PosedScene& scene,
                                const surface::Surface& surface, const LightAndShade& lit,
                                const SeenThrough& screen, const std::optional<gpu::BufferId>& far_tiles,
                                const std::optional<gpu::ImageId>& halo);

/// Paints a lit surface in its style variants' colours, and `background` at pixels without a surface.
[[nodiscard]] gpu::ImageId add_paint(const FrameContext& context, const PosedScene& scene,
                                     const surface::Surface& surface, const LightAndShade& lit,
                                     const std::optional<gpu::ImageId>& background,
                                     const SeenThrough* screen = nullptr);

/// Adds to `colors` what is visible through clear bodies (such as glass), and paints transparent surfaces one
/// after another over the colours behind them. Does so only if the style asks for it.
[[nodiscard]] Colors add_seen_through(const FrameContext& context, const PosedScene& scene,
                                      gpu::BufferId visibility, const surface::Surface& surface,
                                      const light::ShadowMaps& maps, const SeenThrough& screen,
                                      Colors colors);

/// Returns the inputs of haze.
[[nodiscard]] haze::HazeInputs haze_inputs(const FrameContext& context, const PosedScene& scene,
                                           const surface::Surface& surface);

/// Returns the haze for strokes that are output as paths; none without haze.
[[nodiscard]] std::optional<StrokeHaze> stroke_haze(const FrameContext& context, const PosedScene& scene,
                                                    const surface::Surface& surface);

/// Applies haze to colour and ink.
[[nodiscard]] haze::HazeLayers add_haze(const FrameContext& context, const PosedScene& scene,
                                        const surface::Surface& surface, gpu::ImageId sky_wash,
                                        const std::optional<gpu::BufferId>& far_tiles,
                                        const haze::HazeLayers& layers);

/// Lets ink flow out of the drawn layers, if the style asks for it.
[[nodiscard]] std::optional<gpu::ImageId> add_flowing_ink(const FrameContext& context,
                                                          const PosedScene& scene, gpu::BufferId visibility,
                                                          const surface::Surface& surface, gpu::ImageId light,
                                                          const haze::HazeLayers& layers);

/// Draws smoke in front of the scene, if there is any.
[[nodiscard]] std::optional<smoke::Layer> add_smoke(const FrameContext& context, const PosedScene& scene,
                                                    const surface::Surface& surface,
                                                    const std::optional<smoke::Volume>& volume,
                                                    gpu::ImageId sky_wash, gpu::ImageId lines);

/// Returns the layers that are composed on the paper.
[[nodiscard]] paper::ComposeInputs page_layers(const FrameContext& context, const PosedScene& scene,
                                               const haze::HazeLayers& layers, const Colors& colors,
                                               const MovingLayers& moving,
                                               const std::optional<gpu::ImageId>& cover, gpu::ImageId light);

} // namespace estampe::frame
