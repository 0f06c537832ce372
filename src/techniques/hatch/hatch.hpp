// SPDX-License-Identifier: MIT
#pragma once

// Strokes whose ink is a darkness that is wanted: lines, tonal art maps and dots; and such maps on the GPU,
// with what darkness to ask them for.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "shaders/tone.glsl.h"
#include "style/parameter.hpp"
#include "techniques/hatch/hatch.glsl.h"

namespace estampe::hatch {

/// How a map's tones come together.
enum class MapTone : uint8_t {
    order = shared::map_in_order,  ///< stroke by stroke, by the thresholds
    blend = shared::map_in_blends, ///< between two tones, with contrast about the middle
    step = shared::map_in_steps    ///< one tone or the next
};

/// A tonal art map as the shading takes it: squares of 8-bit texels, row by row from the top, from the finest
/// level of `size_px` texels a side, a power of two, to the last of one.
struct MapData {
    uint32_t size_px = 0;
    std::vector<std::vector<std::vector<uint8_t>>> level_of_tone; ///< coverage, 255 ink; lightest tone first
    std::vector<std::vector<uint8_t>> threshold_of_level; ///< darkness times 255 at which a texel is inked
};

/// The ramp that hatch.glsl.h describes, for a way to bring tones together and the contrast of the shading:
/// found by measuring the map, so that the mean ink is the darkness wanted, at every level and between any
/// two, whatever the map's own tones are. Cost: 60 ms for 512 px.
[[nodiscard]] std::vector<float> measured_ramp(const MapData& map, MapTone tone, float contrast);

struct MapImages {
    gpu::Image tones;      ///< r8, a layer a tone
    gpu::Image thresholds; ///< r8
    gpu::Buffer ramp;
    uint32_t size_px = 0;
    uint32_t tone_count = 0;
    uint32_t level_count = 0;
};

/// `map` has at least one tone. Throws Error when memory runs out.
[[nodiscard]] MapImages upload_map(gpu::Device& device, const MapData& map, MapTone tone, float contrast);

/// What strokes follow.
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
    float wind_deg = 20.0F;
    float wobble_mm = 0.18F;
    float gap_mm = 0.6F;
    float taper_mm = 2.6F;
    float length_mm = 15.0F;
    float pressure = 0.28F;
    float growth = 0.0F;
    float overrun_mm = 0.0F;
    float fade = 1.0F;
    float fade_distance_m = 60.0F;
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

/// The first layer of lines in full shadow, for what goes along with its strokes.
struct FirstLayer {
    float width_mm = 0.3F;
    float darkness = 0.5F; ///< of the lines where they run
    uint32_t seed = 1;
    glm::vec2 flat_axis{0.0F, 1.0F}; ///< across the strokes, over UVs and on the page
    glm::vec2 wind{0.0F, 1.0F};      ///< horizontal direction x, z
};

[[nodiscard]] FirstLayer first_layer(const HatchStyle& style);

/// A tonal art map as handles of one graph.
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
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
    gpu::ImageId color;
    gpu::ImageId coordinate;
    gpu::ImageId footprint;
    gpu::ImageId light;
    gpu::ImageId screen; ///< colour and cover of what is looked through; one texel for none
    bool has_screen = false;
    shared::ToneConstants tone;
    uint32_t strokes_present =
        0xff; ///< a bit for each kind of stroke in `draw`, see shaders/stroke_kind.glsl.h
    /// Octahedral directions (r32ui) towards the local light that rules a pixel, 0 for none: strokes along
    /// the light follow it.
    std::optional<gpu::ImageId> strongest_light;
    glm::vec3 towards_light{0.0F, 1.0F, 0.0F};
    glm::vec2 ground_wind{1.0F, 0.0F}; ///< horizontal direction x, z, for strokes along the slope
    std::optional<MapInputs> map;      ///< where the style asks for one
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0};
    std::optional<gpu::BufferId> look_of_draw; ///< where surfaces differ: r32ui texels
    std::optional<gpu::BufferId> draws;        ///< needed by dots
    uint32_t look = 0;                         ///< which of them is drawn, then
    std::optional<gpu::ImageId> ink_before;    ///< of looks that are drawn already
};

/// How the surfaces of one look are hatched.
struct LookHatch {
    HatchStyle style;
    shared::ToneConstants tone;
    std::optional<MapInputs> map; ///< where the style asks for one
};

/// `in` for one of several looks, over what was drawn before.
[[nodiscard]] HatchInputs inputs_of_look(const HatchInputs& in, const std::vector<LookHatch>& looks,
                                         uint32_t number, std::optional<gpu::ImageId> ink_before);

/// How dark the strokes have to be, and where there are none to draw.
struct Darkness {
    gpu::ImageId image;  ///< r16f: 0 paper to 1 ink
    gpu::ImageId blank;  ///< ink before any stroke of the look is drawn
    gpu::BufferId tiles; ///< those that are not blank, see darkness.comp
};

/// Darkness from light by the tone curve, paler with distance and behind screens. Cost: one full-screen
/// dispatch.
[[nodiscard]] Darkness add_darkness(gpu::Graph& graph, const HatchInputs& in, const HatchStyle& style);

/// Strokes whose ink, on average, is the darkness wanted: see shaders/lines.glsl for the construction.
///
/// Writes  r16f: coverage, 0 paper to 1 ink
/// Cost    one dispatch over the tiles that are not blank, no texture; over the page where strokes run over
///         silhouettes
[[nodiscard]] gpu::ImageId add_lines(gpu::Graph& graph, const HatchInputs& in, const Darkness& darkness,
                                     const HatchStyle& style);

/// Strokes of a tonal art map, which `in` must have. Nearer than its finest level the map repeats at half the
/// size, so that strokes keep their width at any zoom.
///
/// Writes  r16f: coverage, 0 paper to 1 ink
/// Cost    one full-screen dispatch, five texels a pixel
/// Source  Praun et al., "Real-Time Hatching", SIGGRAPH 2001; thresholds: Webb et al., "Fine Tone Control in
/// Hardware Hatching", NPAR 2002
[[nodiscard]] gpu::ImageId add_map(gpu::Graph& graph, const HatchInputs& in, const Darkness& darkness,
                                   const HatchStyle& style);

/// How far off the strokes lie that run over into a pixel.
[[nodiscard]] uint32_t reach_px(const HatchStyle& style, float pixels_per_mm);

/// Dots of a screentone, whose ink on average is the darkness wanted, or the tone nearest to it. They lie on
/// the page and go along with the place of the object that they shade.
///
/// Writes  r16f: coverage, 0 paper to 1 ink
/// Cost    one full-screen dispatch
[[nodiscard]] gpu::ImageId add_dots(gpu::Graph& graph, const HatchInputs& in, const Darkness& darkness,
                                    const HatchStyle& style);

/// The ink of all strokes; tone, map and look of `in` are left aside. Cost: for each look a full-screen
/// dispatch, and what its strokes cost.
[[nodiscard]] gpu::ImageId add_hatch(gpu::Graph& graph, const HatchInputs& in,
                                     const std::vector<LookHatch>& looks);

[[nodiscard]] shared::LineConstants line_constants(const HatchInputs& in, const HatchStyle& style);

/// Bits of line_families.glsl, without that of the tiles.
[[nodiscard]] uint32_t line_variant(const HatchInputs& in, const HatchStyle& style);

/// For each pixel the nearest one with strokes, as far as they run over; the draw image where they do not.
[[nodiscard]] gpu::ImageId add_overrun(gpu::Graph& graph, const HatchInputs& in, gpu::ImageId darkness,
                                       const HatchStyle& style);

} // namespace estampe::hatch
