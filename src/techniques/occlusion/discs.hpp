// SPDX-License-Identifier: MIT
#pragma once

// Occlusion between discs, one a vertex: what is not seen occludes too.

#include <array>
#include <span>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/occlusion/discs.glsl.h"
#include "techniques/occlusion/occlusion_style.hpp"

namespace estampe::occlusion {

/// The discs of a scene in an order in which eight after another, and eight times so many, lie together.
struct DiscList {
    std::vector<uint32_t> vertices; ///< posed ones, those of triangles alone
    std::vector<float> areas_m2;    ///< a third of each triangle about it, at rest, and kept when it moves
};

/// Discs of `triangles`, whose first three numbers are vertices; `places` are theirs, times `unit_m`.
/// Cost: n log n.
[[nodiscard]] DiscList list_discs(std::span<const glm::vec3> places, float unit_m,
                                  std::span<const glm::uvec4> triangles);

/// What outlives a frame: the list, and what was found last.
struct DiscBuffers {
    gpu::Buffer vertices;
    gpu::Buffer open; ///< a float a posed vertex
    uint32_t disc_count = 0;
    uint32_t vertex_count = 0;
    bool is_found = false; ///< for the pose and the style in hand
    float radius_m = 0.0F; ///< of that

    [[nodiscard]] bool empty() const { return disc_count == 0; }
};

[[nodiscard]] DiscBuffers upload_discs(gpu::Device& device, const DiscList& list, uint32_t vertex_count);

/// A node of the tree counts as a whole where its radius is less than this of its distance.
inline constexpr float usual_apart = 0.35F;

/// Finds how much of the light from everywhere each vertex gets: 1 less the sum of A cos cos / (pi r^2 + A)
/// over all discs that face it, less with distance up to `radius_m`.
///
/// Returns a float a posed vertex; 1 for those without a disc
/// Cost    about n log n, and a small dispatch for each level of the tree; n^2 where `apart` is 0, which
/// looks
///         at each disc by itself
/// Source  Zanuttini, "Recherches en rendu non réaliste temps réel", Université Paris 8, 2008, section 8.4;
///         Bunnell, "Dynamic Ambient Occlusion and Indirect Lighting", GPU Gems 2, 2005
[[nodiscard]] gpu::BufferId add_discs(gpu::Graph& graph, DiscBuffers& buffers, gpu::BufferId posed_vertices,
                                      float radius_m, float apart = usual_apart);

struct DiscPageInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId open; ///< by add_discs()
    uint32_t vertex_count = 0;
    glm::uvec2 size_px{0};
};

/// The same for each pixel, as add_horizon() gives it. Cost: one full-screen dispatch.
[[nodiscard]] gpu::ImageId add_disc_page(gpu::Graph& graph, const DiscPageInputs& in, float strength);

} // namespace estampe::occlusion
