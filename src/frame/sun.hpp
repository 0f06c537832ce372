// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "techniques/hatch/hatch.hpp"
#include "techniques/shadow/edge_look.hpp"

namespace estampe::frame {

/// The lines of the hatching that edges of shadows can follow; none where no lines are drawn.
[[nodiscard]] std::optional<shadow::HatchedLines>
hatched_lines(const hatch::HatchStyle& style, const glm::vec3& towards_light, bool has_directions);

} // namespace estampe::frame
