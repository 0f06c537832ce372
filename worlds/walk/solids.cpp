// SPDX-License-Identifier: MIT
#include "solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace walk {
namespace {

constexpr uint32_t triangles_a_box = 4;

glm::vec3 low_of(const Triangle& triangle)
{
    return glm::min(glm::min(triangle.a, triangle.b), triangle.c);
}

glm::vec3 high_of(const Triangle& triangle)
{
    return glm::max(glm::max(triangle.a, triangle.b), triangle.c);
}

/// Returns where the ray from `from` along `way` hits a triangle, as a multiple of `way` (Möller and
/// Trumbore); nothing if the ray misses the triangle.
std::optional<float> meets(const glm::vec3& from, const glm::vec3& way, const Triangle& triangle)
{
    const glm::vec3 ab = triangle.b - triangle.a;
    const glm::vec3 ac = triangle.c - triangle.a;
    const glm::vec3 p = glm::cross(way, ac);
    const float det = glm::dot(ab, p);
    if (det == 0.0F) {
        return std::nullopt;
    }
    const glm::vec3 off = from - triangle.a;
    const float u = glm::dot(off, p) / det;
    const glm::vec3 q = glm::cross(off, ab);
    const float v = glm::dot(way, q) / det;
    const float t = glm::dot(ac, q) / det;
    constexpr float edge = 1e-5F; // Tolerance, so that no ray passes between two adjacent triangles
    const bool is_met = u >= -edge && v >= -edge && u + v <= 1.0F + edge && t >= 0.0F && t <= 1.0F;
    return is_met ? std::optional(t) : std::nullopt;
}

/// Returns the point of a triangle that is nearest to the point `p`. Source: Ericson, "Real-Time Collision
/// Detection", 2005, 5.1.5.
glm::vec3 nearest_on_triangle(const glm::vec3& p, const Triangle& triangle)
{
    const auto& [a, b, c] = triangle;
    const glm::vec3 ab = b - a;
    const glm::vec3 ac = c - a;
    const float d1 = glm::dot(ab, p - a);
    const float d2 = glm::dot(ac, p - a);
    if (d1 <= 0.0F && d2 <= 0.0F) {
        return a;
    }
    const float d3 = glm::dot(ab, p - b);
    const float d4 = glm::dot(ac, p - b);
    if (d3 >= 0.0F && d4 <= d3) {
        return b;
    }
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0F && d1 >= 0.0F && d3 <= 0.0F) {
        return a + d1 / (d1 - d3) * ab;
    }
    const float d5 = glm::dot(ab, p - c);
    const float d6 = glm::dot(ac, p - c);
    if (d6 >= 0.0F && d5 <= d6) {
        return c;
    }
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0F && d2 >= 0.0F && d6 <= 0.0F) {
        return a + d2 / (d2 - d6) * ac;
    }
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0.0F && d4 - d3 >= 0.0F && d5 - d6 >= 0.0F) {
        return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    }
    const float whole = va + vb + vc;
    return a + vb / whole * ab + vc / whole * ac;
}

/// Returns the nearest points of two segments. Source: Ericson, "Real-Time Collision Detection", 2005, 5.1.9.
Nearest nearest_of_segments(const glm::vec3& p, const glm::vec3& p_end, const glm::vec3& q,
                            const glm::vec3& q_end)
{
    const glm::vec3 d1 = p_end - p;
    const glm::vec3 d2 = q_end - q;
    const glm::vec3 r = p - q;
    const float a = glm::dot(d1, d1);
    const float e = glm::dot(d2, d2);
    const float f = glm::dot(d2, r);
    constexpr float least = 1e-12F;
    float s = 0.0F;
    float t = 0.0F;
    if (a <= least && e <= least) {
        return {p, q};
    }
    if (a <= least) {
        t = std::clamp(f / e, 0.0F, 1.0F);
    } else if (const float c = glm::dot(d1, r); e <= least) {
        s = std::clamp(-c / a, 0.0F, 1.0F);
    } else {
        const float b = glm::dot(d1, d2);
        const float det = a * e - b * b;
        s = det > least * a * e ? std::clamp((b * f - c * e) / det, 0.0F, 1.0F) : 0.0F;
        t = (b * s + f) / e;
        if (t < 0.0F || t > 1.0F) {
            t = std::clamp(t, 0.0F, 1.0F);
            s = std::clamp((b * t - c) / a, 0.0F, 1.0F);
        }
    }
    return {p + s * d1, q + t * d2};
}

float distance_2(const Nearest& pair)
{
    const glm::vec3 way = pair.on_segment - pair.on_triangle;
    return glm::dot(way, way);
}

} // namespace

Nearest nearest(const glm::vec3& from, const glm::vec3& to, const Triangle& triangle)
{
    if (const std::optional<float> t = meets(from, to - from, triangle)) {
        const glm::vec3 place = from + *t * (to - from);
        return {place, place};
    }
    const std::array<Nearest, 5> pairs{{{from, nearest_on_triangle(from, triangle)},
                                        {to, nearest_on_triangle(to, triangle)},
                                        nearest_of_segments(from, to, triangle.a, triangle.b),
                                        nearest_of_segments(from, to, triangle.b, triangle.c),
                                        nearest_of_segments(from, to, triangle.c, triangle.a)}};
    return *std::ranges::min_element(pairs, {}, distance_2);
}

Solids::Solids(std::vector<Triangle> triangles) : triangles_(std::move(triangles))
{
    owners_.assign(triangles_.size(), 0);
    gone_.assign(1, false);
    build();
}

Solids::Solids(const estampe::Scene& scene, const std::function<bool(const estampe::Node& node)>& is_solid)
{
    const estampe::ScenePose pose = estampe::pose_scene(scene, 0.0, estampe::no_index);
    for (estampe::Index index = 0; index < scene.nodes.size(); ++index) {
        const estampe::Node& node = scene.nodes[index];
        if (node.mesh >= scene.meshes.size() || node.skin != estampe::no_index ||
            (is_solid && !is_solid(node))) {
            continue;
        }
        std::vector<glm::dmat4> places(node.instances.begin(), node.instances.end());
        if (places.empty()) {
            places.emplace_back(1.0);
        }
        for (const estampe::Primitive& part : scene.meshes[node.mesh].primitives) {
            if (part.topology != estampe::Topology::triangles || !part.morph_targets.empty() ||
                estampe::cloth_of(scene, node, part) != nullptr) {
                continue;
            }
            for (const glm::dmat4& place : places) {
                const glm::dmat4 world = pose.world_from_node[index] * place;
                const auto corner = [&](size_t i) {
                    return glm::vec3(world * glm::dvec4(part.positions[part.indices[i]], 1.0));
                };
                for (size_t i = 0; i + 2 < part.indices.size(); i += 3) {
                    triangles_.push_back({corner(i), corner(i + 1), corner(i + 2)});
                    owners_.push_back(index);
                }
            }
        }
    }
    gone_.assign(scene.nodes.size(), false);
    build();
}

void Solids::build()
{
    boxes_.clear();
    if (!triangles_.empty()) {
        boxes_.reserve(triangles_.size());
        std::vector<uint32_t> order(triangles_.size());
        std::iota(order.begin(), order.end(), 0U);
        // Sorts the triangles into a tree of boxes: splits the list at the median along the longest side of
        // the box around the triangles' centroids.
        const std::function<void(size_t, size_t)> sort = [&](size_t first, size_t last) {
            if (last - first <= triangles_a_box) {
                return;
            }
            const auto middle_of = [&](uint32_t i) {
                const Triangle& t = triangles_[i];
                return t.a + t.b + t.c;
            };
            glm::vec3 low(std::numeric_limits<float>::max());
            glm::vec3 high(-std::numeric_limits<float>::max());
            for (size_t i = first; i < last; ++i) {
                low = glm::min(low, middle_of(order[i]));
                high = glm::max(high, middle_of(order[i]));
            }
            const glm::vec3 size = high - low;
            const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
            const size_t half = first + (last - first) / 2;
            const auto at = [&](size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
            std::nth_element(at(first), at(half), at(last), [&](uint32_t i, uint32_t k) {
                const float a = middle_of(i)[axis];
                const float b = middle_of(k)[axis];
                return a < b || (a == b && i < k);
            });
            sort(first, half);
            sort(half, last);
        };
        sort(0, order.size());
        std::vector<Triangle> triangles;
        std::vector<estampe::Index> owners;
        triangles.reserve(order.size());
        owners.reserve(order.size());
        for (const uint32_t i : order) {
            triangles.push_back(triangles_[i]);
            owners.push_back(owners_[i]);
        }
        triangles_ = std::move(triangles);
        owners_ = std::move(owners);
        add_box(0, static_cast<uint32_t>(triangles_.size()));
    }
}

uint32_t Solids::add_box(uint32_t first, uint32_t last)
{
    const auto index = static_cast<uint32_t>(boxes_.size());
    boxes_.emplace_back();
    if (last - first <= triangles_a_box) {
        Box box{.low_m = low_of(triangles_[first]),
                .high_m = high_of(triangles_[first]),
                .first = first,
                .count = last - first};
        for (uint32_t i = first + 1; i < last; ++i) {
            box.low_m = glm::min(box.low_m, low_of(triangles_[i]));
            box.high_m = glm::max(box.high_m, high_of(triangles_[i]));
        }
        boxes_[index] = box;
        return index;
    }
    const uint32_t half = first + (last - first) / 2;
    const uint32_t left = add_box(first, half);
    const uint32_t right = add_box(half, last);
    boxes_[index] = {.low_m = glm::min(boxes_[left].low_m, boxes_[right].low_m),
                     .high_m = glm::max(boxes_[left].high_m, boxes_[right].high_m),
                     .first = right};
    return index;
}

template <typename Touches, typename Visit>
void Solids::search(const Touches& touches, const Visit& visit) const
{
    if (boxes_.empty()) {
        return;
    }
    // The tree is never deeper than this, because each split halves the triangles.
    std::array<uint32_t, 64> open{};
    size_t count = 1;
    while (count > 0) {
        const uint32_t index = open.at(--count);
        const Box& box = boxes_[index];
        if (!touches(box.low_m, box.high_m)) {
            continue;
        }
        if (box.count == 0) {
            open.at(count++) = box.first;
            open.at(count++) = index + 1;
            continue;
        }
        for (uint32_t i = box.first; i < box.first + box.count; ++i) {
            if (!gone_[owners_[i]]) {
                visit(triangles_[i]);
            }
        }
    }
}

void Solids::find(const glm::vec3& low_m, const glm::vec3& high_m, std::vector<Triangle>& found) const
{
    const auto touches = [&](const glm::vec3& low, const glm::vec3& high) {
        return glm::all(glm::lessThanEqual(low, high_m)) && glm::all(glm::greaterThanEqual(high, low_m));
    };
    search(touches, [&](const Triangle& triangle) {
        if (touches(low_of(triangle), high_of(triangle))) {
            found.push_back(triangle);
        }
    });
}

std::optional<Support> Solids::below(const glm::vec3& place_m, float reach_m) const
{
    std::optional<Support> highest;
    const glm::vec3 way(0.0F, -reach_m, 0.0F);
    search(
        [&](const glm::vec3& low, const glm::vec3& high) {
            return low.x <= place_m.x && high.x >= place_m.x && low.z <= place_m.z && high.z >= place_m.z &&
                   low.y <= place_m.y && high.y >= place_m.y - reach_m &&
                   (!highest || high.y > highest->height_m);
        },
        [&](const Triangle& triangle) {
            const glm::vec3 normal = glm::cross(triangle.b - triangle.a, triangle.c - triangle.a);
            const std::optional<float> t = normal.y > 0.0F ? meets(place_m, way, triangle) : std::nullopt;
            const float height_m = place_m.y - t.value_or(0.0F) * reach_m;
            if (t && (!highest || height_m > highest->height_m)) {
                highest = {height_m, glm::normalize(normal)};
            }
        });
    return highest;
}

bool Solids::blocks(const glm::vec3& from_m, const glm::vec3& to_m) const
{
    const glm::vec3 way = to_m - from_m;
    bool is_met = false;
    search(
        [&](const glm::vec3& low, const glm::vec3& high) {
            if (is_met) {
                return false;
            }
            float enters = 0.0F;
            float leaves = 1.0F;
            for (int axis = 0; axis < 3; ++axis) {
                if (way[axis] == 0.0F) {
                    if (from_m[axis] < low[axis] || from_m[axis] > high[axis]) {
                        return false;
                    }
                    continue;
                }
                const float a = (low[axis] - from_m[axis]) / way[axis];
                const float b = (high[axis] - from_m[axis]) / way[axis];
                enters = std::max(enters, std::min(a, b));
                leaves = std::min(leaves, std::max(a, b));
            }
            return enters <= leaves + 1e-4F;
        },
        [&](const Triangle& triangle) { is_met = is_met || meets(from_m, way, triangle).has_value(); });
    return is_met;
}

void Solids::set_gone(estampe::Index node, bool is_gone)
{
    if (node < gone_.size()) {
        gone_[node] = is_gone;
    }
}

} // namespace walk
