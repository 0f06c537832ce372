// SPDX-License-Identifier: MIT
#pragma once

// Solid bodies and cloth sheets for small scenes.

#include <functional>

#include <estampe/scene.hpp>

namespace kit {

using Hold = std::function<float(glm::vec2 share)>; ///< how firmly a sheet is held there, 0 to 1

/// A solid of revolution about the y axis. `rings` holds radius and height, from the foot up. Both ends are
/// closed.
[[nodiscard]] estampe::Primitive turned(const std::vector<glm::vec2>& rings, uint32_t segments = 28);
[[nodiscard]] estampe::Primitive block(glm::vec3 half_m);

/// A scene without nodes, with one material for solid bodies and one for sheets.
[[nodiscard]] estampe::Scene empty_scene();

/// Adds a mesh at a position. Returns its node.
estampe::Index add(estampe::Scene& scene, const std::string& name, estampe::Primitive primitive,
                   glm::dvec3 place_m, estampe::ClothCollider collider = estampe::ClothCollider::none);

/// Adds a cloth sheet with one corner at a position. Returns its node.
estampe::Index add_sheet(estampe::Scene& scene, glm::uvec2 particles, glm::dvec3 corner_m, glm::vec3 along_m,
                         glm::vec3 down_m, const Hold& hold, const estampe::Cloth& cloth = {});

} // namespace kit
