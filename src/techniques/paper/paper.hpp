// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"
#include "techniques/paper/paper.glsl.h"

namespace estampe::paper {

/// The parts of the paper that are transparent, so that the picture has an alpha channel.
enum class Transparency : uint8_t {
    none,       ///< the whole picture is opaque
    background, ///< paper beyond all objects is transparent; objects hide what is behind them
    paper       ///< all paper is transparent: only ink and paint remain
};

struct PaperStyle {
    float height_mm = 150.0F;
    float margin_mm = 6.0F;
    float border_mm = 0.0F;
    glm::vec3 color = style::srgb(0xf6f0e2);
    Transparency transparent = Transparency::none;
    float grain = 0.55F;
    float granulation = 0.5F;
    glm::vec3 ink = style::srgb(0x1c1a20);
    float ink_break = 0.25F;
    float ink_grain = 0.0F;
    float ink_tint = 0.0F;
    float overprint = 0.0F;
    float misprint_mm = 0.0F;
    float misprint_deg = 30.0F;
    int seed = 1;
};

[[nodiscard]] const style::Table<PaperStyle>& paper_table();

/// The colour of transparent paper; empty for an opaque picture.
[[nodiscard]] inline std::optional<glm::vec3> transparent_color(const PaperStyle& style)
{
    return style.transparent == Transparency::none ? std::nullopt : std::optional(style.color);
}

/// How far the style prints paint beside its place, in whole pixels to the right and down.
[[nodiscard]] glm::ivec2 paint_shift_px(const PaperStyle& style, float pixels_per_mm);

/// Largest distance in pixels from which paint affects a pixel; 0 if the style prints paint at its place.
[[nodiscard]] uint32_t reach_px(const PaperStyle& style, float pixels_per_mm);

/// The rectangle of the page inside the margin.
struct Window {
    glm::vec2 min_mm{0.0F}; ///< upper left corner, from the page's upper left corner, y down
    glm::vec2 max_mm{0.0F};
    bool operator==(const Window&) const = default;
};

/// The rectangle inside the margin, for a page with the given width and the style's height.
[[nodiscard]] Window window_of(const PaperStyle& style, float width_mm);

struct ComposeInputs {
    gpu::BufferId frame; ///< buffer with a FrameGlobals record
    gpu::ImageId wash;
    gpu::ImageId hatch;
    gpu::ImageId lines;
    gpu::ImageId sky_ink;
    std::optional<gpu::ImageId> ink = {}; ///< flowing ink, drawn below strokes and lines: rgba8 like `lines`
    float ink_settles = 0.0F;             ///< degree to which flowing ink settles in the paper's hollows
    /// Paint of smoke, drawn over the lines: rgba8, square roots of the colour, coverage in alpha.
    std::optional<gpu::ImageId> smoke_paint = {};
    std::optional<gpu::ImageId> smoke_ink = {}; ///< ink of smoke, r16f; required together with `smoke_paint`
    bool has_sky = true;                        ///< whether `sky_ink` is drawn
    /// rgba16f: coverage by objects in red, for a transparent background. If empty, the wash's alpha is used.
    std::optional<gpu::ImageId> cover = {};
    gpu::ImageId light;    ///< light on surfaces; used if the style tints the ink
    glm::uvec2 page_px{0}; ///< size of the whole page in pixels
    glm::uvec2 size_px{0}; ///< size of the current tile of the page
};

/// Adds a pass that composes the layers on paper. Writes rgba16f, linear colour; for transparent paper
/// rgba32f, with the picture's alpha. Cost: one full-screen dispatch.
[[nodiscard]] gpu::ImageId add_compose(gpu::Graph& graph, const ComposeInputs& in, const PaperStyle& style);

/// Adds a pass that composes the layers on paper and writes a picture of one sample into `pixels`, like
/// add_compose() followed by add_develop(). `pixels` may be host memory. Cost: one full-screen dispatch, and
/// the transfer to the pixels' memory.
[[nodiscard]] gpu::BufferId add_pixels(gpu::Graph& graph, const ComposeInputs& in, const PaperStyle& style,
                                       gpu::BufferId pixels);

/// The last layer that is composed, from the paper up.
enum class Stage : uint8_t {
    paper = shared::stage_paper,
    wash = shared::stage_wash,
    ink = shared::stage_ink,
    hatch = shared::stage_hatch,
    lines = shared::stage_lines,
    smoke = shared::stage_smoke,
    /// All layers, with the picture's alpha instead of the coverage of a layer.
    picture = shared::stage_picture
};

/// Adds a pass that composes the layers up to `stage`. Writes rgba32f: linear colour, and the topmost layer's
/// coverage, which is 1 for paper and wash. For transparent paper, the paper has relief only below objects,
/// and the wash has the picture's alpha so far. Cost: as add_compose().
[[nodiscard]] gpu::ImageId add_compose_stage(gpu::Graph& graph, const ComposeInputs& in,
                                             const PaperStyle& style, Stage stage);

/// Position of this frame among the jittered samples of one picture.
struct Accumulation {
    uint32_t sample_index = 0;
    uint32_t sample_count = 1;

    [[nodiscard]] bool is_last() const { return sample_index + 1 == sample_count; }
};

enum class PixelForm : uint8_t { srgb_bytes, linear_floats };

/// Outputs of add_develop(): new versions of the sums and the pixels.
struct Developed {
    gpu::ImageId sums;
    gpu::BufferId pixels;
};

/// Imports the image of sums of earlier samples. The first sample ignores its content.
[[nodiscard]] gpu::ImageId import_sums(gpu::Graph& graph, gpu::Image& sums, const Accumulation& accumulation);

/// Adds a frame to `sums` (rgba32f, as large as the picture if it has several samples). The last frame writes
/// the mean to `pixels`: as four sRGB bytes per pixel, or as four linear floats. `transparent` is the colour
/// of transparent paper: the bytes then have straight alpha, see shaders/color.glsl; the floats have the
/// paper's colour removed and are premultiplied by alpha. Otherwise the bytes are opaque. Cost: one
/// full-screen dispatch.
[[nodiscard]] Developed add_develop(gpu::Graph& graph, gpu::ImageId picture, gpu::ImageId sums,
                                    gpu::BufferId pixels, glm::uvec2 size_px,
                                    const Accumulation& accumulation, PixelForm form = PixelForm::srgb_bytes,
                                    const std::optional<glm::vec3>& transparent = {});

/// The layers that depth of field and motion blur process. The copies of add_cover() have a wash with the
/// objects' coverage in red, green and blue, so that the coverage is blurred like the wash.
struct CoverLayers {
    gpu::ImageId wash;  ///< rgba16f: flat colour under the ink
    gpu::ImageId hatch; ///< r16f: ink of strokes
    gpu::ImageId lines; ///< rgba8: contour lines, coverage in alpha
};

/// Adds a pass that copies strokes and lines, and makes a wash from the wash's alpha (coverage by objects).
/// Cost: one full-screen dispatch.
[[nodiscard]] CoverLayers add_cover(gpu::Graph& graph, const CoverLayers& drawn, glm::uvec2 size_px);

} // namespace estampe::paper
