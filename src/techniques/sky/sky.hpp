// SPDX-License-Identifier: MIT
#pragma once

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::sky {

enum class SkyMode : uint8_t { automatic, drawn, paper };

struct SkyStyle {
    SkyMode mode = SkyMode::automatic;
    glm::vec3 horizon = style::srgb(0xf0dca2);
    glm::vec3 zenith = style::srgb(0x5f9a92);
    float darkness = 0.22F;
    float width_mm = 0.34F;
};

inline const style::Table<SkyStyle>& sky_table()
{
    static const auto table =
        style::Table<SkyStyle>("sky", "The background: a wash with long level strokes")
            .choice("mode", &SkyStyle::mode,
                    {{"auto", SkyMode::automatic}, {"drawn", SkyMode::drawn}, {"paper", SkyMode::paper}},
                    "Drawn, bare paper, or (auto) drawn where the scene brings a camera and a sun")
            .color("horizon", &SkyStyle::horizon, "Colour of the wash at the horizon")
            .color("zenith", &SkyStyle::zenith, "Colour of the wash high above")
            .number("darkness", &SkyStyle::darkness, {0.0F, 1.0F}, "", "Darkness of the strokes high above")
            .number("width_mm", &SkyStyle::width_mm, {0.02F, 10.0F}, "mm", "Width of a stroke on the page");
    return table;
}

struct SkyInputs {
    gpu::BufferId frame; ///< FrameGlobals
    glm::vec3 towards_sun{0.0F, 1.0F, 0.0F};
    float pixels_per_mm = 1.0F;
    bool drawn = false;
    glm::uvec2 size_px{0};
};

struct Sky {
    gpu::ImageId wash; ///< rgba16f: what the paint lets through
    gpu::ImageId ink;  ///< r16f: coverage
};

/// Paints the background of the whole page; one blank texel for all of it where no sky is drawn. Cost: one
/// full-screen dispatch.
[[nodiscard]] Sky add_sky(gpu::Graph& graph, const SkyInputs& in, const SkyStyle& style);

} // namespace estampe::sky
