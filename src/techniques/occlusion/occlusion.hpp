// SPDX-License-Identifier: MIT
#pragma once

// How much of the light from everywhere reaches what is seen: one interface for every method that a style may
// choose. The horizon is the usual one; the others are in alternatives/.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::occlusion {

/// How it is found: from the depths on the page, between all vertices, by pixels or by texels from all
/// vertices, or as a mask of depth.
enum class Method : uint8_t { horizon, discs, splats, uv, unsharp };

/// What occlusion is let into: light from everywhere, all light, or nothing but its own mask.
enum class Feeds : uint8_t { ambient, tone, layer };

struct OcclusionStyle {
    bool enabled = false;
    Method method = Method::horizon;
    Feeds feeds = Feeds::ambient;
    float radius_m = 0.0F;
    float reach_mm = 25.0F;
    float thickness = 0.5F;
    float strength = 1.0F;
    float bleeding = 0.0F;
    uint32_t texels = 512;
};

[[nodiscard]] const style::Table<OcclusionStyle>& occlusion_table();

/// A map that lies on all surfaces, as the shaders read it.
struct SurfaceMap {
    gpu::BufferId texels;  ///< see shaders/surface_map.glsl
    gpu::BufferId corners; ///< see shaders/map_corners.glsl
    uint32_t size = 0;     ///< texels a side
};

/// The scene's surfaces, posed, for methods that look at all of them, seen or not.
struct PosedSurfaces {
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    std::optional<SurfaceMap> map; ///< of map_texels() a side, where the style's method needs one
};

struct OcclusionInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId depth;
    gpu::ImageId normal;
    std::optional<PosedSurfaces> surfaces; ///< none: the style's method looks at the page alone
    float radius_m = 1.0F;                 ///< as radius_of() has it
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0};
    glm::uvec2 from_px{0}; ///< where on the page what is drawn begins
};

/// What was found for pixels.
struct AmbientOcclusion {
    gpu::ImageId
        visibility; ///< r16f: share of the light from everywhere that arrives, 1 where nothing is seen
    std::optional<gpu::ImageId> bounced; ///< rgba16f: what occluders bounce back of that light, as a share
};

/// The style's radius, or what it is in a scene of this one.
[[nodiscard]] float radius_of(const OcclusionStyle& style, float scene_radius_m);

/// How far off the page the pixels may lie that one of this style hangs on.
[[nodiscard]] uint32_t reach_px(const OcclusionStyle& style, float pixels_per_mm);

/// Side of the map of all surfaces in which the style's method finds occlusion; none where it needs no map.
[[nodiscard]] std::optional<uint32_t> map_texels(const OcclusionStyle& style);

/// The surfaces that occlude, at rest, for methods that look at all of them.
struct OccluderMesh {
    std::span<const glm::vec3> places; ///< of all posed vertices, times `unit_m`
    float unit_m = 1.0F;
    std::vector<glm::uvec4> triangles;      ///< their first three numbers are vertices
    std::vector<glm::vec3> color_of_vertex; ///< linear
};

/// What the style's method keeps from frame to frame; methods on the page keep nothing.
class Memory {
public:
    Memory();
    ~Memory();
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;
    Memory(Memory&&) = delete;
    Memory& operator=(Memory&&) = delete;

    /// Whether the style's method needs set_surfaces() first.
    [[nodiscard]] bool lacks_surfaces(const OcclusionStyle& style) const;

    /// Cost: n log n in vertices.
    void set_surfaces(gpu::Device& device, const OccluderMesh& surfaces);

    /// Makes room for what the style's method keeps.
    void ensure(gpu::Device& device, const OcclusionStyle& style);

    /// The scene has other surfaces.
    void forget_surfaces();

    /// What was found for posed surfaces is outdated: they moved.
    void forget_pose();

private:
    friend std::optional<AmbientOcclusion> add_occlusion(gpu::Graph&, Memory&, const OcclusionInputs&,
                                                         const OcclusionStyle&);
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

/// Finds occlusion by the style's method; none where no surface occludes.
///
/// Writes  images as large as what is drawn
/// Cost    that of the method: see add_horizon(), and alternatives/
[[nodiscard]] std::optional<AmbientOcclusion>
add_occlusion(gpu::Graph& graph, Memory& memory, const OcclusionInputs& in, const OcclusionStyle& style);

/// Finds occlusion from what is seen about each pixel, and nothing else: the usual method.
///
/// Cost    four dispatches, all but the last over every second pixel each way: 20 depths, twice 4 neighbours,
///         then 4 at every pixel
/// Source  Therrien, Levesque and Gilet, "Screen Space Indirect Lighting with Visibility Bitmask", 2023;
///         slices and their weights after Jimenez et al., "Practical Real-Time Strategies for Accurate
///         Indirect Occlusion", 2016
[[nodiscard]] AmbientOcclusion add_horizon(gpu::Graph& graph, const OcclusionInputs& in,
                                           const OcclusionStyle& style);

/// Pixel `i` is pixel 2 * (from_half + i) of the page: the same pixels of it whatever tile is drawn.
struct HalfPage {
    glm::uvec2 from_half{0};
    glm::uvec2 half_px{1};
};

[[nodiscard]] inline HalfPage half_page(const OcclusionInputs& in)
{
    const glm::uvec2 from_half = (in.from_px + 1U) / 2U;
    const glm::uvec2 last_half = (in.from_px + in.size_px - 1U) / 2U;
    return {.from_half = from_half, .half_px = glm::max(last_half + 1U, from_half + 1U) - from_half};
}

} // namespace estampe::occlusion
