// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "techniques/pose/mesh_data.hpp"

namespace estampe::pose {
namespace {

constexpr size_t most_triangles = 1U << 16U; // of a primitive that is looked into at all
constexpr size_t most_tests = 1U << 24U;     // of a corner against a triangle's plane

/// Vertices in one place count as one, so that bodies whose corners were split along their edges stay whole.
std::vector<uint32_t> weld(const std::vector<glm::vec3>& positions)
{
    std::map<std::tuple<float, float, float>, uint32_t> places;
    std::vector<uint32_t> first_at;
    first_at.reserve(positions.size());
    for (const glm::vec3& p : positions) {
        first_at.push_back(
            places.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(first_at.size())).first->second);
    }
    return first_at;
}

uint32_t root_of(std::vector<uint32_t>& parents, uint32_t vertex)
{
    while (parents[vertex] != vertex) {
        parents[vertex] = parents[parents[vertex]];
        vertex = parents[vertex];
    }
    return vertex;
}

/// The parts of a primitive that hang together, as lists of corners, three a triangle.
std::vector<std::vector<uint32_t>> parts_of(const Primitive& primitive)
{
    const std::vector<uint32_t> welded = weld(primitive.positions);
    std::vector<uint32_t> parents(welded.size());
    std::iota(parents.begin(), parents.end(), 0U);
    const auto& indices = primitive.indices;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        for (const size_t k : {i + 1, i + 2}) {
            parents[root_of(parents, welded[indices[k]])] = root_of(parents, welded[indices[i]]);
        }
    }
    std::map<uint32_t, std::vector<uint32_t>> parts;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        auto& part = parts[root_of(parents, welded[indices[i]])];
        part.insert(part.end(), {welded[indices[i]], welded[indices[i + 1]], welded[indices[i + 2]]});
    }
    std::vector<std::vector<uint32_t>> result;
    result.reserve(parts.size());
    for (auto& [root, part] : parts) {
        result.push_back(std::move(part));
    }
    return result;
}

enum class Form : uint8_t { flat, convex, other };

/// Flat when all corners lie in the plane of every triangle, convex when all lie on one side of each, the
/// same side for all of them.
Form form_of(const std::vector<glm::vec3>& positions, const std::vector<uint32_t>& part)
{
    const std::set<uint32_t> corners(part.begin(), part.end());
    if (part.size() / 3 * corners.size() > most_tests) {
        return Form::other;
    }
    Bounds bounds;
    for (const uint32_t corner : corners) {
        bounds.extend(positions[corner]);
    }
    const double radius = bounds.radius();
    const double rounding = 1.2e-7 * (glm::length(bounds.center()) + radius); // of corners, in floats
    bool has_below = false;
    bool has_above = false;
    for (size_t i = 0; i < part.size() && !(has_below && has_above); i += 3) {
        const glm::dvec3 a(positions[part[i]]);
        const glm::dvec3 ab = glm::dvec3(positions[part[i + 1]]) - a;
        const glm::dvec3 ac = glm::dvec3(positions[part[i + 2]]) - a;
        const glm::dvec3 across = glm::cross(ab, ac);
        const double twice_area = glm::length(across);
        // The plane of a sliver is as good as unknown.
        const double breadth =
            twice_area / std::max({glm::length(ab), glm::length(ac), glm::length(ac - ab)});
        const double tolerance = 1e-5 * radius + 4.0 * radius * rounding / breadth;
        if (!(twice_area > 0.0)) {
            continue;
        }
        for (const uint32_t corner : corners) {
            const double height = glm::dot(across, glm::dvec3(positions[corner]) - a) / twice_area;
            has_below = has_below || height < -tolerance;
            has_above = has_above || height > tolerance;
        }
    }
    return has_below && has_above ? Form::other : has_below || has_above ? Form::convex : Form::flat;
}

} // namespace

uint32_t most_sheets(const Primitive& primitive, bool two_sided, uint32_t enough)
{
    const bool bends = !primitive.joints_0.empty() || !primitive.morph_targets.empty();
    if (bends || primitive.indices.size() > 3 * most_triangles) {
        return enough;
    }
    uint32_t sheets = 0;
    for (const std::vector<uint32_t>& part : parts_of(primitive)) {
        const Form form = form_of(primitive.positions, part);
        sheets += form == Form::flat ? 1 : form == Form::convex ? (two_sided ? 2 : 1) : enough;
        if (sheets >= enough) {
            return enough;
        }
    }
    return sheets;
}

} // namespace estampe::pose
