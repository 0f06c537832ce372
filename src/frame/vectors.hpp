// SPDX-License-Identifier: MIT
#pragma once

// A frame as strokes of the pen.

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

/// What the device hands back of one frame's strokes. Empty where lines or hatching are not drawn.
struct StrokeLists {
    explicit StrokeLists(gpu::Device& on_device) : device(on_device) {}

    gpu::Device& device;
    gpu::Buffer line_sizes; ///< these six as in contour::LineLists; points once for each hand
    gpu::Buffer line_samples;
    gpu::Buffer line_samples_before;
    gpu::Buffer line_strokes_before;
    std::vector<gpu::Buffer> line_points;
    gpu::Buffer line_facing;
    gpu::Buffer crossings; ///< as hatch::add_trace() writes them
    gpu::Buffer ink_left;  ///< as haze::add_ink_left() writes it, where there is haze
};

/// Throws Error when a look has strokes without paths: those of a tonal art map, and lines that are found
/// between pixels.
void check_has_paths(const features::StyleVariants& looks);

/// What the strokes of hatching come from.
struct HatchStrokes {
    hatch::HatchInputs inputs;
    std::vector<hatch::LookHatch> looks;
};

/// What those of lines come from.
struct LineStrokes {
    contour::ContourInputs inputs;
    contour::LineMesh* mesh; ///< null where there are none
};

/// What thins them.
struct StrokeHaze {
    haze::HazeInputs inputs;
    haze::HazeStyle style;
};

/// Declares what fills `lists` in place of a picture. The lists must outlive the graph.
void declare_stroke_lists(gpu::Graph& graph, const HatchStrokes& hatch, const LineStrokes& chains,
                          const features::StyleVariants& looks, const std::optional<StrokeHaze>& haze,
                          StrokeLists& lists);

/// What strokes belong to.
struct DrawnScene {
    const Scene& scene;
    const pose::MeshData& layout;
    const contour::EdgeMesh* edges; ///< where there are lines
    glm::uvec2 size_px{0};
};

/// The strokes of `lists` on the page. Throws Error when there was no room for all of the hatching.
[[nodiscard]] VectorDrawing drawing_of(const StrokeLists& lists, const DrawnScene& drawn,
                                       const FramePlan& plan, bool with_hidden_lines);

} // namespace estampe::frame
