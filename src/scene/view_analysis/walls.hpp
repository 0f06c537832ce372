// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "scene/view_analysis/surface_points.hpp"

namespace estampe {

/// What the outermost surfaces show to the middle of the scene, along -x, +x, -y, +y, -z, +z.
struct Walls {
    std::array<bool, 6> inward{};    ///< a wall of a room: at the side of the box, it faces the middle alone
    std::array<bool, 6> closed{};    ///< something stands there, whichever way it faces
    std::array<bool, 6> two_sided{}; ///< what stands there is seen from both sides

    /// At least four of the six sides face inwards, as a room's do and a model's skin does not.
    [[nodiscard]] bool room() const;

    /// Whether one of the four upright sides is open, as a stage's or a doll's house's is.
    [[nodiscard]] bool has_opening() const;

    /// The side of the four upright ones to look in through: an open one, +z first, else +z.
    [[nodiscard]] size_t opening() const;
};

/// Cost: linear in points.
[[nodiscard]] Walls find_walls(const SurfaceCloud& cloud);

} // namespace estampe
