// SPDX-License-Identifier: MIT
#pragma once

// Ambient occlusion between discs, one per vertex, so that invisible surfaces also occlude. The occlusion is
// computed per vertex, per pixel, or per texel of a map of all surfaces.

#include <optional>
#include <span>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/occlusion/alternatives/discs.glsl.h"
#include "techniques/occlusion/occlusion.hpp"

namespace estampe::occlusion {

/// Whether the occlusion method needs a disc at each vertex.
[[nodiscard]] constexpr bool has_discs(Method method)
{
    return method == Method::discs || method == Method::splats || method == Method::uv;
}

/// The occluding discs of a scene, sorted so that each run of 8, 64, ... neighbours is close together in
/// space.
struct DiscList {
    std::vector<uint32_t> vertices; ///< indices of posed vertices that belong to triangles
    /// Area of each disc: a third of the area of the vertex's triangles, in the rest pose.
    std::vector<float> areas_m2;
    std::vector<glm::vec4> colors; ///< linear colour of each node of the tree; empty without colours
};

/// Makes the list of discs from `triangles`, whose first three numbers are vertex indices. `places` are the
/// vertices in units of `unit_m`. Cost: n log n.
[[nodiscard]] DiscList list_discs(std::span<const glm::vec3> places, float unit_m,
                                  std::span<const glm::uvec4> triangles);

/// Sets the discs' colours from vertex colours. Each tree node gets the area-weighted mean of its children's
/// colours.
void color_discs(DiscList& list, std::span<const glm::vec3> color_of_vertex);

/// The list of discs and the last occlusion result, kept from frame to frame.
struct DiscBuffers {
    gpu::Buffer vertices;
    gpu::Buffer colors;     ///< colour of each node of the tree
    gpu::Buffer visibility; ///< visibility, one float per posed vertex
    gpu::Buffer bounced;    ///< bounced light, four floats per posed vertex
    uint32_t disc_count = 0;
    uint32_t vertex_count = 0;
    bool is_found = false;    ///< the result is valid for the current pose and style
    float radius_m = 0.0F;    ///< occlusion radius of the result
    bool has_bounced = false; ///< the result includes bounced light

    [[nodiscard]] bool empty() const { return disc_count == 0; }
};

[[nodiscard]] DiscBuffers upload_discs(gpu::Device& device, const DiscList& list, uint32_t vertex_count);

/// A node of the tree counts as one disc if the node's radius is less than `apart` times its distance.
inline constexpr float usual_apart = 0.35F;

/// Settings of the sum over occluding discs.
struct DiscSettings {
    float radius_m = 1.0F; ///< largest distance of a disc that occludes, in metres
    float apart = usual_apart;
    bool bounces = false; ///< the sum includes bounced light
};

/// Ambient occlusion per posed vertex.
struct VertexOcclusion {
    gpu::BufferId visibility;             ///< visibility, one float per vertex
    std::optional<gpu::BufferId> bounced; ///< bounced light, four floats per vertex
};

/// Adds passes that compute each vertex's ambient visibility: 1 minus the sum of the form factors of all
/// discs that face the vertex. A disc's form factor depends on its area, its distance and the angles at both
/// ends, and fades to 0 at the radius. For bounced light, each form factor in the sum is multiplied by the
/// disc's colour. Requires disc colours for bounced light.
///
/// Returns one float per posed vertex; 1 for vertices without a disc
/// Cost    for n discs about n log n, and a small dispatch for each level of the tree; n^2 if `apart` is 0,
///         because then every vertex evaluates every disc
/// Source  Zanuttini, "Recherches en rendu non réaliste temps réel", Université Paris 8, 2008, section 8.4;
///         Bunnell, "Dynamic Ambient Occlusion and Indirect Lighting", GPU Gems 2, 2005
[[nodiscard]] VertexOcclusion add_discs(gpu::Graph& graph, DiscBuffers& buffers, gpu::BufferId posed_vertices,
                                        const DiscSettings& settings);

/// Adds a pass that sums the occlusion by discs per pixel. The result is the same as if every disc were
/// drawn over all pixels within its radius.
///
/// Cost    one full-screen dispatch, proportional to the logarithm of the number of discs; takes 40 ms or
///         more on a CPU
/// Source  as add_discs()
[[nodiscard]] AmbientOcclusion add_disc_splats(gpu::Graph& graph, DiscBuffers& buffers,
                                               gpu::BufferId posed_vertices, const OcclusionInputs& in,
                                               const OcclusionStyle& style, float apart = usual_apart);

/// The last occlusion result for a map's texels, kept from frame to frame.
struct DiscMapBuffers {
    /// Result per texel as four floats: bounced light, and visibility; -1 where the map has no surface.
    gpu::Buffer found;
    uint32_t size = 0;     ///< texels per side of the map
    bool is_found = false; ///< the result is valid for the current pose and style
    float radius_m = 0.0F; ///< occlusion radius of the result
    bool has_bounced = false;
};

/// Allocates an occlusion map of `size` texels per side.
[[nodiscard]] DiscMapBuffers make_disc_map(gpu::Device& device, uint32_t size);

struct DiscMapInputs {
    gpu::BufferId map_texels; ///< texels of the map, see shaders/surface_map.glsl
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
};

/// Adds passes that sum the occlusion by discs, as add_discs() does, at the middle of each texel. The result
/// is kept until something moves.
///
/// Returns four floats per texel, row by row, in the layout of DiscMapBuffers::found
/// Cost    the number of texels times the logarithm of the number of discs, and the tree
/// Source  as add_discs(); into a texture as in the thesis
[[nodiscard]] gpu::BufferId add_disc_map(gpu::Graph& graph, DiscBuffers& discs, DiscMapBuffers& map,
                                         const DiscMapInputs& in, const DiscSettings& settings);

/// Adds passes that compute occlusion for the page's pixels by the disc method that the style selects; empty
/// without discs.
///
/// Cost    the sum over discs, and one full-screen dispatch that interpolates between vertices or texels
[[nodiscard]] std::optional<AmbientOcclusion> add_disc_occlusion(gpu::Graph& graph, DiscBuffers& discs,
                                                                 DiscMapBuffers& map,
                                                                 const OcclusionInputs& in,
                                                                 const OcclusionStyle& style);

} // namespace estampe::occlusion
