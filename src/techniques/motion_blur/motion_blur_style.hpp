// SPDX-License-Identifier: MIT
#pragma once

#include "style/parameter.hpp"

namespace estampe::motion_blur {

enum class Mode : uint8_t { none, tiles, own, stretched, velocity };

struct MotionBlurStyle {
    Mode mode = Mode::none;
    float shutter_deg = 180.0F;
    float frames_per_s = 24.0F;
    float largest_mm = 12.0F;
    bool lines = false;
    float lines_length = 5.0F;
    float lines_spacing_mm = 3.0F;
    float lines_width_mm = 0.3F;
    float lines_from_mm = 1.5F;
    glm::vec3 lines_ink = style::srgb(0x1c1a20);
    bool smear = false;
    float smear_length = 5.0F;
    float smear_spacing_mm = 3.0F;
    float smear_width_mm = 2.5F;
    float smear_from_mm = 1.0F;
    glm::vec3 smear_ink = style::srgb(0x1c1a20);
    int seed = 1;
};

[[nodiscard]] const style::Table<MotionBlurStyle>& motion_blur_table();

} // namespace estampe::motion_blur
