// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "style/parameter.hpp"

namespace estampe::lens {

enum class Mode : uint8_t { none, gather, separable, mips, sums, circles };
enum class ActsOn : uint8_t { picture, wash, strokes };

struct LensStyle {
    Mode mode = Mode::none;
    ActsOn acts_on = ActsOn::picture;
    float focal_mm = 50.0F;
    float f_number = 2.8F;
    float focus_m = 0.0F;
    std::string focus_on;
    float largest_mm = 10.0F;
    int blades = 0;
    float blade_turn_deg = 0.0F;
    float widen = 1.0F;
    float pale = 0.6F;
};

[[nodiscard]] const style::Table<LensStyle>& lens_table();

} // namespace estampe::lens
