// SPDX-License-Identifier: MIT
#pragma once

// Contours as chains (lines linked along surfaces): from the line mesh of a scene to strokes. Also keeps the
// state of the strokes from frame to frame.

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

/// GPU buffers of the line mesh: the triangles from which contours are extracted, with their neighbours.
struct LineMesh {
    gpu::Buffer triangles; ///< three vertices per triangle, see EdgeMesh::triangles
    gpu::Buffer neighbors;
    /// The two sides of each loose edge (an edge that may be outline but has no feature line).
    gpu::Buffer loose_edges;
    /// Number of the loose edge (an edge without a crease or other fixed line) at each side, three per
    /// triangle; unused if there are no loose edges.
    gpu::Buffer loose_edge_of_side;
    gpu::Buffer feature_points;
    gpu::Buffer feature_chains;
    /// One VertexBending per vertex, for suggestive contours; empty if the style has none.
    gpu::Buffer bendings;
    uint32_t triangle_count = 0;
    uint32_t loose_edge_count = 0;
    uint32_t feature_point_count = 0;
    uint32_t feature_chain_count = 0;
    uint32_t bending_count = 0; ///< number of entries in `bendings`: the number of vertices, or 0
    uint32_t shell_count = 0;   ///< number of connected surfaces, from EdgeMesh::shell_count
    /// Some feature lines (creases and other lines fixed to the surface) cross triangles, see
    /// FeatureChains::leave_edges.
    bool features_leave_edges = false;
};

/// Uploads `mesh` with its feature lines (lines fixed to the surface). Also uploads `bendings` if suggestive
/// contours are drawn. With `along_edges`, every edge without a feature line becomes a loose edge, so that
/// outlines run along the edges of the mesh. Throws Error when memory runs out.
[[nodiscard]] LineMesh upload_line_mesh(gpu::Device& device, const EdgeMesh& mesh, FeatureChains features,
                                        const std::vector<shared::VertexBending>& bendings, bool along_edges);

/// Visible and hidden lines are drawn separately.
enum class LineClass : uint8_t { seen, hidden };

/// The strokes that the previous frame drew. Strokes use the line history to keep their width, wobble and
/// position along the line when chains split or join.
class LineHistory {
public:
    /// Buffers with the strokes of one frame, kept for the next frame.
    struct Drawn {
        gpu::Buffer grid;    ///< sample grid, which finds samples by their position on the page
        gpu::Buffer samples; ///< one DrawnSample per sample
    };

    /// Allocates buffers for frames of `size_px`. The previous frame is used only if `continues` is set and
    /// the frame size is unchanged. With `has_hidden`, the history stores hidden lines too. Throws Error when
    /// memory runs out.
    void begin_frame(gpu::Device& device, glm::uvec2 size_px, bool continues, bool has_hidden = false);

    /// Call this function when a frame is drawn. `clip_from_anchor` is the camera of that frame.
    void end_frame(const glm::mat4& clip_from_anchor);

    /// Replaces the previous frame by `drawn`, which holds the visible lines and the hidden lines of a page
    /// of `size_px`. Throws Error when memory runs out.
    void recall(gpu::Device& device, glm::uvec2 size_px, std::array<std::optional<Drawn>, 2> drawn,
                const glm::mat4& clip_from_anchor);

    /// Forgets the strokes of all frames. Call this function when the scene has changed.
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
    /// Stored strokes of either the visible or the hidden lines.
    struct Memory {
        std::array<Drawn, 2> drawn;
        glm::uvec2 size_px{0};
        bool is_kept = false; ///< the strokes of the current frame will be stored for the next frame
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

/// Number of cells in the sample grid, which finds samples by their position on the page.
[[nodiscard]] uint32_t grid_cell_count(glm::uvec2 size_px);

/// Largest number of line samples on a page of `size_px`.
[[nodiscard]] uint32_t sample_capacity(glm::uvec2 size_px);

/// Buffers of outlines and feature lines (creases and other lines fixed to the surface) after they were
/// linked into chains.
struct Chains {
    shared::ChainConstants constants;
    gpu::BufferId facing; ///< one bit per triangle, set if the triangle faces the eye
    /// One bit per item (triangle, loose edge or cell of the page), set if a line runs through the item.
    gpu::BufferId marks;
    /// Two floats per vertex, from which suggestive contours and crests are found; empty if neither is drawn.
    std::optional<gpu::BufferId> view_bends;
    gpu::BufferId sizes; ///< the length of each list, as one ListSize per list
    gpu::BufferId points_of_slot;
    gpu::BufferId flags_of_slot;
    /// For each slot (entry of the list of chains): number of chain points in all earlier slots.
    gpu::BufferId points_before;
    gpu::BufferId points;  ///< one ChainPoint per point of a chain
    gpu::BufferId lengths; ///< length on the page from each point to the next, in 1/1024 pixel
};

/// Chains divided into evenly spaced samples, with the visibility of each.
struct ChainSamples {
    gpu::BufferId sizes;
    /// For each point of the chains: arc length of the chain from its start to the point.
    gpu::BufferId lengths_before;
    /// For each slot (entry of the list of chains): number of line samples in all earlier slots.
    gpu::BufferId samples_before;
    gpu::BufferId flags_of_slot;
    gpu::BufferId samples; ///< one LineSample per sample
    gpu::BufferId states;  ///< state bits of each sample: sample_is_visible and so on
    /// For each slot (entry of the list of chains): the position at which a closed chain is cut open.
    gpu::BufferId rotation;
    gpu::BufferId facing; ///< one bit per triangle, set if the triangle faces the eye
    gpu::ExecutionProfile execution;
};

/// Buffers of strokes: the samples at which each stroke starts and ends.
struct ChainStrokes {
    gpu::BufferId sizes;
    gpu::BufferId samples; ///< one LineSample per sample; closed chains are already cut open
    /// For each slot (entry of the list of chains): number of line samples in all earlier slots.
    gpu::BufferId samples_before;
    gpu::BufferId strokes_before; ///< for each sample: number of strokes that start before the sample
    gpu::BufferId strokes;        ///< one Stroke per stroke
    gpu::BufferId grid;           ///< sample grid, which finds samples by their position on the page
};

constexpr size_t most_hands = 3; ///< how many times lines can be drawn, see the style's `contour.strokes`

/// Path and width of the pen along all strokes, for one of the times that the simulated hand draws the
/// strokes.
struct HandDrawn {
    /// Two LinePoints per sample: one for the start of the line to the next sample, one for the end of the
    /// line from the previous sample.
    gpu::BufferId line_points;
    gpu::BufferId touches; ///< two LineTouches per sample; unused if all lines are drawn with the pen
};

struct ShapedStrokes {
    ChainStrokes strokes;
    gpu::BufferId facing; ///< one bit per triangle, set if the triangle faces the eye
    /// The pen's path for each time that the simulated hand draws the lines: once, or several times over each
    /// other.
    InlineVector<HandDrawn, most_hands> hands;
    /// Strokes of hidden lines; empty if the style draws none.
    std::optional<std::pair<ChainStrokes, HandDrawn>> hidden;
};

/// Inputs for finding the edges of the sun's shadow.
struct SunPixels {
    /// Image: visible share of the sun per pixel; negative where the surface cannot face the sun.
    gpu::ImageId share;
    /// Visibility buffer of all solid surfaces and of clear glass. Clear glass is included because shadows
    /// fall on it.
    gpu::BufferId visibility;
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
};

/// Inputs for finding clumps of foliage.
struct FoliagePixels {
    gpu::BufferId visibility; ///< visibility buffer of all solid surfaces
    gpu::BufferId draws;
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId light;
    shared::ToneConstants tone; ///< converts light to the tone in which marks are found
    float clump_px = 0.0F;      ///< size of the gaps between leaves that are drawn as one clump
    uint32_t first_leaf = 0;    ///< number of the first triangle of surfaces that alpha cuts
    bool has_outlines = false;  ///< draws outlines of clumps
    bool has_marks = false;     ///< draws marks where the light ends on clumps
};

/// Inputs for linking lines into chains.
struct ChainInputs {
    gpu::BufferId frame;
    gpu::BufferId posed_vertices;
    gpu::BufferId visibility; ///< visibility buffer of the surfaces that can hide lines
    gpu::BufferId neighbors;  ///< the three adjacent sides and the flags of each triangle of the line mesh
    gpu::BufferId line_triangles;
    /// Conditions for suggestive contours; unused if the line mesh has no curvature.
    SuggestiveCut suggestive_cut;
    std::optional<CrestMesh> crests; ///< the terrain mesh on which crests are drawn; empty if there is none
    /// Smallest bend of a crest in degrees, the style's `contour.crest.angle_deg`.
    float crest_deg = 3.0F;
    bool meetings = false; ///< draws lines where two connected surfaces intersect
    /// Inputs for the edges of the sun's shadow; empty if the style does not draw them.
    std::optional<SunPixels> sun;
    /// Inputs for lines around clumps of foliage; empty if the style or the scene has none.
    std::optional<FoliagePixels> foliage;
    float step_px = 3.0F;       ///< approximate distance between samples, in pixels
    float pixels_per_mm = 1.0F; ///< of the page
    float shortest_px = 0.0F;   ///< a shorter visible part of a line is not drawn
    float gap_px = 0.0F;        ///< how far before a nearer line a line stops
    /// Width of outlines: a shorter hidden part is drawn, and kinks are rounded within half of it.
    float pen_px = 0.0F;
    bool has_brushes = false; ///< some lines are drawn by brushes other than the pen
    uint32_t shell_count = 0; ///< number of connected surfaces, from EdgeMesh::shell_count
    glm::uvec2 size_px{0};
    gpu::ExecutionProfile execution;
};

/// Collects the inputs of add_chains() from the inputs of a frame's contours.
[[nodiscard]] ChainInputs chain_inputs(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                                       const ContourStyle& style);

/// Finds outlines (one segment per triangle or edge), and lines between the pixels of the page. Also finds
/// suggestive contours if the line mesh has curvature. Links all lines found and the feature lines (creases
/// and other lines fixed to the surface) into chains.
///
/// Cost    one or two threads per triangle, and further threads in proportion to the number of lines
/// Source  segments: Hertzmann and Zorin, "Illustrating Smooth Surfaces", 2000; ranking: Wyllie, "The
/// Complexity of Parallel Computations", 1979
[[nodiscard]] Chains add_chains(gpu::Graph& graph, const ChainInputs& in, LineMesh& mesh, bool along_edges);

/// Divides chains into evenly spaced samples and determines the visibility of each sample.
///
/// Source  Cole and Finkelstein, "Fast High-Quality Line Visibility", 2009
[[nodiscard]] ChainSamples add_samples(gpu::Graph& graph, const ChainInputs& in, const Chains& chains);

/// Makes strokes of the visible lines, or of the hidden lines on the page. Enters the samples into the sample
/// grid `grid` by their position. Overwrites the lengths of the stroke lists of an earlier call.
[[nodiscard]] ChainStrokes add_strokes(gpu::Graph& graph, const ChainInputs& lines, const ChainSamples& in,
                                       gpu::BufferId grid, LineClass wanted = LineClass::seen);

/// Returns the line widths and inks of a style variant (the style of certain materials or objects) as an
/// entry of ContourInputs::variant_lines.
[[nodiscard]] shared::VariantLines variant_lines_of(const ContourStyle& style, float pixels_per_mm);

/// Links lines into chains and shapes their strokes, but does not ink them. With a `history`, the strokes
/// continue the previous frame's strokes and are stored for the next frame. `history` must live until the
/// graph has run.
[[nodiscard]] ShapedStrokes add_shaped_strokes(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                                               LineHistory* history, const ContourStyle& style);

/// Draws chains as strokes into an ink layer; the alternative to add_contours(), which finds lines on the
/// page. add_shaped_strokes() describes `history`. If `under` is given, the strokes are drawn over that ink
/// layer.
[[nodiscard]] gpu::ImageId add_chain_contours(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                                              LineHistory* history, const ContourStyle& style,
                                              std::optional<gpu::ImageId> under = std::nullopt);

} // namespace estampe::contour
