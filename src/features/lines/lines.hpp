// SPDX-License-Identifier: MIT
#pragma once

// Lines from picture to picture: the mesh in which lines are found, the brushes that draw lines, and the
// lines of the previous frame. This file also clips vector strokes to the page.

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

/// The parts of a stroke inside the window of the page. A closed stroke that leaves the window becomes
/// several open strokes. The result is empty for a stroke without length.
[[nodiscard]] std::vector<VectorStroke> clipped(const VectorStroke& stroke, const paper::Window& window);

/// The line mesh of one scene, made when lines are first drawn as chains.
class LineMeshes {
public:
    /// The line mesh for `style`; null if lines are not drawn as chains. Costs nothing if neither meshes nor
    /// style changed; otherwise linear in triangles. Throws Error if memory runs out.
    [[nodiscard]] contour::LineMesh* ensure(gpu::Device& device, const pose::MeshData& layout,
                                            const contour::ContourStyle& style);

    /// Runs the part of ensure() that needs no device in a thread. No other function may be called before
    /// the future is ready. The future is invalid if there is nothing to do.
    [[nodiscard]] std::future<void> find_edges(const pose::MeshData& layout,
                                               const contour::ContourStyle& style);

    /// The edges from which the line mesh is made; null before they are found.
    [[nodiscard]] const contour::EdgeMesh* edges() const { return edges_ ? &*edges_ : nullptr; }

    /// Must be called when triangles or their flags change.
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
    std::optional<std::vector<contour::Bending>> bendings_; ///< made only if some kind of line needs them
    std::optional<Choice> choice_;                          ///< the choice from which `lines_` was made
    std::optional<contour::LineMesh> lines_;
};

/// The edge mesh of the triangles in `layout`. The ground, and surfaces with holes cut by a texture, are left
/// out, because their visible borders are not mesh edges.
[[nodiscard]] contour::EdgeMesh edge_mesh_of(const pose::MeshData& layout);

/// Everything on which the brushes of a style depend.
struct BrushChoice {
    /// A name of contour::brush_names() or a path. Empty means the pen, or a kind of line that is not
    /// searched.
    std::array<std::string, shared::line_kind_count> brush_of_kind;
    contour::BrushFit fit = contour::BrushFit::repeat;
    float dash_mm = 0.0F; ///< of hidden lines; 0 means no dashes
    float gap_mm = 0.0F;
    float dash_width_mm = 0.0F;
    bool operator==(const BrushChoice&) const = default;
};

[[nodiscard]] BrushChoice brush_choice(const contour::ContourStyle& style);

/// Whether all kinds of lines use the pen.
[[nodiscard]] bool is_drawn_by_pen(const contour::ContourStyle& style);

/// Draws the tools' brushes by the formulas of [tam](../techniques/tam/README.md), and reads brushes from
/// pictures. None if every line uses the pen. Throws Error naming the file if it is no picture or has no
/// ink. Cost: 20 ms per tool.
[[nodiscard]] std::optional<contour::BrushSet> load_brushes(const contour::ContourStyle& style);

/// The brushes of a renderer; reloaded when the style changes them.
class LineBrushes {
public:
    /// The brushes of the style's lines; null if all use the pen. Throws as load_brushes() does.
    contour::BrushImages* ensure(gpu::Device& device, const contour::ContourStyle& style);

private:
    std::optional<contour::BrushImages> images_;
    std::optional<BrushChoice> choice_;
};

/// Lines linked for the whole page, and the part of the page to ink.
struct LinkedPart {
    contour::LinkedLines* lines = nullptr;
    contour::PartOfPage part;
};

/// How to draw the lines of one sample of a picture.
struct LineJob {
    const contour::ContourStyle& style;    ///< see StyleVariants::lines
    bool has_cuts = false;                 ///< some triangles are cut by a texture
    bool remembers = false;                ///< chains continue those of the history's frame
    std::optional<LinkedPart> linked = {}; ///< drawn instead of searching for lines
};

class Lines final : public Feature {
public:
    /// Forgets the mesh when triangles change, and the former frame's lines when the scene, the ground's
    /// triangles or the origin change.
    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override { return FilmSection{"lines", 1}; }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

    /// Makes the line mesh and the brushes for `style`. Costs nothing if neither triangles nor style
    /// changed; otherwise linear in triangles. Throws Error if a brush cannot be read.
    void ensure(gpu::Device& device, const pose::MeshData& layout, const contour::ContourStyle& style);

    /// Draws lines where surfaces end, meet or fold: as chains, or by comparing pixels. Surfaces with holes
    /// cut by a texture always use the pixel method. Returns an image as contour::add_contours() does.
    [[nodiscard]] gpu::ImageId record(gpu::Graph& graph, const contour::ContourInputs& in,
                                      const LineJob& job);

    /// Links the lines of the whole page into `linked`, which must outlive the graph. Does nothing if lines
    /// are not drawn as chains.
    void record_linked(gpu::Graph& graph, gpu::Device& device, const contour::ContourInputs& in,
                       const contour::ContourStyle& style, contour::LinkedLines& linked);

    /// Made by ensure(); null if lines are not drawn as chains.
    [[nodiscard]] contour::LineMesh* mesh() { return mesh_; }

    /// Made by ensure(); null if all lines use the pen.
    [[nodiscard]] contour::BrushImages* brushes() { return brush_images_; }

    [[nodiscard]] LineMeshes& meshes() { return meshes_; }

    [[nodiscard]] contour::LineHistory& history() { return history_; }

    /// One VariantLines of the contour technique per style variant, if there are several.
    [[nodiscard]] gpu::Buffer& variants() { return variants_; }

    /// One FocusLine per line that points at the centre of interest.
    [[nodiscard]] gpu::Buffer& focus_lines() { return focus_lines_; }

private:
    LineMeshes meshes_;
    LineBrushes brushes_;
    contour::LineMesh* mesh_ = nullptr;            ///< points into `meshes_`
    contour::BrushImages* brush_images_ = nullptr; ///< points into `brushes_`
    contour::LineHistory history_;
    gpu::Buffer variants_;
    gpu::Buffer focus_lines_;
};

} // namespace estampe::features
