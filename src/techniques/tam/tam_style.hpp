// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "style/parameter.hpp"

namespace estampe::tam {

/// Drawing tool of the strokes, see class Brush in stroke.hpp.
enum class Tool : uint8_t { pen, pencil, charcoal, burin, brush };

/// Style of the strokes of a tonal art map. Lengths are in pixels, equal for all mip levels: a stroke is as
/// many pixels wide in the coarsest level as in the finest.
struct TamStyle {
    int size_px = 512;
    int tones = 6;
    float lightest = 0.1F;
    float darkest = 0.88F;
    float curve = 1.0F;
    Tool tool = Tool::pen;
    float width_px = 2.2F;
    float length_px = 110.0F;
    float length_spread = 0.5F;
    float taper_px = 16.0F;
    float tip = 0.4F;
    float pressure = 0.3F;
    float opacity = 1.0F;
    float grain = 0.5F;
    float bow = 0.018F;
    float wobble = 0.012F;
    float angle_deg = 0.0F;
    float angle_spread_deg = 2.5F;
    int second_from = 4;
    float second_deg = 64.0F;
    int third_from = 6;
    float third_deg = -38.0F;
    int candidates = 64;
    int seed = 1;

    bool operator==(const TamStyle&) const = default;
};

[[nodiscard]] const style::Table<TamStyle>& tam_table();

} // namespace estampe::tam
