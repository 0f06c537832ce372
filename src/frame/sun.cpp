// SPDX-License-Identifier: MIT
#include "frame/sun.hpp"

#include <algorithm>

#include <glm/trigonometric.hpp>

namespace estampe::frame {

std::optional<shadow::HatchedLines> hatched_lines(const hatch::HatchStyle& style,
                                                  const glm::vec3& towards_light, bool has_directions)
{
    if (!style.drawn || style.strokes != hatch::Strokes::lines) {
        return std::nullopt;
    }
    // In full shadow the first of several layers draws its largest share, and pays for gaps and tapers.
    const float darkness = style.layers > 1 ? 0.46F : 0.7F;
    const float kept =
        std::max(1.0F - 0.75F * (style.gap_mm + style.taper_mm) / std::max(style.length_mm, 1e-3F), 0.1F);
    const float slant = glm::radians(style.slant_deg);
    const float wind = glm::radians(style.wind_deg);
    return shadow::HatchedLines{.width_mm = style.width_mm,
                                .darkness = std::min(darkness / kept, 1.0F),
                                .seed = static_cast<uint32_t>(style.seed),
                                .flat_axis = {-glm::sin(slant), glm::cos(slant)},
                                .wind = {glm::sin(wind), glm::cos(wind)},
                                .towards_light = towards_light,
                                .has_directions = has_directions};
}

} // namespace estampe::frame
