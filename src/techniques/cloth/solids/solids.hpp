// SPDX-License-Identifier: MIT
#pragma once

// Solids that cloth collides with: simple shapes, and any shape as numbers on a grid.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "techniques/cloth/cloth.glsl.h"

namespace estampe::cloth {

/// A solid as numbers at the nodes of a regular grid: heights (one node in y), or signed distances, negative
/// inside. x varies fastest, then y.
struct SolidGrid {
    glm::uvec3 nodes{2, 1, 2};
    glm::vec3 centre_m{0.0F};
    glm::vec3 half_m{1.0F}; ///< half the grid's size, from the middle to the last nodes
    std::vector<float> values_m;
};

/// Makes a grid of heights over a rectangle: `height_m(x, z)` at each node, relative to `centre_m`. Several
/// threads call `height_m` in parallel. Cost: one call per node, shared by all cores.
[[nodiscard]] SolidGrid grid_of_heights(glm::uvec2 nodes, glm::vec3 centre_m, glm::vec2 half_m,
                                        const std::function<double(double x_m, double z_m)>& height_m);

/// Computes the signed distance from the nodes of a grid to the nearest triangle, with three indices per
/// triangle. A node is inside if at least two of three rays, one per axis, say so; therefore small holes do
/// no harm. The longest side has `cells` cells around the triangles, and two more at each end. The result is
/// empty if no triangle has a position. Cost: the cells around each triangle, and eight sweeps over all
/// nodes. Source: Bridson, "Fluid Simulation for Computer Graphics", 2008, on making level sets of meshes.
[[nodiscard]] SolidGrid grid_of_distances(std::span<const glm::vec3> positions_m,
                                          std::span<const glm::uvec3> triangles, uint32_t cells);

enum class SolidKind : uint8_t { plane, ellipsoid, box, cylinder, capsule, heights, distances, seen };

/// A solid at one time. The solid is rotated in its own coordinates, then translated.
struct Solid {
    SolidKind kind = SolidKind::plane; ///< shape of the solid; a plane is all space below y = 0
    glm::vec3 half_m{1.0F}; ///< radii, or half size of a box or grid; for a cylinder or capsule about y:
                            ///< radius and half the axis' length (without a capsule's ends)
    glm::vec3 centre_m{0.0F};
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    uint32_t grid = 0; ///< number of the solid's grid in set_grids(), or of the solid's body in set_bodies()
};

/// Makes the solid of all space below a plane.
[[nodiscard]] Solid below(glm::vec3 point_m, glm::vec3 normal);
[[nodiscard]] Solid ball(glm::vec3 centre_m, float radius_m);
[[nodiscard]] Solid capsule_between(glm::vec3 from_m, glm::vec3 to_m, float radius_m);

/// Transforms a solid by a matrix. An ellipsoid stays an exact ellipsoid. For all solids except ellipsoids
/// shear is ignored, and cylinders and capsules stay round. Half sizes are at least 1e-4 m.
[[nodiscard]] Solid placed(const Solid& solid, const glm::dmat4& place);

/// Makes the solid of a grid, placed at the grid's middle. Heights are relative to the grid's middle.
[[nodiscard]] Solid solid_of_grid(SolidKind kind, const SolidGrid& grid, uint32_t number);

/// Prepares a solid's previous rotation for interpolation to the current one by the shorter way. Two
/// quaternions represent each rotation, and a capsule may rotate freely about the capsule's axis.
void turn_alike(shared::ClothCollider& before, const shared::ClothCollider& after);

/// Converts a solid to the shaders' record. `first_of_grid` is the index of the first number of the solid's
/// grid or body.
[[nodiscard]] shared::ClothCollider as_shared(const Solid& solid, uint32_t first_of_grid = 0);

} // namespace estampe::cloth
