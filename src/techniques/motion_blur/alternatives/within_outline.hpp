// SPDX-License-Identifier: MIT
#pragma once

// Motion blur within the outline of moving objects: each pixel is blurred along its own motion. In the mode
// `stretched`, meshes are also stretched along their motion, so that the pixels over which a mesh passes get
// a velocity.

#include <span>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/motion_blur/motion_blur.hpp"

namespace estampe::motion_blur {

/// Blurs each pixel along a path that follows the velocities of the pixels on its way. No object blurs over
/// its background.
///
/// Reads   `page`: packed layers with the displacement in half the exposure
/// Writes  new layers
/// Cost    one full-screen dispatch, 17 texels per pixel
[[nodiscard]] MotionBlurLayers add_own_blur(gpu::Graph& graph, const MotionBlurInputs& in, gpu::ImageId page,
                                            const shared::MotionBlurConstants& constants);

/// Lists of the vertices at the same position in one draw call. Vertices at the same position move together
/// even if their normals differ. `of_vertex` holds the start and length of each vertex's list in `members`.
struct CoincidentList {
    std::vector<glm::uvec2> of_vertex;
    std::vector<uint32_t> members;
};

/// Finds vertices at the same position. `places` are the positions of the vertices in the rest pose (without
/// animation). Cost: n log n.
[[nodiscard]] CoincidentList list_coincident(std::span<const glm::vec3> places,
                                             std::span<const uint32_t> draw_of_vertex);

/// A CoincidentList (vertices at the same position) on the device. The list is made when a style uses the
/// list for the first time.
struct CoincidentVertices {
    gpu::Buffer of_vertex;
    gpu::Buffer members;
    uint32_t vertex_count = 0;

    [[nodiscard]] bool empty() const { return vertex_count == 0; }
};

[[nodiscard]] CoincidentVertices upload_coincident(gpu::Device& device, const CoincidentList& list);

/// Displaces each vertex by its motion times `share`: forwards if the surface around it faces in the
/// direction of motion, otherwise backwards.
///
/// Cost    one dispatch, one thread per vertex
/// Source  Wloka and Zeleznik, "Interactive Real-Time Motion Blur", The Visual Computer 12, 1996; Zanuttini,
///         "Recherches en rendu non réaliste temps réel", Université Paris 8, 2008, section 8.3
[[nodiscard]] VelocityShape add_stretch(gpu::Graph& graph, CoincidentVertices& together,
                                        const VelocityShapeInputs& in);

} // namespace estampe::motion_blur
