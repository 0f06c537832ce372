// SPDX-License-Identifier: MIT
#include "scene/input/origin.hpp"

#include <algorithm>
#include <cmath>

namespace estampe {
namespace {

constexpr double most_m = 1e15;           ///< as the mending of meshes has it
constexpr double furthest_of_file = 16.0; ///< distance from zero by extent
constexpr double furthest_of_object = 1024.0;

double largest(const glm::dvec3& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Zero, or a whole number near the centre when that is further than `furthest` extents from `origin`.
glm::dvec3 origin_of(const Bounds& bounds, const glm::dvec3& origin, double furthest)
{
    if (bounds.empty())
        return origin;
    const glm::dvec3 center = bounds.center();
    if (!(largest(center - origin) > furthest * largest(bounds.max - bounds.min)))
        return origin;
    // What is smaller than a unit keeps its fractions: its centre is rounded to a power of two below its
    // size.
    const double extent = largest(bounds.max - bounds.min);
    const double step = extent > 0.0 && extent < 1.0 ? std::exp2(std::floor(std::log2(extent))) : 1.0;
    return glm::round(center / step) * step;
}

} // namespace

glm::dvec3 file_origin(const Bounds& bounds)
{
    return origin_of(bounds, glm::dvec3(0.0), furthest_of_file);
}

glm::dvec3 object_origin(const Bounds& bounds, const glm::dvec3& file)
{
    return origin_of(bounds, file, furthest_of_object);
}

bool is_usable(const glm::dvec3& position)
{
    // Written so that NaN fails.
    return largest(position) < most_m && position.x == position.x && position.y == position.y &&
           position.z == position.z;
}

} // namespace estampe
