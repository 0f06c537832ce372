// SPDX-License-Identifier: MIT
#pragma once

// Test meshes with known properties, and checks of coordinates over them.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/form/form.hpp"

namespace estampe::form::test {

constexpr float pi = std::numbers::pi_v<float>;

struct TestMesh {
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;

    [[nodiscard]] glm::vec3 corner(size_t triangle, size_t k) const
    {
        return positions[indices[3 * triangle + k]];
    }

    [[nodiscard]] glm::vec3 centroid(size_t triangle) const
    {
        return (corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2)) / 3.0F;
    }
};

/// Size of a grid of vertices, its random displacement, and its closed directions.
struct Grid {
    int columns = 0;
    int rows = 0;
    bool closes_columns = false;
    bool closes_rows = false;
};

/// A grid of `place(u, v)`, u and v in 0 to 1, with inner vertices displaced by up to 0.3 cells and random
/// diagonals.
template <typename Place>
TestMesh make_grid(const Grid& grid, Place place)
{
    TestMesh mesh;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> shake(-0.3F, 0.3F);
    for (int row = 0; row < grid.rows + (grid.closes_rows ? 0 : 1); ++row) {
        for (int column = 0; column < grid.columns + (grid.closes_columns ? 0 : 1); ++column) {
            const bool is_inner = (grid.closes_columns || (column > 0 && column < grid.columns)) &&
                                  (grid.closes_rows || (row > 0 && row < grid.rows));
            const float du = is_inner ? shake(random) : 0.0F;
            const float dv = is_inner ? shake(random) : 0.0F;
            mesh.positions.push_back(
                place((static_cast<float>(column) + du) / static_cast<float>(grid.columns),
                      (static_cast<float>(row) + dv) / static_cast<float>(grid.rows)));
        }
    }
    const int width = grid.closes_columns ? grid.columns : grid.columns + 1;
    const int height = grid.closes_rows ? grid.rows : grid.rows + 1;
    const auto at = [&](int column, int row) {
        return static_cast<uint32_t>((row % height) * width + column % width);
    };
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            const uint32_t a = at(column, row);
            const uint32_t b = at(column + 1, row);
            const uint32_t c = at(column + 1, row + 1);
            const uint32_t d = at(column, row + 1);
            const auto cut = shake(random) < 0.0F ? std::array<uint32_t, 6>{a, b, c, a, c, d}
                                                  : std::array<uint32_t, 6>{a, b, d, b, c, d};
            mesh.indices.insert(mesh.indices.end(), cut.begin(), cut.end());
        }
    }
    return mesh;
}

/// An open cylinder of radius 1 and length 3 along y.
inline TestMesh cylinder()
{
    return make_grid({.columns = 48, .rows = 24, .closes_columns = true}, [](float u, float v) {
        return glm::vec3(std::cos(2 * pi * u), 3.0F * v, -std::sin(2 * pi * u));
    });
}

/// A tube of radius 1 around a circle of radius 2 in the plane y = 0.
inline TestMesh torus()
{
    return make_grid(
        {.columns = 96, .rows = 48, .closes_columns = true, .closes_rows = true}, [](float u, float v) {
            const float away = 2.0F + std::cos(2 * pi * v);
            return glm::vec3(away * std::cos(2 * pi * u), std::sin(2 * pi * v), -away * std::sin(2 * pi * u));
        });
}

/// Maps -1 to 1 to -1 to 1 so that a cube blown up to a sphere has even cells and both halves are exact
/// mirror images.
inline float evened(float x)
{
    const float rounded = std::round(x * 4096.0F) / 4096.0F;
    return std::abs(rounded) == 1.0F ? rounded : std::tan(0.25F * pi * rounded);
}

/// A cube of `cells` x `cells` squares per side, blown up to a sphere, or to what `place` returns for a unit
/// vector.
template <typename Place>
TestMesh ball(int cells, Place place)
{
    TestMesh mesh;
    for (int side = 0; side < 6; ++side) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        const TestMesh face = make_grid({.columns = cells, .rows = cells}, [&](float u, float v) {
            const float sign = side % 2 == 0 ? 1.0F : -1.0F;
            const glm::vec3 p(evened(2 * u - 1) * sign, evened(2 * v - 1), sign);
            const glm::vec3 turned = side < 2   ? p
                                     : side < 4 ? glm::vec3(p.y, p.z, p.x)
                                                : glm::vec3(p.z, p.x, p.y);
            // In double precision, so that the sides meet at identical places.
            return place(glm::vec3(glm::normalize(glm::dvec3(turned))));
        });
        mesh.positions.insert(mesh.positions.end(), face.positions.begin(), face.positions.end());
        for (const uint32_t index : face.indices) {
            mesh.indices.push_back(first + index);
        }
    }
    return mesh;
}

/// Gradient of coordinate `which` (0: a, 1: b) over a triangle, in periods per metre.
inline glm::vec3 gradient(const TestMesh& mesh, const FormField& field, size_t triangle, int which)
{
    const glm::dvec3 p0 = mesh.corner(triangle, 0);
    const glm::dvec3 e1 = glm::dvec3(mesh.corner(triangle, 1)) - p0;
    const glm::dvec3 e2 = glm::dvec3(mesh.corner(triangle, 2)) - p0;
    const glm::dvec3 normal = glm::cross(e1, e2);
    const auto& value = field.corners[triangle];
    const double along_1 = value[1][which] - value[0][which];
    const double along_2 = value[2][which] - value[0][which];
    return glm::vec3((along_1 * glm::cross(e2, normal) + along_2 * glm::cross(normal, e1)) /
                     glm::dot(normal, normal));
}

/// Coordinate a (0), b (1) or their sum (2); the sum breaks where only one of them changes its sign.
inline float coordinate(const glm::vec2& corner, int which)
{
    return which == 2 ? corner.x + corner.y : corner[which];
}

/// Continuity of one coordinate across edges flatter than 45 degrees.
struct Seams {
    int edges = 0;
    int breaks = 0; ///< the values differ by no whole number, for either sign
    int jumps = 0;  ///< the values differ by a whole number other than 0, or by a sign
};

inline std::tuple<float, float, float> place_of(const glm::vec3& p)
{
    return {p.x + 0.0F, p.y + 0.0F, p.z + 0.0F};
}

/// Skips edges of faulty triangles unless `with_faulty`.
inline Seams find_seams(const TestMesh& mesh, const FormField& field, int which, bool with_faulty = false)
{
    struct Side {
        size_t triangle;
        glm::vec2 values; ///< at the lower and the higher end
        glm::vec3 normal;
    };

    std::map<std::pair<std::tuple<float, float, float>, std::tuple<float, float, float>>, std::vector<Side>>
        sides;
    for (size_t t = 0; t < field.corners.size(); ++t) {
        const glm::vec3 normal = glm::normalize(
            glm::cross(mesh.corner(t, 1) - mesh.corner(t, 0), mesh.corner(t, 2) - mesh.corner(t, 0)));
        for (size_t k = 0; k < 3; ++k) {
            auto from = place_of(mesh.corner(t, k));
            auto to = place_of(mesh.corner(t, (k + 1) % 3));
            glm::vec2 values(coordinate(field.corners[t][k], which),
                             coordinate(field.corners[t][(k + 1) % 3], which));
            if (to < from) {
                std::swap(from, to);
                std::swap(values.x, values.y);
            }
            sides[{from, to}].push_back({t, values, normal});
        }
    }
    Seams seams;
    const auto fits = [](glm::vec2 difference) {
        return std::abs(difference.x - difference.y) < 1e-3F &&
               std::abs(difference.x - std::round(difference.x)) < 1e-3F;
    };
    for (const auto& [place, pair] : sides) {
        if (pair.size() != 2 || glm::dot(pair[0].normal, pair[1].normal) < 0.72F) {
            continue;
        }
        if (!with_faulty && (field.is_faulty[pair[0].triangle] | field.is_faulty[pair[1].triangle]) != 0) {
            continue;
        }
        ++seams.edges;
        const glm::vec2 difference = pair[0].values - pair[1].values;
        const bool is_same = fits(difference);
        seams.breaks += is_same || fits(pair[0].values + pair[1].values) ? 0 : 1;
        seams.jumps += is_same && std::abs(difference.x) < 0.5F ? 0 : 1;
    }
    return seams;
}

inline FormField follow(const TestMesh& mesh, float period_m)
{
    return follow_form(mesh.positions, mesh.indices, {.period_m = period_m});
}

} // namespace estampe::form::test
