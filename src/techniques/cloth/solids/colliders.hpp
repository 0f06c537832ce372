// SPDX-License-Identifier: MIT
#pragma once

// What cloth runs into.

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "techniques/cloth/cloth.glsl.h"
#include "techniques/cloth/solids/solid_grid.hpp"

namespace estampe::cloth {

enum class SolidKind : uint8_t { plane, ellipsoid, box, cylinder, capsule, heights, distances, seen };

/// A solid at a moment: in its own space, turned, then moved.
struct Solid {
    SolidKind kind = SolidKind::plane; ///< all below its y = 0
    glm::vec3 half_m{1.0F}; ///< radii, or half a box; of a cylinder or capsule about y the radius, and half
                            ///< the length of its axis, without a capsule's ends
    glm::vec3 centre_m{0.0F};
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    uint32_t grid = 0; ///< of heights or distances, by its place among those that sheets were told of, or the
                       ///< body that is seen along z; `half_m` is half the size of either then
};

/// All below a plane.
[[nodiscard]] Solid below(glm::vec3 point_m, glm::vec3 normal);
[[nodiscard]] Solid ball(glm::vec3 centre_m, float radius_m);
[[nodiscard]] Solid capsule_between(glm::vec3 from_m, glm::vec3 to_m, float radius_m);

/// A solid of its own space in a place of any matrix. An ellipsoid stays one whatever the matrix is; of
/// others shear is left out, and cylinders and capsules keep round. Half sizes of 1e-4 m are the least there
/// are.
[[nodiscard]] Solid placed(const Solid& solid, const glm::dmat4& place);

/// The solid of a grid, where the grid has its middle; heights count from there.
[[nodiscard]] Solid solid_of_grid(SolidKind kind, const SolidGrid& grid, uint32_t number);

/// Writes the rotation that a solid had so that the way from it to the one it has now is the short one: the
/// same turn has two quaternions, and a capsule any about its axis.
void turn_alike(shared::ClothCollider& before, const shared::ClothCollider& after);

/// `first_of_grid` is where the numbers of its grid or body begin.
[[nodiscard]] shared::ClothCollider as_shared(const Solid& solid, uint32_t first_of_grid = 0);

} // namespace estampe::cloth
