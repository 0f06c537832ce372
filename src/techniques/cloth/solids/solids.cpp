// SPDX-License-Identifier: MIT
#include "techniques/cloth/solids/solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <limits>
#include <thread>

#include "core/long_jobs.hpp"

namespace estampe::cloth {
namespace {

constexpr uint32_t margin_cells = 2;
constexpr uint32_t no_triangle = std::numeric_limits<uint32_t>::max();

using Triangle = std::array<glm::dvec3, 3>;

/// Squared distance from a point to a triangle, by finding whether a corner, a side or the face is nearest:
/// Ericson, "Real-Time Collision Detection", 2005, 5.1.5.
double squared_distance(const glm::dvec3& p, const Triangle& t)
{
    const glm::dvec3 ab = t[1] - t[0];
    const glm::dvec3 ac = t[2] - t[0];
    const auto to_segment = [&](const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 way = to - from;
        const double share = glm::dot(p - from, way) / std::max(glm::dot(way, way), 1e-300);
        const glm::dvec3 off = p - (from + glm::clamp(share, 0.0, 1.0) * way);
        return glm::dot(off, off);
    };
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double area2 = glm::dot(normal, normal);
    if (area2 > 0.0) {
        const glm::dvec3 ap = p - t[0];
        const double v = glm::dot(glm::cross(ap, ac), normal) / area2;
        const double w = glm::dot(glm::cross(ab, ap), normal) / area2;
        if (v >= 0.0 && w >= 0.0 && v + w <= 1.0) {
            const double off = glm::dot(ap, normal);
            return off * off / area2;
        }
    }
    return std::min({to_segment(t[0], t[1]), to_segment(t[1], t[2]), to_segment(t[2], t[0])});
}

/// A grid of signed distances during its computation. Positions are in cells from the first node.
class Making {
public:
    Making(const glm::uvec3& nodes, std::vector<Triangle>&& triangles)
        : nodes_(nodes), triangles_(std::move(triangles)), nearest_(count(), no_triangle),
          squared_(count(), std::numeric_limits<double>::infinity()), votes_(count(), 0)
    {
    }

    /// Computes exact distances at nodes next to triangles first. Every node farther away tests only the
    /// triangles that are nearest to the neighbouring nodes.
    void find_distances()
    {
        for (uint32_t i = 0; i < triangles_.size(); ++i) {
            const auto& [a, b, c] = triangles_[i];
            const glm::dvec3 last = glm::dvec3(nodes_) - 1.0;
            const glm::uvec3 from(glm::clamp(glm::floor(glm::min(a, glm::min(b, c)) - 1.0), {}, last));
            const glm::uvec3 to(glm::clamp(glm::ceil(glm::max(a, glm::max(b, c)) + 1.0), {}, last));
            for_box(from, to, [&](const glm::uvec3& at) { offer(at, i); });
        }
        for (int round = 0; round < 2; ++round) {
            for (uint32_t way = 0; way < 8; ++way) {
                sweep(way);
            }
        }
    }

    /// Finds the nodes inside the mesh: every crossing of a line along an axis switches between inside and
    /// outside.
    void find_inside()
    {
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            std::vector<std::vector<double>> crossings(size_t{nodes_[u]} * nodes_[v]);
            for (const Triangle& triangle : triangles_) {
                cross_lines(triangle, axis, crossings);
            }
            for (uint32_t j = 0; j < nodes_[v]; ++j) {
                for (uint32_t i = 0; i < nodes_[u]; ++i) {
                    auto& line = crossings[size_t{j} * nodes_[u] + i];
                    std::ranges::sort(line);
                    glm::uvec3 at(0);
                    at[u] = i;
                    at[v] = j;
                    size_t passed = 0;
                    for (at[axis] = 0; at[axis] < nodes_[axis]; ++at[axis]) {
                        while (passed < line.size() && line[passed] < at[axis]) {
                            ++passed;
                        }
                        votes_[index(at)] += static_cast<uint8_t>(passed % 2);
                    }
                }
            }
        }
    }

    [[nodiscard]] std::vector<float> signed_distances(double cell_m) const
    {
        std::vector<float> distances;
        distances.reserve(count());
        for (size_t i = 0; i < count(); ++i) {
            const double distance_m = cell_m * std::sqrt(squared_[i]);
            distances.push_back(static_cast<float>(votes_[i] >= 2 ? -distance_m : distance_m));
        }
        return distances;
    }

private:
    [[nodiscard]] size_t count() const { return size_t{nodes_.x} * nodes_.y * nodes_.z; }

    [[nodiscard]] size_t index(const glm::uvec3& at) const
    {
        return (size_t{at.z} * nodes_.y + at.y) * nodes_.x + at.x;
    }

    template <class Do>
    static void for_box(const glm::uvec3& from, const glm::uvec3& to, const Do& act)
    {
        for (uint32_t z = from.z; z <= to.z; ++z) {
            for (uint32_t y = from.y; y <= to.y; ++y) {
                for (uint32_t x = from.x; x <= to.x; ++x) {
                    act(glm::uvec3(x, y, z));
                }
            }
        }
    }

    void offer(const glm::uvec3& at, uint32_t triangle)
    {
        const size_t i = index(at);
        if (triangle == no_triangle || nearest_[i] == triangle) {
            return;
        }
        const double squared = squared_distance(glm::dvec3(at), triangles_[triangle]);
        if (squared < squared_[i]) {
            squared_[i] = squared;
            nearest_[i] = triangle;
        }
    }

    /// Passes over all nodes once. Each bit of `way` reverses the direction along one axis.
    void sweep(uint32_t way)
    {
        for_box(glm::uvec3(0), nodes_ - 1U, [&](const glm::uvec3& counted) {
            glm::uvec3 at = counted;
            for (int axis = 0; axis < 3; ++axis) {
                at[axis] = (way >> axis & 1U) != 0 ? nodes_[axis] - 1 - at[axis] : at[axis];
            }
            for (int axis = 0; axis < 3; ++axis) {
                const bool is_back = (way >> axis & 1U) != 0;
                if (counted[axis] > 0) {
                    glm::uvec3 beside = at;
                    beside[axis] += is_back ? 1U : ~0U;
                    offer(at, nearest_[index(beside)]);
                }
            }
        });
    }

    void cross_lines(const Triangle& triangle, int axis, std::vector<std::vector<double>>& crossings) const
    {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        // A small offset of lines, so that no line passes exactly through a corner or along a side.
        constexpr glm::dvec2 aside(1.237e-5, 2.911e-5);
        std::array<glm::dvec2, 3> flat{};
        for (size_t i = 0; i < 3; ++i) {
            flat.at(i) = glm::dvec2(triangle.at(i)[u], triangle.at(i)[v]) - aside;
        }
        const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
        const double area = cross(flat[1] - flat[0], flat[2] - flat[0]);
        if (area == 0.0) {
            return;
        }
        const glm::dvec2 last(nodes_[u] - 1, nodes_[v] - 1);
        const glm::dvec2 low = glm::ceil(glm::min(flat[0], glm::min(flat[1], flat[2])));
        const glm::dvec2 high = glm::floor(glm::max(flat[0], glm::max(flat[1], flat[2])));
        for (double j = std::max(low.y, 0.0); j <= std::min(high.y, last.y); ++j) {
            for (double i = std::max(low.x, 0.0); i <= std::min(high.x, last.x); ++i) {
                const glm::dvec2 at(i, j);
                const glm::dvec3 shares(cross(flat[2] - flat[1], at - flat[1]) / area,
                                        cross(flat[0] - flat[2], at - flat[2]) / area,
                                        cross(flat[1] - flat[0], at - flat[0]) / area);
                if (shares.x >= 0.0 && shares.y >= 0.0 && shares.z >= 0.0) {
                    const double along = shares.x * triangle[0][axis] + shares.y * triangle[1][axis] +
                                         shares.z * triangle[2][axis];
                    crossings[static_cast<size_t>(j) * nodes_[u] + static_cast<size_t>(i)].push_back(along);
                }
            }
        }
    }

    glm::uvec3 nodes_;
    std::vector<Triangle> triangles_;
    std::vector<uint32_t> nearest_;
    std::vector<double> squared_;
    std::vector<uint8_t> votes_; ///< per node: number of axes whose line says that the node is inside
};

} // namespace

SolidGrid grid_of_heights(glm::uvec2 nodes, glm::vec3 centre_m, glm::vec2 half_m,
                          const std::function<double(double x_m, double z_m)>& height_m)
{
    nodes = glm::max(nodes, 2U);
    SolidGrid grid{.nodes = {nodes.x, 1, nodes.y},
                   .centre_m = centre_m,
                   .half_m = {half_m.x, 1.0F, half_m.y},
                   .values_m = std::vector<float>(size_t{nodes.x} * nodes.y)};
    const auto fill_rows = [&](uint32_t from_z, uint32_t to_z) {
        for (uint32_t z = from_z; z < to_z; ++z) {
            for (uint32_t x = 0; x < nodes.x; ++x) {
                const glm::dvec2 share = 2.0 * glm::dvec2(x, z) / glm::dvec2(nodes - 1U) - 1.0;
                const glm::dvec2 at = glm::dvec2(centre_m.x, centre_m.z) + share * glm::dvec2(half_m);
                grid.values_m[size_t{z} * nodes.x + x] =
                    static_cast<float>(height_m(at.x, at.y) - double{centre_m.y});
            }
        }
    };
    constexpr uint32_t least_rows = 8;
    const uint32_t parts =
        std::clamp(std::thread::hardware_concurrency(), 1U, (nodes.y - 1U) / least_rows + 1U);
    std::vector<std::future<void>> rows;
    for (uint32_t part = 1; part < parts; ++part) {
        rows.push_back(
            std::async(launch_if_possible, fill_rows, nodes.y * part / parts, nodes.y * (part + 1U) / parts));
    }
    fill_rows(0, nodes.y / parts);
    for (std::future<void>& filled : rows) {
        filled.get();
    }
    return grid;
}

SolidGrid grid_of_distances(std::span<const glm::vec3> positions_m, std::span<const glm::uvec3> triangles,
                            uint32_t cells)
{
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    std::vector<Triangle> kept;
    for (const glm::uvec3& indices : triangles) {
        Triangle triangle;
        for (int i = 0; i < 3; ++i) {
            triangle.at(static_cast<size_t>(i)) = positions_m[indices[i]];
        }
        const glm::dvec3 sum = triangle[0] + triangle[1] + triangle[2];
        if (std::isfinite(sum.x) && std::isfinite(sum.y) && std::isfinite(sum.z)) {
            low = glm::min(low, glm::min(triangle[0], glm::min(triangle[1], triangle[2])));
            high = glm::max(high, glm::max(triangle[0], glm::max(triangle[1], triangle[2])));
            kept.push_back(triangle);
        }
    }
    const glm::dvec3 extent = high - low;
    const double longest_m = kept.empty() ? 0.0 : std::max({extent.x, extent.y, extent.z});
    if (!(longest_m > 0.0)) {
        return {};
    }
    const double cell_m = longest_m / std::max(cells, 1U);
    const glm::uvec3 nodes =
        glm::uvec3(glm::max(glm::ceil(extent / cell_m), glm::dvec3(1.0))) + 1U + 2 * margin_cells;
    const glm::dvec3 half_m = 0.5 * cell_m * glm::dvec3(nodes - 1U);
    const glm::dvec3 first_m = 0.5 * (low + high) - half_m;
    for (Triangle& triangle : kept) {
        for (glm::dvec3& corner : triangle) {
            corner = (corner - first_m) / cell_m;
        }
    }
    Making making(nodes, std::move(kept));
    making.find_distances();
    making.find_inside();
    return {.nodes = nodes,
            .centre_m = glm::vec3(0.5 * (low + high)),
            .half_m = glm::vec3(half_m),
            .values_m = making.signed_distances(cell_m)};
}

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

/// Axes of the ellipsoid that a matrix M makes of a sphere: the eigenvectors of M times its transpose, found
/// by Jacobi rotations.
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

/// Directions of a matrix's columns, made orthogonal, and the columns' lengths.
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
