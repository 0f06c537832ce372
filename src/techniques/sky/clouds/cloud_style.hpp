// SPDX-License-Identifier: MIT
#pragma once

#include "style/parameter.hpp"

namespace estampe::sky {

struct CloudStyle {
    float coverage = 0.0F;
    float base_m = 1400.0F;
    float size_m = 2400.0F;
    float heaped = 1.0F;
    float flocks = 0.0F;
    float flocks_base_m = 3600.0F;
    float flocks_size_m = 2600.0F;
    float streaks = 0.0F;
    float streaks_base_m = 8000.0F;
    float streaks_size_m = 9000.0F;
    float streaks_mm = 0.9F;
    float wind_mps = 9.0F;
    float wind_deg = 90.0F;
    float change_s = 3600.0F;
    glm::vec3 color = style::srgb(0xffffff);
    glm::vec3 shade_color = style::srgb(0xc4cfd0);
    int tones = 2;
    float shade = 0.35F;
    float outline_mm = 0.5F;
    float broken = 0.5F;
    float hatch = 0.0F;
    float hatch_mm = 0.25F;
    float shadow = 0.0F;
    float reach_m = 32000.0F;
    int seed = 1;

    bool operator==(const CloudStyle& other) const = default;
};

[[nodiscard]] const style::Table<CloudStyle>& cloud_table();

} // namespace estampe::sky
