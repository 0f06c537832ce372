// SPDX-License-Identifier: MIT
#include <algorithm>

#include "scene/mending/mend.hpp"
#include "scene/mending/repair.hpp"

namespace estampe {
namespace {

/// Whether a triangle's corners run clockwise as seen from where all of its three normals point.
bool runs_against_normals(const Primitive& primitive, const uint32_t* corners)
{
    const glm::dvec3 a = primitive.positions[corners[0]];
    const glm::dvec3 face = glm::cross(glm::dvec3(primitive.positions[corners[1]]) - a,
                                       glm::dvec3(primitive.positions[corners[2]]) - a);
    // Beyond a right angle by this cosine: smoothed normals of a sharp edge reach a right angle, and rounding
    // goes a little further.
    constexpr double clearly = 0.05;
    const double least = -clearly * glm::length(face);
    return std::all_of(corners, corners + 3, [&](uint32_t corner) {
        const glm::dvec3 normal = primitive.normals[corner];
        return glm::dot(face, normal) < least * glm::length(normal);
    });
}

} // namespace

void turn_by_normals(Scene& scene)
{
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            if (primitive.topology != Topology::triangles || primitive.normals.empty() ||
                !scene.materials[primitive.material].double_sided) {
                continue;
            }
            for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
                if (runs_against_normals(primitive, &primitive.indices[i])) {
                    turn_triangle(primitive, i / 3);
                }
            }
        }
    }
}

} // namespace estampe
