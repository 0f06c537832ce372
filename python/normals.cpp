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
    const float length = glm::length(vector);
    return length > 0.0F && std::isfinite(length) ? vector / length : glm::vec3(0.0F);
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

} // namespace

void compute_normals(Primitive& primitive, double crease_deg)
{
    const std::vector<uint32_t>& indices = primitive.indices;
    const size_t face_count = indices.size() / 3;
    std::vector<glm::vec3> face_normals(face_count);
    std::vector<float> corner_angles_rad(3 * face_count);
    for (size_t face = 0; face < face_count; ++face) {
        std::array<glm::vec3, 3> p{};
        for (size_t k = 0; k < 3; ++k) {
            p[k] = primitive.positions[indices[3 * face + k]];
        }
        // The product of two edges overflows or vanishes for very large or small faces, their directions do
        // not.
        face_normals[face] = unit_or_zero(glm::cross(unit_or_zero(p[1] - p[0]), unit_or_zero(p[2] - p[0])));
        for (size_t k = 0; k < 3; ++k) {
            corner_angles_rad[3 * face + k] = angle_between(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
        }
    }

    uint32_t place_count = 0;
    const std::vector<uint32_t> places = numbered_positions(primitive.positions, place_count);
    std::vector<std::vector<Corner>> corners_of_place(place_count);
    for (size_t at = 0; at < 3 * face_count; ++at) {
        corners_of_place[places[indices[at]]].push_back({at, corner_angles_rad[at]});
    }

    const auto least_cosine =
        static_cast<float>(std::cos(glm::radians(std::clamp(crease_deg, 0.0, 180.0))) - 1e-5);
    std::map<std::tuple<uint32_t, float, float, float>, uint32_t> known;
    std::vector<uint32_t> source_of_vertex;
    std::vector<glm::vec3> normals;
    std::vector<uint32_t> new_indices(3 * face_count);
    for (size_t at = 0; at < 3 * face_count; ++at) {
        const glm::vec3& own = face_normals[at / 3];
        glm::vec3 sum(0.0F);
        for (const Corner& corner : corners_of_place[places[indices[at]]]) {
            const glm::vec3& other = face_normals[corner.at / 3];
            if (glm::dot(own, other) >= least_cosine) {
                sum += corner.angle_rad * other;
            }
        }
        glm::vec3 normal = unit_or_zero(sum);
        if (normal == glm::vec3(0.0F)) { // a face without area, which is not visible
            normal = own == glm::vec3(0.0F) ? glm::vec3(0.0F, 1.0F, 0.0F) : own;
        }
        const auto [found, is_new] = known.try_emplace(std::tuple(indices[at], normal.x, normal.y, normal.z),
                                                       static_cast<uint32_t>(normals.size()));
        if (is_new) {
            source_of_vertex.push_back(indices[at]);
            normals.push_back(normal);
        }
        new_indices[at] = found->second;
    }
    reorder(primitive.positions, source_of_vertex);
    reorder(primitive.uvs[0], source_of_vertex);
    reorder(primitive.uvs[1], source_of_vertex);
    reorder(primitive.colors, source_of_vertex);
    reorder(primitive.held, source_of_vertex);
    primitive.normals = std::move(normals);
    primitive.indices = std::move(new_indices);
}

} // namespace estampe::python
