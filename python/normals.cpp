// SPDX-License-Identifier: MIT
// Normals for parts that come without any.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"

namespace estampe::python {
namespace {

/// A corner of a face: where it is in Primitive::indices, and how strongly the face counts there.
struct Corner {
    size_t at = 0;
    float angle_rad = 0.0F;
};

glm::vec3 unit_or_zero(const glm::vec3& vector)
{
    const double length = glm::length(glm::dvec3(vector)); // a float would overflow for very large faces
    return length > 0.0 && std::isfinite(length) ? glm::vec3(glm::dvec3(vector) / length) : glm::vec3(0.0F);
}

float angle_between(const glm::vec3& a, const glm::vec3& b)
{
    return std::acos(std::clamp(glm::dot(unit_or_zero(a), unit_or_zero(b)), -1.0F, 1.0F));
}

/// Numbers the positions; vertices at equal positions get the same number.
std::vector<uint32_t> numbered_positions(const std::vector<glm::vec3>& positions, uint32_t& count)
{
    std::vector<uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](uint32_t vertex) {
        const glm::vec3& p = positions[vertex];
        return std::tuple(p.x, p.y, p.z);
    };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    std::vector<uint32_t> numbers(positions.size());
    count = 0;
    for (size_t i = 0; i < order.size(); ++i) {
        count += i == 0 || key(order[i - 1]) < key(order[i]) ? 1U : 0U;
        numbers[order[i]] = count - 1;
    }
    return numbers;
}

/// Repeats the entries of a vertex array in a new order; an empty array stays empty.
template <typename T>
void reorder(std::vector<T>& values, const std::vector<uint32_t>& source_of_vertex)
{
    if (values.empty()) {
        return;
    }
    std::vector<T> ordered;
    ordered.reserve(source_of_vertex.size());
    for (const uint32_t source : source_of_vertex) {
        ordered.push_back(values[source]);
    }
    values = std::move(ordered);
}

/// The faces of a mesh: their unit normals, and which of their corners meet at each position.
struct Faces {
    std::vector<glm::vec3> normals;
    std::vector<uint32_t> place_of_vertex;
    std::vector<std::vector<Corner>> corners_of_place;
};

Faces faces_of(const Primitive& primitive)
{
    const std::vector<uint32_t>& indices = primitive.indices;
    Faces faces;
    uint32_t place_count = 0;
    faces.place_of_vertex = numbered_positions(primitive.positions, place_count);
    faces.corners_of_place.resize(place_count);
    for (size_t first = 0; first + 2 < indices.size(); first += 3) {
        std::array<glm::vec3, 3> p{};
        for (size_t k = 0; k < 3; ++k) {
            p[k] = primitive.positions[indices[first + k]];
        }
        faces.normals.push_back(
            unit_or_zero(glm::cross(unit_or_zero(p[1] - p[0]), unit_or_zero(p[2] - p[0]))));
        for (size_t k = 0; k < 3; ++k) {
            const float angle_rad = angle_between(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            faces.corners_of_place[faces.place_of_vertex[indices[first + k]]].push_back(
                {first + k, angle_rad});
        }
    }
    return faces;
}

/// Returns the sum of the normals of all faces at a position that differ from `own` by an angle whose cosine
/// is at least `least_cosine`.
glm::vec3 sum_of_normals(const Faces& faces, const std::vector<Corner>& corners, const glm::vec3& own,
                         float least_cosine)
{
    glm::vec3 sum(0.0F);
    for (const Corner& corner : corners) {
        const glm::vec3& other = faces.normals[corner.at / 3];
        if (glm::dot(own, other) >= least_cosine) {
            sum += corner.angle_rad * other;
        }
    }
    return sum;
}

/// Returns the normal of each corner of the mesh.
std::vector<glm::vec3> corner_normals(const Faces& faces, float least_cosine)
{
    // Comparing each face with each other one would take hours at a position where all faces meet. Above this
    // number, all faces are averaged at once, and those that are not near the average stay flat.
    constexpr size_t most_compared = 1024;
    std::vector<glm::vec3> normals(3 * faces.normals.size());
    for (const std::vector<Corner>& corners : faces.corners_of_place) {
        const bool is_crowded = corners.size() > most_compared;
        const glm::vec3 average =
            is_crowded ? unit_or_zero(sum_of_normals(faces, corners, {}, -1.0F)) : glm::vec3(0.0F);
        for (const Corner& corner : corners) {
            const glm::vec3& own = faces.normals[corner.at / 3];
            glm::vec3 normal = own;
            if (!is_crowded) {
                normal = unit_or_zero(sum_of_normals(faces, corners, own, least_cosine));
            } else if (glm::dot(own, average) >= least_cosine) {
                normal = average;
            }
            if (normal == glm::vec3(0.0F)) { // a face without area, which is not visible
                normal = own == glm::vec3(0.0F) ? glm::vec3(0.0F, 1.0F, 0.0F) : own;
            }
            normals[corner.at] = normal;
        }
    }
    return normals;
}

} // namespace

void compute_normals(Primitive& primitive, double crease_deg)
{
    const auto least_cosine =
        static_cast<float>(std::cos(glm::radians(std::clamp(crease_deg, 0.0, 180.0))) - 1e-5);
    const std::vector<glm::vec3> normal_of_corner = corner_normals(faces_of(primitive), least_cosine);
    std::map<std::tuple<uint32_t, float, float, float>, uint32_t> known;
    std::vector<uint32_t> source_of_vertex;
    std::vector<glm::vec3> normals;
    for (size_t at = 0; at < normal_of_corner.size(); ++at) {
        const glm::vec3& normal = normal_of_corner[at];
        uint32_t& index = primitive.indices[at];
        const auto [found, is_new] = known.try_emplace(std::tuple(index, normal.x, normal.y, normal.z),
                                                       static_cast<uint32_t>(normals.size()));
        if (is_new) {
            source_of_vertex.push_back(index);
            normals.push_back(normal);
        }
        index = found->second;
    }
    reorder(primitive.positions, source_of_vertex);
    reorder(primitive.uvs[0], source_of_vertex);
    reorder(primitive.uvs[1], source_of_vertex);
    reorder(primitive.colors, source_of_vertex);
    reorder(primitive.held, source_of_vertex);
    primitive.normals = std::move(normals);
}

} // namespace estampe::python
