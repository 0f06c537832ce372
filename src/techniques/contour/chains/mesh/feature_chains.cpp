// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/mesh/feature_chains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "techniques/contour/chains/mesh/lone_creases.hpp"

namespace estampe::contour {
namespace {

constexpr float smooth_crease_deg = 60.0F;
// Cosine of 60 degrees, the largest bend at which two edges are linked.
constexpr float straight_cosine = 0.5F;
constexpr uint32_t no_end = ~0U;
constexpr size_t most_edges_at_a_point = 64;

/// Whether an edge gets a line, if the surface folds there by `fold_deg`.
bool is_chosen(const FeatureEdge& edge, float fold_deg, const FeatureChoice& choice)
{
    if (choice.marked && edge.mark == EdgeMark::marked) {
        return true;
    }
    const bool is_left_out = choice.marked && edge.mark == EdgeMark::plain;
    if (is_left_out && edge.kind != FeatureKind::boundary) {
        return false;
    }
    const float least_deg = edge.is_split ? std::max(choice.crease_deg, least_fold_deg)
                                          : std::max(choice.crease_deg, smooth_crease_deg);
    const bool is_crease = choice.creases && !is_left_out && fold_deg >= least_deg;
    switch (edge.kind) {
    case FeatureKind::border:
        return choice.borders;
    case FeatureKind::boundary:
        return choice.boundaries || is_crease;
    case FeatureKind::crease:
        return is_crease;
    }
    return false;
}

uint32_t line_kind(const FeatureEdge& edge, const FeatureChoice& choice)
{
    return edge.kind == FeatureKind::border                 ? shared::line_border
           : choice.marked && edge.mark == EdgeMark::marked ? shared::line_marked
           : edge.kind == FeatureKind::boundary             ? shared::line_boundary
                                                            : shared::line_crease;
}

class Stringer {
public:
    Stringer(const EdgeMesh& mesh, std::span<const glm::vec3> positions, const FeatureChoice& choice)
        : mesh_(mesh), positions_(positions)
    {
        for (const FeatureEdge& feature : mesh.features) {
            if (is_chosen(feature, feature.fold_deg, choice) &&
                is_chosen(feature, fold_of_shape(feature), choice)) {
                edges_.push_back({feature.side, line_kind(feature, choice), vertex(feature.side, 0),
                                  vertex(feature.side, 1)});
            }
        }
        leave_out_lone_creases(mesh, positions, edges_);
    }

    FeatureChains run()
    {
        join_ends();
        is_linked_.assign(edges_.size(), false);
        for (uint32_t end = 0; end < partner_.size(); ++end) {
            if (partner_[end] == no_end && !is_linked_[end / 2]) {
                string_from(end, false);
            }
        }
        for (uint32_t edge = 0; edge < edges_.size(); ++edge) {
            if (!is_linked_[edge]) {
                string_from(2 * edge, true);
            }
        }
        list_loose();
        return std::move(result_);
    }

private:
    [[nodiscard]] uint32_t vertex(uint32_t side, uint32_t step) const
    {
        return mesh_.triangles[side >> 2U][static_cast<int>(((side & 3U) + step) % 3)];
    }

    /// The angle in degrees by which the shape folds at an edge, whatever triangles stand for the shape.
    [[nodiscard]] float fold_of_shape(const FeatureEdge& edge) const
    {
        return edge.other_side == no_side                   ? edge.fold_deg
               : is_between_facets(mesh_, positions_, edge) ? 0.0F
                                                            : fold_beyond_slivers(mesh_, positions_, edge);
    }

    /// The vertex at an end of an edge. The two ends of the edge with number e have the numbers 2 e and 2 e +
    /// 1.
    [[nodiscard]] uint32_t vertex_at(uint32_t end) const
    {
        return (end & 1U) == 0 ? edges_[end / 2].from : edges_[end / 2].to;
    }

    /// Direction from the end `end` of an edge towards the edge's opposite end.
    [[nodiscard]] glm::vec3 inwards(uint32_t end) const
    {
        const glm::vec3 along = positions_[vertex_at(end ^ 1U)] - positions_[vertex_at(end)];
        const float length = glm::length(along);
        return length > 0.0F ? along / length : glm::vec3(0.0F);
    }

    /// Pairs each end of an edge with the end of the edge on which the line continues.
    void join_ends()
    {
        partner_.assign(2 * edges_.size(), no_end);
        // Ends of edges at each point, per kind of line.
        std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> ends_at;
        for (uint32_t end = 0; end < partner_.size(); ++end) {
            ends_at[{mesh_.points[vertex_at(end)], edges_[end / 2].kind}].push_back(end);
        }

        struct Joint {
            float cosine = 0.0F;
            uint32_t a = 0;
            uint32_t b = 0;
        };

        std::vector<Joint> joints;
        for (const auto& [place, ends] : ends_at) {
            joints.clear();
            for (size_t i = 0; i < ends.size() && ends.size() <= most_edges_at_a_point; ++i) {
                for (size_t j = i + 1; j < ends.size(); ++j) {
                    joints.push_back({-glm::dot(inwards(ends[i]), inwards(ends[j])), ends[i], ends[j]});
                }
            }
            std::stable_sort(joints.begin(), joints.end(),
                             [](const Joint& x, const Joint& y) { return x.cosine > y.cosine; });
            for (const Joint& joint : joints) {
                if (joint.cosine >= straight_cosine && partner_[joint.a] == no_end &&
                    partner_[joint.b] == no_end) {
                    partner_[joint.a] = joint.b;
                    partner_[joint.b] = joint.a;
                }
            }
        }
    }

    /// Follows linked edges from `end` until the line ends or returns to its start, and stores the linked
    /// edges as a chain.
    void string_from(uint32_t end, bool is_closed)
    {
        const auto chain = static_cast<uint32_t>(result_.chains.size());
        const auto first = static_cast<uint32_t>(result_.points.size());
        uint32_t last = end;
        while (end != no_end && !is_linked_[end / 2]) {
            is_linked_[end / 2] = true;
            const LineEdge& edge = edges_[end / 2];
            result_.points.push_back({.vertex = vertex_at(end),
                                      .other_vertex = vertex_at(end),
                                      .share = 0.0F,
                                      .chain = chain,
                                      .kind = edge.kind,
                                      .side = edge.side});
            last = end ^ 1U;
            end = partner_[last];
        }
        shared::FeaturePoint final_point = result_.points.back();
        final_point.vertex = final_point.other_vertex = vertex_at(last);
        result_.points.push_back(final_point);
        result_.chains.push_back({.first_point = first,
                                  .point_count = static_cast<uint32_t>(result_.points.size()) - first,
                                  .is_closed = is_closed ? 1U : 0U});
    }

    void list_loose()
    {
        std::vector<uint32_t> lined;
        lined.reserve(edges_.size());
        for (const LineEdge& edge : edges_) {
            lined.push_back(edge.side);
        }
        std::sort(lined.begin(), lined.end());
        for (const glm::uvec2& edge : mesh_.hard_edges) {
            if (!std::binary_search(lined.begin(), lined.end(), edge.x)) {
                result_.loose_edges.push_back(edge);
            }
        }
    }

    const EdgeMesh& mesh_;
    std::span<const glm::vec3> positions_;
    std::vector<LineEdge> edges_;
    std::vector<uint32_t> partner_; ///< for each end of an edge: the end with which it is paired
    std::vector<bool> is_linked_;   ///< for each edge: whether the edge already belongs to a chain
    FeatureChains result_;
};

} // namespace

FeatureChains string_features(const EdgeMesh& mesh, std::span<const glm::vec3> positions,
                              const FeatureChoice& choice)
{
    return Stringer(mesh, positions, choice).run();
}

namespace {

constexpr uint32_t nowhere = ~0U;
// Sharpness that every point of a line must have, as a share of the sharpness that its sharpest point must
// have.
constexpr float least_share = 2.0F / 3.0F;
constexpr float shortest_share = 1.0F / 30.0F;
// Smallest ratio of the two principal curvatures at a ridge, so that near-spheres have no lines.
constexpr float least_lead = 1.1F;
// Length over which a ridge's turn is measured, as a share of the object's size.
constexpr float sharpness_reach = 0.01F;

/// Curvature at a vertex as seen by one kind of line: a ridge or a valley.
struct Bend {
    /// Turn of the surface in degrees over a hundredth of the object's size; 0 where no line of the kind can
    /// run.
    float sharpness_deg = 0.0F;
    float growth = 0.0F; ///< change of the greatest curvature along `way`
    glm::vec3 way{0.0F}; ///< direction of the greatest curvature, across the line
};

/// A point where a ridge or valley crosses an edge of the mesh.
struct Crossing {
    uint32_t low = 0; ///< the vertex with the lower number; `low` and `high` are the two vertices of the edge
    uint32_t high = 0;
    float share = 0.0F; ///< position of the crossing between the vertices `low` (0) and `high` (1)
    float sharpness_deg = 0.0F;
    /// The next crossings of the line, on either side of the edge.
    std::array<uint32_t, 2> next{nowhere, nowhere};
    std::array<uint32_t, 2> triangle{nowhere, nowhere};
    bool is_linked = false;
};

class RidgeFinder {
public:
    RidgeFinder(const RestSurface& surface, std::span<const Bending> bendings, float ridge_deg, uint32_t kind)
        : surface_(surface), bendings_(bendings), ridge_deg_(ridge_deg), kind_(kind)
    {
    }

    void run(const std::vector<bool>& is_taken, FeatureChains& features)
    {
        find_bends();
        find_crossings();
        for (uint32_t t = 0; t < surface_.mesh.triangles.size(); ++t) {
            if (!is_taken[t]) {
                link_through(t);
            }
        }
        for (uint32_t i = 0; i < crossings_.size(); ++i) {
            const bool is_end = (crossings_[i].next[0] == nowhere) != (crossings_[i].next[1] == nowhere);
            if (is_end && !crossings_[i].is_linked) {
                string_from(i, features);
            }
        }
        for (uint32_t i = 0; i < crossings_.size(); ++i) {
            if (crossings_[i].next[0] != nowhere && !crossings_[i].is_linked) {
                string_from(i, features);
            }
        }
    }

private:
    void find_bends()
    {
        const float sign = kind_ == shared::line_ridge ? 1.0F : -1.0F;
        bends_.resize(bendings_.size());
        for (size_t v = 0; v < bendings_.size(); ++v) {
            const Bending& bending = bendings_[v];
            const PrincipalCurvatures curvatures = principal_curvatures(sign * bending.form);
            if (curvatures.greatest > least_lead * std::abs(curvatures.least)) {
                const glm::vec3 across = glm::cross(bending.normal, bending.tangent);
                const float growth = change_along(sign * bending.change, curvatures.direction);
                bends_[v] = {glm::degrees(curvatures.greatest * sharpness_reach * surface_.sizes[v]),
                             // The sign of zero is undefined, so a growth of zero is replaced by the smallest
                             // positive number.
                             growth != 0.0F ? growth : std::numeric_limits<float>::min(),
                             curvatures.direction.x * bending.tangent + curvatures.direction.y * across};
            }
        }
    }

    void find_crossings()
    {
        const EdgeMesh& mesh = surface_.mesh;
        of_side_.assign(3 * mesh.triangles.size(), nowhere);
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            for (uint32_t k = 0; k < 3; ++k) {
                const uint32_t beyond = mesh.neighbors[t][static_cast<int>(k)];
                const bool is_smooth = (mesh.neighbors[t].w >> (neighbor_smooth_shift + k) & 1U) != 0;
                if (!is_smooth || side_of(t, k) > beyond) {
                    continue;
                }
                const uint32_t a = mesh.triangles[t][static_cast<int>(k)];
                const uint32_t b = mesh.triangles[t][static_cast<int>((k + 1) % 3)];
                if (is_crossed(std::min(a, b), std::max(a, b))) {
                    const auto index = static_cast<uint32_t>(crossings_.size()) - 1;
                    of_side_[3 * size_t{t} + k] = index;
                    of_side_[3 * size_t{beyond >> 2U} + (beyond & 3U)] = index;
                }
            }
        }
    }

    /// Whether, between two vertices, the greatest principal curvature has an extremum along the curvature's
    /// own direction. If so, stores the crossing.
    bool is_crossed(uint32_t low, uint32_t high)
    {
        const Bend& a = bends_[low];
        const Bend& b = bends_[high];
        const float turn = glm::dot(a.way, b.way) < 0.0F ? -1.0F : 1.0F;
        const float growth_b = turn * b.growth;
        if (a.sharpness_deg <= 0.0F || b.sharpness_deg <= 0.0F || !(a.growth * growth_b < 0.0F)) {
            return false;
        }
        const float share = a.growth / (a.growth - growth_b);
        const float sharpness_deg = glm::mix(a.sharpness_deg, b.sharpness_deg, share);
        if (sharpness_deg < least_share * ridge_deg_) {
            return false;
        }
        crossings_.push_back({.low = low, .high = high, .share = share, .sharpness_deg = sharpness_deg});
        return true;
    }

    /// Whether curvature decreases on both sides of a line through a triangle, so that the line is a maximum.
    [[nodiscard]] bool has_maximum(uint32_t t) const
    {
        const glm::uvec4& corners = surface_.mesh.triangles[t];
        std::array<glm::vec3, 3> places;
        for (int k = 0; k < 3; ++k) {
            places.at(static_cast<size_t>(k)) = surface_.positions[corners[k]];
        }
        glm::vec3 turned(0.0F); // gradient of `growth`, rotated by a right angle and scaled
        glm::vec3 way(0.0F);
        for (size_t k = 0; k < 3; ++k) {
            const Bend& bend = bends_[corners[static_cast<int>(k)]];
            const float turn = glm::dot(bend.way, bends_[corners.x].way) < 0.0F ? -1.0F : 1.0F;
            turned += turn * bend.growth * (places.at((k + 2) % 3) - places.at((k + 1) % 3));
            way += turn * bend.way;
        }
        const glm::vec3 normal = glm::cross(places[1] - places[0], places[2] - places[0]);
        return glm::dot(glm::cross(normal, turned), way) < 0.0F;
    }

    /// Joins the two crossings of a line with the sides of a triangle. If directions are inconsistent, three
    /// sides have crossings; then the sharpest two are joined.
    void link_through(uint32_t t)
    {
        std::array<uint32_t, 3> found{};
        size_t count = 0;
        for (uint32_t k = 0; k < 3; ++k) {
            if (of_side_[3 * size_t{t} + k] != nowhere) {
                found.at(count++) = of_side_[3 * size_t{t} + k];
            }
        }
        if (count < 2 || !has_maximum(t)) {
            return;
        }
        std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count),
                  [this](uint32_t a, uint32_t b) {
                      return crossings_[a].sharpness_deg > crossings_[b].sharpness_deg;
                  });
        link(found[0], found[1], t);
        link(found[1], found[0], t);
    }

    void link(uint32_t from, uint32_t to, uint32_t triangle)
    {
        Crossing& crossing = crossings_[from];
        const size_t free = crossing.next[0] == nowhere ? 0 : 1;
        crossing.next.at(free) = to;
        crossing.triangle.at(free) = triangle;
    }

    [[nodiscard]] glm::vec3 place(const Crossing& crossing) const
    {
        return glm::mix(surface_.positions[crossing.low], surface_.positions[crossing.high], crossing.share);
    }

    /// Follows a line from one end, or all around a closed line. Keeps the line if it is sharp and long
    /// enough.
    void string_from(uint32_t start, FeatureChains& features)
    {
        std::vector<uint32_t> line;
        // For each crossing of `line`: the triangle that the line crosses next.
        std::vector<uint32_t> triangles;
        uint32_t before = nowhere;
        uint32_t at = start;
        while (at != nowhere && !crossings_[at].is_linked) {
            Crossing& crossing = crossings_[at];
            crossing.is_linked = true;
            line.push_back(at);
            const bool came_from_0 =
                crossing.next[0] == nowhere || (before != nowhere && crossing.next[0] == before);
            const size_t way = came_from_0 ? 1 : 0;
            triangles.push_back(crossing.triangle.at(way));
            before = at;
            at = crossing.next.at(way);
        }
        const bool is_closed = at == start;
        if (is_closed) {
            line.push_back(start);
        }
        float length = 0.0F;
        float sharpest_deg = 0.0F;
        for (size_t i = 0; i < line.size(); ++i) {
            sharpest_deg = std::max(sharpest_deg, crossings_[line[i]].sharpness_deg);
            length +=
                i > 0 ? glm::distance(place(crossings_[line[i - 1]]), place(crossings_[line[i]])) : 0.0F;
        }
        if (sharpest_deg >= ridge_deg_ && length >= shortest_share * surface_.sizes[crossings_[start].low]) {
            append(line, triangles, is_closed, features);
        }
    }

    void append(const std::vector<uint32_t>& line, const std::vector<uint32_t>& triangles, bool is_closed,
                FeatureChains& features) const
    {
        features.leave_edges = true;
        const auto chain = static_cast<uint32_t>(features.chains.size());
        const auto first = static_cast<uint32_t>(features.points.size());
        for (size_t i = 0; i < line.size(); ++i) {
            const Crossing& crossing = crossings_[line[i]];
            const size_t piece = std::min(i, line.size() - 2);
            features.points.push_back({.vertex = crossing.low,
                                       .other_vertex = crossing.high,
                                       .share = crossing.share,
                                       .chain = chain,
                                       .kind = kind_,
                                       .side = side_of(triangles[piece], 3)});
        }
        features.chains.push_back({.first_point = first,
                                   .point_count = static_cast<uint32_t>(line.size()),
                                   .is_closed = is_closed ? 1U : 0U});
    }

    const RestSurface& surface_;
    std::span<const Bending> bendings_;
    float ridge_deg_;
    uint32_t kind_;
    std::vector<Bend> bends_; ///< curvature at each vertex
    std::vector<Crossing> crossings_;
    /// Number of the crossing on each side of a triangle, three per triangle; `nowhere` if none.
    std::vector<uint32_t> of_side_;
};

/// Marks the triangles that touch a line of another kind, a border or an edge where the shading breaks. No
/// ridge or valley may cross the marked triangles.
std::vector<bool> taken_triangles(const EdgeMesh& mesh, size_t vertex_count, const FeatureChains& features)
{
    std::vector<bool> is_taken_point(vertex_count, false);
    const auto take = [&](uint32_t side) {
        for (const uint32_t step : {0U, 1U}) {
            is_taken_point
                [mesh.points[mesh.triangles[side >> 2U][static_cast<int>(((side & 3U) + step) % 3)]]] = true;
        }
    };
    for (const shared::FeaturePoint& point : features.points) {
        take(point.side);
    }
    for (const glm::uvec2& edge : mesh.hard_edges) {
        take(edge.x);
    }
    for (const FeatureEdge& feature : mesh.features) {
        if (feature.kind == FeatureKind::border) {
            take(feature.side);
        }
    }
    std::vector<bool> is_taken(mesh.triangles.size(), false);
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const uint32_t point = mesh.points[mesh.triangles[t][k]];
            is_taken[t] = is_taken[t] || point == no_side || is_taken_point[point];
        }
    }
    return is_taken;
}

} // namespace

void add_ridges(const RestSurface& surface, std::span<const Bending> bendings, const RidgeChoice& choice,
                FeatureChains& features)
{
    if (!choice.ridges && !choice.valleys) {
        return;
    }
    const std::vector<bool> is_taken = taken_triangles(surface.mesh, surface.positions.size(), features);
    if (choice.ridges) {
        RidgeFinder(surface, bendings, choice.ridge_deg, shared::line_ridge).run(is_taken, features);
    }
    if (choice.valleys) {
        RidgeFinder(surface, bendings, choice.ridge_deg, shared::line_valley).run(is_taken, features);
    }
}

} // namespace estampe::contour
