// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::sky {

enum class SkyMode : uint8_t { automatic, drawn, paper };

enum class SkyFollow : uint8_t { automatic, sun, none };

struct SkyStyle {
    SkyMode mode = SkyMode::automatic;
    glm::vec3 horizon = style::srgb(0xf0dca2);
    glm::vec3 zenith = style::srgb(0x5f9a92);
    float darkness = 0.22F;
    float width_mm = 0.34F;
    SkyFollow follow = SkyFollow::automatic;
    glm::vec3 noon_horizon = style::srgb(0xf4eed6);
    glm::vec3 noon_zenith = style::srgb(0x78aebd);
    glm::vec3 dusk_horizon = style::srgb(0xe3a06f);
    glm::vec3 dusk_zenith = style::srgb(0x4d6b80);
    glm::vec3 night_horizon = style::srgb(0x4a5c74);
    glm::vec3 night_zenith = style::srgb(0x1d2740);
    float night_darkness = 0.5F;
    int steps = 0;
    glm::vec3 high_band = style::srgb(0x1f3f6e);
    float high_band_deg = 90.0F;
    glm::vec3 low_band = style::srgb(0xd98a5f);
    float low_band_deg = 0.0F;
    float disc_deg = 0.0F;
    glm::vec3 sun_color = style::srgb(0xc8452f);
    glm::vec3 moon_color = style::srgb(0xf6efd6);
    float moon_lit = 1.0F;
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
            .number("width_mm", &SkyStyle::width_mm, {0.02F, 10.0F}, "mm", "Width of a stroke on the page")
            .choice("follow", &SkyStyle::follow,
                    {{"auto", SkyFollow::automatic}, {"sun", SkyFollow::sun}, {"none", SkyFollow::none}},
                    "Whether horizon and zenith are those of a low sun and the colours below those of other "
                    "hours, by the height of the sun: yes, no, or (auto) where sun.by = place")
            .color("noon_horizon", &SkyStyle::noon_horizon, "Horizon under a sun higher than 40 degrees")
            .color("noon_zenith", &SkyStyle::noon_zenith, "Zenith under a sun higher than 40 degrees")
            .color("dusk_horizon", &SkyStyle::dusk_horizon, "Horizon when the sun is 2 degrees under it")
            .color("dusk_zenith", &SkyStyle::dusk_zenith,
                   "Zenith when the sun is 2 degrees under the horizon")
            .color("night_horizon", &SkyStyle::night_horizon,
                   "Horizon when the sun is 10 degrees under it and lower")
            .color("night_zenith", &SkyStyle::night_zenith,
                   "Zenith when the sun is 10 degrees under the horizon and lower")
            .number("night_darkness", &SkyStyle::night_darkness, {0.0F, 1.0F}, "",
                    "Darkness of the strokes high above at night")
            .integer("steps", &SkyStyle::steps, {0, 12}, "",
                     "Flat tones from horizon to zenith, each wiped a little into the next; 0 grades evenly")
            .color("high_band", &SkyStyle::high_band, "Colour of a band that is wiped in from above")
            .number("high_band_deg", &SkyStyle::high_band_deg, {0.0F, 90.0F}, "deg",
                    "Height of the middle of its edge; 90 draws none")
            .color("low_band", &SkyStyle::low_band, "Colour of a band that is wiped in at the horizon")
            .number("low_band_deg", &SkyStyle::low_band_deg, {0.0F, 90.0F}, "deg",
                    "Height of the middle of its edge; 0 draws none")
            .number("disc_deg", &SkyStyle::disc_deg, {0.0F, 45.0F}, "deg",
                    "Width of the sun's disc, and by night of the moon's; 0 draws neither, 0.53 is nature's")
            .color("sun_color", &SkyStyle::sun_color, "Colour of the sun's disc")
            .color("moon_color", &SkyStyle::moon_color, "Colour of the moon's")
            .number("moon_lit", &SkyStyle::moon_lit, {0.0F, 1.0F}, "",
                    "Share of the moon's width that shines");
    return table;
}

struct SkyInputs {
    gpu::BufferId frame; ///< FrameGlobals
    glm::vec3 towards_sun{0.0F, 1.0F, 0.0F};
    std::optional<float> daylight_rad; ///< height of a sun that stands by place and hour
    float pixels_per_mm = 1.0F;
    bool drawn = false;
    glm::uvec2 size_px{0};
};

struct Sky {
    gpu::ImageId wash; ///< rgba16f: what the paint lets through
    gpu::ImageId ink;  ///< r16f: coverage
};

/// What an hour's sky looks like.
struct SkyLook {
    glm::vec3 horizon{0.0F};
    glm::vec3 zenith{0.0F};
    float darkness = 0.0F; ///< of the strokes high above
};

/// The look that the style has under this sun: by its height where the style follows that.
[[nodiscard]] SkyLook look_under(const SkyStyle& style, const glm::vec3& towards_sun,
                                 const std::optional<float>& daylight_rad);

/// The height of the sun that colours go by; none where they stay.
[[nodiscard]] std::optional<double> followed_elevation_rad(const SkyStyle& style,
                                                           const glm::vec3& towards_sun,
                                                           const std::optional<float>& daylight_rad);

/// The look under a sun at that height: night up to -10 degrees, dusk at -2, the style's horizon and zenith
/// from 4 to 12, noon from 40, smooth between.
[[nodiscard]] SkyLook look_at(const SkyStyle& style, double sun_elevation_rad);

/// Paints the background of the whole page; one blank texel for all of it where no sky is drawn. Cost: one
/// full-screen dispatch; next to nothing without a sky.
[[nodiscard]] Sky add_sky(gpu::Graph& graph, const SkyInputs& in, const SkyStyle& style);

} // namespace estampe::sky
