// SPDX-License-Identifier: MIT
#pragma once

// Hatching: draws strokes whose mean ink is a target darkness, as lines, tonal art maps or dots. Also uploads
// tonal art maps, with the ramp (a table) that converts darkness to the value to look up in the map.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <estampe/read_scope.hpp>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "shaders/tone.glsl.h"
#include "style/parameter.hpp"
#include "style/wind.hpp"
#include "techniques/hatch/hatch.glsl.h"

namespace estampe::hatch {

/// How the tones of a tonal art map are combined at one pixel.
enum class MapTone : uint8_t {
    order = shared::map_in_order, ///< more darkness adds stroke after stroke, by the map's thresholds
    /// Two neighbouring tones are blended, then the contrast about middle grey is increased.
    blend = shared::map_in_blends,
    step = shared::map_in_steps ///< each pixel shows only one tone, the nearer of two tones
};

/// A tonal art map for shading, as square images of 8-bit texels, row by row from the top. The finest mip
/// level has `size_px` texels per side, a power of two; the coarsest level has one texel.
struct MapData {
    uint32_t size_px = 0;
    /// For each tone, from light to dark, and each mip level: coverage of each texel; 255 is full ink.
    std::vector<std::vector<std::vector<uint8_t>>> level_of_tone;
    /// For each mip level: the darkness at which each texel turns to ink, times 255.
    std::vector<std::vector<uint8_t>> threshold_of_level;
};

/// Measures a tonal art map and computes the map's ramp (a table, see hatch.glsl.h). With the ramp, the drawn
/// mean ink equals the wanted darkness at every mip level and between mip levels. That holds even if the
/// map's own tones are uneven. Cost: 60 ms for 512 px.
[[nodiscard]] std::vector<float> measured_ramp(const MapData& map, MapTone tone, float contrast);

struct MapImages {
    gpu::Image tones;      ///< image array in format r8, one layer per tone
    gpu::Image thresholds; ///< image in format r8: darkness at which a texel turns to ink
    gpu::Buffer ramp;
    uint32_t size_px = 0;
    uint32_t tone_count = 0;
    uint32_t level_count = 0;
};

/// Uploads `map`, which must have at least one tone. Throws Error if memory runs out.
[[nodiscard]] MapImages upload_map(gpu::Device& device, const MapData& map, MapTone tone, float contrast);

/// The coordinates on a surface along which strokes run.
enum class Coordinates : uint8_t {
    solid = shared::strokes_solid,
    uv = shared::strokes_uv,
    form = shared::strokes_form,
    height = shared::strokes_height,
    wind = shared::strokes_wind,
    light = shared::strokes_light,
    page = shared::strokes_page,
    slope = shared::strokes_slope,
    automatic = shared::strokes_automatic
};

enum class Strokes : uint8_t { lines, map, dots };

struct HatchStyle {
    bool enabled = true;
    Strokes strokes = Strokes::lines;
    float width_mm = 0.27F;
    int layers = 3;
    Coordinates coordinates = Coordinates::automatic;
    float slant_deg = 24.0F;
    wind::Wind wind; ///< wind of the scene, which is not a style key of hatching
    float wobble_mm = 0.18F;
    float gap_mm = 0.6F;
    float taper_mm = 2.6F;
    float length_mm = 15.0F;
    float pressure = 0.28F;
    float growth = 0.0F;
    float overrun_mm = 0.0F;
    float loose_mm = 0.0F;
    float fade = 1.0F; ///< share of darkness kept at infinite distance, from the style's `haze.hatching`
    /// Distance in metres over which hatching fades, from the style's `haze.hatching_distance_m`.
    float fade_distance_m = 60.0F;
    float black_above = 0.96F;
    float form_shade = 1.6F;
    float cast_shade = 1.8F;
    float ground_shade = 0.6F;
    float under_shade = 1.0F;
    float halo_mm = 3.0F;
    int groups = 0;
    float group_strength = 1.0F;
    float group_area_mm2 = 3.0F;
    float group_smooth_mm = 1.0F;
    std::string map;
    ReadScope scope; ///< Limits the files that the style may name; no parameter
    MapTone map_tone = MapTone::order;
    float map_contrast = 12.0F;
    float map_texel_mm = 0.13F;
    float dots_mm = 1.0F;
    float dots_deg = 45.0F;
    int dots_tones = 4;
    int seed = 1;
};

[[nodiscard]] const style::Table<HatchStyle>& hatch_table();

/// Whether a style hatches shade more or less densely by its cause, for which HatchInputs::sun is needed.
[[nodiscard]] bool needs_causes(const HatchStyle& style);

/// The first layer of lines in full shadow. Effects with marks that follow the strokes of the first layer
/// need the values of FirstLayer.
struct FirstLayer {
    float width_mm = 0.3F;
    float darkness = 0.5F; ///< darkness of the lines without the gaps between strokes
    uint32_t seed = 1;
    glm::vec2 flat_axis{0.0F, 1.0F}; ///< axis across the strokes, for strokes in UV space or on the page
    glm::vec2 wind{0.0F, 1.0F};      ///< unit vector of the wind's horizontal direction, as (x, z)
};

[[nodiscard]] FirstLayer first_layer(const HatchStyle& style);

/// Handles of the images of a tonal art map in one frame graph.
struct MapInputs {
    gpu::ImageId tones;
    gpu::ImageId thresholds;
    gpu::BufferId ramp;
    uint32_t size_px = 0;
    uint32_t tone_count = 0;
    uint32_t level_count = 0;
};

/// Imports the images of a tonal art map into `graph`. `map` must live until `graph` has run.
[[nodiscard]] MapInputs import_map(gpu::Graph& graph, MapImages& map);

struct HatchInputs {
    gpu::BufferId frame; ///< buffer with the FrameGlobals of the current frame
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
    gpu::ImageId color;
    gpu::ImageId coordinate;
    gpu::ImageId footprint;
    gpu::ImageId light;
    /// Visible share of the sun, see light::LitPixels; set if a style needs_causes().
    std::optional<gpu::ImageId> sun;
    /// Draw calls of the ground and the terrain; UINT32_MAX where there is none.
    glm::uvec2 ground_draws{UINT32_MAX};
    /// Distances on the page to things, see techniques/halo; set if the strokes of the ground thin out around
    /// things.
    std::optional<gpu::ImageId> halo;
    gpu::ImageId screen; ///< colour and coverage of transparent surfaces; a single texel if there are none
    bool has_screen = false;
    shared::ToneConstants tone;
    uint32_t strokes_present =
        0xff; ///< bit mask of the kinds of stroke that occur in `draw`, see shaders/stroke_kind.glsl.h
    /// Direction towards the strongest local light at each pixel, octahedral in r32ui; 0 if there is none.
    /// Strokes along the light follow the stored directions.
    std::optional<gpu::ImageId> strongest_light;
    glm::vec3 towards_light{0.0F, 1.0F, 0.0F};
    /// Unit vector of the wind on the ground, as (x, z), for strokes along the slope.
    glm::vec2 ground_wind{1.0F, 0.0F};
    std::optional<MapInputs> map; ///< tonal art map; set if the style uses one
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0};
    /// Number of the style variant (the style of certain materials or objects) of each draw call, as r32ui
    /// texels; not set if there is only one variant.
    std::optional<gpu::BufferId> variant_of_draw;
    std::optional<gpu::BufferId> draws; ///< buffer of all draws (mesh primitives); used only for dots
    /// Number of the style variant (the style of certain materials or objects) whose surfaces are hatched.
    uint32_t variant = 0;
    /// Ink of other style variants (styles of certain materials or objects) that were drawn earlier in the
    /// frame.
    std::optional<gpu::ImageId> ink_before;
    /// Whether hatching has the value shared::solid_ink where ink fills the paper, for contour::add_spared().
    bool marks_solid = false;
};

/// Style of hatching for the surfaces of one style variant (the style of certain materials or objects).
struct HatchVariant {
    HatchStyle style;
    shared::ToneConstants tone;
    std::optional<MapInputs> map; ///< tonal art map; set if the variant's style uses a tonal art map
};

/// Returns a copy of `in` for one of several style variants (styles of certain materials or objects), which
/// draws over `ink_before`.
[[nodiscard]] HatchInputs inputs_of_variant(const HatchInputs& in, const std::vector<HatchVariant>& variants,
                                            uint32_t number, std::optional<gpu::ImageId> ink_before);

/// The darkness that the strokes must reach, and a list of the tiles where the darkness is not zero.
struct Darkness {
    gpu::ImageId image;  ///< r16f: darkness from 0 for paper to 1 for ink
    gpu::ImageId blank;  ///< ink of the page before the style variant draws strokes
    gpu::BufferId tiles; ///< list of the tiles that are not blank, see darkness.comp
};

/// Converts light to darkness by the tone curve. Darkness decreases with distance and behind transparent
/// surfaces. If the style groups tones, the darkness is then grouped. Cost: one full-screen dispatch, or six
/// if the darkness is grouped.
[[nodiscard]] Darkness add_darkness(gpu::Graph& graph, const HatchInputs& in, const HatchStyle& style);

/// Draws lines whose mean ink is the wanted darkness. shaders/lines.glsl explains how lines are placed.
///
/// Writes  r16f: coverage, 0 paper to 1 ink
/// Cost    one dispatch without texture reads over the tiles that are not blank; over the whole page if
///         strokes run over silhouettes
[[nodiscard]] gpu::ImageId add_lines(gpu::Graph& graph, const HatchInputs& in, const Darkness& darkness,
                                     const HatchStyle& style);

/// Draws strokes of a tonal art map; requires `in.map`. Near the eye, the map's finest level would be
/// enlarged. Near the eye, the finest mip level is repeated at half the size, so that strokes keep their
/// width at any zoom.
///
/// Writes  r16f: coverage, 0 paper to 1 ink
/// Cost    one full-screen dispatch, five texels per pixel
/// Source  Praun et al., "Real-Time Hatching", SIGGRAPH 2001; thresholds: Webb et al., "Fine Tone Control in
///         Hardware Hatching", NPAR 2002
[[nodiscard]] gpu::ImageId add_map(gpu::Graph& graph, const HatchInputs& in, const Darkness& darkness,
                                   const HatchStyle& style);

/// Largest distance in pixels between a pixel and a neighbour whose strokes extend into the first pixel; 0 if
/// strokes do not run over silhouettes.
[[nodiscard]] uint32_t reach_px(const HatchStyle& style, float pixels_per_mm);

/// Distance in pixels from which the tone of a pixel can depend on its neighbours, if tones are grouped; 0 if
/// they are not. Thin areas that are longer than that and smaller than the least area are not seen whole.
[[nodiscard]] uint32_t group_reach_px(const HatchStyle& style, float pixels_per_mm);

/// Draws dots of a screentone. The mean ink of the dots is the wanted darkness, or the nearest tone. The dots
/// lie on the page and move with the object that they shade.
///
/// Writes  r16f: coverage, 0 paper to 1 ink
/// Cost    one full-screen dispatch
[[nodiscard]] gpu::ImageId add_dots(gpu::Graph& graph, const HatchInputs& in, const Darkness& darkness,
                                    const HatchStyle& style);

/// Draws the strokes of all style variants (styles of certain materials or objects). Ignores `tone`, `map`
/// and `variant` of `in`. Cost per variant: one full-screen dispatch and the variant's strokes.
[[nodiscard]] gpu::ImageId add_hatch(gpu::Graph& graph, const HatchInputs& in,
                                     const std::vector<HatchVariant>& variants);

[[nodiscard]] shared::LineConstants line_constants(const HatchInputs& in, const HatchStyle& style);

/// Variant bits of the shaders that include line_families.glsl, without lines_has_all_tiles.
[[nodiscard]] uint32_t line_variant(const HatchInputs& in, const HatchStyle& style);

/// Finds for each pixel the nearest pixel whose strokes may extend into it. Returns the draw image
/// unchanged if strokes do not run over silhouettes.
[[nodiscard]] gpu::ImageId add_overrun(gpu::Graph& graph, const HatchInputs& in, gpu::ImageId darkness,
                                       const HatchStyle& style);

} // namespace estampe::hatch
