// SPDX-License-Identifier: MIT
#include "scene/mending/triangulate.hpp"

#include <algorithm>
#include <cmath>

namespace estampe {
namespace {

/// Returns twice the signed area of a triangle; positive if the triangle is counter-clockwise.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Returns the normal of a polygon by Newell's method. The length of the normal is twice the area of the
/// polygon.
glm::dvec3 normal_of(std::span<const glm::dvec3> corners)
{
    glm::dvec3 normal(0.0);
    const glm::dvec3 origin = corners[0]; // subtracted from all corners, to keep precision far from zero
    for (size_t i = 1; i + 1 < corners.size(); ++i)
        normal += glm::cross(corners[i] - origin, corners[i + 1] - origin);
    return normal;
}

} // namespace

void Triangulation::fan(std::vector<uint32_t>& triangles) const
{
    for (size_t i = 1; i + 1 < kept_.size(); ++i)
        triangles.insert(triangles.end(), {kept_[0], kept_[i], kept_[i + 1]});
}

/// Projects the corners that are not cut off yet along a coordinate axis: the axis for which the projected
/// area is largest. The result is counter-clockwise.
void Triangulation::flatten(std::span<const glm::dvec3> corners)
{
    const glm::dvec3 normal = normal_of(corners);
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const double sign = normal[axis] < 0.0 ? -1.0 : 1.0;
    flat_.clear();
    for (const uint32_t corner : kept_)
        flat_.emplace_back(corners[corner][u] - corners[0][u], sign * (corners[corner][v] - corners[0][v]));
}

void Triangulation::cut(std::span<const glm::dvec3> corners, std::vector<uint32_t>& triangles)
{
    kept_.clear();
    for (uint32_t i = 0; i < corners.size(); ++i)
        if (kept_.empty() || corners[i] != corners[kept_.back()])
            kept_.push_back(i);
    while (kept_.size() > 1 && corners[kept_.back()] == corners[kept_.front()])
        kept_.pop_back();
    const size_t count = kept_.size();
    if (count <= 3) {
        fan(triangles);
        return;
    }
    flatten(corners);
    is_reflex_.assign(count, false);
    reflex_.clear();
    for (uint32_t i = 0; i < count; ++i) {
        const double left = turn(flat_[(i + count - 1) % count], flat_[i], flat_[(i + 1) % count]);
        if (left <= 0.0) {
            is_reflex_[i] = true;
            reflex_.push_back(i);
        }
    }
    const bool has_hollow = std::any_of(reflex_.begin(), reflex_.end(), [&](uint32_t i) {
        return turn(flat_[(i + count - 1) % count], flat_[i], flat_[(i + 1) % count]) < 0.0;
    });
    if (!has_hollow) {
        fan(triangles);
        return;
    }
    if (count == 4) { // at most one corner is reflex; a fan from this corner is valid
        const auto hollow =
            static_cast<std::ptrdiff_t>(*std::find_if(reflex_.begin(), reflex_.end(), [&](uint32_t i) {
                return turn(flat_[(i + 3) % 4], flat_[i], flat_[(i + 1) % 4]) < 0.0;
            }));
        std::rotate(kept_.begin(), kept_.begin() + hollow, kept_.end());
        fan(triangles);
        return;
    }
    clip_ears(triangles);
}

/// Returns whether the corner is an ear, which can be cut off: the corner is convex, and its triangle
/// contains no reflex corner.
bool Triangulation::is_ear(size_t at)
{
    if (is_reflex_[at])
        return false;
    const glm::dvec2 a = flat_[last_[at]];
    const glm::dvec2 b = flat_[at];
    const glm::dvec2 c = flat_[next_[at]];
    const glm::dvec2 low = glm::min(a, glm::min(b, c));
    const glm::dvec2 high = glm::max(a, glm::max(b, c));
    work_left_ -= std::min<uint64_t>(work_left_, reflex_.size());
    return std::none_of(reflex_.begin(), reflex_.end(), [&](uint32_t i) {
        const glm::dvec2& p = flat_[i];
        if (!is_reflex_[i] || p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y)
            return false;
        // A corner at the same position as a corner of the triangle does not count as inside. This happens
        // where a hole is joined to the outline.
        if (p == a || p == b || p == c)
            return false;
        return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    });
}

void Triangulation::clip_ears(std::vector<uint32_t>& triangles)
{
    const size_t count = kept_.size();
    next_.resize(count);
    last_.resize(count);
    for (size_t i = 0; i < count; ++i) {
        next_[i] = static_cast<uint32_t>((i + 1) % count);
        last_[i] = static_cast<uint32_t>((i + count - 1) % count);
    }
    size_t left = count;
    size_t tried = 0;
    uint32_t at = 0;
    bool is_clean = true;
    while (left > 3) {
        const bool gives_up = tried > left || work_left_ == 0;
        if (!gives_up && !is_ear(at)) {
            at = next_[at];
            ++tried;
            continue;
        }
        is_clean = is_clean && !gives_up;
        triangles.insert(triangles.end(), {kept_[last_[at]], kept_[at], kept_[next_[at]]});
        const uint32_t before = last_[at];
        const uint32_t behind = next_[at];
        next_[before] = behind;
        last_[behind] = before;
        is_reflex_[at] = false; // a corner that is cut off no longer prevents other corners from being ears
        for (const uint32_t i : {before, behind})
            if (is_reflex_[i] && turn(flat_[last_[i]], flat_[i], flat_[next_[i]]) > 0.0)
                is_reflex_[i] = false;
        --left;
        tried = 0;
        // Continues after the next corner, because cutting every other corner gives fewer slivers than a fan.
        at = next_[behind];
    }
    triangles.insert(triangles.end(), {kept_[last_[at]], kept_[at], kept_[next_[at]]});
    unclean_ += is_clean ? 0 : 1;
}

} // namespace estampe
