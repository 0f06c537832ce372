// SPDX-License-Identifier: MIT
#pragma once

// Occlusion between discs, one a vertex: what is not seen occludes too. At vertices, at pixels, or at the
// texels of a map that lies on all surfaces.

#include <optional>
#include <span>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/occlusion/alternatives/discs.glsl.h"
#include "techniques/occlusion/occlusion.hpp"

namespace estampe::occlusion {

/// Whether there is a disc at each vertex.
[[nodiscard]] constexpr bool has_discs(Method method)
{
    return method == Method::discs || method == Method::splats || method == Method::uv;
}

/// The discs of a scene in an order in which eight after another, and eight times so many, lie together.
struct DiscList {
    std::vector<uint32_t> vertices; ///< posed ones, those of triangles alone
    std::vector<float> areas_m2;    ///< a third of each triangle about it, at rest, and kept when it moves
    std::vector<glm::vec4> colors;  ///< of all nodes of the tree, linear; empty where none are known
};

/// Discs of `triangles`, whose first three numbers are vertices; `places` are theirs, times `unit_m`.
/// Cost: n log n.
[[nodiscard]] DiscList list_discs(std::span<const glm::vec3> places, float unit_m,
                                  std::span<const glm::uvec4> triangles);

/// Colours the discs by their vertices' colours, and each node by the mean of what lies below it, by area.
void color_discs(DiscList& list, std::span<const glm::vec3> color_of_vertex);

/// What outlives a frame: the list, and what was found last.
struct DiscBuffers {
    gpu::Buffer vertices;
    gpu::Buffer colors;     ///< of all nodes
    gpu::Buffer visibility; ///< a float a posed vertex
    gpu::Buffer bounced;    ///< four floats a posed vertex
    uint32_t disc_count = 0;
    uint32_t vertex_count = 0;
    bool is_found = false;    ///< for the pose and the style in hand
    float radius_m = 0.0F;    ///< of that
    bool has_bounced = false; ///< what is bounced was found with it

    [[nodiscard]] bool empty() const { return disc_count == 0; }
};

[[nodiscard]] DiscBuffers upload_discs(gpu::Device& device, const DiscList& list, uint32_t vertex_count);

/// A node of the tree counts as a whole where its radius is less than this of its distance.
inline constexpr float usual_apart = 0.35F;

/// How the sum over discs is made.
struct DiscSettings {
    float radius_m = 1.0F; ///< discs farther off count for nothing
    float apart = usual_apart;
    bool bounces = false; ///< light that they bounce back is wanted too
};

/// What was found for posed vertices.
struct VertexOcclusion {
    gpu::BufferId visibility;             ///< a float each
    std::optional<gpu::BufferId> bounced; ///< four floats each
};

/// Finds how much of the light from everywhere each vertex gets: 1 less the sum of A cos cos / (pi r^2 + A)
/// over all discs that face it, less with distance up to the radius; and what they bounce of it, which is the
/// same sum, each disc in its colour. Of a list without colours nothing may be bounced.
///
/// Returns a float a posed vertex; 1 for those without a disc
/// Cost    about n log n, and a small dispatch for each level of the tree; n^2 where `apart` is 0, which
///         looks at each disc by itself
/// Source  Zanuttini, "Recherches en rendu non réaliste temps réel", Université Paris 8, 2008, section 8.4;
///         Bunnell, "Dynamic Ambient Occlusion and Indirect Lighting", GPU Gems 2, 2005
[[nodiscard]] VertexOcclusion add_discs(gpu::Graph& graph, DiscBuffers& buffers, gpu::BufferId posed_vertices,
                                        const DiscSettings& settings);

/// The sum at each pixel itself: what splatting every disc over all that it reaches would add up there.
///
/// Cost    one full-screen dispatch that goes with the logarithm of the discs: 40 ms and more on a processor
/// Source  as add_discs()
[[nodiscard]] AmbientOcclusion add_disc_splats(gpu::Graph& graph, DiscBuffers& buffers,
                                               gpu::BufferId posed_vertices, const OcclusionInputs& in,
                                               const OcclusionStyle& style, float apart = usual_apart);

/// What was found last for a map's texels: it outlives a frame.
struct DiscMapBuffers {
    gpu::Buffer found; ///< four floats a texel: what is bounced onto it, and what is open; -1 off the surface
    uint32_t size = 0; ///< texels a side
    bool is_found = false; ///< for the pose and the style in hand
    float radius_m = 0.0F; ///< of that
    bool has_bounced = false;
};

/// Of a map of so many texels a side.
[[nodiscard]] DiscMapBuffers make_disc_map(gpu::Device& device, uint32_t size);

struct DiscMapInputs {
    gpu::BufferId map_texels; ///< see shaders/surface_map.glsl
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
};

/// The sum of add_discs() at the middle of each texel. Kept until something moves.
///
/// Returns four floats a texel, row by row, as DiscMapBuffers has them
/// Cost    texels times the logarithm of the discs, and the tree
/// Source  as add_discs(); to a texture as the thesis has it
[[nodiscard]] gpu::BufferId add_disc_map(gpu::Graph& graph, DiscBuffers& discs, DiscMapBuffers& map,
                                         const DiscMapInputs& in, const DiscSettings& settings);

/// By one of the three above, as the style says, brought to the page; none where there are no discs.
///
/// Cost    that of the sum, and one full-screen dispatch that takes it between vertices or texels
[[nodiscard]] std::optional<AmbientOcclusion> add_disc_occlusion(gpu::Graph& graph, DiscBuffers& discs,
                                                                 DiscMapBuffers& map,
                                                                 const OcclusionInputs& in,
                                                                 const OcclusionStyle& style);

} // namespace estampe::occlusion
