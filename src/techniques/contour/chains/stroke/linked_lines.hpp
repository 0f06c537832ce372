// SPDX-License-Identifier: MIT
#pragma once

// The lines of a whole page, strung and shaped once, for a page that is inked part by part: where a stroke
// begins and ends, how long it is and how it sways must not hang on the part.

#include <optional>
#include <vector>

#include "gpu/resources.hpp"
#include "techniques/contour/chains/chains.hpp"

namespace estampe::gpu {
class Executor;
}

namespace estampe::contour {

/// What ShapedStrokes are, kept from graph to graph.
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

    glm::uvec2 page_px{0}; ///< of the page that they were strung on
    gpu::Buffer sizes;
    Strokes seen;
    std::optional<Strokes> hidden;
};

/// Declares what copies `shaped`, of a page of `page_px`, into `lines`, which must outlive the graph.
void add_keeping(gpu::Graph& graph, gpu::Device& device, const ShapedStrokes& shaped, glm::uvec2 page_px,
                 LinkedLines& lines);

/// Gives back the room that lines do not take, once the graph has run. Throws Error when there are more than
/// had room.
[[nodiscard]] LinkedLines shrunk(gpu::Device& device, gpu::Executor& executor, LinkedLines lines);

/// Which part of the page is inked: pixels of the part are `scale` to one of the page that lines were strung
/// on, and it begins `from_px` of its own pixels from the page's corner.
struct PartOfPage {
    glm::vec2 from_px{0.0F};
    float scale = 1.0F;
};

/// The strokes in pixels of a part of the page.
[[nodiscard]] ShapedStrokes take_part(gpu::Graph& graph, LinkedLines& lines, const PartOfPage& part);

/// As add_chain_contours(), of lines that were strung before.
[[nodiscard]] gpu::ImageId add_linked_contours(gpu::Graph& graph, const ContourInputs& in, LinkedLines& lines,
                                               const PartOfPage& part, const ContourStyle& style,
                                               std::optional<gpu::ImageId> under = std::nullopt);

} // namespace estampe::contour
