// SPDX-License-Identifier: MIT
#include "techniques/terrain/mesh/mesh_methods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace estampe::terrain {
namespace {

constexpr uint32_t most_levels = 16;
constexpr uint32_t none = std::numeric_limits<uint32_t>::max();

/// The vertices of one grid that are used, made when they are first asked for.
class GridVertices {
public:
    GridVertices(MeshTopology& mesh, uint32_t word, uint32_t columns, uint32_t rows)
        : mesh_(mesh), word_(word), columns_(columns), known_(size_t{columns} * rows, none)
    {
    }

    uint32_t at(uint32_t i, uint32_t j)
    {
        uint32_t& vertex = known_[size_t{j} * columns_ + i];
        if (vertex == none) {
            vertex = static_cast<uint32_t>(mesh_.vertices.size());
            mesh_.vertices.push_back(word_ | i | j << shared::terrain_index_bits);
        }
        return vertex;
    }

    void triangle(glm::uvec2 a, glm::uvec2 b, glm::uvec2 c)
    {
        // Seen from above with x to the right, z runs down: counter-clockwise is the other way round there.
        const auto cross = [](glm::ivec2 p, glm::ivec2 q) { return p.x * q.y - p.y * q.x; };
        if (cross(glm::ivec2(b) - glm::ivec2(a), glm::ivec2(c) - glm::ivec2(a)) > 0) {
            std::swap(b, c);
        }
        mesh_.triangles.emplace_back(at(a.x, a.y), at(b.x, b.y), at(c.x, c.y));
    }

    /// Two triangles, parted from the first corner to the last.
    void cell(uint32_t i, uint32_t j)
    {
        triangle({i, j}, {i + 1, j}, {i + 1, j + 1});
        triangle({i, j}, {i + 1, j + 1}, {i, j + 1});
    }

private:
    MeshTopology& mesh_;
    uint32_t word_;
    uint32_t columns_;
    std::vector<uint32_t> known_;
};

/// The outermost cells of a grid of n x n, whose border goes in steps of two.
void add_border(GridVertices& grid, uint32_t n)
{
    for (uint32_t side = 0; side < 4; ++side) {
        // `along` the border, `in` from it.
        const auto place = [&](uint32_t along, uint32_t in) {
            const glm::uvec2 lower(along, in);
            const glm::uvec2 upper(along, n - in);
            const glm::uvec2 p = (side & 1U) != 0 ? upper : lower;
            return side >= 2 ? glm::uvec2(p.y, p.x) : p;
        };
        for (uint32_t i = 0; i < n; i += 2) {
            if (i > 0) {
                grid.triangle(place(i, 0), place(i, 1), place(i + 1, 1));
            }
            grid.triangle(place(i, 0), place(i + 1, 1), place(i + 2, 0));
            if (i + 2 < n) {
                grid.triangle(place(i + 2, 0), place(i + 1, 1), place(i + 2, 1));
            }
        }
    }
}

} // namespace

Rings::Rings(const TerrainMeshing& meshing) : cell_m_(cell_of(meshing)), cells_(cells_of(meshing, 32))
{
    const auto reach_of = [&](uint32_t levels) {
        return cell_m_ * std::exp2(levels - 1) * (0.5 * cells_ - 2.0);
    };
    while (levels_ < most_levels && reach_of(levels_) < static_cast<double>(meshing.reach_m)) {
        ++levels_;
    }
}

MeshTopology Rings::topology() const
{
    MeshTopology mesh;
    const uint32_t n = cells_;
    const uint32_t hole_first = n / 4;
    const uint32_t hole_count = n / 2;
    for (uint32_t level = 0; level < levels_; ++level) {
        const uint32_t word = level << 28U;
        GridVertices grid(mesh, word, n + 1, n + 1);
        const bool is_last = level + 1 == levels_;
        const uint32_t border = is_last ? 0 : 1;
        const auto is_hole = [&](uint32_t i, uint32_t j) {
            const auto within = [&](uint32_t k) { return k >= hole_first && k <= hole_first + hole_count; };
            return level > 0 && within(i) && within(j);
        };
        for (uint32_t j = border; j + border < n; ++j) {
            for (uint32_t i = border; i + border < n; ++i) {
                if (!is_hole(i, j)) {
                    grid.cell(i, j);
                }
            }
        }
        if (!is_last) {
            add_border(grid, n);
        }
        if (level > 0) {
            GridVertices column(mesh, word | shared::terrain_part_trim_column << 26U, 2, hole_count + 2);
            for (uint32_t j = 0; j <= hole_count; ++j) {
                column.cell(0, j);
            }
            GridVertices row(mesh, word | shared::terrain_part_trim_row << 26U, hole_count + 1, 2);
            for (uint32_t i = 0; i < hole_count; ++i) {
                row.cell(i, 0);
            }
        }
    }
    return mesh;
}

std::vector<shared::TerrainLevel> Rings::place(const EyePlace& eye, const glm::dvec2& anchor_m) const
{
    std::vector<shared::TerrainLevel> result;
    for (uint32_t level = 0; level < levels_; ++level) {
        const double cell_m = cell_m_ * std::exp2(level);
        const glm::dvec2 eye_cells = eye.eye_m / cell_m;
        const glm::dvec2 origin = 2.0 * glm::floor(0.5 * eye_cells) - 0.5 * cells_;
        const glm::dvec2 shift = glm::floor(eye_cells) - 2.0 * glm::floor(0.5 * eye_cells);
        const bool is_last = level + 1 == levels_;
        const double fade_to = is_last ? std::numeric_limits<float>::max() : 0.5 * cells_ - 2.0;
        const double fade_from = is_last ? fade_to : 0.95 * fade_to;
        result.push_back({.origin_m = glm::vec2(origin * cell_m - anchor_m),
                          .eye_cells = glm::vec2(eye_cells - origin),
                          .cell_m = static_cast<float>(cell_m),
                          .fade_from = static_cast<float>(fade_from),
                          .fade_to = static_cast<float>(fade_to),
                          .hole_first = cells_ / 4,
                          .hole_count = cells_ / 2,
                          .hole_shift = glm::uvec2(shift)});
    }
    return result;
}

} // namespace estampe::terrain
