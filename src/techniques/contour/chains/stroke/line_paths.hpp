// SPDX-License-Identifier: MIT
#pragma once

// Converts strokes from the GPU to paths on the CPU, for vector output.

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
    uint32_t kind = shared::line_silhouette; ///< most frequent kind of line along the path
    uint32_t triangle = 0;                   ///< index of a triangle along which the line runs
    uint32_t ink = 0;                        ///< ink of the first LinePoint of the path; 0 for hidden lines
    bool is_hidden = false;
    bool is_closed = false; ///< the path returns to its first point
    std::vector<PathPoint> points;
};

/// The lists of ShapedStrokes, read back to the CPU.
struct LineLists {
    std::span<const shared::ListSize> sizes;
    std::span<const shared::LineSample> samples;
    /// For each slot (entry of the list of chains): number of line samples in all earlier slots.
    std::span<const uint32_t> samples_before;
    /// For each sample: number of strokes that start before the sample.
    std::span<const uint32_t> strokes_before;
    std::span<const shared::LinePoint> points;
    std::span<const uint32_t> facing;
};

/// One width per kind of line.
using LineWidths = std::array<float, shared::line_kind_count>;

/// Returns every stroke as a path, in the order of the samples. With `hidden_widths_px`, also returns the
/// hidden lines on the page; a chain's hidden lines come after its visible strokes. Cost: linear in the
/// number of samples.
[[nodiscard]] std::vector<LinePath> line_paths(const LineLists& lists, const EdgeMesh& mesh,
                                               const std::optional<LineWidths>& hidden_widths_px);

/// Which paths join_paths() joins. All paths that are joined have equal ink.
struct JoinRule {
    float most_width_change = 0.1F; ///< largest difference of widths, as a share of the greater width
    bool only_one_kind = false;     ///< both paths must be of one kind of line
    /// A line goes on as the line at its end that bends least, if that bends by no more than 50 degrees.
    bool goes_straight_on = false;
    /// A path shorter than `shortest_px` joins a path that ends at the same place, whatever the kinds of both
    /// paths and the bend between them.
    float shortest_px = 0.0F;
};

/// Corners of which the pen makes one mitred stroke, as joints.comp draws them.
constexpr JoinRule mitred_corners{};
/// Corners that the pen rounds on its way: an outline stays one stroke, whatever its width does.
constexpr JoinRule rounded_corners{
    .most_width_change = 0.5F, .only_one_kind = true, .goes_straight_on = true};

/// Joins paths that end in a common corner into one stroke. Among all ends at one place, joints.comp and
/// join_paths() join the two ends that enclose all ends at the place. If joining closes a path, the path
/// starts in the middle of a stroke. Cost: n log n in the number n of paths.
[[nodiscard]] std::vector<LinePath> join_paths(std::vector<LinePath> paths,
                                               const JoinRule& rule = mitred_corners);

} // namespace estampe::contour
