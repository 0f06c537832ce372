// SPDX-License-Identifier: MIT
// Builds edge meshes (triangles with their neighbours): welds vertices, then finds adjacent triangles and
// classifies the edges between them.
#include "techniques/contour/chains/mesh/edge_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "shaders/scene.glsl.h"
#include "techniques/contour/chains/mesh/weld.hpp"

namespace estampe::contour {
namespace {

// Cosine of half a degree: normals that differ by less than half a degree count as equal.
constexpr float same_normal_cosine = 0.99996F;
// Cosine of 9.87 degrees, which is less than least_fold_deg: an edge with a smaller fold angle is no fold.
constexpr float flat_cosine = 0.9852F;

// Cosine of 40 degrees. A vertex normal that is further from the normal of its flat face was averaged with
// other faces; on a round bar of five sides or more, vertex normals are nearer.
constexpr float round_cosine = 0.766F;
// Cosine of half a degree: two triangles lie in one plane.
constexpr float one_plane_cosine = 0.99996F;

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
        mark_flat();
        mark_smooth();
        mark_inside_out();
        return std::move(mesh_);
    }

private:
    /// A side of a triangle. The side is stored in the list of its end point with the lower number.
    struct Side {
        uint32_t to = 0; ///< the point with the higher number
        uint32_t side = 0;
        uint32_t opposite = 0; ///< the third point of the triangle
        /// In the triangle's winding, the side runs from the lower to the higher point.
        bool goes_up = true;
    };

    /// Finds for each vertex the point (the first vertex at the same position), and the first vertex with the
    /// same position and normal.
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
            // The flag also keeps the outline of the smooth surface away from triangles without lines.
            mesh_.triangles[t].w |= soup_.bodies[t] == no_side ? shared::triangle_is_flat : 0U;
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

    /// Lists the sides of all triangles, sorted by the lower-numbered of each side's two points.
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

    /// Adds an edge to the mesh. `around` contains all triangle sides that lie on the edge.
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

    /// The mark of an edge: marked if any triangle marks the edge, plain if all triangles say that the edge
    /// is not marked.
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
        // Most edges of a fine mesh are flat. Comparing cosines avoids computing the angle of flat edges.
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

    /// Whether shading is smooth across an edge: two adjacent triangles have equal normals at both ends of
    /// the edge.
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

    /// Normal of a triangle with the given `positions`. The length of the normal is twice the triangle's
    /// area.
    [[nodiscard]] glm::vec3 area_normal(uint32_t t, std::span<const glm::vec3> positions) const
    {
        const glm::uvec4& corners = mesh_.triangles[t];
        const glm::vec3 a = positions[corners.x];
        return glm::cross(positions[corners.y] - a, positions[corners.z] - a);
    }

    [[nodiscard]] glm::vec3 normal(uint32_t t) const { return normal(t, soup_.positions); }

    [[nodiscard]] glm::vec3 normal(uint32_t t, std::span<const glm::vec3> positions) const
    {
        const glm::vec3 n = area_normal(t, positions);
        const float length = glm::length(n);
        return length > 0.0F ? n / length : glm::vec3(0.0F);
    }

    /// How well the vertex normals of a triangle agree with the triangle's winding, weighted by area. The
    /// value is negative if normals and winding disagree.
    [[nodiscard]] float agreement(uint32_t t) const
    {
        const glm::uvec4& corners = mesh_.triangles[t];
        const glm::vec3 mean =
            soup_.mesh_normals[corners.x] + soup_.mesh_normals[corners.y] + soup_.mesh_normals[corners.z];
        const float sense = (mesh_.neighbors[t].w & neighbor_is_turned) != 0 ? -1.0F : 1.0F;
        return sense * glm::dot(area_normal(t, soup_.mesh_positions), mean);
    }

    /// Visits all triangles that have lines, one piece (connected triangles) after another. A piece continues
    /// from triangle t across side k to an unvisited triangle if `crosses(t, k)` is true. After each piece,
    /// calls `ends(piece, agrees)`. `agrees` says how well the vertex normals of the piece agree with the
    /// piece's winding.
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

    /// Numbers the shells (connected surfaces). Flags triangles whose winding must be reversed, so that each
    /// shell (connected surface) has one consistent winding that agrees with the shell's normals.
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

    [[nodiscard]] bool is_flat(uint32_t t) const
    {
        return (mesh_.triangles[t].w & shared::triangle_is_flat) != 0;
    }

    /// Cosine of the angle between a triangle and the triangle beyond a side: 1 if they lie in one plane.
    [[nodiscard]] float fold_cosine(uint32_t t, uint32_t beyond) const
    {
        const bool is_against =
            ((mesh_.neighbors[t].w ^ mesh_.neighbors[beyond].w) & neighbor_is_turned) != 0;
        return glm::dot(normal(t), normal(beyond)) * (is_against ? -1.0F : 1.0F);
    }

    /// Whether a triangle is part of a flat face whose vertex normals belong to other faces, as on a box with
    /// averaged normals.
    [[nodiscard]] bool is_shaded_round(uint32_t t) const
    {
        const glm::vec3 plane = normal(t, soup_.mesh_positions);
        bool bends = false;
        for (int k = 0; k < 3; ++k) {
            const glm::vec3& vertex_normal = soup_.mesh_normals[mesh_.triangles[t][k]];
            const float length = glm::length(vertex_normal);
            bends = bends || std::abs(glm::dot(plane, vertex_normal)) < round_cosine * length;
        }
        for (int k = 0; k < 3 && bends; ++k) {
            const uint32_t beyond = mesh_.neighbors[t][k];
            if (beyond != no_side && fold_cosine(t, beyond >> 2U) > one_plane_cosine) {
                return true;
            }
        }
        return false;
    }

    struct Flat {
        uint32_t triangle;
        glm::vec3 plane; ///< normal of the face
    };

    /// Flags the triangles of flat faces that are shaded as if they were round. The shading breaks at all
    /// edges of such a face, whatever the vertex normals say: an outline along the edges of the face goes on
    /// in the triangles beyond.
    void mark_flat()
    {
        std::vector<Flat> flat;
        const auto mark = [&](uint32_t t, const glm::vec3& plane) {
            mesh_.triangles[t].w |= shared::triangle_is_flat;
            flat.push_back({t, plane});
        };
        for (uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            if (has_lines(t) && is_shaded_round(t)) {
                mark(t, normal(t));
            }
        }
        if (flat.empty()) {
            return;
        }
        while (!flat.empty()) { // goes over the rest of each face
            const Flat from = flat.back();
            flat.pop_back();
            for (int k = 0; k < 3; ++k) {
                const uint32_t beyond = mesh_.neighbors[from.triangle][k];
                if (beyond != no_side && has_lines(beyond >> 2U) && !is_flat(beyond >> 2U) &&
                    std::abs(glm::dot(from.plane, normal(beyond >> 2U))) > one_plane_cosine) {
                    mark(beyond >> 2U, from.plane);
                }
            }
        }
        std::vector<bool> is_hard(3 * mesh_.triangles.size(), false);
        for (const glm::uvec2& edge : mesh_.hard_edges) {
            is_hard[3 * size_t{edge.x >> 2U} + (edge.x & 3U)] = true;
        }
        for (uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            for (uint32_t k = 0; k < 3; ++k) {
                const uint32_t facing = mesh_.neighbors[t][static_cast<int>(k)];
                if (facing == no_side || facing < side_of(t, k) || !(is_flat(t) || is_flat(facing >> 2U)) ||
                    is_hard[3 * size_t{t} + k] || is_hard[3 * size_t{facing >> 2U} + (facing & 3U)]) {
                    continue;
                }
                const bool is_one_face =
                    is_flat(t) && is_flat(facing >> 2U) && fold_cosine(t, facing >> 2U) > one_plane_cosine;
                if (is_one_face) {
                    continue;
                }
                mesh_.hard_edges.emplace_back(side_of(t, k), facing);
            }
        }
        for (FeatureEdge& feature : mesh_.features) {
            feature.is_split = feature.is_split || is_flat(feature.side >> 2U) ||
                               (feature.other_side != no_side && is_flat(feature.other_side >> 2U));
        }
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
    /// For each vertex: the first vertex with the same position and normal.
    std::vector<uint32_t> stands_for_;
    /// For each vertex: index in `sides_` of the first side stored at the vertex.
    std::vector<uint32_t> first_side_;
    std::vector<Side> sides_;
    std::vector<Side> distinct_; ///< sides at the edge that is being added, without duplicate triangles
};

} // namespace

EdgeMesh build_edge_mesh(const TriangleSoup& soup)
{
    return Builder(soup).run();
}

} // namespace estampe::contour
