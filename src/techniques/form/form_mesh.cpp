// SPDX-License-Identifier: MIT
#include "techniques/form/form_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace estampe::form {
namespace {

constexpr double crease_cosine = 0.70710678;

bool is_finite(const glm::vec3& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool comes_before(const glm::vec3& a, const glm::vec3& b)
{
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// Returns for each vertex the first vertex at an equal position; `none` if the vertex's place is not finite.
std::vector<uint32_t> weld(std::span<const glm::vec3> positions)
{
    std::vector<uint32_t> order;
    order.reserve(positions.size());
    for (uint32_t i = 0; i < positions.size(); ++i) {
        if (is_finite(positions[i])) {
            order.push_back(i);
        }
    }
    std::sort(order.begin(), order.end(), [&](uint32_t i, uint32_t j) {
        return positions[i] == positions[j] ? i < j : comes_before(positions[i], positions[j]);
    });
    std::vector<uint32_t> first(positions.size(), none);
    for (size_t i = 0; i < order.size(); ++i) {
        const bool is_same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        first[order[i]] = is_same ? first[order[i - 1]] : order[i];
    }
    return first;
}

class Builder {
public:
    explicit Builder(std::span<const glm::vec3> positions) : positions_(positions) {}

    Mesh run(std::span<const uint32_t> indices)
    {
        find_scale(indices);
        take_triangles(indices);
        find_twins();
        split_vertices();
        list_edges();
        list_creases();
        return std::move(mesh_);
    }

private:
    glm::dvec3 place(uint32_t point) const
    {
        return (glm::dvec3(positions_[point]) - mesh_.center_m) / mesh_.radius_m;
    }

    void find_scale(std::span<const uint32_t> indices)
    {
        glm::dvec3 low(1e300);
        glm::dvec3 high(-1e300);
        for (const uint32_t index : indices) {
            if (index < positions_.size() && is_finite(positions_[index])) {
                low = glm::min(low, glm::dvec3(positions_[index]));
                high = glm::max(high, glm::dvec3(positions_[index]));
            }
        }
        if (low.x <= high.x) {
            mesh_.center_m = 0.5 * (low + high);
            mesh_.radius_m = std::max(0.5 * glm::length(high - low), 1e-30);
        }
    }

    void take_triangles(std::span<const uint32_t> indices)
    {
        const std::vector<uint32_t> first = weld(positions_);
        const auto count = static_cast<uint32_t>(indices.size() / 3);
        for (uint32_t t = 0; t < count; ++t) {
            std::array<uint32_t, 3> corners{};
            bool is_sound = true;
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t index = indices[3 * size_t{t} + k];
                corners[k] = index < first.size() ? first[index] : none;
                is_sound = is_sound && corners[k] != none;
            }
            if (!is_sound || !has_area(corners)) {
                ++mesh_.dropped_triangles;
                continue;
            }
            mesh_.triangles.push_back(corners);
            mesh_.sources.push_back(t);
        }
        points_of_corners_ = mesh_.triangles;
    }

    /// Whether a triangle can be used. Returns false if its area is too small, or the triangle is too thin
    /// for meaningful angles.
    bool has_area(const std::array<uint32_t, 3>& corners)
    {
        const std::array<glm::dvec3, 3> p{place(corners[0]), place(corners[1]), place(corners[2])};
        const double twice_area = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        const double longest =
            std::max({glm::length(p[1] - p[0]), glm::length(p[2] - p[1]), glm::length(p[0] - p[2])});
        if (!(twice_area > 1e-7 * longest * longest) || !(twice_area > 1e-16)) {
            return false;
        }
        for (size_t k = 0; k < 3; ++k) {
            const glm::dvec3 a = p[(k + 1) % 3] - p[k];
            const glm::dvec3 b = p[(k + 2) % 3] - p[k];
            mesh_.corner_angles.push_back(std::atan2(twice_area, glm::dot(a, b)));
        }
        return true;
    }

    uint32_t origin(uint32_t half_edge) const { return points_of_corners_[half_edge / 3][half_edge % 3]; }

    glm::dvec3 normal_of_places(uint32_t t) const
    {
        const auto& c = points_of_corners_[t];
        return glm::cross(place(c[1]) - place(c[0]), place(c[2]) - place(c[0]));
    }

    void find_twins()
    {
        struct Side {
            uint64_t key;
            uint32_t half_edge;
        };

        std::vector<Side> sides(3 * mesh_.triangles.size());
        for (uint32_t h = 0; h < sides.size(); ++h) {
            const uint32_t start = origin(h);
            const uint32_t end = origin(next_corner(h));
            sides[h] = {uint64_t{std::min(start, end)} << 32U | std::max(start, end), h};
        }
        std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
            return a.key != b.key ? a.key < b.key : a.half_edge < b.half_edge;
        });
        mesh_.twins.assign(sides.size(), none);
        for (size_t i = 0; i < sides.size();) {
            size_t end = i + 1;
            while (end < sides.size() && sides[end].key == sides[i].key) {
                ++end;
            }
            around_.clear();
            for (size_t k = i; k < end; ++k) {
                around_.push_back(sides[k].half_edge);
            }
            pair_up(around_);
            i = end;
        }
    }

    /// Joins two triangles of equal orientation that share an edge. If more than two triangles share the
    /// edge, joins each triangle to the triangle that continues it best. Such edges occur at the rim of a
    /// sheet with front and back.
    void pair_up(std::vector<uint32_t>& around)
    {
        constexpr size_t most_triangles = 16;
        while (around.size() >= 2 && around.size() <= most_triangles) {
            double best = -2.0;
            std::array<uint32_t, 2> pair{};
            for (const uint32_t a : around) {
                for (const uint32_t b : around) {
                    const double flatness = a < b && origin(a) != origin(b) ? cosine_between(a, b) : -2.0;
                    if (flatness > best) {
                        best = flatness;
                        pair = {a, b};
                    }
                }
            }
            if (best < crease_cosine) {
                if (best > -2.0 && around.size() == 2) {
                    creases_.push_back(pair);
                    ++mesh_.crease_edges;
                }
                return;
            }
            mesh_.twins[pair[0]] = pair[1];
            mesh_.twins[pair[1]] = pair[0];
            std::erase_if(around, [&](uint32_t h) { return h == pair[0] || h == pair[1]; });
        }
    }

    double cosine_between(uint32_t a, uint32_t b) const
    {
        const glm::dvec3 n_a = normal_of_places(a / 3);
        const glm::dvec3 n_b = normal_of_places(b / 3);
        return glm::dot(n_a, n_b) / (glm::length(n_a) * glm::length(n_b));
    }

    /// Makes one vertex for each fan (triangles around a point that are connected by edges), and computes the
    /// fan's angles in the tangent plane.
    void split_vertices()
    {
        const size_t count = mesh_.twins.size();
        std::vector<uint8_t> is_done(count, 0);
        mesh_.half_edge_angles.assign(count, 0.0);
        for (uint32_t h = 0; h < count; ++h) {
            if (is_done[h] != 0) {
                continue;
            }
            uint32_t first = h;
            bool is_closed = false;
            while (mesh_.twins[first] != none && !is_closed) {
                first = next_corner(mesh_.twins[first]);
                is_closed = first == h;
            }
            lay_out_fan(first, is_closed, is_done);
        }
        for (glm::dvec3& normal : mesh_.normals) {
            normal = normal / std::max(glm::length(normal), 1e-300);
        }
    }

    void lay_out_fan(uint32_t first, bool is_closed, std::vector<uint8_t>& is_done)
    {
        const auto vertex = static_cast<uint32_t>(mesh_.points.size());
        mesh_.points.push_back(place(origin(first)));
        double angle = 0.0;
        double area = 0.0;
        glm::dvec3 normal(0.0);
        std::vector<uint32_t>& fan = fan_;
        fan.clear();
        for (uint32_t h = first; h != none && is_done[h] == 0; h = mesh_.twins[previous_corner(h)]) {
            is_done[h] = 1;
            fan.push_back(h);
            mesh_.half_edge_angles[h] = angle;
            angle += mesh_.corner_angles[h];
            mesh_.triangles[h / 3][h % 3] = vertex;
            const glm::dvec3 twice_area = normal_of_places(h / 3);
            normal += twice_area * (mesh_.corner_angles[h] / glm::length(twice_area));
            area += glm::length(twice_area) / 6.0;
        }
        const double scale = is_closed ? 2.0 * std::numbers::pi / angle : 1.0;
        for (const uint32_t h : fan) {
            mesh_.half_edge_angles[h] *= scale;
        }
        mesh_.angle_scales.push_back(scale);
        mesh_.areas.push_back(area);
        mesh_.normals.push_back(normal);
    }

    /// Angle of a half-edge's reverse direction, in the tangent plane of the half-edge's end.
    double angle_back(uint32_t half_edge) const
    {
        const uint32_t there = next_corner(half_edge);
        const uint32_t vertex = mesh_.triangles[there / 3][there % 3];
        return mesh_.half_edge_angles[there] + mesh_.angle_scales[vertex] * mesh_.corner_angles[there];
    }

    double cotangent_opposite(uint32_t half_edge) const
    {
        return half_edge == none ? 0.0 : 1.0 / std::tan(mesh_.corner_angles[previous_corner(half_edge)]);
    }

    double length_of(uint32_t half_edge) const
    {
        return glm::distance(place(origin(half_edge)), place(origin(next_corner(half_edge))));
    }

    void list_edges()
    {
        const auto vertex_at = [&](uint32_t h) { return mesh_.triangles[h / 3][h % 3]; };
        mesh_.edge_of.assign(mesh_.twins.size(), none);
        for (uint32_t h = 0; h < mesh_.twins.size(); ++h) {
            const uint32_t twin = mesh_.twins[h];
            if (twin != none && twin < h) {
                mesh_.edge_of[h] = mesh_.edge_of[twin];
                continue;
            }
            mesh_.edge_of[h] = static_cast<uint32_t>(mesh_.edges.size());
            const double cotangents = cotangent_opposite(h) + cotangent_opposite(twin);
            mesh_.edges.push_back({.from = vertex_at(h),
                                   .to = vertex_at(next_corner(h)),
                                   .half_edge = h,
                                   .twin = twin,
                                   .weight = std::clamp(0.5 * cotangents, 0.05, 10.0),
                                   .length = length_of(h),
                                   .angle_at_from = mesh_.half_edge_angles[h],
                                   .angle_at_to = angle_back(h)});
        }
    }

    void list_creases()
    {
        const auto vertex_at = [&](uint32_t h) { return mesh_.triangles[h / 3][h % 3]; };
        for (const auto& [a, b] : creases_) {
            const double half = 0.5 * length_of(a);
            const double at_start = mesh_.half_edge_angles[a];
            const double at_end = angle_back(a);
            mesh_.crease_links.push_back(
                {vertex_at(a), vertex_at(next_corner(b)), angle_back(b) - at_start, at_start, half});
            mesh_.crease_links.push_back(
                {vertex_at(next_corner(a)), vertex_at(b), mesh_.half_edge_angles[b] - at_end, at_end, half});
        }
    }

    std::span<const glm::vec3> positions_;
    Mesh mesh_;
    /// The points of each triangle, before the points are split into vertices.
    std::vector<std::array<uint32_t, 3>> points_of_corners_;
    std::vector<std::array<uint32_t, 2>> creases_; ///< each crease as the crease's two half-edges
    std::vector<uint32_t> fan_;
    std::vector<uint32_t> around_; ///< all half-edges between two points
};

} // namespace

glm::dvec3 Mesh::triangle_normal(uint32_t triangle) const
{
    const auto& c = triangles[triangle];
    return glm::cross(points[c[1]] - points[c[0]], points[c[2]] - points[c[0]]);
}

double Mesh::vertex_from_triangle(uint32_t triangle, uint32_t corner) const
{
    const uint32_t h = 3 * triangle;
    const double edge_direction = corner == 0   ? 0.0
                                  : corner == 1 ? std::numbers::pi - corner_angles[h + 1]
                                                : std::numbers::pi + corner_angles[h];
    const double scale = angle_scales[triangles[triangle][corner]];
    return half_edge_angles[h + corner] + 0.5 * (scale - 1.0) * corner_angles[h + corner] - edge_direction;
}

Mesh build_mesh(std::span<const glm::vec3> positions_m, std::span<const uint32_t> triangle_indices)
{
    return Builder(positions_m).run(triangle_indices);
}

} // namespace estampe::form
