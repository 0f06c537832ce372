// SPDX-License-Identifier: MIT
#pragma once

// Motion blur within the outline of what moves: each pixel along its own way; or meshes stretched along their
// way, so that what they pass has a velocity too.

#include <span>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/motion_blur/motion_blur.hpp"

namespace estampe::motion_blur {

/// Blurs each pixel along its own way, from velocity to velocity: nothing is spread over what it passes.
///
/// Reads   `page`: the layers and half their way, packed
/// Writes  new layers
/// Cost    one full-screen dispatch, 17 texels a pixel
[[nodiscard]] MotionBlurLayers add_own_blur(gpu::Graph& graph, const MotionBlurInputs& in, gpu::ImageId page,
                                            const shared::MotionBlurConstants& constants);

/// Vertices at one place of one draw, which go together whatever their normals are: for each vertex where its
/// list begins and how long it is, then the lists.
struct CoincidentList {
    std::vector<glm::uvec2> of_vertex;
    std::vector<uint32_t> members;
};

/// `places` are of posed vertices at rest. Cost: n log n.
[[nodiscard]] CoincidentList list_coincident(std::span<const glm::vec3> places,
                                             std::span<const uint32_t> draw_of_vertex);

/// A CoincidentList on the device, made when a style first asks for it.
struct CoincidentVertices {
    gpu::Buffer of_vertex;
    gpu::Buffer members;
    uint32_t vertex_count = 0;

    [[nodiscard]] bool empty() const { return vertex_count == 0; }
};

[[nodiscard]] CoincidentVertices upload_coincident(gpu::Device& device, const CoincidentList& list);

/// Moves each vertex along its way, by half of it and its share: forwards where the surface about it faces
/// that way, else backwards.
///
/// Cost    one dispatch, one thread a vertex
/// Source  Wloka and Zeleznik, "Interactive Real-Time Motion Blur", The Visual Computer 12, 1996; Zanuttini,
///         "Recherches en rendu non réaliste temps réel", Université Paris 8, 2008, section 8.3
[[nodiscard]] VelocityShape add_stretch(gpu::Graph& graph, CoincidentVertices& together,
                                        const VelocityShapeInputs& in);

} // namespace estampe::motion_blur
