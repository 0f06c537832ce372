// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/tam/brush.hpp"

namespace estampe::tam {

/// A stroke on the unit square, which wraps; the same at every level but for its width.
struct Stroke {
    glm::vec2 start{0.0F};
    glm::vec2 direction{1.0F, 0.0F}; ///< of the chord, unit length
    float length = 0.1F;
    float bow = 0.0F;    ///< height of the arc over the chord, as a share of the length
    float wobble = 0.0F; ///< how far it strays from the arc, as a share of the length
    uint32_t seed = 0;

    /// Distance to the left of the chord at `along` (0 to 1), in the units of the square.
    [[nodiscard]] float offset(float along) const;

    /// The middle of the stroke at `along`, not wrapped.
    [[nodiscard]] glm::vec2 point(float along) const;
};

/// Width in pixels, the same at every level.
struct Nib {
    float width_px = 2.0F;
    float taper_px = 16.0F;
    float tip = 0.4F;
};

/// Share of the ink that one stroke leaves on one texel.
struct Mark {
    uint32_t texel = 0; ///< index into the image
    uint16_t ink = 0;   ///< 0 to 65535
};

/// Fills `marks` with what `stroke` leaves on a level of `size_px`, each texel once (twice where a stroke
/// overlaps itself across the wrap). `tooth` is the paper of that level, or empty.
///
/// Cost    about 30 ns a texel near the stroke
void draw_stroke(const Stroke& stroke, const Nib& nib, const Brush& brush, const std::vector<float>& tooth,
                 uint32_t size_px, std::vector<Mark>& marks);

} // namespace estampe::tam
