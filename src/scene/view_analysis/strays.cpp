// SPDX-License-Identifier: MIT
#include "scene/view_analysis/strays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "scene/pose.hpp"

namespace estampe {
namespace {

constexpr uint32_t side_cells = 16;
constexpr uint32_t cell_count = side_cells * side_cells * side_cells;
constexpr uint32_t outside = cell_count;

struct StrayCell {
    Bounds bounds;
    double vertices = 0.0;
    double area_m2 = 0.0;
};

/// A part of the scene that no triangle and no neighbourhood joins to the others.
struct Part {
    Bounds bounds;
    double vertices = 0.0;
    double area_m2 = 0.0;

    void add(const Bounds& other_bounds, double other_vertices, double other_area_m2)
    {
        bounds.extend(other_bounds.min);
        bounds.extend(other_bounds.max);
        vertices += other_vertices;
        area_m2 += other_area_m2;
    }
};

/// The scene as a grid of cubes about its bounds: which cubes hold vertices, and which belong together.
class Grid {
public:
    explicit Grid(const Bounds& whole) : whole_(whole), cells_(cell_count), parents_(cell_count)
    {
        const glm::dvec3 size = whole.max - whole.min;
        side_m_ = std::max({size.x, size.y, size.z}) / side_cells;
        std::iota(parents_.begin(), parents_.end(), 0U);
    }

    void add(const PosedPrimitive& posed)
    {
        cell_of_.clear();
        for (const glm::dvec3& position : posed.positions) {
            const uint32_t cell = cell_at(position);
            cell_of_.push_back(cell);
            if (cell != outside) {
                cells_[cell].bounds.extend(position);
                cells_[cell].vertices += 1.0;
            }
        }
        const std::vector<uint32_t>& indices = posed.primitive->indices;
        if (posed.primitive->topology == Topology::triangles) {
            for (size_t i = 0; i + 2 < indices.size(); i += 3)
                add_triangle(posed, indices[i], indices[i + 1], indices[i + 2]);
        } else if (posed.primitive->topology == Topology::lines) {
            for (size_t i = 0; i + 1 < indices.size(); i += 2)
                join(cell_of_[indices[i]], cell_of_[indices[i + 1]]);
        }
    }

    /// What hangs together, by triangles or as neighbours; parts whose boxes meet are one.
    [[nodiscard]] std::vector<Part> parts()
    {
        join_neighbours();
        std::vector<Part> by_root(cell_count);
        for (uint32_t i = 0; i < cell_count; ++i) {
            if (cells_[i].vertices > 0.0)
                by_root[root(i)].add(cells_[i].bounds, cells_[i].vertices, cells_[i].area_m2);
        }
        std::vector<Part> parts;
        for (const Part& part : by_root) {
            if (part.vertices > 0.0)
                merge_into(parts, part);
        }
        return parts;
    }

private:
    [[nodiscard]] uint32_t cell_at(const glm::dvec3& position) const
    {
        if (!holds(whole_, position))
            return outside;
        const glm::dvec3 place = (position - whole_.min) / side_m_;
        const glm::uvec3 cell = glm::min(glm::uvec3(place), glm::uvec3(side_cells - 1));
        return (cell.z * side_cells + cell.y) * side_cells + cell.x;
    }

    uint32_t root(uint32_t cell)
    {
        while (parents_[cell] != cell) {
            parents_[cell] = parents_[parents_[cell]];
            cell = parents_[cell];
        }
        return cell;
    }

    void join(uint32_t a, uint32_t b)
    {
        if (a != b && a != outside && b != outside)
            parents_[root(a)] = root(b);
    }

    /// A long way from one of a mesh's thousands of vertices to one far off is a broken vertex, and no
    /// surface.
    [[nodiscard]] bool is_spike(uint32_t a, uint32_t b) const
    {
        if (a == outside || b == outside)
            return a != b;
        constexpr double most_few = 1e-3;
        constexpr int long_cells = side_cells / 2;
        const auto [few, many] = std::minmax(cells_[a].vertices, cells_[b].vertices);
        const auto apart = [&](uint32_t stride) {
            return std::abs(static_cast<int>(a / stride % side_cells) -
                            static_cast<int>(b / stride % side_cells));
        };
        return few <= most_few * many &&
               std::max({apart(1), apart(side_cells), apart(side_cells * side_cells)}) >= long_cells;
    }

    void add_triangle(const PosedPrimitive& posed, uint32_t a, uint32_t b, uint32_t c)
    {
        const std::array<uint32_t, 3> in{cell_of_[a], cell_of_[b], cell_of_[c]};
        if (is_spike(in[0], in[1]) || is_spike(in[1], in[2]) || is_spike(in[2], in[0]))
            return;
        join(in[0], in[1]);
        join(in[1], in[2]);
        if (in[0] != outside) {
            const glm::dvec3& corner = posed.positions[a];
            cells_[in[0]].area_m2 +=
                0.5 * glm::length(glm::cross(posed.positions[b] - corner, posed.positions[c] - corner));
        }
    }

    void join_neighbours()
    {
        constexpr int side = side_cells;
        for (int i = 0; i < static_cast<int>(cell_count); ++i) {
            if (cells_[static_cast<size_t>(i)].vertices == 0.0)
                continue;
            const glm::ivec3 at(i % side, i / side % side, i / side / side);
            for (int k = 0; k < 27; ++k) {
                const glm::ivec3 next = at + glm::ivec3(k % 3, k / 3 % 3, k / 9) - 1;
                if (glm::any(glm::lessThan(next, glm::ivec3(0))) ||
                    glm::any(glm::greaterThanEqual(next, glm::ivec3(side))))
                    continue;
                const auto other = static_cast<uint32_t>((next.z * side + next.y) * side + next.x);
                if (cells_[other].vertices > 0.0)
                    join(static_cast<uint32_t>(i), other);
            }
        }
    }

    /// Adds a part, with all those whose boxes come within a cube's side of it.
    void merge_into(std::vector<Part>& parts, Part part) const
    {
        const auto meets = [&](const Part& other) {
            return glm::all(glm::lessThanEqual(part.bounds.min, other.bounds.max + side_m_)) &&
                   glm::all(glm::lessThanEqual(other.bounds.min, part.bounds.max + side_m_));
        };
        for (auto met = std::ranges::find_if(parts, meets); met != parts.end();
             met = std::ranges::find_if(parts, meets)) {
            part.add(met->bounds, met->vertices, met->area_m2);
            std::swap(*met, parts.back());
            parts.pop_back();
        }
        parts.push_back(part);
    }

    Bounds whole_;
    double side_m_ = 0.0;
    std::vector<StrayCell> cells_;
    std::vector<uint32_t> parents_;
    std::vector<uint32_t> cell_of_; ///< of the vertices of the primitive in hand
};

double length_of(const Bounds& bounds)
{
    return glm::length(bounds.max - bounds.min);
}

/// The part that outweighs all others together, if these are strays.
std::optional<Bounds> main_part(const std::vector<Part>& parts, const Bounds& whole)
{
    constexpr double home = 0.15; // bonus of the part nearest to the origin, from where strays have gone
    constexpr double least_weight = 0.5;  // of all
    constexpr double far_lengths = 20.0;  // of the subject, from end to end
    constexpr double speck_lengths = 8.0; // the same of specks
    constexpr double speck_share = 0.005; // of all vertices and of all area
    Part all;
    for (const Part& part : parts)
        all.add(part.bounds, part.vertices, part.area_m2);
    const auto nearest = std::ranges::min_element(
        parts, {}, [](const Part& part) { return glm::length(part.bounds.center()); });
    const auto share = [&](const Part& part) {
        const double of_vertices = part.vertices / all.vertices;
        return 0.5 * (of_vertices + (all.area_m2 > 0.0 ? part.area_m2 / all.area_m2 : of_vertices));
    };
    const auto weight = [&](const Part& part) { return share(part) + (&part == &*nearest ? home : 0.0); };
    const auto heaviest = std::ranges::max_element(parts, {}, weight);
    const double length_m = length_of(heaviest->bounds);
    const double far = 1.0 - share(*heaviest) <= speck_share ? speck_lengths : far_lengths;
    if (weight(*heaviest) < least_weight || !(length_m > 0.0) || length_of(whole) < far * length_m)
        return std::nullopt;
    return heaviest->bounds;
}

} // namespace

Bounds bounds_without_strays(const Scene& scene, const ScenePose& pose, const Bounds& whole)
{
    constexpr int most_rounds = 6; // some strays are much farther away than others
    Bounds bounds = whole;
    for (int round = 0; round < most_rounds && length_of(bounds) > 0.0; ++round) {
        if (!std::isfinite(length_of(bounds)))
            return whole;
        Grid grid(bounds);
        visit_posed(scene, pose, [&](const PosedPrimitive& posed) { grid.add(posed); });
        const std::vector<Part> parts = grid.parts();
        const std::optional<Bounds> main = parts.size() > 1 ? main_part(parts, bounds) : std::nullopt;
        if (!main)
            break;
        bounds = *main;
    }
    return bounds;
}

} // namespace estampe
