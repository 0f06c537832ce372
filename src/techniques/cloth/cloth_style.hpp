// SPDX-License-Identifier: MIT
#pragma once

// What a style says of cloth.

#include "style/parameter.hpp"

namespace estampe::cloth {

/// What skinned bodies are to cloth.
enum class ClothBodies : uint8_t { capsules, depth };

/// How cloth is worked out.
struct ClothStyle {
    float settle_s = 3.0F;
    float effort = 1.0F;
    float rest_mm_per_s = 5.0F;
    ClothBodies bodies = ClothBodies::capsules;

    bool operator==(const ClothStyle&) const = default;
};

[[nodiscard]] const style::Table<ClothStyle>& cloth_table();

} // namespace estampe::cloth
