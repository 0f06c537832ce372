// SPDX-License-Identifier: MIT
#pragma once

// The lines of a whole page, linked and shaped once. The lines are kept for a page that is inked in parts: no
// stroke's start, end, length or wobble may depend on the part.

#include <optional>
#include <vector>

#include "gpu/resources.hpp"
#include "techniques/contour/chains/chains.hpp"

namespace estampe::gpu {
class Executor;
}

namespace estampe::contour {

/// Copies of the buffers of ShapedStrokes. The copies outlive the frame graph that made them.
struct LinkedLines {
    struct Hand {
        gpu::Buffer line_points;
        gpu::Buffer touches;
    };

    struct Strokes {
        gpu::Buffer samples;
        gpu::Buffer strokes_before;
        gpu::Buffer strokes;
        gpu::Buffer grid;
        std::vector<Hand> hands;
    };

    glm::uvec2 page_px{0}; ///< size in pixels of the page on which the lines were linked
    gpu::Buffer sizes;
    Strokes seen;
    std::optional<Strokes> hidden;
};

/// Adds passes that copy `shaped`, the strokes of a page of `page_px` pixels, into `lines`. `lines` must
/// outlive the graph.
void add_keeping(gpu::Graph& graph, gpu::Device& device, const ShapedStrokes& shaped, glm::uvec2 page_px,
                 LinkedLines& lines);

/// Returns `lines` with buffers no larger than the buffers' contents. Call this function after the graph has
/// run. Throws Error if there were more lines than the buffers could hold.
[[nodiscard]] LinkedLines shrunk(gpu::Device& device, gpu::Executor& executor, LinkedLines lines);

/// The part of a page to ink. One pixel of the page on which the lines were linked is `scale` pixels of the
/// part. `from_px` is the position of the part's corner on the page, in pixels of the part.
struct PartOfPage {
    glm::vec2 from_px{0.0F};
    float scale = 1.0F;
};

/// Returns the strokes in pixel coordinates of a part of the page.
[[nodiscard]] ShapedStrokes take_part(gpu::Graph& graph, LinkedLines& lines, const PartOfPage& part);

/// Draws lines that were linked before. Apart from linking, works like add_chain_contours().
[[nodiscard]] gpu::ImageId add_linked_contours(gpu::Graph& graph, const ContourInputs& in, LinkedLines& lines,
                                               const PartOfPage& part, const ContourStyle& style,
                                               std::optional<gpu::ImageId> under = std::nullopt);

} // namespace estampe::contour
