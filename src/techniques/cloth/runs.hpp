// SPDX-License-Identifier: MIT
#pragma once

// What runs of steps and their passes know of each other.

#include "techniques/cloth/cloth.hpp"

namespace estampe::cloth {

inline constexpr uint32_t sweeps_of_descent = 4; ///< over all colours in a small step

/// Whether wind keeps all sheets awake: a breath of it moves nothing of note.
[[nodiscard]] inline bool blows(const Surroundings& now)
{
    return now.air_kg_m3 > 0.0F && now.wind.speed_m_s > shared::cloth_breath_m_s;
}

/// Without where the numbers of its grid begin.
[[nodiscard]] inline uint32_t kind_of(const shared::ClothCollider& solid)
{
    return solid.kind & ((1U << shared::cloth_kind_bits) - 1);
}

[[nodiscard]] inline bool is_of_grid(const shared::ClothCollider& solid)
{
    return kind_of(solid) == shared::cloth_heights || kind_of(solid) == shared::cloth_distances;
}

[[nodiscard]] inline bool is_seen(const shared::ClothCollider& solid)
{
    return kind_of(solid) == shared::cloth_seen;
}

} // namespace estampe::cloth
