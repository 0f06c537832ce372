// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "features/hatching/strokes.hpp"

namespace estampe::features {

/// Coordinates along the form in the rest pose, three a triangle, zero where a draw does not follow it.
/// Cost: see form::follow_form; each draw by itself.
[[nodiscard]] std::vector<glm::vec2> form_coordinates(const pose::MeshData& meshes, const StrokePlan& plan);

} // namespace estampe::features
