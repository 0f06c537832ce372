// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/mesh/edge_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "techniques/contour/chains/mesh/weld.hpp"

namespace estampe::contour {
namespace {

constexpr float same_normal_cosine = 0.99996F; // half a degree
constexpr float flat_cosine = 0.9852F;         // of 9.87 degrees, less than least_fold_deg

uint32_t next(uint32_t corner)
{
    return corner == 2 ? 0 : corner + 1;
}

class Builder {
public:
    explicit Builder(const TriangleSoup& soup) : soup_(soup) {}

    EdgeMesh run()
    {
        weld();
        take_triangles();
        list_sides();
        pair_sides();
        find_shells();
        mark_smooth();
        mark_inside_out();
        return std::move(mesh_);
    }

private:
    /// One side of a triangle, as seen from the lower of its two points.
    struct Side {
        uint32_t to = 0; ///< the higher point
        uint32_t side = 0;
        uint32_t opposite = 0; ///< the triangle's third point
        bool goes_up = true;   ///< runs from the lower to the higher
    };

    /// Gives each vertex its point, and the vertex that stands for all with its point and normal.
    void weld()
    {
        const auto count = static_cast<uint32_t>(soup_.positions.size());
        body_of_vertex_.assign(count, no_side);
        for (size_t t = 0; t < soup_.triangles.size(); ++t) {
            for (int k = 0; k < 3 && soup_.bodies[t] != no_side; ++k) {
                body_of_vertex_[soup_.triangles[t][k]] = soup_.bodies[t];
            }
        }
        mesh_.points = weld_vertices(
            {soup_.triangles, soup_.positions, soup_.mesh_positions, soup_.bodies, body_of_vertex_});
        stands_for_.resize(count);
        std::iota(stands_for_.begin(), stands_for_.end(), 0U);
        std::vector<uint32_t> next_normal(count, no_side);
        for (uint32_t v = 0; v < count; ++v) {
            if (body_of_vertex_[v] == no_side) {
                continue;
            }
            uint32_t like = mesh_.points[v];
            while (!has_same_normal(like, v) && next_normal[like] != no_side) {
                like = next_normal[like];
            }
            if (like != v && !has_same_normal(like, v)) {
                next_normal[like] = v;
                like = v;
            }
            stands_for_[v] = like;
        }
    }

    [[nodiscard]] bool has_same_normal(uint32_t a, uint32_t b) const
    {
        return glm::dot(soup_.mesh_normals[a], soup_.mesh_normals[b]) >= same_normal_cosine;
    }

    void take_triangles()
    {
        mesh_.triangles.assign(soup_.triangles.begin(), soup_.triangles.end());
        mesh_.neighbors.assign(soup_.triangles.size(), {no_side, no_side, no_side, 0});
        for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
            for (int k = 0; k < 3 && soup_.bodies[t] != no_side; ++k) {
                mesh_.triangles[t][k] = stands_for_[mesh_.triangles[t][k]];
            }
        }
    }

    [[nodiscard]] uint32_t point(uint32_t triangle, uint32_t corner) const
    {
        return mesh_.points[mesh_.triangles[triangle][static_cast<int>(corner)]];
    }

    [[nodiscard]] bool has_lines(uint32_t t) const
    {
        return soup_.bodies[t] != no_side && point(t, 0) != point(t, 1) && point(t, 1) != point(t, 2) &&
               point(t, 2) != point(t, 0);
    }

    /// Sorts the sides of all triangles by their lower points.
    void list_sides()
    {
        first_side_.assign(soup_.positions.size() + 1, 0);
        const auto count = static_cast<uint32_t>(mesh_.triangles.size());
        for (uint32_t t = 0; t < count; ++t) {
            for (uint32_t k = 0; k < 3 && has_lines(t); ++k) {
                ++first_side_[std::min(point(t, k), point(t, next(k))) + 1];
            }
        }
        std::partial_sum(first_side_.begin(), first_side_.end(), first_side_.begin());
        sides_.resize(first_side_.back());
        std::vector<uint32_t> place(first_side_.begin(), first_side_.end() - 1);
        for (uint32_t t = 0; t < count; ++t) {
            for (uint32_t k = 0; k < 3 && has_lines(t); ++k) {
                const uint32_t a = point(t, k);
                const uint32_t b = point(t, next(k));
                sides_[place[std::min(a, b)]++] = {std::max(a, b), side_of(t, k), point(t, next(next(k))),
                                                   a < b};
            }
        }
    }

    void pair_sides()
    {
        for (size_t v = 0; v + 1 < first_side_.size(); ++v) {
            const auto begin = sides_.begin() + first_side_[v];
            const auto end = sides_.begin() + first_side_[v + 1];
            std::sort(begin, end, [](const Side& a, const Side& b) {
                return a.to != b.to ? a.to < b.to : a.side < b.side;
            });
            for (auto group = begin; group != end;) {
                const auto group_end =
                    std::find_if(group, end, [&](const Side& side) { return side.to != group->to; });
                add_edge({group, group_end});
                group = group_end;
            }
        }
    }

    /// `around` is all the sides of one edge.
    void add_edge(std::span<const Side> around)
    {
        const EdgeMark mark = mark_of(around);
        distinct_.clear();
        for (const Side& side : around) {
            const bool is_twice = std::any_of(distinct_.begin(), distinct_.end(), [&](const Side& other) {
                return other.opposite == side.opposite;
            });
            if (!is_twice) {
                distinct_.push_back(side);
            }
        }
        if (distinct_.size() == 1) {
            mesh_.features.push_back({.side = distinct_[0].side, .kind = FeatureKind::border, .mark = mark});
        } else if (distinct_.size() == 2) {
            pair(distinct_[0], distinct_[1], mark);
        } else {
            mesh_.features.push_back({.side = distinct_[0].side,
                                      .other_side = distinct_[1].side,
                                      .fold_deg = 180.0F,
                                      .kind = FeatureKind::crease,
                                      .mark = mark,
                                      .is_split = true});
        }
    }

    /// Marked if one triangle says so, plain if all say no.
    [[nodiscard]] EdgeMark mark_of(std::span<const Side> around) const
    {
        if (soup_.edge_marks.empty()) {
            return EdgeMark::unsaid;
        }
        bool is_plain = true;
        for (const Side& side : around) {
            const uint32_t marks = soup_.edge_marks[side.side >> 2U];
            if ((marks >> (side.side & 3U) & 1U) != 0) {
                return EdgeMark::marked;
            }
            is_plain = is_plain && marks != 0;
        }
        return is_plain ? EdgeMark::plain : EdgeMark::unsaid;
    }

    void pair(const Side& a, const Side& b, EdgeMark mark)
    {
        mesh_.neighbors[a.side >> 2U][static_cast<int>(a.side & 3U)] = b.side;
        mesh_.neighbors[b.side >> 2U][static_cast<int>(b.side & 3U)] = a.side;
        const bool is_smooth = shades_on(a, b);
        const glm::vec3 normal_b = normal(b.side >> 2U) * (a.goes_up == b.goes_up ? -1.0F : 1.0F);
        const float cosine = glm::dot(normal(a.side >> 2U), normal_b);
        const bool is_boundary = soup_.materials[a.side >> 2U] != soup_.materials[b.side >> 2U];
        // Most edges of a fine mesh are flat: their angle is not worth an arc cosine.
        const bool is_flat = cosine > flat_cosine && !is_boundary && mark != EdgeMark::marked;
        const float fold_deg = is_flat ? 0.0F : glm::degrees(std::acos(std::clamp(cosine, -1.0F, 1.0F)));
        if (is_boundary || fold_deg > least_fold_deg || mark == EdgeMark::marked) {
            mesh_.features.push_back({.side = a.side,
                                      .other_side = b.side,
                                      .fold_deg = fold_deg,
                                      .kind = is_boundary ? FeatureKind::boundary : FeatureKind::crease,
                                      .mark = mark,
                                      .is_split = !is_smooth});
        }
        if (!is_smooth) {
            mesh_.hard_edges.emplace_back(a.side, b.side);
        }
    }

    /// Whether both triangles have the same normals at both ends of their edge.
    [[nodiscard]] bool shades_on(const Side& a, const Side& b) const
    {
        const auto vertex = [this](uint32_t side, uint32_t step) {
            const uint32_t corner = step == 0 ? side & 3U : next(side & 3U);
            return mesh_.triangles[side >> 2U][static_cast<int>(corner)];
        };
        const bool is_alike = a.goes_up == b.goes_up;
        return vertex(a.side, 0) == vertex(b.side, is_alike ? 0 : 1) &&
               vertex(a.side, 1) == vertex(b.side, is_alike ? 1 : 0);
    }

    /// As long as twice the triangle's area, in the space of `positions`.
    [[nodiscard]] glm::vec3 area_normal(uint32_t t, std::span<const glm::vec3> positions) const
    {
        const glm::uvec4& corners = mesh_.triangles[t];
        const glm::vec3 a = positions[corners.x];
        return glm::cross(positions[corners.y] - a, positions[corners.z] - a);
    }

    [[nodiscard]] glm::vec3 normal(uint32_t t) const
    {
        const glm::vec3 n = area_normal(t, soup_.positions);
        const float length = glm::length(n);
        return length > 0.0F ? n / length : glm::vec3(0.0F);
    }

    /// How much a triangle's normals agree with the sense of its corners, by area.
    [[nodiscard]] float agreement(uint32_t t) const
    {
        const glm::uvec4& corners = mesh_.triangles[t];
        const glm::vec3 mean =
            soup_.mesh_normals[corners.x] + soup_.mesh_normals[corners.y] + soup_.mesh_normals[corners.z];
        const float sense = (mesh_.neighbors[t].w & neighbor_is_turned) != 0 ? -1.0F : 1.0F;
        return sense * glm::dot(area_normal(t, soup_.mesh_positions), mean);
    }

    /// Takes triangles that have lines piece by piece. A piece goes on over side k of triangle t to one that
    /// was not reached before, if `crosses(t, k)`; `ends(piece, agrees)` is told how its normals agree with
    /// its sense.
    template <class Crosses, class Ends>
    void flood(const Crosses& crosses, const Ends& ends)
    {
        std::vector<bool> is_reached(mesh_.triangles.size(), false);
        std::vector<uint32_t> piece;
        for (uint32_t first = 0; first < mesh_.triangles.size(); ++first) {
            if (is_reached[first] || !has_lines(first)) {
                continue;
            }
            is_reached[first] = true;
            piece.assign(1, first);
            float agrees = 0.0F;
            for (size_t i = 0; i < piece.size(); ++i) {
                const uint32_t t = piece[i];
                agrees += agreement(t);
                for (uint32_t k = 0; k < 3; ++k) {
                    const uint32_t facing = mesh_.neighbors[t][static_cast<int>(k)];
                    if (facing != no_side && !is_reached[facing >> 2U] && crosses(t, k)) {
                        is_reached[facing >> 2U] = true;
                        piece.push_back(facing >> 2U);
                    }
                }
            }
            ends(piece, agrees);
        }
    }

    /// Numbers shells, and flags triangles so that, those turned around, all of a shell have one sense: that
    /// of its normals.
    void find_shells()
    {
        const auto turn_alike = [this](uint32_t t, uint32_t k) {
            const uint32_t facing = mesh_.neighbors[t][static_cast<int>(k)];
            const bool is_against = point(t, k) == point(facing >> 2U, facing & 3U);
            mesh_.neighbors[facing >> 2U].w = mesh_.neighbors[t].w ^ (is_against ? neighbor_is_turned : 0U);
            return true;
        };
        flood(turn_alike, [this](const std::vector<uint32_t>& shell, float agrees) {
            const uint32_t number = ++mesh_.shell_count << neighbor_shell_shift;
            for (const uint32_t t : shell) {
                uint32_t& flags = mesh_.neighbors[t].w;
                flags = (flags | number) ^ (agrees < 0.0F ? neighbor_is_turned : 0U);
            }
        });
    }

    void mark_smooth()
    {
        for (glm::uvec4& neighbors : mesh_.neighbors) {
            for (int k = 0; k < 3; ++k) {
                neighbors.w |=
                    neighbors[k] != no_side ? 1U << (neighbor_smooth_shift + static_cast<uint32_t>(k)) : 0U;
            }
        }
        for (const glm::uvec2& edge : mesh_.hard_edges) {
            for (const uint32_t side : {edge.x, edge.y}) {
                mesh_.neighbors[side >> 2U].w &= ~(1U << (neighbor_smooth_shift + (side & 3U)));
            }
        }
    }

    void mark_inside_out()
    {
        const auto is_smooth = [this](uint32_t t, uint32_t k) {
            return (mesh_.neighbors[t].w >> (neighbor_smooth_shift + k) & 1U) != 0;
        };
        flood(is_smooth, [this](const std::vector<uint32_t>& piece, float agrees) {
            for (const uint32_t t : piece) {
                mesh_.neighbors[t].w |= agrees < 0.0F ? neighbor_is_inside_out : 0U;
            }
        });
    }

    const TriangleSoup& soup_;
    EdgeMesh mesh_;
    std::vector<uint32_t> body_of_vertex_;
    std::vector<uint32_t> stands_for_; ///< one a vertex
    std::vector<uint32_t> first_side_; ///< one a vertex, into sides_
    std::vector<Side> sides_;
    std::vector<Side> distinct_; ///< of one edge
};

} // namespace

EdgeMesh build_edge_mesh(const TriangleSoup& soup)
{
    return Builder(soup).run();
}

} // namespace estampe::contour
