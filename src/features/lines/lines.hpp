// SPDX-License-Identifier: MIT
#pragma once

// Lines from picture to picture: what they are found in, what they are drawn with, and where the frame before
// drew them.

#include "features/common/feature.hpp"
#include "features/lines/line_brushes.hpp"
#include "features/lines/line_meshes.hpp"
#include "techniques/contour/chains/history/line_history.hpp"
#include "techniques/focus/focus.glsl.h"

namespace estampe::features {

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
