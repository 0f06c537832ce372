// SPDX-License-Identifier: MIT
#pragma once

// Lines from picture to picture: what they are found in, what they are drawn with, and where the frame
// before drew them. Beside them what of a stroke as a path lies on the page.

#include <array>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include <estampe/vector_drawing.hpp>

#include "features/common/feature.hpp"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/contour/chains/ink/ink.hpp"
#include "techniques/contour/chains/mesh/feature_chains.hpp"
#include "techniques/contour/chains/stroke/linked_lines.hpp"
#include "techniques/contour/contour.hpp"
#include "techniques/focus/focus.glsl.h"
#include "techniques/paper/paper.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

/// The parts of a stroke that lie within the window of the page. A closed one that leaves it falls into open
/// ones; nothing for a stroke without length.
[[nodiscard]] std::vector<VectorStroke> clipped(const VectorStroke& stroke, const paper::Window& window);

/// The line mesh of one scene, made when lines are first drawn as chains.
class LineMeshes {
public:
    /// The line mesh for `style`, or null when lines are not chains. Cost: nothing when neither meshes nor
    /// choice changed; else linear in triangles. Throws Error when memory runs out.
    [[nodiscard]] contour::LineMesh* ensure(gpu::Device& device, const pose::MeshData& layout,
                                            const contour::ContourStyle& style);

    /// Begins that part of it which needs no device, in a thread that ends before what is returned does, and
    /// before which no other function may be called. Nothing to wait for where there is nothing to find.
    [[nodiscard]] std::future<void> find_edges(const pose::MeshData& layout,
                                               const contour::ContourStyle& style);

    /// What the line mesh was made of; null when there is none.
    [[nodiscard]] const contour::EdgeMesh* edges() const { return edges_ ? &*edges_ : nullptr; }

    /// To be called when triangles change, or what they are flagged with.
    void forget();

private:
    struct Choice {
        contour::FeatureChoice features;
        contour::RidgeChoice ridges;
        bool along_edges = false;
        bool suggestive = false;
        bool operator==(const Choice&) const = default;
    };

    void make_lines(gpu::Device& device, const pose::MeshData& layout, const Choice& choice);

    std::optional<contour::EdgeMesh> edges_;
    std::optional<std::vector<contour::Bending>> bendings_; ///< only when some line wants them
    std::optional<Choice> choice_;                          ///< of what `lines_` holds
    std::optional<contour::LineMesh> lines_;
};

/// The edge mesh of the triangles in `layout`. Neither the ground nor anything with holes cut by a texture
/// has lines: their edges are not where they seem to end.
[[nodiscard]] contour::EdgeMesh edge_mesh_of(const pose::MeshData& layout);

/// What the brushes of a style depend on.
struct BrushChoice {
    /// A name of contour::brush_names() or a path; empty, for the pen, where lines of that kind are not
    /// looked for.
    std::array<std::string, shared::line_kind_count> brush_of_kind;
    contour::BrushFit fit = contour::BrushFit::repeat;
    float dash_mm = 0.0F; ///< of hidden lines; 0 for none
    float gap_mm = 0.0F;
    float dash_width_mm = 0.0F;
    bool operator==(const BrushChoice&) const = default;
};

[[nodiscard]] BrushChoice brush_choice(const contour::ContourStyle& style);

/// Whether no kind of line has another brush than the pen.
[[nodiscard]] bool is_drawn_by_pen(const contour::ContourStyle& style);

/// Draws tools by the formulas of [tam](../techniques/tam/README.md), and reads pictures. Nothing when all is
/// drawn by the pen. Throws Error naming the file when it is no picture or has no ink. Cost: 20 ms a tool.
[[nodiscard]] std::optional<contour::BrushSet> load_brushes(const contour::ContourStyle& style);

/// The brushes of a renderer, loaded when the style asks for others.
class LineBrushes {
public:
    /// What the style's lines are drawn with; none where that is the pen alone. Throws as load_brushes()
    /// does.
    contour::BrushImages* ensure(gpu::Device& device, const contour::ContourStyle& style);

private:
    std::optional<contour::BrushImages> images_;
    std::optional<BrushChoice> choice_;
};

/// Lines that were linked for a whole page, and the part of it that is inked.
struct LinkedPart {
    contour::LinkedLines* lines = nullptr;
    contour::PartOfPage part;
};

/// Which lines a sample of a picture has.
struct LineJob {
    const contour::ContourStyle& style;    ///< see LookPlan::lines
    bool has_cuts = false;                 ///< some triangles are cut by a texture
    bool remembers = false;                ///< chains go on from the history's frame
    std::optional<LinkedPart> linked = {}; ///< in place of those that would be found
};

class Lines final : public Feature {
public:
    /// Lines of another scene are no continuation; nor are those that were found among other triangles, or
    /// relative to another origin.
    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override { return FilmSection{"lines", 1}; }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

    /// Makes the line mesh and the brushes that `style` asks for. Cost: nothing where neither triangles nor
    /// style changed; otherwise linear in triangles. Throws Error for a brush that cannot be read.
    void ensure(gpu::Device& device, const pose::MeshData& layout, const contour::ContourStyle& style);

    /// Draws lines where surfaces end, meet or fold: as chains, or between pixels, which is also how what a
    /// texture cuts gets its own. Writes an image as contour::add_contours() has it.
    [[nodiscard]] gpu::ImageId record(gpu::Graph& graph, const contour::ContourInputs& in,
                                      const LineJob& job);

    /// Links the lines of a whole page into `linked`, which must outlive the graph; nothing where lines are
    /// not chains.
    void record_linked(gpu::Graph& graph, gpu::Device& device, const contour::ContourInputs& in,
                       const contour::ContourStyle& style, contour::LinkedLines& linked);

    /// What ensure() made; null where lines are not chains.
    [[nodiscard]] contour::LineMesh* mesh() { return mesh_; }

    /// What ensure() made; null where all is drawn by the pen.
    [[nodiscard]] contour::BrushImages* brushes() { return brush_images_; }

    [[nodiscard]] LineMeshes& meshes() { return meshes_; }

    [[nodiscard]] contour::LineHistory& history() { return history_; }

    /// contour's LineLook of each style variant, where there are several.
    [[nodiscard]] gpu::Buffer& looks() { return looks_; }

    /// FocusLine, of lines that point at what matters.
    [[nodiscard]] gpu::Buffer& focus_lines() { return focus_lines_; }

private:
    LineMeshes meshes_;
    LineBrushes brushes_;
    contour::LineMesh* mesh_ = nullptr;            ///< of `meshes_`
    contour::BrushImages* brush_images_ = nullptr; ///< of `brushes_`
    contour::LineHistory history_;
    gpu::Buffer looks_;
    gpu::Buffer focus_lines_;
};

} // namespace estampe::features
