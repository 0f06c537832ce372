// SPDX-License-Identifier: MIT
#pragma once

// Ambient occlusion: one interface to every method that a style may choose. The default is the horizon
// method; the other methods are in alternatives/.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::occlusion {

/// The method of computing ambient occlusion: from depth on the page (horizon); from a disc at each vertex,
/// computed per vertex (discs), per pixel (splats) or per texel (uv); or by depth darkening (unsharp).
enum class Method : uint8_t { horizon, discs, splats, uv, unsharp };

/// What ambient occlusion darkens: ambient light, all light, or only the separate layer that holds the
/// occlusion.
enum class Feeds : uint8_t { ambient, tone, layer };

/// How the method horizon knows how far an occluder reaches behind its visible front: by an assumed
/// thickness, or by the depth of the back faces behind the front.
enum class ThicknessFrom : uint8_t { guess, back_faces };

struct OcclusionStyle {
    bool enabled = false;
    Method method = Method::horizon;
    Feeds feeds = Feeds::ambient;
    float radius_m = 0.0F;
    float reach_mm = 25.0F;
    float thickness = 0.5F;
    ThicknessFrom thickness_from = ThicknessFrom::guess;
    float strength = 1.0F;
    float bleeding = 0.0F;
    uint32_t texels = 512;
};

[[nodiscard]] const style::Table<OcclusionStyle>& occlusion_table();

/// A map (texture) that covers all surfaces, as the shaders read it.
struct SurfaceMap {
    gpu::BufferId texels;  ///< texels of the map, see shaders/surface_map.glsl
    gpu::BufferId corners; ///< corners of triangles in the map, see shaders/map_corners.glsl
    uint32_t size = 0;     ///< texels per side of the map
};

/// The scene's posed surfaces, for methods in which invisible surfaces also occlude.
struct PosedSurfaces {
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    std::optional<SurfaceMap> map; ///< map with map_texels() per side; empty if the style's method needs none
    /// Visibility buffer of the next surfaces of either facing behind the visible ones, from depth peeling;
    /// set if needs_behind().
    std::optional<gpu::BufferId> behind = std::nullopt;
};

struct OcclusionInputs {
    gpu::BufferId frame; ///< buffer with a FrameGlobals record
    gpu::ImageId depth;
    gpu::ImageId normal;
    std::optional<PosedSurfaces> surfaces; ///< posed surfaces; empty if the style's method uses only the page
    float radius_m = 1.0F;                 ///< radius within which surfaces occlude, from radius_of()
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0};
    glm::uvec2 from_px{0}; ///< position of the current tile's first pixel on the page
};

/// Ambient occlusion per pixel.
struct AmbientOcclusion {
    gpu::ImageId visibility; ///< r16f: share of ambient light that arrives; 1 on the background
    /// rgba16f: light that occluding surfaces reflect, as a share of ambient light.
    std::optional<gpu::ImageId> bounced;
};

/// The occlusion radius of the style, or the default for a scene with the given radius.
[[nodiscard]] float radius_of(const OcclusionStyle& style, float scene_radius_m);

/// Distance in pixels from which other surfaces affect a pixel's occlusion, also from beyond the page.
[[nodiscard]] uint32_t reach_px(const OcclusionStyle& style, float pixels_per_mm);

/// Texels per side of the occlusion map; empty if the style's method needs no map.
[[nodiscard]] std::optional<uint32_t> map_texels(const OcclusionStyle& style);

/// Whether the style's method reads the surfaces behind the visible ones, PosedSurfaces::behind.
[[nodiscard]] bool needs_behind(const OcclusionStyle& style);

/// The surfaces in the rest pose that occlude, for methods that use all surfaces.
struct OccluderMesh {
    std::span<const glm::vec3> places; ///< positions of all posed vertices, in units of `unit_m`
    float unit_m = 1.0F;
    std::vector<glm::uvec4> triangles;      ///< triangles; the first three numbers are vertex indices
    std::vector<glm::vec3> color_of_vertex; ///< linear colour of each vertex
};

/// Results that an occlusion method keeps from frame to frame; methods on the page keep none.
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

    /// Copies the surfaces that occlude. Cost: n log n in vertices.
    void set_surfaces(gpu::Device& device, const OccluderMesh& surfaces);

    /// Allocates memory for the occlusion method of the style.
    void ensure(gpu::Device& device, const OcclusionStyle& style);

    /// Discards the surfaces. Call forget_surfaces() when the scene's surfaces have been replaced.
    void forget_surfaces();

    /// Discards the results for the posed surfaces. Call forget_pose() when surfaces have moved.
    void forget_pose();

private:
    friend std::optional<AmbientOcclusion> add_occlusion(gpu::Graph&, Memory&, const OcclusionInputs&,
                                                         const OcclusionStyle&);
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

/// Adds passes that compute ambient occlusion by the style's method. Returns nothing if no surface occludes.
///
/// Writes  images of the tile's size
/// Cost    that of the method: see add_horizon(), and alternatives/
[[nodiscard]] std::optional<AmbientOcclusion>
add_occlusion(gpu::Graph& graph, Memory& memory, const OcclusionInputs& in, const OcclusionStyle& style);

/// Adds passes that compute ambient occlusion from the visible surfaces around each pixel, which is the
/// default method. If `in.surfaces->behind` is set, an occluder ends at its back face, and the part of a body
/// within the radius also occludes if the body's front is farther away. Open sheets, which have no back face,
/// keep the style's assumed thickness.
///
/// Cost    four dispatches. The first three run over every second pixel in x and y: one reads 20 depths per
///         pixel, two read 4 neighbours. The last runs over every pixel and reads 4 samples. With back faces
///         one more dispatch over every pixel, which reads two triangles, and 20 more depths per pixel; the
///         caller adds a layer of depth peeling
/// Source  Therrien, Levesque and Gilet, "Screen Space Indirect Lighting with Visibility Bitmask", 2023;
///         slices and their weights after Jimenez et al., "Practical Real-Time Strategies for Accurate
///         Indirect Occlusion", 2016; back faces after Zanuttini, "Recherches en rendu non réaliste temps
///         réel", Université Paris 8, 2008, section 8.4
[[nodiscard]] AmbientOcclusion add_horizon(gpu::Graph& graph, const OcclusionInputs& in,
                                           const OcclusionStyle& style);

/// The half page, which has every second pixel of the page in x and y. The half-page pixel at the index `i`
/// is the page's pixel 2 * (from_half + i). `from_half` is the first half-page pixel of the drawn tile.
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
