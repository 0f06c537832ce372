// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <optional>
#include <span>

#include <estampe/scene.hpp>

#include "shaders/frame.glsl.h"

namespace estampe::features {

/// A rectangle of pixels of the page.
struct PixelRect {
    glm::uvec2 from_px{0};
    glm::uvec2 size_px{0};
    bool operator==(const PixelRect&) const = default;
};

/// The whole page at reduced resolution. Results that must be equal in all tiles are computed from this page.
struct Survey {
    /// Rectangle of the survey in page pixels; larger than the page if `shrink` does not divide its size.
    PixelRect part;
    uint32_t shrink = 1; ///< Page pixels per survey pixel, along each axis

    [[nodiscard]] glm::uvec2 size_px() const { return part.size_px / shrink; }
};

/// Page, tile and sampling of a picture, for the shaders' FrameGlobals.
struct ViewSettings {
    glm::uvec2 size_px{0};         ///< Size of the whole page in pixels
    std::optional<PixelRect> tile; ///< Part of the page to draw; none: the whole page
    std::optional<Survey> survey;  ///< If set, the whole page is drawn in fewer pixels
    glm::dvec2 jitter_px{0.0};     ///< Subpixel shift of the picture, within half a pixel
    double page_height_mm = 150.0;
    float nearby_m = 1.0F; ///< Distance from the eye to nearby objects, see FrameGlobals::nearby_m
};

/// Returns a matrix that maps clip space of the page to clip space of a part of it. In both clip spaces, y
/// points down on the page.
[[nodiscard]] glm::dmat4 crop_of(const PixelRect& part, glm::uvec2 page_px);

/// The two views between which a frame's motion is measured.
struct MotionPlan {
    glm::mat4 clip_from_anchor{1.0F}; ///< Camera matrix of one moment, without the subpixel shift of a sample
    glm::mat4 clip_from_anchor_before{1.0F};
    /// The vertices moved between the two moments; MeshBuffers::posed_vertices[1] holds the earlier vertices.
    bool pose_moved = false;
};

/// Computes the camera matrices for shaders, with reversed z. A perspective has an infinite far plane; a
/// parallel projection has a depth range that contains `bounds`. Positions are made relative to `anchor` in
/// double precision, before they are rounded to floats.
[[nodiscard]] shared::FrameGlobals frame_globals(const Camera& camera, const Bounds& bounds,
                                                 const glm::dvec3& anchor, const ViewSettings& settings);

/// Returns a matrix that maps anchor space (positions relative to the scene's anchor) to the clip space of
/// the drawn tile, or of the whole page if there are no tiles.
[[nodiscard]] glm::mat4 drawn_clip(const shared::FrameGlobals& globals);

/// Returns the FrameGlobals of a picture with half the resolution, which samples the pixels at even page
/// coordinates.
[[nodiscard]] shared::FrameGlobals every_second(shared::FrameGlobals globals);

/// Distance from the eye within which a fifth of `places` lies, in the unit of `places`. At most 4096 places
/// are sampled. Returns 0 without places. The result changes smoothly as the eye moves.
[[nodiscard]] float nearby(std::span<const glm::vec3> places, const glm::vec3& eye);

/// Pixels per millimetre of a page that is `height_px` pixels high.
[[nodiscard]] float pixels_per_mm(uint32_t height_px, double page_height_mm);

/// Size of a page pixel in the scene's metres.
struct PixelSize {
    /// Size of a pixel at a distance of one metre; in parallel projection at any distance.
    float at_one_m = 0.001F;
    bool is_parallel = false;

    /// Returns the size of a page pixel in the scene, at a distance from the eye.
    template <std::floating_point Number>
    [[nodiscard]] Number at(Number distance_m) const
    {
        return static_cast<Number>(at_one_m) * (is_parallel ? Number(1) : distance_m);
    }
};

/// Returns a camera with a wider view. A centred window with these shares of the page's width and height then
/// shows the view of `camera`, which has the aspect of the window.
[[nodiscard]] Camera seen_within(const Camera& camera, const glm::dvec2& share);

[[nodiscard]] PixelSize pixel_size(const Camera& camera, uint32_t height_px);

/// Returns the subpixel shift of sample `index` of `count`: Halton sequence with bases 2 and 3. Zero if
/// `count` is 1.
[[nodiscard]] glm::dvec2 jitter(uint32_t index, uint32_t count);

} // namespace estampe::features
