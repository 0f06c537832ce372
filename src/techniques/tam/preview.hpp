// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/image.hpp>
#include <glm/glm.hpp>

#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

/// All images of a map on one sheet: a column a tone, the lightest at the left; in each the finest level on
/// top and the coarser ones below it, from left to right. Colours are linear.
[[nodiscard]] Image preview_sheet(const TonalArtMap& map, const glm::vec3& paper, const glm::vec3& ink);

} // namespace estampe::tam
