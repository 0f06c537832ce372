// SPDX-License-Identifier: MIT
#pragma once

// Converts the strokes that the GPU made to paths on the CPU.

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
    uint32_t kind = shared::line_silhouette; ///< the kind of most of its pieces
    uint32_t triangle = 0;                   ///< a triangle that it runs along
    uint32_t ink = 0;                        ///< that of its first LinePoint; 0 for hidden lines
    bool is_hidden = false;
    bool is_closed = false; ///< the last point is the first
    std::vector<PathPoint> points;
};

/// The buffers of ShapedStrokes.
struct LineLists {
    std::span<const shared::ListSize> sizes;
    std::span<const shared::LineSample> samples;
    std::span<const uint32_t> samples_before; ///< one per slot
    std::span<const uint32_t> strokes_before; ///< one per sample
    std::span<const shared::LinePoint> points;
    std::span<const uint32_t> facing;
};

/// A width for each kind of line.
using LineWidths = std::array<float, shared::line_kind_count>;

/// Returns every stroke, in the order of the samples. With `hidden_widths_px`, also returns the hidden lines
/// on the page, each chain's after its visible strokes. Cost: linear in samples.
[[nodiscard]] std::vector<LinePath> line_paths(const LineLists& lists, const EdgeMesh& mesh,
                                               const std::optional<LineWidths>& hidden_widths_px);

/// Joins paths whose ends meet in a corner that pictures mitre, so that the corner can be mitred here too.
/// Among all ends at one place, the two that enclose the others are joined, as in joints.comp, if their
/// widths differ by less than a tenth and their ink is equal. A path that this closes starts in the middle of
/// a stroke. Cost: n log n in paths.
[[nodiscard]] std::vector<LinePath> join_paths(std::vector<LinePath> paths);

} // namespace estampe::contour
