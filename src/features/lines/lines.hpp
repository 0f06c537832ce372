// SPDX-License-Identifier: MIT
#pragma once

// Contour lines over several pictures: the mesh in which lines are found, the brushes that draw lines, and
// the lines of the previous frame. The file also declares the clipping of vector strokes to the page.

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

/// Returns the parts of a stroke that lie inside the window of the page. A closed stroke that leaves the
/// window becomes several open strokes. The result is empty for a stroke without length.
[[nodiscard]] std::vector<VectorStroke> clipped(const VectorStroke& stroke, const paper::Window& window);

/// The mesh in which the lines of one scene are found. The mesh is made when lines are first drawn as chains
/// (linked edges of the mesh).
class LineMeshes {
public:
    /// Returns the line mesh for `style`; null if lines are not drawn as chains (linked edges of the mesh).
    /// Cost: none if neither meshes nor style changed, otherwise linear in triangles. Throws Error if memory
    /// runs out.
    [[nodiscard]] contour::LineMesh* ensure(gpu::Device& device, const pose::MeshData& layout,
                                            const contour::ContourStyle& style);

    /// Starts to find the mesh's edges in another thread, because this part of ensure() needs no device. No
    /// other function may be called before the future is ready. The returned future is invalid if the edges
    /// are already known.
    [[nodiscard]] std::future<void> find_edges(const pose::MeshData& layout,
                                               const contour::ContourStyle& style);

    /// Returns the edges from which the line mesh is made; null before they are found.
    [[nodiscard]] const contour::EdgeMesh* edges() const { return edges_ ? &*edges_ : nullptr; }

    /// Forgets the line mesh. Must be called when triangles or their flags change.
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
    /// For each vertex: how the surface bends there. Only computed if some kind of line needs it.
    std::optional<std::vector<contour::Bending>> bendings_;
    std::optional<Choice> choice_; ///< Choice of lines for which `lines_` was made
    std::optional<contour::LineMesh> lines_;
};

/// Makes the edge mesh of the triangles in `layout`. The ground, and surfaces with holes cut by a texture,
/// are left out, because their visible borders are not mesh edges.
[[nodiscard]] contour::EdgeMesh edge_mesh_of(const pose::MeshData& layout);

/// The settings on which the brushes of a style depend.
struct BrushChoice {
    /// Brush of each kind of line: a name of contour::brush_names(), or the path of a picture. Empty: the
    /// line is drawn by the pen, or is not searched.
    std::array<std::string, shared::line_kind_count> brush_of_kind;
    contour::BrushFit fit = contour::BrushFit::repeat;
    float dash_mm = 0.0F; ///< Length of the dashes of hidden lines; 0: no dashes
    float gap_mm = 0.0F;
    float dash_width_mm = 0.0F;
    ReadScope scope; ///< Limits the files of the pictures
    bool operator==(const BrushChoice&) const = default;
};

[[nodiscard]] BrushChoice brush_choice(const contour::ContourStyle& style);

/// Returns whether all kinds of lines use the pen.
[[nodiscard]] bool is_drawn_by_pen(const contour::ContourStyle& style);

/// Draws the brushes by the formulas of [tam](../techniques/tam/README.md), and reads brushes from pictures.
/// Returns none if every line uses the pen. Throws Error naming the file if it is no picture or has no ink.
/// Cost: 20 ms per brush.
[[nodiscard]] std::optional<contour::BrushSet> load_brushes(const contour::ContourStyle& style);

/// The brushes of a renderer's lines; reloaded when the style changes them.
class LineBrushes {
public:
    /// Returns the brushes of the style's lines; null if all use the pen. Throws Error as load_brushes()
    /// does.
    contour::BrushImages* ensure(gpu::Device& device, const contour::ContourStyle& style);

private:
    std::optional<contour::BrushImages> images_;
    std::optional<BrushChoice> choice_;
};

/// Lines that were already linked for the whole page, and the part of the page on which they are drawn.
struct LinkedPart {
    contour::LinkedLines* lines = nullptr;
    contour::PartOfPage part;
};

/// The settings for drawing the lines of one sample of a picture.
struct LineJob {
    const contour::ContourStyle& style;    ///< Lines of all style variants, see StyleVariants::lines
    bool has_cuts = false;                 ///< Some triangles with holes have lines between pixels
    bool remembers = false;                ///< Lines continue those of the previous frame
    std::optional<LinkedPart> linked = {}; ///< Lines that are already linked; if set, no lines are searched
};

class Lines final : public Feature {
public:
    /// Forgets the line mesh when triangles change. Forgets the previous frame's lines when the scene, the
    /// ground's triangles or the origin of positions change.
    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override { return FilmSection{"lines", 1}; }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

    /// Makes the line mesh and the brushes for `style`. Cost: none if neither triangles nor style changed,
    /// otherwise linear in triangles. Throws Error if a brush cannot be read.
    void ensure(gpu::Device& device, const pose::MeshData& layout, const contour::ContourStyle& style);

    /// Draws lines where surfaces end, meet or fold: as chains of mesh edges, or by comparing pixels.
    /// Surfaces with holes cut by a texture always use the pixel method, except foliage with clumps. Returns
    /// an image as contour::add_contours() does.
    [[nodiscard]] gpu::ImageId record(gpu::Graph& graph, const contour::ContourInputs& in,
                                      const LineJob& job);

    /// Draws the chains that `in.line_hiders` leaves visible a second time, without hidden lines and without
    /// memory of the previous frame. Returns an image as record() does; none if lines are not drawn as chains
    /// of mesh edges.
    [[nodiscard]] std::optional<gpu::ImageId>
    record_behind(gpu::Graph& graph, const contour::ContourInputs& in, const contour::ContourStyle& style);

    /// Links the lines of the whole page into `linked`, which must outlive the graph. Does nothing if lines
    /// are not drawn as chains of mesh edges.
    void record_linked(gpu::Graph& graph, gpu::Device& device, const contour::ContourInputs& in,
                       const contour::ContourStyle& style, contour::LinkedLines& linked);

    /// Returns the line mesh that ensure() made; null if lines are not drawn as chains of mesh edges.
    [[nodiscard]] contour::LineMesh* mesh() { return mesh_; }

    /// Returns the brushes that ensure() made; null if all lines use the pen.
    [[nodiscard]] contour::BrushImages* brushes() { return brush_images_; }

    [[nodiscard]] LineMeshes& meshes() { return meshes_; }

    [[nodiscard]] contour::LineHistory& history() { return history_; }

    /// Returns the buffer with one VariantLines (widths and inks of lines) per style variant; only filled if
    /// there are several variants.
    [[nodiscard]] gpu::Buffer& variants() { return variants_; }

    /// Returns the buffer with the same records for record_behind(): lines of clear bodies have no width.
    [[nodiscard]] gpu::Buffer& variants_behind() { return variants_behind_; }

    /// Returns the buffer with one FocusLine for each line that points at the centre of interest.
    [[nodiscard]] gpu::Buffer& focus_lines() { return focus_lines_; }

private:
    LineMeshes meshes_;
    LineBrushes brushes_;
    contour::LineMesh* mesh_ = nullptr;            ///< The line mesh; the member `meshes_` owns it
    contour::BrushImages* brush_images_ = nullptr; ///< The brushes; the member `brushes_` owns them
    contour::LineHistory history_;
    gpu::Buffer variants_;
    gpu::Buffer variants_behind_;
    gpu::Buffer focus_lines_;
};

} // namespace estampe::features
