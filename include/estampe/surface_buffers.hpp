// SPDX-License-Identifier: MIT
#pragma once

// What each pixel of a picture shows of the scene: distance, normal, object, material and motion. For
// compositing, for measuring, and for programs that draw on top of a picture.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/motion.hpp>
#include <estampe/scene.hpp>

namespace estampe {

/// The solid surface at the centre of each pixel; see Renderer::render_buffers(). All arrays have width *
/// height items, rows from top to bottom. Transparent surfaces are left out: their pixels hold the surface
/// behind them.
struct SurfaceBuffers {
    uint32_t width = 0;
    uint32_t height = 0;
    /// Distance from the eye along the axis of view, in metres; infinity at pixels without a surface. Precise
    /// to about 1e-6 of the distance, in parallel projection to about 1e-5 of the scene's radius.
    std::vector<float> depth_m;
    /// Unit normal in world space, with normal maps, turned towards the eye; zero at pixels without a
    /// surface. Precise to about 0.005 degrees.
    std::vector<glm::vec3> normals;
    /// Index into Scene::nodes; no_index at pixels without a surface, on terrain, and on the blank ground
    /// that the renderer adds under a scene to receive shadows.
    std::vector<Index> objects;
    /// Index into Scene::materials; no_index where `objects` is, and on cloth whose two sides have different
    /// materials.
    std::vector<Index> materials;
    /// Motion since RenderSettings::motion_since; without pixels if that is not set.
    Motion motion;
};

} // namespace estampe
