// SPDX-License-Identifier: MIT
#pragma once

// What tests of chains look at.

#include "scene/shapes.hpp"
#include "support/scenes.hpp"
#include "techniques/contour/contour.hpp"

namespace estampe::contour {

/// The shapes that the project has, each where it hides some of the others.
inline Scene shapes_scene()
{
    Scene scene = test::scene_of(shapes::sphere(1.0F, 48, 24));
    test::add_object(scene, shapes::torus(1.4F, 0.35F, 48, 20), glm::vec3(0.5F), {1.2, 0.3, 0.8});
    test::add_object(scene, shapes::box({1.0F, 1.4F, 0.8F}), glm::vec3(0.5F), {-1.3, -0.2, 0.9});
    test::add_object(scene, shapes::cone(0.7F, 1.6F, 24), glm::vec3(0.5F), {-0.6, 0.6, -1.4});
    test::add_object(scene, shapes::plane(6.0F, 6.0F, 4), glm::vec3(0.5F), {0.0, -1.0, 0.0});
    return scene;
}

inline Camera view_from_above()
{
    return {.eye = {3.1, 2.6, 6.3}, .target = {0.1, 0.0, 0.2}};
}

/// Lines of one width, in pixels.
inline ContourStyle even_lines(float width_px)
{
    ContourStyle style;
    style.outline_mm = style.boundary_mm = style.crease_mm = width_px;
    style.pressure = 0.0F;
    style.distance_thinning = 0.0F;
    style.taper_mm = 0.0F;
    return style;
}

} // namespace estampe::contour
