// SPDX-License-Identifier: MIT
#pragma once

#include "style/parameter.hpp"

namespace estampe::cloth {

enum class WindSource : uint8_t { automatic, style };

/// The wind that moves cloth.
struct WindStyle {
    WindSource from = WindSource::automatic;
    float speed_m_s = 4.0F;
    float direction_deg = 20.0F;
    float gustiness = 0.35F;
    float gust_m = 6.0F;
    float turbulence = 0.5F;
    float eddy_m = 1.2F;

    bool operator==(const WindStyle&) const = default;
};

/// How cloth is worked out.
struct ClothStyle {
    float settle_s = 3.0F;
    float effort = 1.0F;

    bool operator==(const ClothStyle&) const = default;
};

inline const style::Table<WindStyle>& wind_table()
{
    static const auto table =
        style::Table<WindStyle>("wind", "What moves cloth")
            .choice("from", &WindStyle::from, {{"auto", WindSource::automatic}, {"style", WindSource::style}},
                    "Whose speed and direction: (auto) the terrain's where the scene has one, or the style's")
            .number("speed_m_s", &WindStyle::speed_m_s, {0.0F, 60.0F}, "m/s", "How fast, on the whole")
            .number("direction_deg", &WindStyle::direction_deg, {-360.0F, 360.0F}, "deg",
                    "Where it blows to: 0 is +x, 90 is +z")
            .number("gustiness", &WindStyle::gustiness, {0.0F, 1.0F}, "",
                    "How much of its speed comes and goes")
            .number("gust_m", &WindStyle::gust_m, {0.1F, 1000.0F}, "m", "From one gust to the next, about")
            .number("turbulence", &WindStyle::turbulence, {0.0F, 2.0F}, "",
                    "How fast eddies turn, of its speed")
            .number("eddy_m", &WindStyle::eddy_m, {0.05F, 100.0F}, "m", "How large they are");
    return table;
}

inline const style::Table<ClothStyle>& cloth_table()
{
    static const auto table =
        style::Table<ClothStyle>("cloth", "Sheets that hang, lie and blow")
            .number("settle_s", &ClothStyle::settle_s, {0.0F, 20.0F}, "s",
                    "How long it has moved, from how it was laid out, when a still or a film begins")
            .number("effort", &ClothStyle::effort, {0.25F, 8.0F}, "",
                    "How finely time is cut: more stretches less and costs as much more");
    return table;
}

} // namespace estampe::cloth
