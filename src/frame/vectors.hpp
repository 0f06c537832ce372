// SPDX-License-Identifier: MIT
#pragma once

// The strokes of a frame as vector paths.

#include <optional>
#include <vector>

#include <estampe/scene.hpp>
#include <estampe/vector_drawing.hpp>

#include "frame/plan.hpp"
#include "gpu/resources.hpp"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/contour/chains/mesh/edge_mesh.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::frame {

/// The strokes of one frame, read back from the device. Empty if lines or hatching are not drawn.
struct StrokeLists {
    explicit StrokeLists(gpu::Device& on_device) : device(on_device) {}

    gpu::Device& device;
    /// Sizes of the lines. The members from `line_sizes` on have the same meaning as in contour::LineLists.
    gpu::Buffer line_sizes;
    gpu::Buffer line_samples;
    gpu::Buffer line_samples_before;
    gpu::Buffer line_strokes_before;
    /// Points of the lines. If lines are drawn several times over each other, each time has a buffer of its
    /// own.
    std::vector<gpu::Buffer> line_points;
    gpu::Buffer line_facing;
    gpu::Buffer crossings; ///< crossings of hatching strokes, as written by hatch::add_trace()
    /// Share of ink that is left after haze, as written by haze::add_ink_left(); empty if there is no haze.
    gpu::Buffer ink_left;
};

/// Checks that all strokes can be output as paths. Throws Error when a style variant has strokes that have no
/// paths: strokes of a tonal art map, and lines that are found between pixels.
void check_has_paths(const features::StyleVariants& variants);

/// Inputs for the paths of hatching strokes.
struct HatchStrokes {
    hatch::HatchInputs inputs;
    std::vector<hatch::HatchVariant> variants;
};

/// Inputs for the paths of ink lines.
struct LineStrokes {
    contour::ContourInputs inputs;
    contour::LineMesh* mesh; ///< mesh in which lines are found; null without lines
};

/// Inputs for haze, which thins strokes.
struct StrokeHaze {
    haze::HazeInputs inputs;
    haze::HazeStyle style;
};

/// Declares the passes that fill `lists` instead of drawing a picture. `lists` must outlive the graph.
void declare_stroke_lists(gpu::Graph& graph, const HatchStrokes& hatch, const LineStrokes& chains,
                          const features::StyleVariants& variants, const std::optional<StrokeHaze>& haze,
                          StrokeLists& lists);

/// The scene from which the strokes were drawn.
struct DrawnScene {
    const Scene& scene;
    const pose::MeshData& layout;
    const contour::EdgeMesh* edges; ///< mesh edges along which lines were found; null without lines
    glm::uvec2 size_px{0};
};

/// Converts `lists` to strokes on the page. Throws Error when the lists were too short for all of the
/// hatching.
[[nodiscard]] VectorDrawing drawing_of(const StrokeLists& lists, const DrawnScene& drawn,
                                       const FramePlan& plan, bool with_hidden_lines);

} // namespace estampe::frame
