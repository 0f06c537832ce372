// SPDX-License-Identifier: MIT
#include "techniques/cloth/solids/colliders.hpp"

#include <algorithm>
#include <cmath>

namespace estampe::cloth {
namespace {

constexpr double least_half_m = 1e-4;

glm::quat turn_to(glm::vec3 y_axis)
{
    const glm::vec3 from(0.0F, 1.0F, 0.0F);
    const float cosine = glm::dot(from, y_axis);
    if (cosine < -0.999999F) {
        return {0.0F, 1.0F, 0.0F, 0.0F};
    }
    const glm::vec3 axis = glm::cross(from, y_axis);
    return glm::normalize(glm::quat(1.0F + cosine, axis.x, axis.y, axis.z));
}

bool keeps_sides(SolidKind kind)
{
    return kind == SolidKind::box || kind == SolidKind::distances || kind == SolidKind::seen;
}

/// The axes of an ellipsoid from what a ball became: eigenvectors of M M^T, by Jacobi's rotations.
struct Axes {
    glm::dmat3 directions{1.0};
    glm::dvec3 lengths{1.0};
};

Axes axes_of(const glm::dmat3& matrix)
{
    glm::dmat3 a = matrix * glm::transpose(matrix);
    Axes axes;
    for (int sweep = 0; sweep < 24; ++sweep) {
        const int p = sweep % 3 == 2 ? 1 : 0;
        const int q = sweep % 3 == 0 ? 1 : 2;
        if (std::abs(a[p][q]) < 1e-15 * (std::abs(a[p][p]) + std::abs(a[q][q])) || a[p][q] == 0.0) {
            continue;
        }
        const double angle = 0.5 * std::atan2(2.0 * a[p][q], a[q][q] - a[p][p]);
        glm::dmat3 turn(1.0);
        turn[p][p] = turn[q][q] = std::cos(angle);
        turn[q][p] = std::sin(angle);
        turn[p][q] = -std::sin(angle);
        a = glm::transpose(turn) * a * turn;
        axes.directions = axes.directions * turn;
    }
    for (int i = 0; i < 3; ++i) {
        axes.lengths[i] = std::sqrt(std::max(a[i][i], 0.0));
    }
    if (glm::determinant(axes.directions) < 0.0) {
        axes.directions[0] = -axes.directions[0];
    }
    return axes;
}

/// Directions of a matrix's columns, made orthogonal, and their lengths.
Axes columns_of(const glm::dmat3& matrix)
{
    Axes axes;
    for (int i = 0; i < 3; ++i) {
        axes.lengths[i] = glm::length(matrix[i]);
    }
    const auto unit = [](const glm::dvec3& v, const glm::dvec3& otherwise) {
        const double length = glm::length(v);
        return length > 1e-12 ? v / length : otherwise;
    };
    const glm::dvec3 y = unit(matrix[1], {0.0, 1.0, 0.0});
    const glm::dvec3 aside = std::abs(y.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 z = unit(glm::cross(matrix[0], y), glm::normalize(glm::cross(aside, y)));
    axes.directions = {glm::cross(y, z), y, z};
    return axes;
}

} // namespace

Solid below(glm::vec3 point_m, glm::vec3 normal)
{
    return {.kind = SolidKind::plane, .centre_m = point_m, .rotation = turn_to(glm::normalize(normal))};
}

Solid ball(glm::vec3 centre_m, float radius_m)
{
    return {.kind = SolidKind::ellipsoid, .half_m = glm::vec3(radius_m), .centre_m = centre_m};
}

Solid capsule_between(glm::vec3 from_m, glm::vec3 to_m, float radius_m)
{
    const glm::vec3 way = to_m - from_m;
    const float length_m = glm::length(way);
    return {.kind = SolidKind::capsule,
            .half_m = {radius_m, 0.5F * length_m, radius_m},
            .centre_m = 0.5F * (from_m + to_m),
            .rotation = length_m > 0.0F ? turn_to(way / length_m) : glm::quat(1.0F, 0.0F, 0.0F, 0.0F)};
}

Solid placed(const Solid& solid, const glm::dmat4& place)
{
    const glm::dmat3 own = glm::dmat3(place) * glm::dmat3(glm::mat3_cast(glm::dquat(solid.rotation)));
    Solid result = solid;
    result.centre_m = glm::vec3(glm::dvec3(place * glm::dvec4(glm::dvec3(solid.centre_m), 1.0)));
    glm::dvec3 half = solid.half_m;
    Axes axes;
    if (solid.kind == SolidKind::ellipsoid) {
        const glm::dmat3 from_ball(own[0] * half.x, own[1] * half.y, own[2] * half.z);
        axes = axes_of(from_ball);
        half = axes.lengths;
    } else {
        axes = columns_of(own);
        const double across = std::max(axes.lengths.x, axes.lengths.z);
        half *= keeps_sides(solid.kind) ? axes.lengths : glm::dvec3(across, axes.lengths.y, across);
    }
    result.half_m = glm::vec3(glm::max(half, glm::dvec3(least_half_m)));
    result.rotation = glm::quat(glm::normalize(glm::quat_cast(axes.directions)));
    return result;
}

Solid solid_of_grid(SolidKind kind, const SolidGrid& grid, uint32_t number)
{
    return {.kind = kind, .half_m = grid.half_m, .centre_m = grid.centre_m, .grid = number};
}

void turn_alike(shared::ClothCollider& before, const shared::ClothCollider& after)
{
    if (before.rotation == after.rotation) {
        return;
    }
    if (after.kind != shared::cloth_capsule) {
        before.rotation *= glm::dot(before.rotation, after.rotation) < 0.0F ? -1.0F : 1.0F;
        return;
    }
    const auto quaternion = [](const glm::vec4& v) { return glm::quat(v.w, v.x, v.y, v.z); };
    const glm::vec3 y_axis(0.0F, 1.0F, 0.0F);
    const glm::quat now = quaternion(after.rotation);
    const glm::quat back = turn_to(glm::inverse(now) * (quaternion(before.rotation) * y_axis));
    const glm::quat was = now * back;
    before.rotation = {was.x, was.y, was.z, was.w};
}

shared::ClothCollider as_shared(const Solid& solid, uint32_t first_of_grid)
{
    constexpr float everywhere_m = 1e30F;
    float reach_m = everywhere_m;
    auto kind = static_cast<uint32_t>(solid.kind);
    if (kind >= shared::cloth_heights) {
        kind |= first_of_grid << shared::cloth_kind_bits;
    }
    if (solid.kind == SolidKind::ellipsoid) {
        reach_m = std::max({solid.half_m.x, solid.half_m.y, solid.half_m.z});
    } else if (keeps_sides(solid.kind)) {
        reach_m = glm::length(solid.half_m);
    } else if (solid.kind == SolidKind::cylinder) {
        reach_m = glm::length(glm::vec2(solid.half_m));
    } else if (solid.kind == SolidKind::capsule) {
        reach_m = solid.half_m.x + solid.half_m.y;
    }
    return {.centre_m = solid.centre_m,
            .kind = kind,
            .rotation = {solid.rotation.x, solid.rotation.y, solid.rotation.z, solid.rotation.w},
            .half_m = solid.half_m,
            .reach_m = reach_m};
}

} // namespace estampe::cloth
