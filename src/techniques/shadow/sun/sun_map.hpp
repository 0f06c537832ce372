// SPDX-License-Identifier: MIT
#pragma once

// The sun's shadow map: one view of all that throws a shadow, or a clipmap of such maps about the eye, as
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

/// The sun's parallel view of everything that throws a shadow.
struct SunView {
    glm::mat4 clip_from_anchor{1.0F}; ///< reversed z: 1 nearest to the sun, 0 farthest
    glm::vec3 right{1.0F, 0.0F, 0.0F};
    glm::vec3 down{0.0F, 0.0F, 1.0F};
    glm::vec2 extent_m{1.0F}; ///< what the map covers along both
    float texel_m = 0.0F;     ///< the longer side of a texel
    glm::vec2 warp{0.0F};     ///< of a map in perspective: rows are at y = warp.x - warp.y / w; extent_m and
                              ///< texel_m are those where w is 1
    float depth_m = 1.0F;     ///< what clip z of 0 to 1 spans
};

/// Fits the view to `casters` (world space), whatever receives: outside of it nothing can be in shadow.
/// `towards_sun` is a unit vector, `size` the map's side in texels. Empty casters give a view of one metre.
[[nodiscard]] SunView sun_view(const Bounds& casters, const glm::dvec3& anchor, const glm::dvec3& towards_sun,
                               uint32_t size);

/// What the light pass needs to look up a map of that view, `size` texels a side; 0 for no shadow.
[[nodiscard]] shared::SunShadow sun_shadow(const SunView& view, uint32_t size, const ShadowStyle& style = {});

inline constexpr uint32_t most_levels = shared::sun_levels;

/// Maps of the sun's view about the eye, each twice as wide as the one before and of as many texels: the
/// clipmap of Tanner et al., "The Clipmap: A Virtual Mipmap", 1998, for depth. Texels lie on lattices that
/// are fixed to the world, so that a level that moves with the eye keeps what it still covers. A level holds
/// its texels modulo its size: texel (x, y) is at (x mod size, y mod size).
struct Clipmap {
    SunView view; ///< direction and depth
    double finest_m = 0.0;
    uint32_t size = 0; ///< texels a side; a power of two, 64 to 4096
    uint32_t level_count = 0;

    bool operator==(const Clipmap& other) const
    {
        return view.clip_from_anchor == other.view.clip_from_anchor && finest_m == other.finest_m &&
               size == other.size && level_count == other.level_count;
    }
};

/// Lowest texel of every level's window.
using Windows = std::vector<glm::ivec2>;

/// Texels of a level that are to be drawn.
struct Piece {
    uint32_t level = 0;
    glm::ivec2 low{0};
    glm::uvec2 size{0}; ///< powers of two
};

/// As many levels as it takes to get from texels of `finest_m`, rounded down to a power of two, to a level
/// that covers `radius_m` about any place among the casters; where `most_levels` do not suffice, coarser
/// ones.
[[nodiscard]] Clipmap fit_clipmap(const SunView& view, uint32_t size, double finest_m, double radius_m);

/// Windows about an eye, or about what is next to it of the casters' box, in steps of a sixteenth of their
/// size.
[[nodiscard]] Windows windows_about(const Clipmap& clipmap, const glm::dvec3& eye_anchor);

/// What has to be drawn where `before` was drawn, all of it when that is empty: strips that the windows have
/// uncovered, widened to powers of two.
[[nodiscard]] std::vector<Piece> uncovered(const Clipmap& clipmap, const Windows& before, const Windows& now);

/// Squares, at most one a level, that hold what is seen of `places` (anchor space) in the windows: their
/// sides are powers of two, 64 or more, their first columns multiples of 4. Levels of which there are
/// `pieces` are whole.
[[nodiscard]] std::vector<Piece> squares_about(const Clipmap& clipmap, const Windows& windows,
                                               std::span<const Bounds> places, std::span<const Piece> pieces);

/// Puts into `tiles` those of a picture of each of `squares` in which the map may change, see
/// shaders/tiles.glsl.h: where `places` are seen, and where `pieces` lie. A picture has its texels as
/// add_mixed_levels() wants them. Cost: a few steps for each place and level.
void list_tiles(const Clipmap& clipmap, std::span<const Piece> squares, std::span<const Bounds> places,
                std::span<const Piece> pieces, std::vector<uint32_t>& tiles);

/// A rectangle of a piece that lies in one run of rows of the map.
struct PieceHome {
    glm::uvec2 from{0}; ///< texel of the piece
    glm::uvec2 size{0};
    uint32_t texel = 0; ///< of the map, where the rectangle begins; rows are a level's size apart
};

/// Where a piece goes in the map: four rectangles at most, since a level wraps around in both directions.
[[nodiscard]] std::vector<PieceHome> homes(const Clipmap& clipmap, const Piece& piece);

/// Projection of a piece, for the vertices of add_sun_vertices.
[[nodiscard]] glm::mat4 clip_from_sun(const Piece& piece);

/// What the lookup needs to know, from the eye's page where a pixel spans `pixel_m` at a distance of one, or
/// at any in parallel projection.
[[nodiscard]] shared::SunShadow sun_shadow(const Clipmap& clipmap, const Windows& windows, float pixel_m,
                                           const ShadowStyle& style);

/// What a map of the sun is fitted to.
struct SunMapScene {
    Bounds casters;   ///< world space; not empty
    Bounds still_box; ///< a box about them that stays as it is while some of them move
    glm::dvec3 anchor{0.0};
    glm::dvec3 towards_sun{0.0, 1.0, 0.0}; ///< unit vector
    double floor_m = 0.0;                  ///< nothing that is lit lies lower, world space
    double nearest_m = 0.0;                ///< about how far from the eye what is seen begins
    double pixel_m = 0.0;                  ///< what a pixel spans there
    uint64_t most_bytes = ~0ULL;           ///< that a map may take
    uint32_t size = 0;                     ///< side in texels of a single map of all casters
    shared::FrameGlobals eye{};
};

struct SunMapFit {
    SunView view;
    std::optional<Clipmap> clipmap;
    uint32_t size = 0;    ///< side in texels of the map, or of each level
    uint32_t variant = 0; ///< see shaders/light_variant.glsl.h
};

/// The map that the style's `sun_map` asks for: a single one where its texels are fine enough, else a
/// clipmap, or one of alternatives/.
[[nodiscard]] SunMapFit fit_sun_map(const SunMapScene& scene, const ShadowStyle& style);

/// What moves, and what stands still.
struct MixInputs {
    std::span<const Piece> squares;
    gpu::BufferId pictures; ///< of the squares, one after another, row by row; of a whole level as that has
                            ///< its texels
    gpu::BufferId still;    ///< all levels
    gpu::BufferId tiles;    ///< of the pictures, from list_tiles()
    uint32_t tile_count = 0;
};

/// Puts into `map`, in each tile, the nearer to the sun of what both hold there. Cost: one dispatch, three
/// accesses a texel of the tiles.
[[nodiscard]] gpu::BufferId add_mixed_levels(gpu::Graph& graph, const Clipmap& clipmap, const MixInputs& in,
                                             gpu::BufferId map);

/// Posed vertices as the sun sees them: x and y in the finest texels, rounded to 1/32, z its clip z. So what
/// is drawn of them does not depend on where a piece begins.
[[nodiscard]] gpu::BufferId add_sun_vertices(gpu::Graph& graph, gpu::BufferId posed_vertices,
                                             uint32_t vertex_count, const Clipmap& clipmap);

} // namespace estampe::shadow
