// SPDX-License-Identifier: MIT
#include <utility>

#include <meshoptimizer.h>

#include "scene/mending/mend.hpp"

namespace estampe {

std::vector<uint32_t> places_of_vertices(const Primitive& primitive, size_t* count)
{
    // Negative zero equals zero but has other bytes, and vertices are compared by bytes.
    std::vector<glm::vec3> positions = primitive.positions;
    for (glm::vec3& position : positions) {
        position += 0.0F;
    }
    std::vector<uint32_t> places(positions.size());
    const size_t found = meshopt_generateVertexRemap(places.data(), nullptr, positions.size(),
                                                     positions.data(), positions.size(), sizeof(glm::vec3));
    if (count != nullptr) {
        *count = found;
    }
    return places;
}

void turn_triangle(Primitive& primitive, size_t triangle)
{
    std::swap(primitive.indices[3 * triangle + 1], primitive.indices[3 * triangle + 2]);
    if (!primitive.edge_marks.empty()) {
        uint8_t& marks = primitive.edge_marks[triangle];
        // The first edge has become the last, and the other way about.
        marks = static_cast<uint8_t>((marks & ~5U) | (marks & 1U) << 2U | (marks >> 2U & 1U));
    }
}

} // namespace estampe
