// SPDX-License-Identifier: MIT
// The methods that divide a terrain into triangles. mesh_method() chooses one of them.
#include "techniques/terrain/mesh/mesh_method.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace estampe::terrain {
namespace {

/// Nested square grids around the eye. Each grid has twice the cell size of the grid inside it, and a hole
/// for the inner grid. A grid follows the eye in steps of two cells, so that its even vertices coincide with
/// vertices of the next outer grid. A grid's outermost triangles use only even vertices along the border, at
/// the heights of the outer grid. So the inner and the outer grid share their edges bit for bit. The hole may
/// be off by one cell in each direction; a trim of one column and one row of cells fills the gap.
class Rings : public MeshMethod {
public:
    explicit Rings(const TerrainMeshing& meshing);

    [[nodiscard]] MeshTopology topology() const override;
    [[nodiscard]] std::vector<shared::TerrainLevel> place(const EyePlace& eye,
                                                          const glm::dvec2& anchor_m) const override;

private:
    double cell_m_;
    uint32_t cells_;
    uint32_t levels_ = 1;
};

/// One uniform grid that follows the eye in steps of one cell, with three quarters of the grid ahead of the
/// eye. The grid turns only by right angles, so its vertices stay at multiples of the cell size.
class Grid : public MeshMethod {
public:
    explicit Grid(const TerrainMeshing& meshing);

    [[nodiscard]] MeshTopology topology() const override;
    [[nodiscard]] std::vector<shared::TerrainLevel> place(const EyePlace& eye,
                                                          const glm::dvec2& anchor_m) const override;

private:
    double cell_m_;
    uint32_t cells_;
};

/// An existing mesh of the scene. The terrain's heights are added to the mesh's vertices.
class Raised : public MeshMethod {
public:
    explicit Raised(ObjectTriangles object);

    [[nodiscard]] MeshTopology topology() const override;
    [[nodiscard]] std::vector<shared::TerrainLevel> place(const EyePlace& eye,
                                                          const glm::dvec2& anchor_m) const override;

private:
    ObjectTriangles object_;
    float spacing_m_; ///< approximate distance between vertices, in metres
};

/// The finest cell size of the mesh, rounded to a power of two so that the positions of vertices are exact
/// numbers.
double cell_of(const TerrainMeshing& meshing)
{
    return std::exp2(std::round(std::log2(static_cast<double>(meshing.cell_m))));
}

/// Number of cells along a side of a grid: at least `least`, and a multiple of four.
uint32_t cells_of(const TerrainMeshing& meshing, uint32_t least)
{
    return std::max(least, (static_cast<uint32_t>(meshing.cells) + 3U) / 4U * 4U);
}

} // namespace

std::unique_ptr<MeshMethod> mesh_method(const TerrainMeshing& meshing, const ObjectTriangles& object)
{
    if (meshing.method == TerrainMesh::object) {
        return std::make_unique<Raised>(object);
    }
    if (meshing.method == TerrainMesh::grid) {
        return std::make_unique<Grid>(meshing);
    }
    return std::make_unique<Rings>(meshing);
}

glm::vec2 vertex_place(uint32_t vertex, const std::vector<shared::TerrainLevel>& levels)
{
    constexpr uint32_t mask = (1U << shared::terrain_index_bits) - 1U;
    const shared::TerrainLevel& level = levels[vertex >> 28U];
    glm::uvec2 index(vertex & mask, vertex >> shared::terrain_index_bits & mask);
    const uint32_t part = vertex >> 26U & 3U;
    if (part == shared::terrain_part_trim_column) {
        index += level.hole_first + glm::uvec2(level.hole_shift.x == 1 ? 0 : level.hole_count, 0);
    } else if (part == shared::terrain_part_trim_row) {
        index +=
            level.hole_first + glm::uvec2(level.hole_shift.x, level.hole_shift.y == 1 ? 0 : level.hole_count);
    }
    return level.origin_m + level.cell_m * glm::vec2(index);
}

Grid::Grid(const TerrainMeshing& meshing) : cell_m_(cell_of(meshing)), cells_(cells_of(meshing, 16)) {}

MeshTopology Grid::topology() const
{
    MeshTopology mesh;
    const uint32_t row = cells_ + 1;
    for (uint32_t j = 0; j <= cells_; ++j) {
        for (uint32_t i = 0; i <= cells_; ++i) {
            mesh.vertices.push_back(i | j << shared::terrain_index_bits);
        }
    }
    for (uint32_t j = 0; j < cells_; ++j) {
        for (uint32_t i = 0; i < cells_; ++i) {
            const uint32_t corner = j * row + i;
            mesh.triangles.emplace_back(corner, corner + row + 1, corner + 1);
            mesh.triangles.emplace_back(corner, corner + row, corner + row + 1);
        }
    }
    return mesh;
}

std::vector<shared::TerrainLevel> Grid::place(const EyePlace& eye, const glm::dvec2& anchor_m) const
{
    const bool along_x = std::abs(eye.ahead.x) >= std::abs(eye.ahead.y);
    const double side = (along_x ? eye.ahead.x : eye.ahead.y) < 0.0 ? -1.0 : 1.0;
    const glm::dvec2 quarter = 0.25 * cells_ * side * (along_x ? glm::dvec2(1.0, 0.0) : glm::dvec2(0.0, 1.0));
    const glm::dvec2 origin = glm::floor(eye.eye_m / cell_m_) - 0.5 * cells_ + quarter;
    constexpr float never = std::numeric_limits<float>::max();
    return {{.origin_m = glm::vec2(origin * cell_m_ - anchor_m),
             .eye_cells = glm::vec2(eye.eye_m / cell_m_ - origin),
             .cell_m = static_cast<float>(cell_m_),
             .fade_from = never,
             .fade_to = never}};
}

namespace {

/// Approximate distance between the vertices of a mesh: the side of a square whose area is the mean area of
/// two triangles, seen from above.
float spacing_of(const ObjectTriangles& object)
{
    double area = 0.0;
    for (const glm::uvec3& triangle : object.triangles) {
        const glm::dvec3 a = object.places[triangle.x];
        const glm::dvec3 b = object.places[triangle.y] - a;
        const glm::dvec3 c = object.places[triangle.z] - a;
        area += 0.5 * std::abs(b.x * c.z - b.z * c.x);
    }
    const auto pairs = static_cast<double>(std::max<size_t>(object.triangles.size() / 2, 1));
    return static_cast<float>(std::sqrt(area / pairs));
}

} // namespace

Raised::Raised(ObjectTriangles object) : object_(std::move(object)), spacing_m_(spacing_of(object_)) {}

MeshTopology Raised::topology() const
{
    return {.places = object_.places,
            .vertices = std::vector<uint32_t>(object_.places.size()),
            .triangles = object_.triangles};
}

std::vector<shared::TerrainLevel> Raised::place(const EyePlace& /*eye*/, const glm::dvec2& anchor_m) const
{
    constexpr float never = std::numeric_limits<float>::max();
    return {{.origin_m = glm::vec2(-anchor_m), .cell_m = spacing_m_, .fade_from = never, .fade_to = never}};
}

namespace {

constexpr uint32_t most_levels = 16;
constexpr uint32_t none = std::numeric_limits<uint32_t>::max();

/// The used vertices of one grid. A vertex is created when it is used for the first time.
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
        // Seen from above, x points to the right and z points down. So a counter-clockwise triangle has a
        // negative cross product.
        const auto cross = [](glm::ivec2 p, glm::ivec2 q) { return p.x * q.y - p.y * q.x; };
        if (cross(glm::ivec2(b) - glm::ivec2(a), glm::ivec2(c) - glm::ivec2(a)) > 0) {
            std::swap(b, c);
        }
        mesh_.triangles.emplace_back(at(a.x, a.y), at(b.x, b.y), at(c.x, c.y));
    }

    /// Adds the two triangles of a cell, divided along the diagonal from its first corner to its last.
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

/// Adds the outermost cells of a square grid with n cells per side. On the outer border of the grid, edges of
/// triangles are two cells long.
void add_border(GridVertices& grid, uint32_t n)
{
    for (uint32_t side = 0; side < 4; ++side) {
        // The vertex at `along` cells along the border and `in` cells away from the border.
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
