// SPDX-License-Identifier: MIT
#include "scene/smooth_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>
#include <vector>

namespace estampe {

glm::dvec3 second_form(const std::array<SideChange, 3>& sides, double least_determinant)
{
    glm::dmat3 squares(0.0);
    glm::dvec3 right(0.0);
    for (const SideChange& side : sides) {
        const glm::dvec3 row_x(side.place.x, side.place.y, 0.0);
        const glm::dvec3 row_y(0.0, side.place.x, side.place.y);
        squares += glm::outerProduct(row_x, row_x) + glm::outerProduct(row_y, row_y);
        right += row_x * side.normal.x + row_y * side.normal.y;
    }
    const double size = squares[0][0] + squares[2][2];
    const bool is_sound = std::abs(glm::determinant(squares)) > least_determinant * size * size * size;
    return is_sound ? glm::inverse(squares) * right : glm::dvec3(0.0);
}

namespace {

struct Cage {
    std::vector<glm::dvec3> points;
    std::vector<std::array<uint32_t, 3>> triangles;
};

struct Edge {
    uint32_t midpoint = 0;
    uint32_t triangle_count = 0;
    glm::dvec3 opposite_sum{0.0};
};

uint64_t key_of(uint32_t a, uint32_t b)
{
    return uint64_t{std::min(a, b)} << 32U | std::max(a, b);
}

Cage welded(const Primitive& primitive)
{
    const auto comes_before = [](const glm::vec3& a, const glm::vec3& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    };
    std::map<glm::vec3, uint32_t, decltype(comes_before)> numbers(comes_before);
    Cage cage;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        std::array<uint32_t, 3> corners{};
        for (size_t k = 0; k < 3; ++k) {
            const glm::vec3& position = primitive.positions[primitive.indices[i + k]];
            const auto [entry, is_new] =
                numbers.try_emplace(position, static_cast<uint32_t>(cage.points.size()));
            if (is_new) {
                cage.points.emplace_back(position);
            }
            corners[k] = entry->second;
        }
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) {
            cage.triangles.push_back(corners);
        }
    }
    return cage;
}

/// Returns the weight of each neighbour of a vertex with `valence` neighbours, in Loop subdivision.
double neighbor_weight(uint32_t valence)
{
    const double cosine = 0.375 + 0.25 * std::cos(2.0 * std::numbers::pi / valence);
    return (0.625 - cosine * cosine) / valence;
}

/// Moves the old vertices in a subdivision step: inner vertices move towards all their neighbours, border
/// vertices only towards their neighbours on the border.
void move_points(Cage& cage, const std::unordered_map<uint64_t, Edge>& edges, size_t point_count)
{
    struct Around {
        glm::dvec3 sum{0.0};
        uint32_t count = 0;
        glm::dvec3 border_sum{0.0};
        uint32_t border_count = 0;
    };

    std::vector<Around> around(point_count);
    const auto add = [&](uint32_t at, uint32_t neighbor, bool is_border) {
        around[at].sum += cage.points[neighbor];
        ++around[at].count;
        around[at].border_sum += is_border ? cage.points[neighbor] : glm::dvec3(0.0);
        around[at].border_count += is_border ? 1U : 0U;
    };
    std::vector<uint64_t> keys;
    keys.reserve(edges.size());
    for (const auto& entry : edges) {
        keys.push_back(entry.first);
    }
    std::sort(keys.begin(), keys.end()); // a fixed order makes the sums deterministic
    for (const uint64_t key : keys) {
        const auto a = static_cast<uint32_t>(key >> 32U);
        const auto b = static_cast<uint32_t>(key);
        const bool is_border = edges.at(key).triangle_count != 2;
        add(a, b, is_border);
        add(b, a, is_border);
    }
    for (size_t i = 0; i < point_count; ++i) {
        const Around& ring = around[i];
        if (ring.border_count == 2) {
            cage.points[i] = 0.75 * cage.points[i] + 0.125 * ring.border_sum;
        } else if (ring.border_count == 0 && ring.count >= 3) {
            const double weight = neighbor_weight(ring.count);
            cage.points[i] = (1.0 - weight * ring.count) * cage.points[i] + weight * ring.sum;
        }
    }
}

void divide(Cage& cage)
{
    std::unordered_map<uint64_t, Edge> edges;
    edges.reserve(2 * cage.triangles.size());
    for (const auto& corners : cage.triangles) {
        for (size_t k = 0; k < 3; ++k) {
            Edge& edge = edges[key_of(corners[k], corners[(k + 1) % 3])];
            ++edge.triangle_count;
            edge.opposite_sum += cage.points[corners[(k + 2) % 3]];
        }
    }
    const size_t point_count = cage.points.size();
    std::vector<std::array<uint32_t, 3>> finer;
    finer.reserve(4 * cage.triangles.size());
    std::vector<glm::dvec3> midpoints;
    midpoints.reserve(edges.size());
    for (const auto& corners : cage.triangles) {
        std::array<uint32_t, 3> middle{};
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = corners[k];
            const uint32_t b = corners[(k + 1) % 3];
            Edge& edge = edges[key_of(a, b)];
            if (edge.midpoint == 0) {
                const glm::dvec3 ends = cage.points[a] + cage.points[b];
                midpoints.push_back(edge.triangle_count == 2 ? 0.375 * ends + 0.125 * edge.opposite_sum
                                                             : 0.5 * ends);
                edge.midpoint = static_cast<uint32_t>(point_count + midpoints.size() - 1);
            }
            middle[k] = edge.midpoint;
        }
        finer.push_back({corners[0], middle[0], middle[2]});
        finer.push_back({middle[0], corners[1], middle[1]});
        finer.push_back({middle[2], middle[1], corners[2]});
        finer.push_back(middle);
    }
    move_points(cage, edges, point_count);
    cage.points.insert(cage.points.end(), midpoints.begin(), midpoints.end());
    cage.triangles = std::move(finer);
}

} // namespace

Primitive subdivided(const Primitive& primitive, uint32_t levels)
{
    Cage cage = welded(primitive);
    for (uint32_t level = 0; level < levels; ++level) {
        divide(cage);
    }
    std::vector<glm::dvec3> normals(cage.points.size(), glm::dvec3(0.0));
    Primitive result;
    result.material = primitive.material;
    result.indices.reserve(3 * cage.triangles.size());
    for (const auto& c : cage.triangles) {
        const glm::dvec3 normal =
            glm::cross(cage.points[c[1]] - cage.points[c[0]], cage.points[c[2]] - cage.points[c[0]]);
        for (const uint32_t corner : c) {
            normals[corner] += normal;
            result.indices.push_back(corner);
        }
    }
    result.positions.assign(cage.points.begin(), cage.points.end());
    result.normals.reserve(normals.size());
    for (const glm::dvec3& normal : normals) {
        const double length = glm::length(normal);
        result.normals.emplace_back(length > 0.0 ? normal / length : glm::dvec3(0.0, 1.0, 0.0));
    }
    return result;
}

} // namespace estampe
