// SPDX-License-Identifier: MIT
#pragma once

// Strokes whose mean ink is a target darkness: lines, tonal art maps and dots. Also tonal art maps on the
// GPU, with the ramp that converts darkness into the value to look up.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "shaders/tone.glsl.h"
#include "style/parameter.hpp"
#include "style/wind.hpp"
#include "techniques/hatch/hatch.glsl.h"

namespace estampe::hatch {

/// How the tones of a tonal art map are combined.
enum class MapTone : uint8_t {
    order = shared::map_in_order,  ///< stroke by stroke, by the thresholds
    blend = shared::map_in_blends, ///< blend of two tones, with contrast about the middle
    step = shared::map_in_steps    ///< one tone or the next
};

/// A tonal art map for shading: square images of 8-bit texels, row by row from the top. The finest level has
/// `size_px` texels per side, a power of two; the coarsest has one.
struct MapData {
    uint32_t size_px = 0;
    std::vector<std::vector<std::vector<uint8_t>>> level_of_tone; ///< coverage, 255 is ink; lightest first
    std::vector<std::vector<uint8_t>> threshold_of_level; ///< darkness times 255 at which a texel is inked
};

/// Computes the ramp that hatch.glsl.h describes by measuring the map. The mean ink then equals the wanted
/// darkness at every level and between levels, whatever the map's own tones are. Cost: 60 ms for 512 px.
[[nodiscard]] std::vector<float> measured_ramp(const MapData& map, MapTone tone, float contrast);

struct MapImages {
    gpu::Image tones;      ///< r8, one layer per tone
    gpu::Image thresholds; ///< r8
    gpu::Buffer ramp;
    uint32_t size_px = 0;
    uint32_t tone_count = 0;
    uint32_t level_count = 0;
};

/// `map` needs at least one tone. Throws Error if memory runs out.
[[nodiscard]] MapImages upload_map(gpu::Device& device, const MapData& map, MapTone tone, float contrast);

/// Coordinate that strokes follow.
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
    wind::Wind wind; ///< the wind of the scene, not a style key of hatching
    float wobble_mm = 0.18F;
    float gap_mm = 0.6F;
    float taper_mm = 2.6F;
    float length_mm = 15.0F;
    float pressure = 0.28F;
    float growth = 0.0F;
    float overrun_mm = 0.0F;
    float fade = 1.0F;             ///< haze.hatching; no key of its own
    float fade_distance_m = 60.0F; ///< haze.hatching_distance_m
    float black_above = 0.96F;
    std::string map;
    MapTone map_tone = MapTone::order;
    float map_contrast = 12.0F;
    float map_texel_mm = 0.13F;
    float dots_mm = 1.0F;
    float dots_deg = 45.0F;
    int dots_tones = 4;
    int seed = 1;
};

[[nodiscard]] const style::Table<HatchStyle>& hatch_table();

/// The first layer of lines in full shadow, for effects that align with its strokes.
struct FirstLayer {
    float width_mm = 0.3F;
    float darkness = 0.5F; ///< darkness of the lines themselves
    uint32_t seed = 1;
    glm::vec2 flat_axis{0.0F, 1.0F}; ///< across the strokes, in UV space and on the page
    glm::vec2 wind{0.0F, 1.0F};      ///< horizontal direction x, z
};

[[nodiscard]] FirstLayer first_layer(const HatchStyle& style);

/// Handles of a tonal art map in one graph.
struct MapInputs {
    gpu::ImageId tones;
    gpu::ImageId thresholds;
    gpu::BufferId ramp;
    uint32_t size_px = 0;
    uint32_t tone_count = 0;
    uint32_t level_count = 0;
};

/// `map` must outlive the run of `graph`.
[[nodiscard]] MapInputs import_map(gpu::Graph& graph, MapImages& map);

struct HatchInputs {
    gpu::BufferId frame; ///< holds FrameGlobals
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
    gpu::ImageId color;
    gpu::ImageId coordinate;
    gpu::ImageId footprint;
    gpu::ImageId light;
    gpu::ImageId screen; ///< colour and coverage of transparent surfaces; one texel if there are none
    bool has_screen = false;
    shared::ToneConstants tone;
    uint32_t strokes_present =
        0xff; ///< one bit for each kind of stroke in `draw`, see shaders/stroke_kind.glsl.h
    /// Octahedral directions (r32ui) towards the strongest local light at each pixel, or 0. Strokes along the
    /// light follow them.
    std::optional<gpu::ImageId> strongest_light;
    glm::vec3 towards_light{0.0F, 1.0F, 0.0F};
    glm::vec2 ground_wind{1.0F, 0.0F}; ///< horizontal direction x, z, for strokes along the slope
    std::optional<MapInputs> map;      ///< set if the style asks for a map
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0};
    std::optional<gpu::BufferId> variant_of_draw; ///< r32ui, per draw call; unset with one style variant
    std::optional<gpu::BufferId> draws;           ///< needed by dots
    uint32_t variant = 0;                         ///< the style variant to draw
    std::optional<gpu::ImageId> ink_before;       ///< ink of style variants drawn before
};

/// Hatching of the surfaces of one style variant.
struct HatchVariant {
    HatchStyle style;
    shared::ToneConstants tone;
    std::optional<MapInputs> map; ///< set if the style asks for a map
};

/// Returns `in` for one of several style variants, drawn over `ink_before`.
[[nodiscard]] HatchInputs inputs_of_variant(const HatchInputs& in, const std::vector<HatchVariant>& variants,
                                            uint32_t number, std::optional<gpu::ImageId> ink_before);

/// Darkness that the strokes must reach, and the tiles where it is not zero.
struct Darkness {
    gpu::ImageId image;  ///< r16f: 0 paper to 1 ink
    gpu::ImageId blank;  ///< ink before any stroke of this style variant is drawn
    gpu::BufferId tiles; ///< tiles that are not blank, see darkness.comp
};

/// Converts light into darkness by the tone curve; lighter with distance and behind transparent surfaces.
/// Cost: one full-screen dispatch.
[[nodiscard]] Darkness add_darkness(gpu::Graph& graph, const HatchInputs& in, const HatchStyle& style);

/// Draws lines whose mean ink is the wanted darkness; shaders/lines.glsl explains the construction.
///
/// Writes  r16f: coverage, 0 paper to 1 ink
/// Cost    one dispatch without texture reads over the tiles that are not blank; over the page if
///         strokes run over silhouettes
[[nodiscard]] gpu::ImageId add_lines(gpu::Graph& graph, const HatchInputs& in, const Darkness& darkness,
                                     const HatchStyle& style);

/// Draws strokes of a tonal art map; requires `in.map`. Nearer than its finest level the map repeats at half
/// the size, so that strokes keep their width at any zoom.
///
/// Writes  r16f: coverage, 0 paper to 1 ink
/// Cost    one full-screen dispatch, five texels per pixel
/// Source  Praun et al., "Real-Time Hatching", SIGGRAPH 2001; thresholds: Webb et al., "Fine Tone Control in
///         Hardware Hatching", NPAR 2002
[[nodiscard]] gpu::ImageId add_map(gpu::Graph& graph, const HatchInputs& in, const Darkness& darkness,
                                   const HatchStyle& style);

/// Largest distance from a pixel to strokes that run over into the pixel; 0 if no strokes do.
[[nodiscard]] uint32_t reach_px(const HatchStyle& style, float pixels_per_mm);

/// Draws dots of a screentone whose mean ink is the wanted darkness, or the nearest tone. Dots lie on the
/// page and move with the object that they shade.
///
/// Writes  r16f: coverage, 0 paper to 1 ink
/// Cost    one full-screen dispatch
[[nodiscard]] gpu::ImageId add_dots(gpu::Graph& graph, const HatchInputs& in, const Darkness& darkness,
                                    const HatchStyle& style);

/// Draws the strokes of all style variants. Ignores `tone`, `map` and `variant` of `in`. Cost: per variant
/// one full-screen dispatch and its strokes.
[[nodiscard]] gpu::ImageId add_hatch(gpu::Graph& graph, const HatchInputs& in,
                                     const std::vector<HatchVariant>& variants);

[[nodiscard]] shared::LineConstants line_constants(const HatchInputs& in, const HatchStyle& style);

/// Variant bits for line_families.glsl, without lines_has_all_tiles.
[[nodiscard]] uint32_t line_variant(const HatchInputs& in, const HatchStyle& style);

/// For each pixel the nearest pixel whose strokes may run over into it. Returns the draw image if the style
/// has no overrun.
[[nodiscard]] gpu::ImageId add_overrun(gpu::Graph& graph, const HatchInputs& in, gpu::ImageId darkness,
                                       const HatchStyle& style);

} // namespace estampe::hatch
