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

/// A whole page in fewer pixels, in which is found what must not hang on tiles.
struct Survey {
    PixelRect part;      ///< in pixels of the page; a little more than that where the size does not divide
    uint32_t shrink = 1; ///< pixels of the page to one of the survey

    [[nodiscard]] glm::uvec2 size_px() const { return part.size_px / shrink; }
};

/// What a picture looks like from where: all that the shaders' FrameGlobals hold.
struct ViewSettings {
    glm::uvec2 size_px{0};         ///< of the whole page
    std::optional<PixelRect> tile; ///< of the page that is drawn; else all of it
    std::optional<Survey> survey;  ///< the page in fewer pixels, which it then is
    glm::dvec2 jitter_px{0.0};     ///< shift of the picture, within half a pixel
    double page_height_mm = 150.0;
    float nearby_m = 1.0F; ///< see FrameGlobals
};

/// From clip space of the page to that of a part of it: on the page y points down in both.
[[nodiscard]] glm::dmat4 crop_of(const PixelRect& part, glm::uvec2 page_px);

/// What a frame's motion looks back to.
struct MotionPlan {
    glm::mat4 clip_from_anchor{1.0F}; ///< without the shift of a sample
    glm::mat4 clip_from_anchor_before{1.0F};
    bool pose_moved = false; ///< vertices were others then: MeshBuffers::posed_vertices[1] has them
};

/// Camera matrices in reversed z: infinite far plane in perspective; in parallel projection a depth that
/// holds `bounds`. Positions are taken relative to `anchor` in double precision before they become floats.
[[nodiscard]] shared::FrameGlobals frame_globals(const Camera& camera, const Bounds& bounds,
                                                 const glm::dvec3& anchor, const ViewSettings& settings);

/// From anchor space to the clip space of what is drawn: of the page, or of a tile.
[[nodiscard]] glm::mat4 drawn_clip(const shared::FrameGlobals& globals);

/// The same of every second pixel each way, of those at even places of the page.
[[nodiscard]] shared::FrameGlobals every_second(shared::FrameGlobals globals);

/// How far from the eye the nearest fifth of some thousand of `places` is, in their unit; 0 if there are
/// none. It changes smoothly as the eye moves.
[[nodiscard]] float nearby(std::span<const glm::vec3> places, const glm::vec3& eye);

/// Of a page that is `height_px` pixels high.
[[nodiscard]] float pixels_per_mm(uint32_t height_px, double page_height_mm);

/// What a pixel of the page spans in the scene.
struct PixelSize {
    float at_one_m = 0.001F; ///< at a distance of one; in parallel projection at any
    bool is_parallel = false;

    /// At a distance from the eye.
    template <std::floating_point Number>
    [[nodiscard]] Number at(Number distance_m) const
    {
        return static_cast<Number>(at_one_m) * (is_parallel ? Number(1) : distance_m);
    }
};

/// The camera that shows in a window of `share` of the page's height what `camera` shows on the whole page.
[[nodiscard]] Camera seen_within(const Camera& camera, double share);

[[nodiscard]] PixelSize pixel_size(const Camera& camera, uint32_t height_px);

/// The `index`th of `count` shifts that cover a pixel evenly (Halton 2, 3), none for a single one.
[[nodiscard]] glm::dvec2 jitter(uint32_t index, uint32_t count);

} // namespace estampe::features
