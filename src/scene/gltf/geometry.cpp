// SPDX-License-Identifier: MIT
#include "scene/gltf/geometry.hpp"

#include <cmath>

namespace estampe::gltf {
namespace {

template <typename Value>
void pick(std::vector<Value>& values, const std::vector<uint32_t>& order)
{
    if (values.empty()) {
        return;
    }
    std::vector<Value> picked;
    picked.reserve(order.size());
    for (const uint32_t vertex : order) {
        picked.push_back(values[vertex]);
    }
    values = std::move(picked);
}

glm::dvec3 face_cross(const Primitive& primitive, size_t corner)
{
    const glm::dvec3 a(primitive.positions[primitive.indices[corner]]);
    const glm::dvec3 b(primitive.positions[primitive.indices[corner + 1]]);
    const glm::dvec3 c(primitive.positions[primitive.indices[corner + 2]]);
    return glm::cross(b - a, c - a);
}

/// `vector` at unit length, or `otherwise` when it has no direction.
glm::dvec3 unit_or(const glm::dvec3& vector, const glm::dvec3& otherwise)
{
    const double length = glm::length(vector);
    return std::isfinite(length) && length > 1e-150 ? vector / length : otherwise;
}

/// Any unit vector at right angles to `normal`.
glm::dvec3 some_tangent(const glm::dvec3& normal)
{
    const glm::dvec3 axis = std::abs(normal.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(axis - normal * glm::dot(axis, normal));
}

bool is_usable(const glm::vec3& normal)
{
    const float length_squared = glm::dot(normal, normal);
    return std::isfinite(length_squared) && length_squared > 1e-12F;
}

} // namespace

std::vector<uint32_t> list_indices(int mode, const std::vector<uint32_t>& indices)
{
    const size_t count = indices.size();
    std::vector<uint32_t> list;
    const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) {
        if (a != b && b != c && c != a) {
            list.insert(list.end(), {a, b, c});
        }
    };
    switch (mode) {
    case 0:
        return indices;
    case 1:
        return {indices.begin(), indices.end() - static_cast<std::ptrdiff_t>(count % 2)};
    case 2:
    case 3:
        for (size_t i = 0; i + 1 < count; ++i) {
            list.insert(list.end(), {indices[i], indices[i + 1]});
        }
        if (mode == 2 && count > 2) {
            list.insert(list.end(), {indices.back(), indices.front()});
        }
        return list;
    case 5:
        for (size_t i = 0; i + 2 < count; ++i) {
            triangle(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
        }
        return list;
    case 6:
        for (size_t i = 1; i + 1 < count; ++i) {
            triangle(indices[0], indices[i], indices[i + 1]);
        }
        return list;
    default:
        return {indices.begin(), indices.end() - static_cast<std::ptrdiff_t>(count % 3)};
    }
}

void pick_vertices(Primitive& primitive, const std::vector<uint32_t>& order)
{
    pick(primitive.positions, order);
    pick(primitive.normals, order);
    pick(primitive.tangents, order);
    pick(primitive.uvs[0], order);
    pick(primitive.uvs[1], order);
    pick(primitive.colors, order);
    pick(primitive.joints_0, order);
    pick(primitive.joints_1, order);
    pick(primitive.weights_0, order);
    pick(primitive.weights_1, order);
    for (MorphTarget& target : primitive.morph_targets) {
        pick(target.position_offsets, order);
        pick(target.normal_offsets, order);
    }
}

void drop_unused_vertices(Primitive& primitive)
{
    constexpr uint32_t unused = no_index;
    std::vector<uint32_t> new_of_old(primitive.positions.size(), unused);
    std::vector<uint32_t> order;
    for (const uint32_t index : primitive.indices) {
        if (new_of_old[index] == unused) {
            new_of_old[index] = 0;
            order.push_back(index);
        }
    }
    if (order.size() * 2 > primitive.positions.size()) {
        return;
    }
    for (uint32_t i = 0; i < order.size(); ++i) {
        new_of_old[order[i]] = i;
    }
    pick_vertices(primitive, order);
    for (uint32_t& index : primitive.indices) {
        index = new_of_old[index];
    }
}

void make_flat_normals(Primitive& primitive)
{
    const std::vector<uint32_t> order = primitive.indices;
    primitive.normals.clear();
    primitive.tangents.clear();
    pick_vertices(primitive, order);
    for (uint32_t i = 0; i < order.size(); ++i) {
        primitive.indices[i] = i;
    }
    primitive.normals.resize(order.size());
    for (size_t corner = 0; corner + 2 < order.size(); corner += 3) {
        const glm::vec3 normal(unit_or(face_cross(primitive, corner), glm::dvec3(0, 1, 0)));
        std::fill_n(primitive.normals.begin() + static_cast<std::ptrdiff_t>(corner), 3, normal);
    }
}

size_t repair_normals(Primitive& primitive)
{
    size_t bad = 0;
    for (glm::vec3& normal : primitive.normals) {
        if (is_usable(normal)) {
            normal = glm::normalize(normal);
        } else {
            normal = glm::vec3(0.0F);
            ++bad;
        }
    }
    if (bad == 0) {
        return 0;
    }
    std::vector<glm::dvec3> sums(primitive.positions.size(), glm::dvec3(0.0));
    for (size_t corner = 0; corner + 2 < primitive.indices.size(); corner += 3) {
        const glm::dvec3 cross = face_cross(primitive, corner);
        for (size_t i = corner; i < corner + 3; ++i) {
            sums[primitive.indices[i]] += cross;
        }
    }
    for (size_t i = 0; i < sums.size(); ++i) {
        if (primitive.normals[i] == glm::vec3(0.0F)) {
            primitive.normals[i] = glm::vec3(unit_or(sums[i], glm::dvec3(0, 1, 0)));
        }
    }
    return bad;
}

void make_tangents(Primitive& primitive, uint32_t uv_set)
{
    const std::vector<glm::vec2>& uvs = primitive.uvs[uv_set];
    const size_t count = primitive.positions.size();
    std::vector<glm::dvec3> along_u(count, glm::dvec3(0.0));
    std::vector<glm::dvec3> along_v(count, glm::dvec3(0.0));
    for (size_t corner = 0; corner + 2 < primitive.indices.size(); corner += 3) {
        const uint32_t* index = &primitive.indices[corner];
        const glm::dvec3 edge_1 =
            glm::dvec3(primitive.positions[index[1]]) - glm::dvec3(primitive.positions[index[0]]);
        const glm::dvec3 edge_2 =
            glm::dvec3(primitive.positions[index[2]]) - glm::dvec3(primitive.positions[index[0]]);
        const glm::dvec2 uv_1 = glm::dvec2(uvs[index[1]]) - glm::dvec2(uvs[index[0]]);
        const glm::dvec2 uv_2 = glm::dvec2(uvs[index[2]]) - glm::dvec2(uvs[index[0]]);
        const double orientation = uv_1.x * uv_2.y - uv_2.x * uv_1.y < 0.0 ? -1.0 : 1.0;
        const double area = glm::length(glm::cross(edge_1, edge_2));
        const glm::dvec3 u = orientation * area * unit_or(edge_1 * uv_2.y - edge_2 * uv_1.y, glm::dvec3(0.0));
        const glm::dvec3 v = orientation * area * unit_or(edge_2 * uv_1.x - edge_1 * uv_2.x, glm::dvec3(0.0));
        for (size_t i = 0; i < 3; ++i) {
            along_u[index[i]] += u;
            along_v[index[i]] += v;
        }
    }
    primitive.tangents.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3 normal(primitive.normals[i]);
        const glm::dvec3 flat = along_u[i] - normal * glm::dot(normal, along_u[i]);
        const glm::dvec3 tangent = unit_or(flat, some_tangent(normal));
        const double sign = glm::dot(glm::cross(normal, tangent), along_v[i]) < 0.0 ? -1.0 : 1.0;
        primitive.tangents[i] = glm::vec4(glm::dvec4(tangent, sign));
    }
}

size_t normalise_weights(Primitive& primitive)
{
    size_t without_weight = 0;
    const bool two_sets = !primitive.weights_1.empty();
    for (size_t vertex = 0; vertex < primitive.weights_0.size(); ++vertex) {
        glm::vec4 none(0.0F);
        glm::u16vec4 nothing(0);
        glm::vec4* weights[] = {&primitive.weights_0[vertex],
                                two_sets ? &primitive.weights_1[vertex] : &none};
        glm::u16vec4* joints[] = {&primitive.joints_0[vertex],
                                  two_sets ? &primitive.joints_1[vertex] : &nothing};
        double sum = 0.0;
        for (int i = 0; i < 8; ++i) {
            float& weight = (*weights[i / 4])[i % 4];
            if (!std::isfinite(weight) || weight <= 0.0F) {
                weight = 0.0F;
            }
            sum += weight;
        }
        if (sum < 1e-6) {
            ++without_weight;
            *weights[0] = glm::vec4(1.0F, 0.0F, 0.0F, 0.0F);
            *weights[1] = glm::vec4(0.0F);
            sum = 1.0;
        }
        for (int i = 0; i < 8; ++i) {
            float& weight = (*weights[i / 4])[i % 4];
            weight = static_cast<float>(weight / sum);
            if (weight == 0.0F) {
                (*joints[i / 4])[i % 4] = 0;
            }
        }
    }
    return without_weight;
}

} // namespace estampe::gltf
