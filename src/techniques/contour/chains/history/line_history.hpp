// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "gpu/resources.hpp"

namespace estampe::contour {

/// Lines that are drawn apart.
enum class LineClass : uint8_t { seen, hidden };

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
    /// `continues`, not at all. `has_hidden` lines are remembered too. Throws Error when memory runs out.
    void begin_frame(gpu::Device& device, glm::uvec2 size_px, bool continues, bool has_hidden = false);

    /// To be called when what was begun has been drawn as seen by `clip_from_anchor`.
    void end_frame(const glm::mat4& clip_from_anchor);

    /// Makes the next frame follow on `drawn`, of seen and of hidden lines, of pages of `size_px`. Throws
    /// Error when memory runs out.
    void recall(gpu::Device& device, glm::uvec2 size_px, std::array<std::optional<Drawn>, 2> drawn,
                const glm::mat4& clip_from_anchor);

    /// Forgets all frames: the scene is another.
    void forget();

    [[nodiscard]] bool holds_frame(LineClass lines = LineClass::seen) const
    {
        return memory_of(lines).holds_frame;
    }

    /// Of the pages of the frames that are remembered.
    [[nodiscard]] glm::uvec2 size_px() const { return memories_.front().size_px; }

    [[nodiscard]] Drawn& before(LineClass lines = LineClass::seen)
    {
        return memories_.at(static_cast<size_t>(lines)).drawn.at(1 - now_);
    }

    [[nodiscard]] Drawn& now(LineClass lines = LineClass::seen)
    {
        return memories_.at(static_cast<size_t>(lines)).drawn.at(now_);
    }

    [[nodiscard]] const glm::mat4& clip_from_anchor_before() const { return clip_from_anchor_; }

private:
    /// Of one class of lines.
    struct Memory {
        std::array<Drawn, 2> drawn;
        glm::uvec2 size_px{0};
        bool is_kept = false; ///< this frame leaves something
        bool holds_frame = false;
    };

    [[nodiscard]] const Memory& memory_of(LineClass lines) const
    {
        return memories_.at(static_cast<size_t>(lines));
    }

    std::array<Memory, 2> memories_;
    size_t now_ = 0;
    glm::mat4 clip_from_anchor_{1.0F};
};

/// Cells of the grid in which samples find each other.
[[nodiscard]] uint32_t grid_cell_count(glm::uvec2 size_px);

/// Samples that a page has room for.
[[nodiscard]] uint32_t sample_capacity(glm::uvec2 size_px);

} // namespace estampe::contour
