// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "core/hash.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::pose {
namespace {

/// An edge by the places of its ends, not by their numbers, so that it is the same edge on both sides of a
/// seam.
struct EdgePlaces {
    glm::vec3 from;
    glm::vec3 to;

    bool operator==(const EdgePlaces&) const = default;
};

struct EdgeHash {
    size_t operator()(const EdgePlaces& edge) const
    {
        Hash hash;
        for (const glm::vec3& place : {edge.from, edge.to}) {
            hash.add(place + 0.0F); // -0 is 0
        }
        return hash.value();
    }
};

/// Ratio of the larger to the smaller stretch of the map from a triangle to its texture; infinite when
/// degenerate.
float stretch(const glm::vec3& p0, const glm::vec3& p1, const glm::vec3& p2, glm::vec2 u0, glm::vec2 u1,
              glm::vec2 u2)
{
    const glm::vec3 a = p1 - p0;
    const glm::vec3 b = p2 - p0;
    const glm::vec2 s = u1 - u0;
    const glm::vec2 t = u2 - u0;
    const float area = s.x * t.y - s.y * t.x;
    const glm::vec3 along_u = a * t.y - b * s.y;
    const glm::vec3 along_v = b * s.x - a * t.x;
    const float uu = glm::dot(along_u, along_u);
    const float vv = glm::dot(along_v, along_v);
    const float uv = glm::dot(along_u, along_v);
    const float mean = 0.5F * (uu + vv);
    const float root = std::sqrt(std::max(0.0F, 0.25F * (uu - vv) * (uu - vv) + uv * uv));
    const bool degenerate = area == 0.0F || mean - root <= 1e-12F * mean;
    return degenerate ? std::numeric_limits<float>::infinity() : std::sqrt((mean + root) / (mean - root));
}

} // namespace

bool uvs_are_usable(const Primitive& primitive)
{
    const auto& uvs = primitive.uvs[0];
    if (uvs.size() != primitive.positions.size() || primitive.indices.size() < 3) {
        return false;
    }
    constexpr float most_stretch = 8.0F;
    constexpr double most_bad_area = 0.1;
    constexpr double most_seam_length = 0.12;
    double area_all = 0.0;
    double area_bad = 0.0;
    std::unordered_map<EdgePlaces, std::pair<glm::vec2, glm::vec2>, EdgeHash> waiting;
    waiting.reserve(primitive.indices.size() / 2);
    double inner_length = 0.0;
    double seam_length = 0.0;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const uint32_t* corner = &primitive.indices[i];
        const glm::vec3& p0 = primitive.positions[corner[0]];
        const glm::vec3& p1 = primitive.positions[corner[1]];
        const glm::vec3& p2 = primitive.positions[corner[2]];
        const double area = glm::length(glm::cross(p1 - p0, p2 - p0));
        area_all += area;
        if (!(stretch(p0, p1, p2, uvs[corner[0]], uvs[corner[1]], uvs[corner[2]]) < most_stretch)) {
            area_bad += area;
        }
        for (int k = 0; k < 3; ++k) {
            const uint32_t from = corner[k];
            const uint32_t to = corner[(k + 1) % 3];
            const glm::vec3& a = primitive.positions[from];
            const glm::vec3& b = primitive.positions[to];
            const auto other = waiting.find({b, a});
            if (other == waiting.end()) {
                waiting[{a, b}] = {uvs[from], uvs[to]};
                continue;
            }
            const double length = glm::distance(a, b);
            inner_length += length;
            const bool joined = glm::distance(other->second.first, uvs[to]) < 1e-4F &&
                                glm::distance(other->second.second, uvs[from]) < 1e-4F;
            seam_length += joined ? 0.0 : length;
            waiting.erase(other);
        }
    }
    return area_bad <= most_bad_area * area_all && seam_length <= most_seam_length * inner_length;
}

} // namespace estampe::pose
