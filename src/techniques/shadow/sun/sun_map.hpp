// SPDX-License-Identifier: MIT
#pragma once

// The sun's shadow map: one view of all casters, or a clipmap (levels of detail around the eye).
// fit_sun_map() chooses by the style.

#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

#include "gpu/graph/graph.hpp"
#include "shaders/frame.glsl.h"
#include "techniques/shadow/shadow.glsl.h"
#include "techniques/shadow/shadow_style.hpp"

namespace estampe::shadow {

/// The parallel view from the sun that contains all casters.
struct SunView {
    /// Transform from anchor space (relative to a nearby origin); reversed z: 1 nearest to the sun, 0
    /// farthest.
    glm::mat4 clip_from_anchor{1.0F};
    glm::vec3 right{1.0F, 0.0F, 0.0F};
    glm::vec3 down{0.0F, 0.0F, 1.0F};
    glm::vec2 extent_m{1.0F}; ///< size of the area that the map covers, along both axes
    float texel_m = 0.0F;     ///< longer side of a shadow map texel
    glm::vec2 warp{0.0F};     ///< for a perspective map: rows are at y = warp.x - warp.y / w; extent_m and
                              ///< texel_m apply at w = 1
    float depth_m = 1.0F;     ///< distance along the sun's direction that clip z from 0 to 1 covers
};

/// Fits the sun's view to `casters` (world space); points outside the box `casters` cannot be in shadow.
/// `towards_sun` is a unit vector, `size` the map's side in texels. Empty casters give a view of one metre.
[[nodiscard]] SunView sun_view(const Bounds& casters, const glm::dvec3& anchor, const glm::dvec3& towards_sun,
                               uint32_t size);

/// Makes the shaders' lookup data for a single shadow map with `size` texels per side; size 0 means no
/// shadow.
[[nodiscard]] shared::SunShadow sun_shadow(const SunView& view, uint32_t size, const ShadowStyle& style = {});

inline constexpr uint32_t most_levels = shared::sun_levels;

/// Depth maps of the sun's view in levels around the eye. Each level is twice as wide as the previous level
/// and has an equal number of texels. The levels are the clipmap of Tanner et al., "The Clipmap: A Virtual
/// Mipmap", 1998, with depths. Texels are on lattices that are fixed to the world, so a level that moves with
/// the eye keeps the part that it still covers. A level stores texel (x, y) at (x mod size, y mod size).
struct Clipmap {
    SunView view; ///< the sun's view of all casters, which defines direction and depth range
    double finest_m = 0.0;
    uint32_t size = 0; ///< texels per side of a level; a power of two, 64 to 4096
    uint32_t level_count = 0;

    bool operator==(const Clipmap& other) const
    {
        return view.clip_from_anchor == other.view.clip_from_anchor && finest_m == other.finest_m &&
               size == other.size && level_count == other.level_count;
    }
};

/// For each clipmap level, the lowest texel of its window (the area that it covers).
using Windows = std::vector<glm::ivec2>;

/// A rectangle of a clipmap level's texels that must be drawn.
struct Piece {
    uint32_t level = 0;
    glm::ivec2 low{0};
    glm::uvec2 size{0}; ///< size of the rectangle in texels; powers of two
};

/// Makes clipmap levels from texels of `finest_m`, rounded down to a power of two, up to a level that covers
/// `radius_m` around any place among the casters. If that takes more than `most_levels` levels, all levels
/// are made coarser.
[[nodiscard]] Clipmap fit_clipmap(const SunView& view, uint32_t size, double finest_m, double radius_m);

/// Centres the clipmap levels' windows at the eye, or at the point of the casters' box that is nearest to the
/// eye. A window moves in steps of a sixteenth of its size.
[[nodiscard]] Windows windows_about(const Clipmap& clipmap, const glm::dvec3& eye_anchor);

/// Pieces (rectangles of texels) of clipmap levels to draw after the windows moved: the strips that were
/// uncovered, widened to powers of two. If `before` is empty, every level is drawn as a whole.
[[nodiscard]] std::vector<Piece> uncovered(const Clipmap& clipmap, const Windows& before, const Windows& now);

/// Squares, at most one per clipmap level, that contain the visible parts of the boxes `places` (relative to
/// a nearby origin) in the windows. The squares' sides are powers of two from 64 on; their first columns are
/// multiples of 4. A level that has entries in `pieces` gets a square of the whole level.
[[nodiscard]] std::vector<Piece> squares_about(const Clipmap& clipmap, const Windows& windows,
                                               std::span<const Bounds> places, std::span<const Piece> pieces);

/// Appends to `tiles` the tiles of each square's picture in which the map may change (see
/// shaders/tiles.glsl.h): where the boxes `places` are seen, and where the rectangles `pieces` are. Pictures
/// store their texels as add_mixed_levels() expects. Cost: a few steps per place and level.
void list_tiles(const Clipmap& clipmap, std::span<const Piece> squares, std::span<const Bounds> places,
                std::span<const Piece> pieces, std::vector<uint32_t>& tiles);

/// A part of a clipmap piece (a rectangle of texels to draw) that is contiguous in the map. A piece may have
/// several parts, because clipmap levels wrap around.
struct PieceHome {
    glm::uvec2 from{0}; ///< first texel of the part, counted from the piece's corner
    glm::uvec2 size{0};
    uint32_t texel = 0; ///< index of the part's first texel in the map; two rows are one level width apart
};

/// The places in the map where a piece (rectangle) of a clipmap level is stored: at most four, because a
/// level wraps around in both directions.
[[nodiscard]] std::vector<PieceHome> homes(const Clipmap& clipmap, const Piece& piece);

/// Projection that draws a piece (a rectangle of a clipmap level's texels) from the vertices of
/// add_sun_vertices().
[[nodiscard]] glm::mat4 clip_from_sun(const Piece& piece);

/// Makes the shaders' lookup data for a clipmap. `pixel_m` is the size of a pixel at distance 1, or at any
/// distance in parallel projection.
[[nodiscard]] shared::SunShadow sun_shadow(const Clipmap& clipmap, const Windows& windows, float pixel_m,
                                           const ShadowStyle& style);

/// The scene to which the sun's shadow map is fitted.
struct SunMapScene {
    Bounds casters;   ///< box of all shadow casters in world space; not empty
    Bounds still_box; ///< box that contains the casters and stays constant while some of them move
    glm::dvec3 anchor{0.0};
    glm::dvec3 towards_sun{0.0, 1.0, 0.0}; ///< unit vector towards the sun
    double floor_m = 0.0;                  ///< height in world space below which no surface is lit
    double nearest_m = 0.0;                ///< approximate distance from the eye to the nearest visible point
    double pixel_m = 0.0;                  ///< size of a pixel at the distance nearest_m
    uint64_t most_bytes = ~0ULL;           ///< most bytes that the shadow map may take
    uint32_t size = 0;                     ///< texels per side, if a single map covers all casters
    shared::FrameGlobals eye{};
};

struct SunMapFit {
    SunView view;
    std::optional<Clipmap> clipmap;
    uint32_t size = 0;    ///< texels per side of the map, or of each clipmap level
    uint32_t variant = 0; ///< bits of the lighting shader, see shaders/light_variant.glsl.h
};

/// Fits the shadow map that the style's `sun_map` selects. `automatic` is a single map if its texels are fine
/// enough, else a clipmap; `faded` and `warped` are in alternatives/.
[[nodiscard]] SunMapFit fit_sun_map(const SunMapScene& scene, const ShadowStyle& style);

/// Depth maps of moving objects and of static objects, which are merged.
struct MixInputs {
    std::span<const Piece> squares;
    gpu::BufferId pictures; ///< depths of moving objects in squares, one after another; a square of a whole
                            ///< level has the level's wrapped layout
    gpu::BufferId still;    ///< depths of static objects, all clipmap levels
    gpu::BufferId tiles;    ///< tiles of the depth pictures to merge, from list_tiles()
    uint32_t tile_count = 0;
};

/// Adds a pass that merges `pictures` and `still` into `map`, in each listed tile: the depth nearer to the
/// sun is kept. Cost: one dispatch, three accesses per texel of the tiles.
[[nodiscard]] gpu::BufferId add_mixed_levels(gpu::Graph& graph, const Clipmap& clipmap, const MixInputs& in,
                                             gpu::BufferId map);

/// Adds a pass that transforms posed vertices into the sun's view: x and y in finest texels, rounded to 1/32,
/// and z as clip z. The rounding makes the drawn texels independent of where a piece (a rectangle of texels
/// to draw) begins.
[[nodiscard]] gpu::BufferId add_sun_vertices(gpu::Graph& graph, gpu::BufferId posed_vertices,
                                             uint32_t vertex_count, const Clipmap& clipmap);

} // namespace estampe::shadow
