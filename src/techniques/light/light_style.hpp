// SPDX-License-Identifier: MIT
#pragma once

#include "scene/view_analysis/view_analysis.hpp"
#include "shaders/tone.glsl.h"
#include "style/parameter.hpp"

namespace estampe::light {

enum class LightSource : uint8_t { automatic, scene, sun };

/// What sets the exposure: the lights that there are, what is on the page, or the style.
enum class Metering : uint8_t { lights, page, manual };

struct LightStyle {
    LightSource source = LightSource::automatic;
    float sun_azimuth_deg = house_sun_azimuth_deg;
    float sun_elevation_deg = house_sun_elevation_deg;
    bool turn_sun = true;
    Metering metering = Metering::lights;
    float exposure_stops = 0.0F;
    float ev100 = 10.0F;
    float adapt_stops_per_s = 0.0F;
    float ambient = 0.15F;
    float fill = 0.2F;
    float falloff = 0.62F;
    float paling = 0.5F;
    bool shadows = true;
    int shadow_size = 0;
    std::string lights;
    std::string objects;
};

[[nodiscard]] const style::Table<LightStyle>& light_table();

enum class ToneCurve : uint8_t {
    gamma = shared::tone_gamma,
    linear = shared::tone_linear,
    filmic = shared::tone_filmic
};

struct ToneStyle {
    ToneCurve curve = ToneCurve::gamma;
    float exposure = 1.14F;
    float gamma = 0.8F;
    float contrast = 1.05F;
    float floor = 0.12F;
    float ceiling = 0.97F;
    float local_value = 0.3F;
    float occlusion = 1.0F;
};

[[nodiscard]] const style::Table<ToneStyle>& tone_table();

} // namespace estampe::light
