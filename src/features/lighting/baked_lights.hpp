// SPDX-License-Identifier: MIT
#pragma once

// Lights whose light a map holds already.

#include <optional>

#include "features/lighting/lightmaps.hpp"
#include "techniques/light/light.hpp"

namespace estampe::features {

/// The bit of a light's kind, of BakedLights.
[[nodiscard]] uint32_t kind_of(const shared::LightRecord& record);

/// Makes room for a map, if there is one, in the light of a frame: leaves out lights of the kinds that it
/// holds already, and dims the others, where the style wants that. Returns what the map is to be multiplied
/// by.
[[nodiscard]] float make_room(light::Lighting& lighting, const std::optional<WornLight>& worn,
                              const lightmap::LightmapStyle& style);

} // namespace estampe::features
