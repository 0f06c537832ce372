// SPDX-License-Identifier: MIT
#pragma once

// Scenes for tests of chains.

#include <cmath>
#include <utility>
#include <vector>

#include <estampe/shapes.hpp>

#include "support/scenes.hpp"
#include "techniques/contour/contour.hpp"

namespace estampe::contour {

/// The project's basic shapes, placed so that they partly hide each other.
inline Scene shapes_scene()
{
    Scene scene = test::scene_of(shapes::sphere(1.0F, 48, 24));
    test::add_object(scene, shapes::torus(1.4F, 0.35F, 48, 20), glm::vec3(0.5F), {1.2, 0.3, 0.8});
    test::add_object(scene, shapes::box({1.0F, 1.4F, 0.8F}), glm::vec3(0.5F), {-1.3, -0.2, 0.9});
    test::add_object(scene, shapes::cone(0.7F, 1.6F, 24), glm::vec3(0.5F), {-0.6, 0.6, -1.4});
    test::add_object(scene, shapes::plane(6.0F, 6.0F, 4), glm::vec3(0.5F), {0.0, -1.0, 0.0});
    return scene;
}

/// A torus that is smooth around its axis and faceted around its tube.
inline Primitive banded_ring()
{
    std::vector<glm::vec2> profile;
    for (int i = 0; i <= 20; ++i) {
        const float angle = glm::radians(18.0F) * static_cast<float>(i % 20);
        profile.emplace_back(1.4F + 0.35F * std::sin(angle), -0.35F * std::cos(angle));
    }
    return shapes::lathe(profile, 48, 0.0F);
}

/// The page size of most tests.
inline constexpr glm::uvec2 page_px{480, 360};
inline constexpr glm::uvec2 small_page_px{320, 240};

inline bool bit(const std::vector<uint32_t>& words, size_t i)
{
    return (words[i / 32] >> (i % 32) & 1U) != 0;
}

/// Ink at a place of a page that is `width_px` wide.
inline float ink_at(const std::vector<float>& ink, uint32_t width_px, const glm::dvec2& place_px)
{
    const glm::ivec2 pixel(glm::floor(place_px));
    return ink[static_cast<size_t>(pixel.y) * width_px + static_cast<size_t>(pixel.x)];
}

/// Reverses the winding of all triangles, but keeps the normals.
inline Primitive wound_backwards(Primitive thing)
{
    for (size_t i = 0; i + 2 < thing.indices.size(); i += 3) {
        std::swap(thing.indices[i], thing.indices[i + 1]);
    }
    return thing;
}

inline Camera view_from_above()
{
    return {.eye = {3.1, 2.6, 6.3}, .target = {0.1, 0.0, 0.2}};
}

/// A style whose lines all have the same constant width in pixels.
inline ContourStyle even_lines(float width_px)
{
    ContourStyle style;
    style.outline.width_mm = style.border.width_mm = style.crease.width_mm = width_px;
    style.pressure = 0.0F;
    style.distance_thinning = 0.0F;
    style.taper_mm = 0.0F;
    style.rank = 0.0F;
    return style;
}

} // namespace estampe::contour
