// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/view_analysis/subject.hpp"

namespace estampe {
namespace {

constexpr size_t slice_count = 40;

/// What lies at one height of a subject, in its height.
struct Slice {
    double left = 0.0, right = 0.0, back = 0.0, front = 0.0;
    bool is_empty = true;

    void add(double x, double z)
    {
        left = is_empty ? x : std::min(left, x);
        right = is_empty ? x : std::max(right, x);
        back = is_empty ? z : std::min(back, z);
        front = is_empty ? z : std::max(front, z);
        is_empty = false;
    }

    [[nodiscard]] double width() const { return right - left; }

    [[nodiscard]] double depth() const { return front - back; }

    [[nodiscard]] double middle() const { return 0.5 * (left + right); }
};

using Slices = std::array<Slice, slice_count>;

Slices slices_of(const SurfaceCloud& cloud)
{
    Slices slices;
    const double height = cloud.bounds.max.y - cloud.bounds.min.y;
    const glm::dvec3 foot(cloud.bounds.center().x, cloud.bounds.min.y, cloud.bounds.center().z);
    for (const SurfacePoint& point : cloud.points) {
        const glm::dvec3 p = (glm::dvec3(point.position) + cloud.origin - foot) / height;
        const double level = std::clamp(p.y * slice_count, 0.0, slice_count - 1.0);
        slices[static_cast<size_t>(level)].add(p.x, p.z);
    }
    return slices;
}

bool is_round(const Slices& slices)
{
    double difference = 0.0;
    double size = 0.0;
    for (const Slice& slice : slices) {
        difference += std::abs(slice.width() - slice.depth());
        size += slice.width() + slice.depth();
    }
    constexpr double nearly_round = 0.1;
    return difference < nearly_round * size;
}

double widest(const Slices& slices, size_t from, size_t to)
{
    double width = 0.0;
    for (size_t i = from; i < to; ++i)
        width = std::max(width, slices[i].width());
    return width;
}

double deepest(const Slices& slices, size_t from, size_t to)
{
    double depth = 0.0;
    for (size_t i = from; i < to; ++i)
        depth = std::max(depth, slices[i].depth());
    return depth;
}

/// The height of the neck in the subject's: the narrowest place, with a head above it that is neither flat
/// nor far aside.
std::optional<double> neck(const Slices& slices)
{
    constexpr size_t lowest = slice_count * 2 / 5;
    constexpr size_t highest = slice_count - 3;
    constexpr double narrower = 0.8;
    constexpr double aside = 0.1;
    std::optional<size_t> found;
    for (size_t i = lowest; i < highest; ++i) {
        const double head = widest(slices, i + 1, slice_count);
        const double body = widest(slices, 0, i);
        const double head_depth = deepest(slices, i + 1, slice_count);
        const bool is_head = head_depth > 0.5 * head && head_depth < 2.2 * head && head > 0.25 * body;
        if (!slices[i].is_empty && is_head && slices[i].width() <= narrower * std::min(head, body) &&
            std::abs(slices[i].middle()) < aside && std::abs(slices[slice_count - 1].middle()) < aside &&
            (!found || slices[i].width() < slices[*found].width()))
            found = i;
    }
    return found ? std::optional((static_cast<double>(*found) + 0.5) / slice_count) : std::nullopt;
}

/// Whether skeletons move more than half of all vertices.
bool is_skinned(const Scene& scene)
{
    size_t skinned = 0;
    size_t all = 0;
    for (const Node& node : scene.nodes) {
        if (node.mesh >= scene.meshes.size())
            continue;
        for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
            all += primitive.positions.size();
            skinned += node.skin != no_index ? primitive.positions.size() : 0;
        }
    }
    return 2 * skinned > all;
}

} // namespace

std::optional<double> eye_level(const Scene& scene, const SurfaceCloud& inside)
{
    constexpr size_t fewest_points = 1024;
    const glm::dvec3 size = inside.bounds.max - inside.bounds.min;
    if (inside.points.size() < fewest_points || !(size.y > 1.25 * size.z))
        return std::nullopt;
    const Slices slices = slices_of(inside);
    const std::optional<double> found =
        size.y > 1.25 * size.x && !is_round(slices) ? neck(slices) : std::nullopt;
    constexpr double human_neck = 0.87; // of the height
    // With arms held out a person is as wide as high.
    if (!found && !(is_skinned(scene) && size.y > 0.85 * size.x && size.y > 1.5 * size.z))
        return std::nullopt;
    return glm::mix(inside.bounds.min.y, inside.bounds.max.y, 0.5 * (1.0 + found.value_or(human_neck)));
}

} // namespace estampe
