// SPDX-License-Identifier: MIT
#pragma once

// Meshes for tests of baked normal maps.

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include <glm/glm.hpp>

#include <estampe/normal_map.hpp>
#include <estampe/scene.hpp>

#include "support/scenes.hpp"

namespace estampe::bake::testing {

inline constexpr double turn_rad = 2.0 * std::numbers::pi;

/// A point of a surface with its normal and texture coordinates.
struct SurfacePoint {
    glm::dvec3 position;
    glm::dvec3 normal;
    glm::dvec2 uv;
};

/// A grid of `columns` times `rows` squares: `at` maps (0, 0) to (1, 1) to the surface. Its front is the side
/// from which the first coordinate runs to the right and the second one up.
inline Primitive patch(uint32_t columns, uint32_t rows, const std::function<SurfacePoint(double, double)>& at)
{
    Primitive primitive;
    for (uint32_t row = 0; row <= rows; ++row) {
        for (uint32_t column = 0; column <= columns; ++column) {
            const SurfacePoint point =
                at(static_cast<double>(column) / columns, static_cast<double>(row) / rows);
            primitive.positions.emplace_back(point.position);
            primitive.normals.emplace_back(point.normal);
            primitive.uvs[0].emplace_back(point.uv);
            if (column < columns && row < rows) {
                const uint32_t first = row * (columns + 1) + column;
                const uint32_t above = first + columns + 1;
                for (const uint32_t index : {first, first + 1, above + 1, first, above + 1, above}) {
                    primitive.indices.push_back(index);
                }
            }
        }
    }
    return primitive;
}

/// The unit square in the plane z = 0, which faces +z. Its texture is upright.
inline Primitive square()
{
    return patch(1, 1, [](double x, double y) {
        return SurfacePoint{{x, y, 0.0}, {0.0, 0.0, 1.0}, {x, 1.0 - y}};
    });
}

inline constexpr double wave_height_m = 0.03;

/// Normal of the waves z = wave_height_m sin(turn x) cos(turn y).
inline glm::dvec3 wave_normal(double x, double y)
{
    const double a = turn_rad * x;
    const double b = turn_rad * y;
    return glm::normalize(glm::dvec3(-wave_height_m * turn_rad * std::cos(a) * std::cos(b),
                                     wave_height_m * turn_rad * std::sin(a) * std::sin(b), 1.0));
}

/// Waves over the unit square and a border of 5 % around it.
inline Primitive waves(uint32_t cells = 256)
{
    return patch(cells, cells, [](double u, double v) {
        const double x = 1.1 * u - 0.05;
        const double y = 1.1 * v - 0.05;
        const double z = wave_height_m * std::sin(turn_rad * x) * std::cos(turn_rad * y);
        return SurfacePoint{{x, y, z}, wave_normal(x, y), {u, 1.0 - v}};
    });
}

/// A unit sphere of meridians and parallels with smooth normals, and one texture around it.
inline Primitive globe(uint32_t columns, uint32_t rows)
{
    return patch(columns, rows, [](double u, double v) {
        const double longitude = turn_rad * u;
        const double latitude = std::numbers::pi * (v - 0.5);
        const glm::dvec3 place(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                               std::cos(latitude) * std::cos(longitude));
        return SurfacePoint{place, place, {u, 1.0 - v}};
    });
}

/// The normal that a texel stores.
inline glm::dvec3 texel_of(const Image& map, uint32_t x, uint32_t y)
{
    const uint8_t* const texel = &map.rgba[size_t{4} * (y * map.width + x)];
    return glm::dvec3(texel[0], texel[1], texel[2]) / 127.5 - 1.0;
}

} // namespace estampe::bake::testing
