// SPDX-License-Identifier: MIT
#pragma once

// Lines strung along the surface: from the line mesh of a scene to strokes, and what is kept of them from
// frame to frame.

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

/// What lines are strung along, on the device.
struct LineMesh {
    gpu::Buffer triangles; ///< EdgeMesh::triangles
    gpu::Buffer neighbors;
    gpu::Buffer loose_edges;        ///< both sides of each
    gpu::Buffer loose_edge_of_side; ///< three a triangle; of no use where there are no loose edges
    gpu::Buffer feature_points;
    gpu::Buffer feature_chains;
    gpu::Buffer bendings; ///< VertexBending, for suggestive contours; empty without them
    uint32_t triangle_count = 0;
    uint32_t loose_edge_count = 0;
    uint32_t feature_point_count = 0;
    uint32_t feature_chain_count = 0;
    uint32_t bending_count = 0;        ///< vertices, or none
    uint32_t shell_count = 0;          ///< EdgeMesh::shell_count
    bool features_leave_edges = false; ///< FeatureChains::leave_edges
};

/// Uploads `mesh` with the lines of its features, and `bendings` if there are to be suggestive contours. With
/// `along_edges` every edge without a line of its own is loose, so that outlines run along the edges of the
/// mesh. Throws Error when memory runs out.
[[nodiscard]] LineMesh upload_line_mesh(gpu::Device& device, const EdgeMesh& mesh, FeatureChains features,
                                        const std::vector<shared::VertexBending>& bendings, bool along_edges);

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

/// Outlines and features strung into whole lines.
struct Chains {
    shared::ChainConstants constants;
    gpu::BufferId facing; ///< a bit a triangle: faces the eye
    gpu::BufferId marks;  ///< a bit an item: the outline runs through it
    std::optional<gpu::BufferId>
        view_bends;      ///< two floats a vertex, as view_bends.comp and crests.comp have it
    gpu::BufferId sizes; ///< ListSize of each list
    gpu::BufferId points_of_slot;
    gpu::BufferId flags_of_slot;
    gpu::BufferId points_before; ///< each slot
    gpu::BufferId points;        ///< ChainPoint
    gpu::BufferId lengths;       ///< of the piece to the next point
};

/// The same in even steps, of which it is known whether they are seen.
struct ChainSamples {
    gpu::BufferId sizes;
    gpu::BufferId lengths_before; ///< each point of the chains
    gpu::BufferId samples_before; ///< each slot
    gpu::BufferId flags_of_slot;
    gpu::BufferId samples;  ///< LineSample
    gpu::BufferId states;   ///< each sample
    gpu::BufferId rotation; ///< each slot: where a closed chain is cut open
    gpu::ExecutionProfile execution;
};

/// What of them is drawn together: where each stroke starts and ends.
struct ChainStrokes {
    gpu::BufferId sizes;
    gpu::BufferId samples;        ///< LineSample; closed chains cut open
    gpu::BufferId samples_before; ///< each slot
    gpu::BufferId strokes_before; ///< each sample
    gpu::BufferId strokes;        ///< Stroke
    gpu::BufferId grid;           ///< where on the page samples are
};

/// The way and the width of the pen, once along all strokes.
constexpr size_t most_hands = 3; ///< that go over a line, see `contour.strokes`

struct HandDrawn {
    gpu::BufferId line_points; ///< LinePoint, two a sample: as its piece starts, as the piece before it ends
    gpu::BufferId touches;     ///< LineTouch, two a sample as well; of no use where there are no brushes
};

struct ShapedStrokes {
    ChainStrokes strokes;
    gpu::BufferId facing;                                     ///< as in Chains
    InlineVector<HandDrawn, most_hands> hands;                ///< one for each time that lines are gone over
    std::optional<std::pair<ChainStrokes, HandDrawn>> hidden; ///< where they are wanted
};

/// What edges of the sun's shadow are found by.
struct SunPixels {
    gpu::ImageId share;       ///< of the sun that is seen; negative where none can be
    gpu::BufferId visibility; ///< of all that is solid: shadows fall on clear glass too
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
};

/// What strings lines together reads of the frame.
struct ChainInputs {
    gpu::BufferId frame;
    gpu::BufferId posed_vertices;
    gpu::BufferId visibility; ///< of what hides lines
    gpu::BufferId neighbors;  ///< of the line mesh, as its triangles
    gpu::BufferId line_triangles;
    SuggestiveCut suggestive_cut;    ///< of no use where the line mesh has no bendings
    std::optional<CrestMesh> crests; ///< lines are wanted along them
    float crest_deg = 3.0F;          ///< see ContourStyle
    bool meetings = false;           ///< lines are wanted where shells run into each other
    std::optional<SunPixels> sun;    ///< edges of its shadow are wanted
    float step_px = 3.0F;            ///< between samples, about
    glm::uvec2 size_px{0};
    gpu::ExecutionProfile execution;
};

/// What of a frame's inputs lines are strung together from.
[[nodiscard]] ChainInputs chain_inputs(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                                       const ContourStyle& style);

/// Finds the outline, one segment a triangle or edge, suggestive contours where the line mesh has bendings,
/// and what is found on the page, and strings these and the features together.
///
/// Cost    one thread a triangle, or two; all else grows with the lines
/// Source  segments: Hertzmann and Zorin, "Illustrating Smooth Surfaces", 2000; ranking: Wyllie, "The
/// Complexity of Parallel Computations", 1979
[[nodiscard]] Chains add_chains(gpu::Graph& graph, const ChainInputs& in, LineMesh& mesh, bool along_edges);

/// Divides chains into even steps and asks what hides each.
///
/// Source  Cole and Finkelstein, "Fast High-Quality Line Visibility", 2009
[[nodiscard]] ChainSamples add_samples(gpu::Graph& graph, const ChainInputs& in, const Chains& chains);

/// Makes strokes of what is seen, or of what is hidden and on the page. `grid` is where samples enter the
/// cells they lie in. Strokes of what was asked for before no longer count in the sizes.
[[nodiscard]] ChainStrokes add_strokes(gpu::Graph& graph, const ChainSamples& in, gpu::BufferId grid,
                                       glm::uvec2 size_px, LineClass wanted = LineClass::seen);

/// What the lines of a look are, for ContourInputs::line_looks.
[[nodiscard]] shared::LineLook line_look(const ContourStyle& style, float pixels_per_mm);

/// Strings lines together and shapes their strokes: all that comes before the ink. With a `history`, strokes
/// go on from the frame it holds and are remembered for the next; it must outlive the graph's run.
[[nodiscard]] ShapedStrokes add_shaped_strokes(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                                               LineHistory* history, const ContourStyle& style);

/// Draws chains as strokes into an ink layer: the choice beside add_contours(). For `history` see
/// add_shaped_strokes(); `under` is an ink layer to draw over.
[[nodiscard]] gpu::ImageId add_chain_contours(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                                              LineHistory* history, const ContourStyle& style,
                                              std::optional<gpu::ImageId> under = std::nullopt);

} // namespace estampe::contour
