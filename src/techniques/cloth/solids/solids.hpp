// SPDX-License-Identifier: MIT
#pragma once

// What cloth runs into: simple solids, and those of any form as numbers on a grid.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "techniques/cloth/cloth.glsl.h"

namespace estampe::cloth {

/// Numbers at the nodes of a regular grid, x by x, then y by y: heights (one node in y) or signed distances,
/// negative within.
struct SolidGrid {
    glm::uvec3 nodes{2, 1, 2};
    glm::vec3 centre_m{0.0F};
    glm::vec3 half_m{1.0F}; ///< from the middle to the last nodes
    std::vector<float> values_m;
};

/// Heights over a rectangle: `height_m(x, z)` at each node, all from `centre_m` on. It is asked by several
/// threads at once. Cost: nodes, shared by the processor's cores.
[[nodiscard]] SolidGrid grid_of_heights(glm::uvec2 nodes, glm::vec3 centre_m, glm::vec2 half_m,
                                        const std::function<double(double x_m, double z_m)>& height_m);

/// How far it is from the nodes of a grid to the nearest triangle, three indices each. What is within is
/// found by rays along the three axes, of which two decide, so that small holes do no harm. The longest side
/// has `cells` cells about the triangles, and there are two more at each end. Empty where no triangle has a
/// place. Cost: cells about each triangle, and eight sweeps over all nodes. Source: Bridson, "Fluid
/// Simulation for Computer Graphics", 2008, on making level sets of meshes.
[[nodiscard]] SolidGrid grid_of_distances(std::span<const glm::vec3> positions_m,
                                          std::span<const glm::uvec3> triangles, uint32_t cells);

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
