// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "gpu/resources.hpp"

namespace estampe::contour {

/// What the frame before drew, by which strokes keep their width, their hand and their place along the line
/// when chains split or join.
class LineHistory {
public:
    /// What one frame leaves to the next.
    struct Drawn {
        gpu::Buffer grid;    ///< where on the page samples are
        gpu::Buffer samples; ///< DrawnSample
    };

    /// Makes room for frames of `size_px`. Frames before count only if they had that size, and unless
    /// `continues`, not at all. Throws Error when memory runs out.
    void begin_frame(gpu::Device& device, glm::uvec2 size_px, bool continues);

    /// To be called when what was begun has been drawn as seen by `clip_from_anchor`.
    void end_frame(const glm::mat4& clip_from_anchor);

    /// Forgets all frames: the scene is another.
    void forget() { holds_frame_ = false; }

    [[nodiscard]] bool holds_frame() const { return holds_frame_; }

    [[nodiscard]] Drawn& before() { return drawn_[1 - now_]; }

    [[nodiscard]] Drawn& now() { return drawn_[now_]; }

    [[nodiscard]] const glm::mat4& clip_from_anchor_before() const { return clip_from_anchor_; }

private:
    std::array<Drawn, 2> drawn_;
    size_t now_ = 0;
    glm::mat4 clip_from_anchor_{1.0F};
    glm::uvec2 size_px_{0};
    bool holds_frame_ = false;
};

/// Cells of the grid in which samples find each other.
[[nodiscard]] uint32_t grid_cell_count(glm::uvec2 size_px);

/// Samples that a page has room for.
[[nodiscard]] uint32_t sample_capacity(glm::uvec2 size_px);

} // namespace estampe::contour
