// SPDX-License-Identifier: MIT
#pragma once

// Strokes of lines as the device left them, as paths on the processor.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/mesh/edge_mesh.hpp"

namespace estampe::contour {

struct PathPoint {
    glm::vec2 page_px{0.0F};
    float width_px = 0.0F;
};

struct LinePath {
    uint32_t kind = shared::line_silhouette; ///< what most of it is: shared::line_silhouette and so on
    uint32_t triangle = 0;                   ///< one that it runs along
    uint32_t ink = 0;                        ///< material that brings its own, + 1
    bool is_hidden = false;
    bool is_closed = false; ///< the last point is the first
    std::vector<PathPoint> points;
};

/// The buffers of ShapedStrokes.
struct LineLists {
    std::span<const shared::ListSize> sizes;
    std::span<const shared::LineSample> samples;
    std::span<const uint32_t> samples_before; ///< each slot
    std::span<const uint32_t> strokes_before; ///< each sample
    std::span<const shared::LinePoint> points;
    std::span<const uint32_t> facing;
};

/// One for each kind of line.
using LineWidths = std::array<float, shared::line_kind_count>;

/// Every stroke, in the order of the samples. With `hidden_widths_px`, one for each kind, what is on the page
/// and hidden comes too, each chain's after its strokes. Cost: linear in samples.
[[nodiscard]] std::vector<LinePath> line_paths(const LineLists& lists, const EdgeMesh& mesh,
                                               const std::optional<LineWidths>& hidden_widths_px);

/// Makes one path of those whose ends meet in a corner that is mitred in pictures, so that their corner can
/// be mitred too: of all ends at one place those two that enclose the others, as joints.comp chooses, where
/// both are as wide to a tenth and of one ink. Where that closes a path, it starts in the middle of a stroke.
/// Cost: n log n in paths.
[[nodiscard]] std::vector<LinePath> join_paths(std::vector<LinePath> paths);

} // namespace estampe::contour
