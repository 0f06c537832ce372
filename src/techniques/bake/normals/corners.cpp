// SPDX-License-Identifier: MIT
#include "techniques/bake/normals/corners.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <unordered_map>

namespace estampe::bake {
namespace {

glm::dvec3 unit_or(const glm::dvec3& vector, const glm::dvec3& other)
{
    const double length = glm::length(vector);
    return length > 1e-30 ? vector / length : other;
}

/// Normals of the vertices of a primitive in world space, after morphing and skinning.
std::vector<glm::vec3> posed_normals(const PosedPrimitive& posed, const std::vector<float>& morph_weights)
{
    const Primitive& primitive = *posed.primitive;
    std::vector<glm::vec3> normals(primitive.positions.size(), glm::vec3(0.0F, 1.0F, 0.0F));
    glm::dmat3 turned(1.0);
    for (size_t i = 0; i < std::min(normals.size(), primitive.normals.size()); ++i) {
        glm::dvec3 normal(primitive.normals[i]);
        for (size_t k = 0; k < std::min(morph_weights.size(), primitive.morph_targets.size()); ++k) {
            const std::vector<glm::vec3>& offsets = primitive.morph_targets[k].normal_offsets;
            if (i < offsets.size()) {
                normal += static_cast<double>(morph_weights[k]) * glm::dvec3(offsets[i]);
            }
        }
        if (i == 0 || !posed.joints.empty()) {
            const glm::dmat3 linear(world_from_vertex(posed, i));
            const bool is_singular = glm::determinant(linear) == 0.0;
            turned = is_singular ? linear : glm::transpose(glm::inverse(linear));
        }
        normals[i] = glm::vec3(unit_or(turned * normal, {0.0, 1.0, 0.0}));
    }
    return normals;
}

/// Calls `visit` with each set of corners whose keys are equal. `key_of` returns an array of numbers.
template <class KeyOf, class Visit>
void visit_equal(size_t count, const KeyOf& key_of, const Visit& visit)
{
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, {}, key_of);
    for (size_t first = 0; first < count;) {
        size_t end = first + 1;
        while (end < count && key_of(order[end]) == key_of(order[first])) {
            ++end;
        }
        visit(std::span<const uint32_t>(order).subspan(first, end - first));
        first = end;
    }
}

glm::dvec3 place(const Corners& corners, size_t corner)
{
    return glm::dvec3(corners.positions[corner]);
}

/// Component of a vector at a right angle to a unit vector.
glm::dvec3 across(const glm::dvec3& vector, const glm::dvec3& unit)
{
    return vector - unit * glm::dot(unit, vector);
}

/// Angle of a triangle at one of its corners, seen along `axis`; with the axis 0, in the triangle's plane.
double angle_at(const Corners& corners, size_t corner, const glm::dvec3& axis = glm::dvec3(0.0))
{
    const size_t first = corner / 3 * 3;
    const size_t k = corner - first;
    const glm::dvec3 here = place(corners, corner);
    const auto side = [&](size_t other) {
        return unit_or(across(place(corners, first + other % 3) - here, axis), glm::dvec3(0.0));
    };
    return std::acos(std::clamp(glm::dot(side(k + 1), side(k + 2)), -1.0, 1.0));
}

/// The directions in which u and v of a triangle grow, times twice the area of the triangle's UVs; negative
/// for mirrored UVs.
struct UvEdges {
    UvEdges(const Corners& corners, size_t triangle)
    {
        const size_t first = 3 * triangle;
        const glm::dvec3 edge_1 = place(corners, first + 1) - place(corners, first);
        const glm::dvec3 edge_2 = place(corners, first + 2) - place(corners, first);
        const glm::dvec2 uv_1 = glm::dvec2(corners.uvs[first + 1]) - glm::dvec2(corners.uvs[first]);
        const glm::dvec2 uv_2 = glm::dvec2(corners.uvs[first + 2]) - glm::dvec2(corners.uvs[first]);
        u_edge = edge_1 * uv_2.x - edge_2 * uv_1.x;
        v_edge = edge_1 * uv_2.y - edge_2 * uv_1.y;
        plane = glm::cross(edge_1, edge_2);
        longest_2 = std::max(glm::dot(edge_1, edge_1), glm::dot(edge_2, edge_2));
        uv_area = uv_1.x * uv_2.y - uv_2.x * uv_1.y;
    }

    glm::dvec3 u_edge; ///< along a line of equal u
    glm::dvec3 v_edge; ///< along a line of equal v
    glm::dvec3 plane;  ///< normal of the plane, as long as twice the area
    double longest_2;  ///< square of the longer edge
    double uv_area;    ///< negative if u and v are clockwise on the front
};

/// Divides the corners at one vertex into fans of triangles that share edges. Returns for each corner the
/// index in `equal` of one corner of its fan.
std::vector<uint32_t> fans_of(const std::vector<uint32_t>& vertex_of, std::span<const uint32_t> equal)
{
    const auto neighbour = [&](uint32_t corner, uint32_t step) {
        return vertex_of[corner / 3 * 3 + (corner % 3 + step) % 3];
    };
    std::vector<uint32_t> fans(equal.size());
    std::iota(fans.begin(), fans.end(), 0U);
    const auto root = [&](uint32_t i) {
        while (fans[i] != i) {
            i = fans[i] = fans[fans[i]];
        }
        return i;
    };
    std::unordered_map<uint32_t, uint32_t> begins_with; // fans by the first of the two outer vertices
    for (uint32_t i = 0; i < equal.size(); ++i) {
        begins_with.emplace(neighbour(equal[i], 1), i);
    }
    for (uint32_t i = 0; i < equal.size(); ++i) {
        if (const auto next = begins_with.find(neighbour(equal[i], 2)); next != begins_with.end()) {
            fans[root(i)] = root(next->second);
        }
    }
    for (uint32_t i = 0; i < equal.size(); ++i) {
        fans[i] = root(i);
    }
    return fans;
}

} // namespace

Corners corners_of(const Scene& scene, const ScenePose& pose, const glm::dvec3& anchor,
                   const UvSetOf& uv_set_of)
{
    Corners corners;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        const Primitive& primitive = *posed.primitive;
        if (primitive.topology != Topology::triangles) {
            return;
        }
        const std::optional<uint32_t> uv_set = uv_set_of(posed);
        if (!uv_set) {
            return;
        }
        const std::vector<glm::vec2>& uvs = primitive.uvs[*uv_set];
        const std::vector<glm::vec3> normals = posed_normals(posed, pose.morph_weights[posed.node]);
        for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            corners.materials.push_back(primitive.material);
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t vertex = primitive.indices[i + (posed.mirrored ? 2 - k : k)];
                corners.positions.emplace_back(posed.positions[vertex] - anchor);
                corners.normals.push_back(normals[vertex]);
                corners.uvs.push_back(vertex < uvs.size() ? uvs[vertex] : glm::vec2(0.0F));
            }
        }
    });
    return corners;
}

std::vector<glm::vec3> smooth_normals(const Corners& corners)
{
    std::vector<glm::vec3> result(corners.normals);
    const auto key_of = [&](uint32_t corner) {
        const glm::vec3& p = corners.positions[corner];
        return std::array{p.x, p.y, p.z};
    };
    visit_equal(result.size(), key_of, [&](std::span<const uint32_t> equal) {
        glm::dvec3 sum(0.0);
        for (const uint32_t corner : equal) {
            sum += angle_at(corners, corner) * glm::dvec3(corners.normals[corner]);
        }
        // Two sheets back to back have opposite normals; each sheet then keeps its own.
        if (glm::length(sum) > 1e-3) {
            for (const uint32_t corner : equal) {
                result[corner] = glm::vec3(glm::normalize(sum));
            }
        }
    });
    return result;
}

std::vector<glm::vec4> vertex_tangents(const Corners& corners)
{
    constexpr double least_area = 1e-10; // relative to the edges; a thinner triangle has no direction
    std::vector<glm::vec4> result(corners.normals.size(), glm::vec4(1.0F));
    std::vector<float> signs;
    std::vector<glm::dvec3> along_u;
    for (size_t triangle = 0; triangle < corners.count(); ++triangle) {
        const UvEdges edges(corners, triangle);
        // The UVs of glTF run down the picture, so upright UVs have a negative area.
        const double sign = edges.uv_area < 0.0 ? 1.0 : -1.0;
        signs.push_back(static_cast<float>(sign));
        along_u.push_back(glm::length(edges.plane) > least_area * edges.longest_2 ? -sign * edges.v_edge
                                                                                  : glm::dvec3(0.0));
    }
    const auto key_of = [&](uint32_t corner) {
        const glm::vec3& p = corners.positions[corner];
        const glm::vec3& n = corners.normals[corner];
        const glm::vec2& uv = corners.uvs[corner];
        return std::array{p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y, signs[corner / 3]};
    };
    std::vector<uint32_t> vertex_of(result.size());
    uint32_t vertices = 0;
    visit_equal(result.size(), key_of, [&](std::span<const uint32_t> equal) {
        for (const uint32_t corner : equal) {
            vertex_of[corner] = vertices;
        }
        ++vertices;
    });
    visit_equal(result.size(), key_of, [&](std::span<const uint32_t> equal) {
        const glm::dvec3 normal(corners.normals[equal.front()]);
        const glm::dvec3 axis =
            std::abs(normal.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
        const std::vector<uint32_t> fans = fans_of(vertex_of, equal);
        std::vector<glm::dvec3> sums(equal.size(), glm::dvec3(0.0));
        for (size_t i = 0; i < equal.size(); ++i) {
            sums[fans[i]] += angle_at(corners, equal[i], normal) *
                             unit_or(across(along_u[equal[i] / 3], normal), glm::dvec3(0.0));
        }
        for (size_t i = 0; i < equal.size(); ++i) {
            const glm::dvec3 tangent = unit_or(sums[fans[i]], glm::normalize(across(axis, normal)));
            result[equal[i]] = glm::vec4(glm::vec3(tangent), signs[equal[i] / 3]);
        }
    });
    return result;
}

glm::dmat3 triangle_frame(const Corners& corners, size_t triangle, const glm::dvec3& normal)
{
    const UvEdges edges(corners, triangle);
    const glm::dvec3 along = glm::cross(normal, edges.u_edge);
    const glm::dvec3 up = -glm::cross(normal, edges.v_edge);
    const double longest = std::max(glm::length(along), glm::length(up));
    if (longest <= 0.0) {
        return {glm::dvec3(0.0), glm::dvec3(0.0), normal};
    }
    const double scale = (glm::dot(edges.plane, normal) < 0.0 ? -1.0 : 1.0) / longest;
    return {scale * along, scale * up, normal};
}

glm::dmat3 vertex_frame(const glm::dvec4& tangent, const glm::dvec3& normal)
{
    const glm::dvec3 along = unit_or(glm::dvec3(tangent), glm::dvec3(0.0));
    return {along, (tangent.w < 0.0 ? -1.0 : 1.0) * glm::cross(normal, along), normal};
}

glm::dvec3 in_frame(const glm::dmat3& frame, const glm::dvec3& normal)
{
    return std::abs(glm::determinant(frame)) > 1e-9 ? glm::normalize(glm::inverse(frame) * normal)
                                                    : glm::dvec3(0.0, 0.0, 1.0);
}

} // namespace estampe::bake
