// SPDX-License-Identifier: MIT
#include "techniques/sky/sky.hpp"

#include <algorithm>
#include <cmath>

#include "gpu/transfers.hpp"
#include "shaders/sky_comp.hpp"
#include "style/parameter.hpp"
#include "techniques/sky/sky.glsl.h"

namespace estampe::sky {
namespace {

SkyColors mix(const SkyColors& a, const SkyColors& b, float share)
{
    return {glm::mix(a.horizon, b.horizon, share), glm::mix(a.zenith, b.zenith, share),
            glm::mix(a.darkness, b.darkness, share)};
}

struct Disc {
    glm::vec3 towards{0.0F};
    glm::vec3 color{0.0F};
    float lit = 1.0F; ///< lit share of the disc's width; less than 1 for a crescent moon
};

/// The disc to draw: the sun at its position, or after sunset the moon on the opposite side.
Disc disc_of(const SkyStyle& style, const glm::vec3& towards_sun, const std::optional<float>& daylight_rad)
{
    if (!daylight_rad) {
        return {.towards = glm::normalize(towards_sun), .color = style.sun_color};
    }
    const glm::vec2 level = glm::normalize(glm::vec2(towards_sun.x, towards_sun.z) + glm::vec2(0.0F, 1e-6F));
    const float up = std::sin(*daylight_rad);
    const glm::vec2 along = level * std::cos(*daylight_rad);
    constexpr float set_rad = -0.035F; // elevation of the sun below which the sky no longer glows
    return *daylight_rad > set_rad
               ? Disc{.towards = {along.x, up, along.y}, .color = style.sun_color}
               : Disc{.towards = {-along.x, -up, -along.y}, .color = style.moon_color, .lit = style.moon_lit};
}

} // namespace

SkyColors colors_at(const SkyStyle& style, double sun_elevation_rad)
{
    const auto deg = static_cast<float>(glm::degrees(sun_elevation_rad));
    const SkyColors night{style.night_horizon, style.night_zenith, style.night_darkness};
    const SkyColors dusk{style.dusk_horizon, style.dusk_zenith, style.darkness};
    const SkyColors low{style.horizon, style.zenith, style.darkness};
    const SkyColors noon{style.noon_horizon, style.noon_zenith, style.darkness};
    return mix(
        mix(mix(night, dusk, glm::smoothstep(-10.0F, -2.0F, deg)), low, glm::smoothstep(-2.0F, 4.0F, deg)),
        noon, glm::smoothstep(12.0F, 40.0F, deg));
}

std::optional<double> followed_elevation_rad(const SkyStyle& style, const glm::vec3& towards_sun,
                                             const std::optional<float>& daylight_rad)
{
    if (style.follow == SkyFollow::none || (style.follow == SkyFollow::automatic && !daylight_rad)) {
        return std::nullopt;
    }
    return daylight_rad ? static_cast<double>(*daylight_rad)
                        : std::asin(std::clamp(static_cast<double>(towards_sun.y), -1.0, 1.0));
}

SkyColors colors_under(const SkyStyle& style, const glm::vec3& towards_sun,
                       const std::optional<float>& daylight_rad)
{
    const auto elevation_rad = followed_elevation_rad(style, towards_sun, daylight_rad);
    return elevation_rad ? colors_at(style, *elevation_rad)
                         : SkyColors{style.horizon, style.zenith, style.darkness};
}

Sky add_sky(gpu::Graph& graph, const SkyInputs& in, const SkyStyle& style)
{
    const glm::uvec2 size_px = in.drawn ? in.size_px : glm::uvec2(1);
    const gpu::ImageDesc wash_image{.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba16f};
    const gpu::ImageDesc ink_image{.width = size_px.x, .height = size_px.y, .format = gpu::Format::r16f};
    const auto blank = [&] {
        return Sky{gpu::add_filled_image(graph, "sky/no wash", wash_image, glm::vec4(1.0F)),
                   gpu::add_filled_image(graph, "sky/no ink", ink_image, glm::vec4(0.0F))};
    };
    if (!in.drawn) {
        return blank();
    }
    const std::optional<Sky> before = in.tiles ? std::optional(blank()) : std::nullopt;
    auto pass = graph.compute("sky", shaders::sky_comp);
    pass.uniform(in.frame);
    const gpu::ImageId wash =
        before ? pass.modify(before->wash) : pass.write(graph.image("sky/wash", wash_image));
    const gpu::ImageId ink =
        before ? pass.modify(before->ink) : pass.write(graph.image("sky/ink", ink_image));
    pass.read(in.tiles.value_or(in.frame)).sample(in.depth);
    pass.sample(in.halo.value_or(in.depth), in.halo ? gpu::Sampling::linear : gpu::Sampling::nearest);
    pass.variant((in.tiles ? shared::sky_has_tiles : 0U) | (in.far_m ? shared::sky_has_depth : 0U) |
                 (in.halo && style.halo_mm > 0.0F ? shared::sky_has_halo : 0U));
    const SkyColors colors = colors_under(style, in.towards_sun, in.daylight_rad);
    const Disc disc = disc_of(style, in.towards_sun, in.daylight_rad);
    pass.push(shared::SkyConstants{.horizon_color = colors.horizon,
                                   .stroke_width_px = style.width_mm * in.pixels_per_mm,
                                   .zenith_color = colors.zenith,
                                   .darkness = colors.darkness,
                                   .towards_sun = in.towards_sun,
                                   .high_color = style.high_band,
                                   .high_rad = glm::radians(style.high_band_deg),
                                   .low_color = style.low_band,
                                   .low_rad = glm::radians(style.low_band_deg),
                                   .disc_color = disc.color,
                                   .disc_rad = 0.5F * glm::radians(style.disc_deg),
                                   .towards_disc = disc.towards,
                                   .disc_lit = disc.lit,
                                   .steps = static_cast<float>(style.steps),
                                   .far_m = in.far_m.value_or(0.0F),
                                   .halo_px = style.halo_mm * in.pixels_per_mm});
    if (in.tiles) {
        pass.dispatch_indirect(*in.tiles);
    } else {
        pass.dispatch_over(size_px.x, size_px.y);
    }
    return {wash, ink};
}

const style::Table<SkyStyle>& sky_table()
{
    static const auto table =
        style::Table<SkyStyle>("sky", "Sky: a colour wash with long horizontal strokes")
            .auto_toggle("enabled", &SkyStyle::enabled,
                         "Draws a sky behind the scene. true: always; false: never, so the paper stays bare; "
                         "auto: if the scene file contains a camera and a sun.")
            .color("horizon", &SkyStyle::horizon,
                   "Colour of the sky at the horizon. When the sky follows the sun (see sky.follow), this is "
                   "the colour while the sun is 4 to 12 degrees high.")
            .color("zenith", &SkyStyle::zenith,
                   "Colour of the sky high above (zenith). When the sky follows the sun (see sky.follow), "
                   "this is the colour while the sun is 4 to 12 degrees high.")
            .number("darkness", &SkyStyle::darkness, {0.0F, 1.0F}, "",
                    "Darkness of the strokes high in the sky: 0 draws no strokes, 1 draws the darkest")
            .number("width_mm", &SkyStyle::width_mm, {0.02F, 10.0F}, "mm",
                    "Width on the page of a stroke of the sky: more is bolder")
            .number("halo_mm", &SkyStyle::halo_mm, {0.0F, 30.0F}, "mm",
                    "Width of the halo around things in front of the sky: there the strokes of the sky thin "
                    "out towards the things. 0 draws no halo.")
            .choice("follow", &SkyStyle::follow,
                    {{"auto", SkyFollow::automatic}, {"sun", SkyFollow::sun}, {"none", SkyFollow::none}},
                    "When the colours of the sky follow the height of the sun, through noon, dusk and night. "
                    "sun: always; none: never; auto: if sun.by is place.")
            .color("noon_horizon", &SkyStyle::noon_horizon,
                   "Colour of the sky at the horizon when the sun is above 40 degrees. Only used when the "
                   "sky follows the sun (see sky.follow).")
            .color("noon_zenith", &SkyStyle::noon_zenith,
                   "Colour of the sky high above when the sun is above 40 degrees. Only used when the sky "
                   "follows the sun (see sky.follow).")
            .color("dusk_horizon", &SkyStyle::dusk_horizon,
                   "Colour of the sky at the horizon when the sun is 2 degrees below the horizon. Only used "
                   "when the sky follows the sun (see sky.follow).")
            .color("dusk_zenith", &SkyStyle::dusk_zenith,
                   "Colour of the sky high above when the sun is 2 degrees below the horizon. Only used when "
                   "the sky follows the sun (see sky.follow).")
            .color("night_horizon", &SkyStyle::night_horizon,
                   "Colour of the sky at the horizon when the sun is 10 or more degrees below the horizon. "
                   "Only used when the sky follows the sun (see sky.follow).")
            .color("night_zenith", &SkyStyle::night_zenith,
                   "Colour of the sky high above when the sun is 10 degrees or more below the horizon. Only "
                   "used when the sky follows the sun (see sky.follow).")
            .number("night_darkness", &SkyStyle::night_darkness, {0.0F, 1.0F}, "",
                    "Darkness of the strokes high in the sky at night: more gives a darker night. Only used "
                    "when the sky follows the sun (see sky.follow).")
            .integer("steps", &SkyStyle::steps, {0, 12}, "",
                     "Number of flat bands of tone in the sky, blended at their edges as in a woodblock "
                     "print. 0 gives a smooth change of tone from the horizon up.")
            .color("high_band", &SkyStyle::high_band,
                   "Colour of a band at the top of the sky that fades out downwards. Only used when "
                   "sky.high_band_deg is below 90.")
            .number("high_band_deg", &SkyStyle::high_band_deg, {0.0F, 90.0F}, "deg",
                    "Height above the horizon of the lower edge of the colour band at the top of the sky. "
                    "Less brings the band further down, 90 draws no band.")
            .color("low_band", &SkyStyle::low_band,
                   "Colour of a band that lies along the horizon and fades out upwards. Only used when "
                   "sky.low_band_deg is above 0.")
            .number("low_band_deg", &SkyStyle::low_band_deg, {0.0F, 90.0F}, "deg",
                    "Height above the horizon of the upper edge of the colour band along the horizon. More "
                    "makes the band taller, 0 draws no band.")
            .number("disc_deg", &SkyStyle::disc_deg, {0.0F, 45.0F}, "deg",
                    "Width of the disc of the sun in the sky, and of the moon at night: 0.53 is natural, "
                    "more is larger. 0 draws no disc.")
            .color("sun_color", &SkyStyle::sun_color,
                   "Colour of the sun's disc. Only used when sky.disc_deg is above 0.")
            .color("moon_color", &SkyStyle::moon_color,
                   "Colour of the moon's disc. Only used when sky.disc_deg is above 0.")
            .number("moon_lit", &SkyStyle::moon_lit, {0.0F, 1.0F}, "",
                    "Share of the moon's width that is bright: 0.5 is a half moon, 1 is a full moon. Only "
                    "used when sky.disc_deg is above 0.");
    return table;
}

} // namespace estampe::sky
