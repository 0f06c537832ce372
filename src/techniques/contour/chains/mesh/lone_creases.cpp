// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/mesh/lone_creases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {
namespace {

// A triangle is a sliver if its height is a smaller share of its longest side, and its corners lie almost in
// a row. The narrow triangles of a strip have a right angle, and are no slivers.
constexpr float sliver_share = 0.1F;
constexpr float sliver_cosine = -0.87F; // cosine of 150 degrees, the angle opposite of the longest side
constexpr int most_slivers = 4;         // in a row
constexpr float usual_edges = 3.0F;
constexpr float most_share_of_shell = 0.03F;
constexpr float zigzag_deg = 40.0F; // mean bend from edge to edge of a line that turns to and fro
constexpr size_t least_zigzag_edges = 3;
constexpr int rounds = 3;
// The largest fold between two facets of a round shape. An icosahedron folds by 42 degrees, an eight-sided
// bar by 45 degrees; such shapes have flat sides.
constexpr float most_round_deg = 41.0F;
// The least turn of the surface on the two sides of a fold of a round shape, as a share of the fold.
constexpr float least_round_share = 0.5F;
constexpr size_t round_triangles = 8; // on either side of a fold

uint32_t vertex_of(const EdgeMesh& mesh, uint32_t side, uint32_t step)
{
    return mesh.triangles[side >> 2U][static_cast<int>(((side & 3U) + step) % 3)];
}

glm::vec3 place_of(const EdgeMesh& mesh, std::span<const glm::vec3> positions, uint32_t side, uint32_t step)
{
    return positions[vertex_of(mesh, side, step)];
}

/// Normal of the triangle of a side, in the winding of the triangle's shell.
glm::vec3 normal_of(const EdgeMesh& mesh, std::span<const glm::vec3> positions, uint32_t side)
{
    const glm::vec3 a = place_of(mesh, positions, side, 0);
    const glm::vec3 normal =
        glm::cross(place_of(mesh, positions, side, 1) - a, place_of(mesh, positions, side, 2) - a);
    const float length = glm::length(normal);
    const float sense = (mesh.neighbors[side >> 2U].w & neighbor_is_turned) != 0 ? -1.0F : 1.0F;
    return length > 0.0F ? sense / length * normal : glm::vec3(0.0F);
}

float length_of(const EdgeMesh& mesh, std::span<const glm::vec3> positions, uint32_t side)
{
    return glm::distance(place_of(mesh, positions, side, 0), place_of(mesh, positions, side, 1));
}

/// The longest side of a triangle other than `side`.
uint32_t longest_other_side(const EdgeMesh& mesh, std::span<const glm::vec3> positions, uint32_t side)
{
    const uint32_t triangle = side >> 2U;
    const uint32_t corner = side & 3U;
    const std::array<uint32_t, 2> others{side_of(triangle, (corner + 1) % 3),
                                         side_of(triangle, (corner + 2) % 3)};
    return length_of(mesh, positions, others[0]) >= length_of(mesh, positions, others[1]) ? others[0]
                                                                                          : others[1];
}

bool is_sliver(const EdgeMesh& mesh, std::span<const glm::vec3> positions, uint32_t side)
{
    uint32_t longest = longest_other_side(mesh, positions, side);
    longest = length_of(mesh, positions, side) > length_of(mesh, positions, longest) ? side : longest;
    const glm::vec3 from = place_of(mesh, positions, longest, 0);
    const glm::vec3 to = place_of(mesh, positions, longest, 1);
    const glm::vec3 apex = place_of(mesh, positions, longest, 2);
    const float whole = glm::distance(from, to);
    const float twice_area = glm::length(glm::cross(to - from, apex - from));
    const float lengths = glm::distance(from, apex) * glm::distance(to, apex);
    return twice_area < sliver_share * whole * whole &&
           glm::dot(from - apex, to - apex) <= sliver_cosine * lengths;
}

/// The side at which the surface beyond `side` begins, after slivers.
uint32_t beyond_slivers(const EdgeMesh& mesh, std::span<const glm::vec3> positions, uint32_t side)
{
    for (int i = 0; i < most_slivers && is_sliver(mesh, positions, side); ++i) {
        const uint32_t across = longest_other_side(mesh, positions, side);
        const uint32_t next = mesh.neighbors[across >> 2U][static_cast<int>(across & 3U)];
        if (next == no_side) {
            break;
        }
        side = next;
    }
    return side;
}

float angle_deg(const glm::vec3& one, const glm::vec3& other)
{
    return glm::degrees(std::acos(std::clamp(glm::dot(one, other), -1.0F, 1.0F)));
}

/// The most by which the surface turns about `axis`, in degrees, from the triangle of `side` to the triangles
/// around it, up to folds of more than `most_round_deg`.
float turn_beyond(const EdgeMesh& mesh, std::span<const glm::vec3> positions, uint32_t side,
                  const glm::vec3& axis)
{
    const glm::vec3 start = normal_of(mesh, positions, side);
    std::array<uint32_t, round_triangles> around{side >> 2U};
    size_t count = 1;
    float most_deg = 0.0F;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 normal = normal_of(mesh, positions, side_of(around[i], 0));
        const float sine = glm::dot(glm::cross(start, normal), axis);
        most_deg = std::max(most_deg, glm::degrees(std::asin(std::clamp(sine, -1.0F, 1.0F))));
        for (uint32_t k = 0; k < 3 && count < around.size(); ++k) {
            const uint32_t next = mesh.neighbors[around[i]][static_cast<int>(k)];
            const auto end = around.begin() + static_cast<std::ptrdiff_t>(count);
            if (side_of(around[i], k) != side && next != no_side &&
                angle_deg(normal, normal_of(mesh, positions, next)) <= most_round_deg &&
                std::find(around.begin(), end, next >> 2U) == end) {
                around[count++] = next >> 2U;
            }
        }
    }
    return most_deg;
}

/// Size of a shell and the mean length of its edges.
struct ShellMeasure {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};
    double edges = 0.0;
    size_t edge_count = 0;

    [[nodiscard]] float shortest_line() const
    {
        const float usual =
            edge_count > 0 ? static_cast<float>(edges / static_cast<double>(edge_count)) : 0.0F;
        return std::min(usual_edges * usual, most_share_of_shell * glm::distance(min, max));
    }
};

std::vector<ShellMeasure> measure_shells(const EdgeMesh& mesh, std::span<const glm::vec3> positions)
{
    std::vector<ShellMeasure> shells(size_t{mesh.shell_count} + 1);
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        ShellMeasure& shell = shells[mesh.neighbors[t].w >> neighbor_shell_shift];
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 from = positions[mesh.triangles[t][k]];
            shell.min = glm::min(shell.min, from);
            shell.max = glm::max(shell.max, from);
            shell.edges +=
                static_cast<double>(glm::distance(from, positions[mesh.triangles[t][(k + 1) % 3]]));
            ++shell.edge_count;
        }
    }
    return shells;
}

/// Finds lines of creases between points where lines end or branch.
class LoneCreases {
public:
    LoneCreases(const EdgeMesh& mesh, std::span<const glm::vec3> positions, std::vector<LineEdge>& edges)
        : mesh_(mesh), positions_(positions), edges_(edges)
    {
    }

    /// Removes lone creases once. Returns whether there were any.
    bool remove()
    {
        list_ends();
        std::vector<bool> is_lone(edges_.size(), false);
        std::vector<bool> is_seen(edges_.size(), false);
        for (const auto& [point, end] : ends_) {
            const bool is_loose = ends_at(point).size() == 1;
            if (is_loose && !is_seen[end / 2] && edges_[end / 2].kind == shared::line_crease) {
                const std::vector<uint32_t> line = line_from(end);
                for (const uint32_t part : line) {
                    is_seen[part / 2] = true;
                    is_lone[part / 2] = is_scrap(line);
                }
            }
        }
        size_t kept = 0;
        for (size_t i = 0; i < edges_.size(); ++i) {
            if (!is_lone[i]) {
                edges_[kept++] = edges_[i];
            }
        }
        const bool has_any = kept < edges_.size();
        edges_.resize(kept);
        return has_any;
    }

private:
    /// The point at an end of an edge. The ends of the edge with number e have the numbers 2 e and 2 e + 1.
    [[nodiscard]] uint32_t point_at(uint32_t end) const
    {
        return mesh_.points[(end & 1U) == 0 ? edges_[end / 2].from : edges_[end / 2].to];
    }

    [[nodiscard]] glm::vec3 along(uint32_t end) const
    {
        const LineEdge& edge = edges_[end / 2];
        const glm::vec3 way = positions_[edge.to] - positions_[edge.from];
        return (end & 1U) == 0 ? way : -way;
    }

    void list_ends()
    {
        ends_.clear();
        for (uint32_t end = 0; end < 2 * edges_.size(); ++end) {
            ends_.emplace_back(point_at(end), end);
        }
        std::ranges::sort(ends_);
    }

    /// The entries of `ends_` at a point.
    [[nodiscard]] std::span<const std::pair<uint32_t, uint32_t>> ends_at(uint32_t point) const
    {
        const auto first = std::lower_bound(ends_.begin(), ends_.end(), std::pair(point, 0U));
        const auto last = std::upper_bound(first, ends_.end(), std::pair(point, UINT32_MAX));
        return {first, last};
    }

    /// The edges of creases from a loose end on, up to a point where the line ends or branches. Each edge is
    /// named by the end at which it is entered.
    [[nodiscard]] std::vector<uint32_t> line_from(uint32_t end) const
    {
        std::vector<uint32_t> line{end};
        while (true) {
            const uint32_t far_end = line.back() ^ 1U;
            const auto there = ends_at(point_at(far_end));
            if (there.size() != 2) {
                return line;
            }
            const uint32_t next =
                there.front().second == far_end ? there.back().second : there.front().second;
            if (edges_[next / 2].kind != shared::line_crease) {
                return line;
            }
            line.push_back(next);
        }
    }

    [[nodiscard]] bool is_scrap(const std::vector<uint32_t>& line)
    {
        if (shells_.empty()) {
            shells_ = measure_shells(mesh_, positions_);
        }
        float length = 0.0F;
        float bends_deg = 0.0F;
        for (size_t i = 0; i < line.size(); ++i) {
            length += glm::length(along(line[i]));
            if (i > 0) {
                const glm::vec3 before = along(line[i - 1]);
                const glm::vec3 after = along(line[i]);
                const float lengths = glm::length(before) * glm::length(after);
                bends_deg += lengths > 0.0F ? angle_deg(before, after / lengths) : 0.0F;
            }
        }
        const uint32_t triangle = edges_[line.front() / 2].side >> 2U;
        const ShellMeasure& shell = shells_[mesh_.neighbors[triangle].w >> neighbor_shell_shift];
        return length < shell.shortest_line() ||
               (line.size() >= least_zigzag_edges &&
                bends_deg > zigzag_deg * static_cast<float>(line.size() - 1));
    }

    const EdgeMesh& mesh_;
    std::span<const glm::vec3> positions_;
    std::vector<LineEdge>& edges_;
    std::vector<std::pair<uint32_t, uint32_t>> ends_; ///< point and end, sorted
    std::vector<ShellMeasure> shells_;                ///< one per shell; empty until they are needed
};

} // namespace

float fold_beyond_slivers(const EdgeMesh& mesh, std::span<const glm::vec3> positions, const FeatureEdge& edge)
{
    const uint32_t one = beyond_slivers(mesh, positions, edge.side);
    const uint32_t other = beyond_slivers(mesh, positions, edge.other_side);
    if (one == edge.side && other == edge.other_side) {
        return edge.fold_deg;
    }
    return angle_deg(normal_of(mesh, positions, one), normal_of(mesh, positions, other));
}

bool is_between_facets(const EdgeMesh& mesh, std::span<const glm::vec3> positions, const FeatureEdge& edge)
{
    if (edge.other_side == no_side || edge.fold_deg > most_round_deg) {
        return false;
    }
    const glm::vec3 turn =
        glm::cross(normal_of(mesh, positions, edge.side), normal_of(mesh, positions, edge.other_side));
    const float sine = glm::length(turn);
    if (sine <= 0.0F) {
        return false;
    }
    // The axis of the turn from the first side to the other, seen from the fold outwards on both sides.
    const glm::vec3 axis = turn / sine;
    return turn_beyond(mesh, positions, edge.side, -axis) +
               turn_beyond(mesh, positions, edge.other_side, axis) >=
           least_round_share * edge.fold_deg;
}

void leave_out_lone_creases(const EdgeMesh& mesh, std::span<const glm::vec3> positions,
                            std::vector<LineEdge>& edges)
{
    LoneCreases creases(mesh, positions, edges);
    for (int i = 0; i < rounds && creases.remove(); ++i) {
    }
}

} // namespace estampe::contour
