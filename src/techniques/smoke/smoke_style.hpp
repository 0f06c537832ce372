// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "style/parameter.hpp"

namespace estampe::smoke {

/// Where along its rays the volume is looked up.
enum class Sampling : uint8_t {
    rays, ///< at equal steps from where each enters the box, scattered within them
    axis, ///< on planes of the grid, across the axis that the eye looks along most
    view  ///< on planes that face the eye
};

enum class Medium : uint8_t { wash, strokes, both };

struct SmokeStyle {
    bool drawn = false;
    std::string objects = "smoke*";
    uint32_t cells = 64;
    float age_s = 5.0F;
    float source = 0.24F;
    float amount_per_s = 6.0F;
    float rise_s = 3.0F;
    float wind_m_s = 0.0F;
    float wind_deg = 90.0F;
    float curl = 1.0F;
    bool obstacles = false;
    float life_s = 4.0F;
    float thickness = 6.0F;
    bool puffs = true;
    float puff = 0.16F;
    Sampling sampling = Sampling::rays;
    float step = 0.7F;
    float scatter = 0.0F;
    float edge = 0.5F;
    Medium medium = Medium::both;
    glm::vec3 color = style::srgb(0xffffff);
    glm::vec3 shade_color = style::srgb(0xd5d6d3);
    glm::vec3 deep_color = style::srgb(0xa2a6a8);
    float opacity = 1.0F;
    float shade_below = 0.42F;
    float deep_below = 0.18F;
    float form = 0.75F;
    float line_mm = 0.4F;
    float stroke_mm = 0.22F;
    float darkness = 0.4F;
    int seed = 1;
};

inline const style::Table<SmokeStyle>& smoke_table()
{
    static const auto table =
        style::Table<SmokeStyle>("smoke", "Smoke that rises from objects without a mesh")
            .toggle("drawn", &SmokeStyle::drawn, "Whether there is any")
            .text("objects", &SmokeStyle::objects,
                  "The object whose box it fills, 2 m wide each way in its own space, from the middle of the "
                  "box's floor on: a pattern")
            .integer("cells", &SmokeStyle::cells, {16, 256}, "",
                     "Cells along the longest side of the box, a power of two")
            .number("age_s", &SmokeStyle::age_s, {0.0F, 60.0F}, "s",
                    "How long it has risen in a picture that stands for itself, and in the first of a film")
            .number("source", &SmokeStyle::source, {0.02F, 1.0F}, "",
                    "Radius of where it comes from, beside half the box's width")
            .number("amount_per_s", &SmokeStyle::amount_per_s, {0.0F, 100.0F}, "1/s",
                    "How quickly it gets dense there")
            .number("rise_s", &SmokeStyle::rise_s, {0.2F, 100.0F}, "s",
                    "How long it takes to the top of the box, about")
            .number("wind_m_s", &SmokeStyle::wind_m_s, {0.0F, 100.0F}, "m/s", "Speed of the air outside")
            .number("wind_deg", &SmokeStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Where to: 0 is along +z, 90 along +x")
            .number("curl", &SmokeStyle::curl, {0.0F, 4.0F}, "", "How much its swirls are fed")
            .toggle("obstacles", &SmokeStyle::obstacles,
                    "Whether it flows around what stands in its box, as that stands when it starts")
            .number("life_s", &SmokeStyle::life_s, {0.1F, 1000.0F}, "s",
                    "After this long a third of it is left")
            .number("thickness", &SmokeStyle::thickness, {0.1F, 100.0F}, "",
                    "Optical depth of a tenth of the box's width of dense smoke")
            .toggle("puffs", &SmokeStyle::puffs, "Whether it is drawn as puffs; else as it is")
            .number("puff", &SmokeStyle::puff, {0.02F, 1.0F}, "",
                    "From one puff to the next, beside the box's width")
            .choice("sampling", &SmokeStyle::sampling,
                    {{"rays", Sampling::rays}, {"axis", Sampling::axis}, {"view", Sampling::view}},
                    "Where it is looked up: along rays, on planes of the grid, on planes that face the eye")
            .number("step", &SmokeStyle::step, {0.1F, 4.0F}, "", "From one look-up to the next, in cells")
            .number(
                "scatter", &SmokeStyle::scatter, {0.0F, 1.0F}, "",
                "How far look-ups stray within their step, along rays: noise in place of bands in thin smoke")
            .number("edge", &SmokeStyle::edge, {0.02F, 0.98F}, "", "Opacity at which its outline runs")
            .choice("medium", &SmokeStyle::medium,
                    {{"wash", Medium::wash}, {"strokes", Medium::strokes}, {"both", Medium::both}},
                    "What its shade is drawn with")
            .color("color", &SmokeStyle::color, "Paint where it is lit")
            .color("shade_color", &SmokeStyle::shade_color, "And in shade")
            .color("deep_color", &SmokeStyle::deep_color, "And in deep shade")
            .number("opacity", &SmokeStyle::opacity, {0.0F, 1.0F}, "",
                    "How far its paint covers what is behind")
            .number("shade_below", &SmokeStyle::shade_below, {0.0F, 1.0F}, "",
                    "Share of the light under which it is in shade")
            .number("deep_below", &SmokeStyle::deep_below, {0.0F, 1.0F}, "", "And in deep shade")
            .number("form", &SmokeStyle::form, {0.0F, 1.0F}, "",
                    "How far its light follows the form of each puff, beside what comes through the smoke")
            .number("line_mm", &SmokeStyle::line_mm, {0.0F, 5.0F}, "mm",
                    "Width of the line around a puff, wider in shade")
            .number("stroke_mm", &SmokeStyle::stroke_mm, {0.02F, 5.0F}, "mm", "Width of a stroke")
            .number("darkness", &SmokeStyle::darkness, {0.0F, 1.0F}, "", "Ink of strokes in full shade")
            .integer("seed", &SmokeStyle::seed, {0, 1000000}, "", "Another number, other puffs");
    return table;
}

} // namespace estampe::smoke
