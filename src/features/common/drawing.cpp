// SPDX-License-Identifier: MIT
#include "features/common/drawing.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "features/common/style_tables.hpp"

namespace estampe::features {

const style::Table<DrawingStyle>& drawing_table()
{
    static const auto table =
        style::Table<DrawingStyle>("drawing",
                                   "The drawing as a whole: factors that multiply the values of the preset")
            .number(
                "line_weight", &DrawingStyle::line_weight, {0.1F, 10.0F}, "",
                "Width of all ink lines, as a factor: 2 draws lines twice as wide as the preset, 0.5 half "
                "as wide")
            .number("hatch_spacing", &DrawingStyle::hatch_spacing, {0.1F, 10.0F}, "",
                    "Distance between hatching strokes or dots, as a factor: 2 is coarse, 0.5 is fine. The "
                    "strokes widen with the distance, so tones keep their darkness.")
            .number("hatch_weight", &DrawingStyle::hatch_weight, {0.1F, 10.0F}, "",
                    "Width of hatching strokes, as a factor: more draws heavier, darker hatching. The "
                    "distance between strokes does not change.")
            .number("darkness", &DrawingStyle::darkness, {0.1F, 10.0F}, "",
                    "Darkness of the tones, as a factor: more gives a darker drawing, less leaves more white "
                    "paper")
            .number("contrast", &DrawingStyle::contrast, {0.1F, 10.0F}, "",
                    "Contrast of the tones, as a factor: less is flat and even, more pushes tones towards "
                    "white and black")
            .number("detail", &DrawingStyle::detail, {0.0F, 4.0F}, "",
                    "Detail within objects, as a factor of the preset's detail. 0 draws outlines and flat "
                    "colour, more draws more folds, texture and inner lines.")
            .number("wobble", &DrawingStyle::wobble, {0.0F, 10.0F}, "",
                    "Unsteadiness of the drawing hand, as a factor. 0 draws exact lines as with a ruler, "
                    "more looks like a shaky sketch.")
            .number("color", &DrawingStyle::color, {0.0F, 2.0F}, "",
                    "Strength of the colour, as a factor. 0 draws with ink alone, 1 keeps the colour of the "
                    "preset, 2 paints more strongly.")
            .choice("paper", &DrawingStyle::paper,
                    {{"preset", PaperKind::preset},
                     {"white", PaperKind::white},
                     {"cream", PaperKind::cream},
                     {"none", PaperKind::none}},
                    "Paper below the drawing. preset: the paper of the preset; white, cream: plain paper of "
                    "that colour; none: a transparent background, to lay the drawing over another picture.")
            .integer(
                "seed", &DrawingStyle::seed, {0, 1000000}, "",
                "Number that selects the random details of the whole drawing. Another number gives other "
                "strokes, lines, paper, clouds and smoke, as if the picture was drawn a second time.");
    return table;
}

namespace {

class Change {
public:
    explicit Change(StyleTables& style) : style_(style) {}

    /// Replaces a parameter's value, in the picture's style and in every override of the parameter, by the
    /// result of changed(value).
    template <typename Changed>
    void replace(std::string_view key, const Changed& changed)
    {
        const style::AnySchema::Found found = style_schema().find(key);
        void* const values = found.section->place.in(static_cast<void*>(&style_));
        found.parameter->set(values, changed(found.parameter->get(values)));
        for (style::Override& other : style_.overrides) {
            if (other.section == found.section->name && other.key == found.parameter->key) {
                other.value = changed(other.value);
            }
        }
    }

    void multiply(std::string_view key, float factor)
    {
        if (factor == 1.0F) {
            return;
        }
        const style::Range& range = style_schema().find(key).parameter->range;
        replace(key, [&](const style::Value& value) -> style::Value {
            return std::clamp(std::get<float>(value) * factor, range.minimum, range.maximum);
        });
    }

    template <typename Keys>
    void multiply_all(const Keys& keys, float factor)
    {
        for (const std::string_view key : keys) {
            multiply(key, factor);
        }
    }

private:
    StyleTables& style_;
};

/// Returns the keys of the widths of all kinds of ink lines, and of the outlines that other techniques draw.
const std::vector<std::string>& line_widths()
{
    static const std::vector<std::string> keys = [] {
        std::vector<std::string> found{"smoke.line_mm", "clouds.outline_mm", "particles.outline_mm"};
        for (const style::Parameter& parameter : contour::contour_table().parameters()) {
            if (parameter.key.ends_with(".width_mm") || parameter.key.ends_with(".width_m")) {
                found.push_back("contour." + parameter.key);
            }
        }
        return found;
    }();
    return keys;
}

constexpr std::array<std::string_view, 5> stroke_widths{"hatch.width_mm", "hatch.map_texel_mm",
                                                        "sky.width_mm", "smoke.stroke_mm", "clouds.hatch_mm"};
constexpr std::array<std::string_view, 6> unsteadiness{"hatch.wobble_mm",          "contour.wobble_mm",
                                                       "contour.retrace_mm",       "contour.jitter_ends_mm",
                                                       "contour.jitter_offset_mm", "contour.jitter_width"};
constexpr std::array<std::string_view, 2> texture{"wash.detail", "tone.local_value"};
constexpr std::array<std::string_view, 4> fewer_inner_lines{
    "contour.crease.angle_deg", "contour.ridge.turn_deg", "contour.suggestive.growth",
    "contour.crest.angle_deg"};

constexpr std::array<std::string_view, 8> inner_lines{
    "contour.border.enabled",      "contour.crease.enabled",     "contour.ridge.enabled",
    "contour.valley.enabled",      "contour.suggestive.enabled", "contour.intersection.enabled",
    "contour.shadow_edge.enabled", "contour.leaf.enabled"};
constexpr std::array<std::string_view, 21> painted{
    "sky.horizon",     "sky.zenith",        "sky.noon_horizon",  "sky.noon_zenith",    "sky.dusk_horizon",
    "sky.dusk_zenith", "sky.night_horizon", "sky.night_zenith",  "sky.high_band",      "sky.low_band",
    "sky.sun_color",   "sky.moon_color",    "clouds.color",      "clouds.shade_color", "wash.shadow_tint",
    "haze.tint_color", "smoke.color",       "smoke.shade_color", "smoke.deep_color",   "smoke.flame_color",
    "particles.color"};

/// Blends a colour towards the grey of equal luminance (ITU-R BT.709); if `kept` is 1, the colour does not
/// change.
glm::vec3 faded_to_grey(const glm::vec3& color, float kept)
{
    const float grey = glm::dot(color, glm::vec3(0.2126F, 0.7152F, 0.0722F));
    return glm::mix(glm::vec3(grey), color, kept);
}

void change_color(Change& change, float color)
{
    change.multiply("wash.strength", color);
    change.multiply("wash.saturation", color);
    if (color >= 1.0F) {
        return;
    }
    for (const std::string_view key : painted) {
        change.replace(key, [&](const style::Value& value) -> style::Value {
            return faded_to_grey(std::get<glm::vec3>(value), color);
        });
    }
}

void change_paper(paper::PaperStyle& paper, PaperKind kind)
{
    if (kind == PaperKind::white || kind == PaperKind::cream) {
        paper.color = style::srgb(kind == PaperKind::white ? 0xffffff : 0xf6f0e2);
        paper.transparent = paper::Transparency::none;
    } else if (kind == PaperKind::none) {
        paper.transparent = paper::Transparency::background;
    }
}

} // namespace

const StyleTables& with_drawing(const StyleTables& style, StyleTables& room)
{
    const DrawingStyle& drawing = style.drawing;
    if (drawing == DrawingStyle()) {
        return style;
    }
    room = style;
    room.drawing = {};
    Change change(room);
    change.multiply_all(line_widths(), drawing.line_weight);
    change.multiply_all(stroke_widths, drawing.hatch_spacing * drawing.hatch_weight);
    change.multiply("hatch.dots_mm", drawing.hatch_spacing);
    // Darkens the hatching: the gap between strokes is the stroke's width divided by the darkness. The
    // exponent of the tone curve darkens tones and leaves white paper white. A lower exposure would also
    // darken white paper.
    const float darkening = drawing.hatch_weight * drawing.darkness;
    if (room.tone.curve == light::ToneCurve::linear && darkening != 1.0F) {
        room.tone.curve = light::ToneCurve::gamma;
        room.tone.gamma = 1.0F;
    }
    change.multiply("tone.gamma", darkening);
    change.multiply("tone.contrast", drawing.contrast);
    change.multiply_all(texture, drawing.detail);
    change.multiply_all(fewer_inner_lines, 1.0F / std::max(drawing.detail, 1e-3F));
    if (drawing.detail == 0.0F) {
        for (const std::string_view key : inner_lines) {
            change.replace(key, [](const style::Value&) -> style::Value { return false; });
        }
    }
    change.multiply_all(unsteadiness, drawing.wobble);
    change_color(change, drawing.color);
    change_paper(room.paper, drawing.paper);
    for (int* const seed : {&room.hatch.seed, &room.tam.seed, &room.contour.seed, &room.ink.seed,
                            &room.smoke.seed, &room.focus_lines.seed, &room.motion_blur.seed,
                            &room.particles.seed, &room.clouds.seed, &room.paper.seed, &room.pigment.seed}) {
        *seed = drawing.seed;
    }
    return room;
}

} // namespace estampe::features
