// SPDX-License-Identifier: MIT
#pragma once

// Solids of any form for cloth to run into, as numbers on a grid.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

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

} // namespace estampe::cloth
