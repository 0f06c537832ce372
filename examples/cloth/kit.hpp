// SPDX-License-Identifier: MIT
#pragma once

// Solids and sheets for small scenes.

#include <functional>

#include <estampe/scene.hpp>

namespace kit {

using Hold = std::function<float(glm::vec2 share)>; ///< of a place on a sheet, 0 to 1 along and down

/// Turned about the y axis: radius and height of each ring, from the foot up, closed at both ends.
[[nodiscard]] estampe::Primitive turned(const std::vector<glm::vec2>& rings, uint32_t segments = 28);
[[nodiscard]] estampe::Primitive block(glm::vec3 half_m);

/// A scene of one plain material, and what it is under a low sun.
[[nodiscard]] estampe::Scene empty_scene();

/// Adds a mesh in a place, and returns its node.
estampe::Index add(estampe::Scene& scene, const std::string& name, estampe::Primitive primitive,
                   glm::dvec3 place_m, estampe::ClothCollider collider = estampe::ClothCollider::none);

/// A sheet whose corner is in a place.
estampe::Index add_sheet(estampe::Scene& scene, glm::uvec2 particles, glm::dvec3 corner_m, glm::vec3 along_m,
                         glm::vec3 down_m, const Hold& hold, const estampe::Cloth& cloth = {});

} // namespace kit
