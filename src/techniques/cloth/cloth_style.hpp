// SPDX-License-Identifier: MIT
#pragma once

// The section `cloth` of a style.

#include "style/parameter.hpp"

namespace estampe::cloth {

/// The method by which cloth collides with skinned bodies.
enum class ClothBodies : uint8_t { capsules, depth };

/// Settings of the cloth simulation.
struct ClothStyle {
    float settle_s = 3.0F;
    float effort = 1.0F;
    float rest_mm_per_s = 5.0F;
    ClothBodies bodies = ClothBodies::capsules;

    bool operator==(const ClothStyle&) const = default;
};

[[nodiscard]] const style::Table<ClothStyle>& cloth_table();

} // namespace estampe::cloth
