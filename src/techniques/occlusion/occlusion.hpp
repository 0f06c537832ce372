// SPDX-License-Identifier: MIT
#pragma once

// Ambient occlusion: one interface to every method that a style may choose. The default is the horizon
// method; the others are in alternatives/.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::occlusion {

/// The method of computing occlusion: from depth on the page; between discs at all vertices; from these discs
/// per pixel or per texel; or by depth darkening.
enum class Method : uint8_t { horizon, discs, splats, uv, unsharp };

/// What occlusion darkens: ambient light, all light, or nothing but its own layer.
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

/// A map that covers all surfaces, as the shaders read it.
struct SurfaceMap {
    gpu::BufferId texels;  ///< see shaders/surface_map.glsl
    gpu::BufferId corners; ///< see shaders/map_corners.glsl
    uint32_t size = 0;     ///< texels per side
};

/// The scene's posed surfaces, for methods in which invisible surfaces also occlude.
struct PosedSurfaces {
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    std::optional<SurfaceMap> map; ///< has map_texels() per side; none if the style's method needs no map
};

struct OcclusionInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId depth;
    gpu::ImageId normal;
    std::optional<PosedSurfaces> surfaces; ///< none if the style's method uses only the page
    float radius_m = 1.0F;                 ///< from radius_of()
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0};
    glm::uvec2 from_px{0}; ///< first pixel of the current tile on the page
};

/// Ambient occlusion per pixel.
struct AmbientOcclusion {
    gpu::ImageId visibility; ///< r16f: share of ambient light that arrives; 1 on the background
    /// rgba16f: light that occluders reflect, as a share of ambient light.
    std::optional<gpu::ImageId> bounced;
};

/// The style's radius, or the default for a scene of this radius.
[[nodiscard]] float radius_of(const OcclusionStyle& style, float scene_radius_m);

/// How many pixels beyond the page a pixel's occlusion depends on.
[[nodiscard]] uint32_t reach_px(const OcclusionStyle& style, float pixels_per_mm);

/// Texels per side of the occlusion map; none if the style's method needs no map.
[[nodiscard]] std::optional<uint32_t> map_texels(const OcclusionStyle& style);

/// The occluding surfaces in the rest pose, for methods that use all surfaces.
struct OccluderMesh {
    std::span<const glm::vec3> places; ///< all posed vertices, in units of `unit_m`
    float unit_m = 1.0F;
    std::vector<glm::uvec4> triangles;      ///< the first three numbers are vertex indices
    std::vector<glm::vec3> color_of_vertex; ///< linear
};

/// Results that a method keeps from frame to frame; methods on the page keep none.
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

    /// Takes over the occluding surfaces. Cost: n log n in vertices.
    void set_surfaces(gpu::Device& device, const OccluderMesh& surfaces);

    /// Allocates memory for the style's method.
    void ensure(gpu::Device& device, const OcclusionStyle& style);

    /// Call this when the scene has other surfaces.
    void forget_surfaces();

    /// Call this when surfaces have moved: discards the results for the posed surfaces.
    void forget_pose();

private:
    friend std::optional<AmbientOcclusion> add_occlusion(gpu::Graph&, Memory&, const OcclusionInputs&,
                                                         const OcclusionStyle&);
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

/// Computes occlusion by the style's method; none if no surface occludes.
///
/// Writes  images of the tile's size
/// Cost    that of the method: see add_horizon(), and alternatives/
[[nodiscard]] std::optional<AmbientOcclusion>
add_occlusion(gpu::Graph& graph, Memory& memory, const OcclusionInputs& in, const OcclusionStyle& style);

/// Computes occlusion from the visible surfaces around each pixel: the default method.
///
/// Cost    four dispatches, all but the last over every second pixel each way: 20 depths, twice 4 neighbours,
///         then 4 at every pixel
/// Source  Therrien, Levesque and Gilet, "Screen Space Indirect Lighting with Visibility Bitmask", 2023;
///         slices and their weights after Jimenez et al., "Practical Real-Time Strategies for Accurate
///         Indirect Occlusion", 2016
[[nodiscard]] AmbientOcclusion add_horizon(gpu::Graph& graph, const OcclusionInputs& in,
                                           const OcclusionStyle& style);

/// Every second pixel of the page each way: pixel `i` is page pixel 2 * (from_half + i), independent of
/// tiles.
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
