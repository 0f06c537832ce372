// SPDX-License-Identifier: MIT
#include "techniques/form/split.hpp"

#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace estampe::form {

SplitMesh split_at_jumps(std::span<const uint32_t> triangle_indices, uint32_t vertex_count,
                         const FormField& field)
{
    constexpr uint32_t no_copy = std::numeric_limits<uint32_t>::max();
    constexpr float tolerance = 1e-4F;
    SplitMesh split;
    split.sources.resize(vertex_count);
    std::iota(split.sources.begin(), split.sources.end(), 0U);
    split.coordinates.assign(vertex_count, glm::vec2(std::numeric_limits<float>::quiet_NaN()));
    std::vector<uint32_t> next_copy(vertex_count, no_copy);
    for (size_t t = 0; t < field.corners.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            const glm::vec2& wanted = field.corners[t][k];
            uint32_t vertex = triangle_indices[3 * t + k];
            assert(vertex < vertex_count);
            if (std::isnan(split.coordinates[vertex].x)) {
                split.coordinates[vertex] = wanted;
            }
            while (glm::distance(split.coordinates[vertex], wanted) > tolerance &&
                   next_copy[vertex] != no_copy) {
                vertex = next_copy[vertex];
            }
            if (glm::distance(split.coordinates[vertex], wanted) > tolerance) {
                next_copy[vertex] = static_cast<uint32_t>(split.sources.size());
                vertex = next_copy[vertex];
                split.sources.push_back(triangle_indices[3 * t + k]);
                split.coordinates.push_back(wanted);
                next_copy.push_back(no_copy);
            }
            split.indices.push_back(vertex);
        }
    }
    for (glm::vec2& coordinate : split.coordinates) {
        coordinate = std::isnan(coordinate.x) ? glm::vec2(0.0F) : coordinate;
    }
    return split;
}

} // namespace estampe::form
