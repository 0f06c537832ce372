// SPDX-License-Identifier: MIT
#include "techniques/sky/sky.hpp"

#include <algorithm>
#include <cmath>

#include "gpu/fills.hpp"
#include "shaders/sky_comp.hpp"
#include "techniques/sky/sky.glsl.h"

namespace estampe::sky {
namespace {

SkyLook mix(const SkyLook& a, const SkyLook& b, float share)
{
    return {glm::mix(a.horizon, b.horizon, share), glm::mix(a.zenith, b.zenith, share),
            glm::mix(a.darkness, b.darkness, share)};
}

} // namespace

SkyLook look_at(const SkyStyle& style, double sun_elevation_rad)
{
    const auto deg = static_cast<float>(glm::degrees(sun_elevation_rad));
    const SkyLook night{style.night_horizon, style.night_zenith, style.night_darkness};
    const SkyLook dusk{style.dusk_horizon, style.dusk_zenith, style.darkness};
    const SkyLook low{style.horizon, style.zenith, style.darkness};
    const SkyLook noon{style.noon_horizon, style.noon_zenith, style.darkness};
    return mix(
        mix(mix(night, dusk, glm::smoothstep(-10.0F, -2.0F, deg)), low, glm::smoothstep(-2.0F, 4.0F, deg)),
        noon, glm::smoothstep(12.0F, 40.0F, deg));
}

Sky add_sky(gpu::Graph& graph, const SkyInputs& in, const SkyStyle& style)
{
    const glm::uvec2 size_px = in.drawn ? in.size_px : glm::uvec2(1);
    const gpu::ImageDesc wash_image{.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba16f};
    const gpu::ImageDesc ink_image{.width = size_px.x, .height = size_px.y, .format = gpu::Format::r16f};
    if (!in.drawn) {
        return {gpu::add_filled_image(graph, "sky/no wash", wash_image, glm::vec4(1.0F)),
                gpu::add_filled_image(graph, "sky/no ink", ink_image, glm::vec4(0.0F))};
    }
    auto pass = graph.compute("sky", shaders::sky_comp);
    pass.uniform(in.frame);
    const gpu::ImageId wash = pass.write(graph.image("sky/wash", wash_image));
    const gpu::ImageId ink = pass.write(graph.image("sky/ink", ink_image));
    const bool follows =
        style.follow == SkyFollow::sun || (style.follow == SkyFollow::automatic && in.daylight_rad);
    const double elevation_rad =
        in.daylight_rad ? static_cast<double>(*in.daylight_rad)
                        : std::asin(std::clamp(static_cast<double>(in.towards_sun.y), -1.0, 1.0));
    const SkyLook look =
        follows ? look_at(style, elevation_rad) : SkyLook{style.horizon, style.zenith, style.darkness};
    pass.push(shared::SkyConstants{.horizon_color = look.horizon,
                                   .stroke_width_px = style.width_mm * in.pixels_per_mm,
                                   .zenith_color = look.zenith,
                                   .darkness = look.darkness,
                                   .towards_sun = in.towards_sun})
        .dispatch_over(size_px.x, size_px.y);
    return {wash, ink};
}

} // namespace estampe::sky
