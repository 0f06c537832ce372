// SPDX-License-Identifier: MIT
#pragma once

// Lines linked into chains along surfaces: from the line mesh of a scene to strokes, and the state of strokes
// that is kept from frame to frame.

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "core/inline_vector.hpp"
#include "gpu/execution_profile.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/contour/chains/mesh/bending.hpp"
#include "techniques/contour/chains/mesh/edge_mesh.hpp"
#include "techniques/contour/chains/mesh/feature_chains.hpp"
#include "techniques/contour/contour.hpp"

namespace estampe::contour {

/// GPU buffers of the mesh along which lines run.
struct LineMesh {
    gpu::Buffer triangles; ///< EdgeMesh::triangles
    gpu::Buffer neighbors;
    gpu::Buffer loose_edges;        ///< both sides of each loose edge
    gpu::Buffer loose_edge_of_side; ///< three per triangle; unused without loose edges
    gpu::Buffer feature_points;
    gpu::Buffer feature_chains;
    gpu::Buffer bendings; ///< VertexBending, for suggestive contours; empty without them
    uint32_t triangle_count = 0;
    uint32_t loose_edge_count = 0;
    uint32_t feature_point_count = 0;
    uint32_t feature_chain_count = 0;
    uint32_t bending_count = 0;        ///< number of vertices, or 0
    uint32_t shell_count = 0;          ///< EdgeMesh::shell_count
    bool features_leave_edges = false; ///< FeatureChains::leave_edges
};

/// Uploads `mesh` with the lines of its features, and `bendings` if suggestive contours are drawn. With
/// `along_edges` every edge that has no feature line is a loose edge, so that outlines run along the edges of
/// the mesh. Throws Error when memory runs out.
[[nodiscard]] LineMesh upload_line_mesh(gpu::Device& device, const EdgeMesh& mesh, FeatureChains features,
                                        const std::vector<shared::VertexBending>& bendings, bool along_edges);

/// Seen and hidden lines are drawn separately.
enum class LineClass : uint8_t { seen, hidden };

/// What the previous frame drew. Strokes use it to keep their width, their wobble and their position along
/// the line when chains split or join.
class LineHistory {
public:
    /// Buffers that one frame leaves for the next.
    struct Drawn {
        gpu::Buffer grid;    ///< grid that finds samples by their position on the page
        gpu::Buffer samples; ///< DrawnSample
    };

    /// Allocates buffers for frames of `size_px`. The previous frame is used only if it had the same size and
    /// `continues` is set. With `has_hidden`, hidden lines are kept too. Throws Error when memory runs out.
    void begin_frame(gpu::Device& device, glm::uvec2 size_px, bool continues, bool has_hidden = false);

    /// Call this when the frame as seen by `clip_from_anchor` has been drawn.
    void end_frame(const glm::mat4& clip_from_anchor);

    /// Sets the previous frame to `drawn`, of seen and of hidden lines, on pages of `size_px`. Throws Error
    /// when memory runs out.
    void recall(gpu::Device& device, glm::uvec2 size_px, std::array<std::optional<Drawn>, 2> drawn,
                const glm::mat4& clip_from_anchor);

    /// Forgets all frames, because the scene has changed.
    void forget();

    [[nodiscard]] bool holds_frame(LineClass lines = LineClass::seen) const
    {
        return memory_of(lines).holds_frame;
    }

    /// Page size of the stored frames.
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
    /// State of the seen lines or of the hidden lines.
    struct Memory {
        std::array<Drawn, 2> drawn;
        glm::uvec2 size_px{0};
        bool is_kept = false; ///< this frame is stored for the next
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

/// Number of cells in the grid that finds samples by position.
[[nodiscard]] uint32_t grid_cell_count(glm::uvec2 size_px);

/// Largest number of samples on a page.
[[nodiscard]] uint32_t sample_capacity(glm::uvec2 size_px);

/// Outlines and features linked into chains.
struct Chains {
    shared::ChainConstants constants;
    gpu::BufferId facing; ///< one bit per triangle, set if the triangle faces the eye
    gpu::BufferId marks;  ///< one bit per item, set if the outline crosses the item
    std::optional<gpu::BufferId>
        view_bends;      ///< two floats per vertex, written by view_bends.comp and crests.comp
    gpu::BufferId sizes; ///< ListSize of each list
    gpu::BufferId points_of_slot;
    gpu::BufferId flags_of_slot;
    gpu::BufferId points_before; ///< one per slot
    gpu::BufferId points;        ///< ChainPoint
    gpu::BufferId lengths;       ///< length of the piece to the next point
};

/// Chains divided into evenly spaced samples, with the visibility of each.
struct ChainSamples {
    gpu::BufferId sizes;
    gpu::BufferId lengths_before; ///< one per point of the chains
    gpu::BufferId samples_before; ///< one per slot
    gpu::BufferId flags_of_slot;
    gpu::BufferId samples;  ///< LineSample
    gpu::BufferId states;   ///< one per sample
    gpu::BufferId rotation; ///< one per slot: position at which a closed chain is cut open
    gpu::ExecutionProfile execution;
};

/// Strokes: the samples at which each stroke starts and ends.
struct ChainStrokes {
    gpu::BufferId sizes;
    gpu::BufferId samples;        ///< LineSample; closed chains are cut open
    gpu::BufferId samples_before; ///< one per slot
    gpu::BufferId strokes_before; ///< one per sample
    gpu::BufferId strokes;        ///< Stroke
    gpu::BufferId grid;           ///< grid that finds samples by position
};

/// Path and width of the pen, once along all strokes.
constexpr size_t most_hands = 3; ///< how often lines can be retraced, see `contour.strokes`

struct HandDrawn {
    gpu::BufferId line_points; ///< LinePoint, two per sample: start of its piece, end of the previous one
    gpu::BufferId touches;     ///< LineTouch, two per sample; unused without brushes
};

struct ShapedStrokes {
    ChainStrokes strokes;
    gpu::BufferId facing;                                     ///< as in Chains
    InlineVector<HandDrawn, most_hands> hands;                ///< one for each time that the lines are drawn
    std::optional<std::pair<ChainStrokes, HandDrawn>> hidden; ///< set if hidden lines are drawn
};

/// Inputs for finding the edges of the sun's shadow.
struct SunPixels {
    gpu::ImageId share; ///< visible share of the sun; negative where no sun can shine
    /// Visibility buffer of all solid surfaces, including clear glass, because shadows fall on it.
    gpu::BufferId visibility;
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
};

/// Inputs for linking lines into chains.
struct ChainInputs {
    gpu::BufferId frame;
    gpu::BufferId posed_vertices;
    gpu::BufferId visibility; ///< visibility buffer of the surfaces that hide lines
    gpu::BufferId neighbors;  ///< neighbours of the line mesh's triangles
    gpu::BufferId line_triangles;
    SuggestiveCut suggestive_cut;    ///< unused if the line mesh has no bendings
    std::optional<CrestMesh> crests; ///< the mesh whose crests have lines
    float crest_deg = 3.0F;          ///< see ContourStyle
    bool meetings = false;           ///< draws lines where shells intersect
    std::optional<SunPixels> sun;    ///< set if edges of the sun's shadow are drawn
    float step_px = 3.0F;            ///< approximate spacing of samples
    glm::uvec2 size_px{0};
    gpu::ExecutionProfile execution;
};

/// Collects the inputs of add_chains() from those of a frame.
[[nodiscard]] ChainInputs chain_inputs(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                                       const ContourStyle& style);

/// Finds outlines (one segment per triangle or edge), suggestive contours if the line mesh has bendings, and
/// lines on the page, and links these and the features into chains.
///
/// Cost    one or two threads per triangle; the rest grows with the lines
/// Source  segments: Hertzmann and Zorin, "Illustrating Smooth Surfaces", 2000; ranking: Wyllie, "The
/// Complexity of Parallel Computations", 1979
[[nodiscard]] Chains add_chains(gpu::Graph& graph, const ChainInputs& in, LineMesh& mesh, bool along_edges);

/// Divides chains into evenly spaced samples and determines the visibility of each sample.
///
/// Source  Cole and Finkelstein, "Fast High-Quality Line Visibility", 2009
[[nodiscard]] ChainSamples add_samples(gpu::Graph& graph, const ChainInputs& in, const Chains& chains);

/// Makes strokes of the seen lines, or of the hidden lines on the page. Inserts samples into `grid` by
/// position. Overwrites the list sizes of strokes from an earlier call.
[[nodiscard]] ChainStrokes add_strokes(gpu::Graph& graph, const ChainSamples& in, gpu::BufferId grid,
                                       glm::uvec2 size_px, LineClass wanted = LineClass::seen);

/// Widths and inks of a style variant, for ContourInputs::variant_lines.
[[nodiscard]] shared::VariantLines variant_lines_of(const ContourStyle& style, float pixels_per_mm);

/// Links lines and shapes their strokes: all steps before the ink. With a `history`, strokes continue from
/// the frame it holds and are stored for the next; it must outlive the graph's run.
[[nodiscard]] ShapedStrokes add_shaped_strokes(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                                               LineHistory* history, const ContourStyle& style);

/// Draws chains as strokes into an ink layer; the alternative to add_contours(). For `history` see
/// add_shaped_strokes(); `under` is an ink layer to draw over.
[[nodiscard]] gpu::ImageId add_chain_contours(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                                              LineHistory* history, const ContourStyle& style,
                                              std::optional<gpu::ImageId> under = std::nullopt);

} // namespace estampe::contour
