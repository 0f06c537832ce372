// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "shaders/tone.glsl.h"
#include "style/parameter.hpp"
#include "techniques/hatch/map_data.hpp"

namespace estampe::hatch {

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
    bool drawn = true;
    Strokes strokes = Strokes::lines;
    float width_mm = 0.27F;
    int layers = 3;
    Coordinates coordinates = Coordinates::automatic;
    float slant_deg = 24.0F;
    float wind_deg = 20.0F;
    std::string materials;
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

inline const style::Table<HatchStyle>& hatch_table()
{
    static const auto table =
        style::Table<HatchStyle>("hatch", "Pen strokes that carry the tone")
            .toggle("drawn", &HatchStyle::drawn, "Whether there are strokes at all")
            .choice("strokes", &HatchStyle::strokes,
                    {{"lines", Strokes::lines}, {"map", Strokes::map}, {"dots", Strokes::dots}},
                    "Lines of exact tone, the strokes of a tonal art map, or the dots of a screentone")
            .number("width_mm", &HatchStyle::width_mm, {0.02F, 10.0F}, "mm", "Width of a stroke on the page")
            .integer("layers", &HatchStyle::layers, {1, 3}, "",
                     "Layers of strokes that cross as tones deepen")
            .choice(
                "coordinates", &HatchStyle::coordinates,
                {{"auto", Coordinates::automatic},
                 {"uv", Coordinates::uv},
                 {"solid", Coordinates::solid},
                 {"form", Coordinates::form},
                 {"height", Coordinates::height},
                 {"wind", Coordinates::wind},
                 {"light", Coordinates::light},
                 {"page", Coordinates::page},
                 {"slope", Coordinates::slope}},
                "What strokes follow: UVs, slices through the solid, the form's curvature, level lines, the "
                "wind, the light, the page, the ground's slopes and ripples, or (auto) the latter on the "
                "ground, UVs where they run unbroken, and else the solid")
            .number("slant_deg", &HatchStyle::slant_deg, {-180.0F, 180.0F}, "deg",
                    "Turn of the first layer over UVs and on the page")
            .number("wind_deg", &HatchStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Where the wind blows to, from +z towards +x")
            .text("materials", &HatchStyle::materials,
                  "What the strokes of single materials follow, as in \"Skin=form, Sea=wind\"")
            .number("wobble_mm", &HatchStyle::wobble_mm, {0.0F, 5.0F}, "mm",
                    "How far a stroke strays sideways")
            .number("gap_mm", &HatchStyle::gap_mm, {0.0F, 20.0F}, "mm",
                    "White between the end of a stroke and the next")
            .number("taper_mm", &HatchStyle::taper_mm, {0.0F, 50.0F}, "mm",
                    "Length over which a stroke thins to its end")
            .number("length_mm", &HatchStyle::length_mm, {1.0F, 500.0F}, "mm",
                    "Length of the shortest strokes")
            .number("pressure", &HatchStyle::pressure, {0.0F, 1.0F}, "",
                    "How much the width varies along a stroke")
            .number("growth", &HatchStyle::growth, {0.0F, 1.0F}, "",
                    "How a stroke begins as tone deepens: 0 as a hairline, 1 short and of full width")
            .number("overrun_mm", &HatchStyle::overrun_mm, {0.0F, 5.0F}, "mm",
                    "How far strokes run over silhouettes onto the paper")
            .number("fade", &HatchStyle::fade, {0.0F, 1.0F}, "",
                    "Share of the darkness left in the far distance")
            .number("fade_distance_m", &HatchStyle::fade_distance_m, {0.001F, 1e6F}, "m",
                    "Distance by which half of the fading has happened")
            .number("black_above", &HatchStyle::black_above, {0.1F, 2.0F}, "",
                    "Darkness from which the paper is covered whole; above 1 never")
            .file("map", &HatchStyle::map,
                  "A .tam file, or a folder of PNG or DDS files; without one the map is drawn as [tam] says")
            .choice("map_tone", &HatchStyle::map_tone,
                    {{"order", MapTone::order}, {"blend", MapTone::blend}, {"step", MapTone::step}},
                    "How tones of a map come together: stroke by stroke, blended, or in hard steps")
            .number("map_contrast", &HatchStyle::map_contrast, {1.0F, 100.0F}, "",
                    "Contrast of a map about its middle; 1 leaves its greys")
            .number("map_texel_mm", &HatchStyle::map_texel_mm, {0.01F, 5.0F}, "mm",
                    "Size of a texel of the map on the page")
            .number("dots_mm", &HatchStyle::dots_mm, {0.1F, 20.0F}, "mm", "From dot to dot of a screentone")
            .number("dots_deg", &HatchStyle::dots_deg, {-90.0F, 90.0F}, "deg",
                    "Turn of a screentone on the page")
            .integer("dots_tones", &HatchStyle::dots_tones, {0, 32}, "",
                     "Tones of which screentones are cut, black among them; 0 for as many as there are")
            .integer("seed", &HatchStyle::seed, {0, 1000000}, "", "Another number, another hand")
            .by_surface_but({"materials"});
    return table;
}

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
    gpu::BufferId tiles; ///< those that are not blank, see dark_tiles.glsl
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

} // namespace estampe::hatch
