// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"
#include "techniques/paper/paper.glsl.h"

namespace estampe::paper {

/// What of the paper lets through what the picture is laid on.
enum class Transparency : uint8_t {
    none,       ///< nothing: the picture is opaque
    background, ///< the paper beyond all geometry; things hide what is behind them
    paper       ///< all of it: ink and paint alone are left
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
    int seed = 1;
};

[[nodiscard]] const style::Table<PaperStyle>& paper_table();

/// The colour of paper that lets through what the picture is laid on; nothing for an opaque picture.
[[nodiscard]] inline std::optional<glm::vec3> transparent_color(const PaperStyle& style)
{
    return style.transparent == Transparency::none ? std::nullopt : std::optional(style.color);
}

/// The part of a page that is drawn on.
struct Window {
    glm::vec2 min_mm{0.0F}; ///< from the page's upper left corner, y down
    glm::vec2 max_mm{0.0F};
    bool operator==(const Window&) const = default;
};

/// What the margin leaves of a page of this width and of the style's height.
[[nodiscard]] Window window_of(const PaperStyle& style, float width_mm);

struct ComposeInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId wash;
    gpu::ImageId hatch;
    gpu::ImageId lines;
    gpu::ImageId sky_ink;
    std::optional<gpu::ImageId> ink = {};         ///< that flows under strokes and lines: rgba8, as lines
    float ink_settles = 0.0F;                     ///< how far that settles in the hollows of the paper
    std::optional<gpu::ImageId> smoke_paint = {}; ///< over the lines: rgba8, roots of it, cover in alpha
    std::optional<gpu::ImageId> smoke_ink = {};   ///< r16f, where there is such paint
    bool has_sky = true;                          ///< else there is no such ink
    std::optional<gpu::ImageId> cover = {};       ///< rgba16f, in red: how much of each pixel things cover
                                                  ///< on a transparent background; else the wash's alpha is
    gpu::ImageId light;                           ///< read where the style tints the ink
    glm::uvec2 page_px{0};                        ///< of the whole page
    glm::uvec2 size_px{0};                        ///< of what is drawn of it
};

/// Lays the layers on paper. Writes rgba16f, linear colour; where the style's paper is transparent rgba32f,
/// with the picture's alpha besides. Cost: one full-screen dispatch.
[[nodiscard]] gpu::ImageId add_compose(gpu::Graph& graph, const ComposeInputs& in, const PaperStyle& style);

/// Lays the layers on paper and writes a picture of one sample into `pixels`, as add_compose() and
/// add_develop() do one after the other. `pixels` may be the host's memory. Cost: one full-screen dispatch,
/// and the bus to where the pixels are.
[[nodiscard]] gpu::BufferId add_pixels(gpu::Graph& graph, const ComposeInputs& in, const PaperStyle& style,
                                       gpu::BufferId pixels);

/// How far the layers are laid, from the paper up; all of them are the picture.
enum class Stage : uint8_t {
    paper = shared::stage_paper,
    wash = shared::stage_wash,
    ink = shared::stage_ink,
    hatch = shared::stage_hatch,
    lines = shared::stage_lines,
    smoke = shared::stage_smoke,
    picture = shared::stage_picture ///< all of them, with the picture's alpha in place of a cover
};

/// Lays the layers up to one of them. Writes rgba32f: linear colour, and how much of it hides what lies below
/// the topmost of these layers: 1 of paper and wash. Where the style's paper is transparent, the paper has no
/// relief but under things, and the wash has the picture's alpha so far. Cost: as add_compose().
[[nodiscard]] gpu::ImageId add_compose_stage(gpu::Graph& graph, const ComposeInputs& in,
                                             const PaperStyle& style, Stage stage);

/// Which of the jittered frames of one picture this is.
struct Accumulation {
    uint32_t sample_index = 0;
    uint32_t sample_count = 1;

    [[nodiscard]] bool is_last() const { return sample_index + 1 == sample_count; }
};

enum class PixelForm : uint8_t { srgb_bytes, linear_floats };

/// What a developed picture is made of: new versions of both.
struct Developed {
    gpu::ImageId sums;
    gpu::BufferId pixels;
};

/// The sums of the samples before, or for the first of them an image that may hold anything.
[[nodiscard]] gpu::ImageId import_sums(gpu::Graph& graph, gpu::Image& sums, const Accumulation& accumulation);

/// Adds a frame to `sums` (rgba32f, as large as the picture where it has several samples) and, with the last
/// one, writes `pixels`: the mean, sRGB-encoded in four bytes a pixel, or as it is in four floats. Bytes are
/// opaque, or where the picture was laid on `transparent` paper of a colour, straight: see
/// shaders/color.glsl; floats have that paper taken off them, and are multiplied by alpha. Cost: one
/// full-screen dispatch.
[[nodiscard]] Developed add_develop(gpu::Graph& graph, gpu::ImageId picture, gpu::ImageId sums,
                                    gpu::BufferId pixels, glm::uvec2 size_px,
                                    const Accumulation& accumulation, PixelForm form = PixelForm::srgb_bytes,
                                    const std::optional<glm::vec3>& transparent = {});

/// Takes how much of each pixel things cover out of the wash's alpha, so that lens and shutter can blur that
/// as they do the wash: red, green and blue of its own wash. Strokes and lines come along as copies.
struct CoverLayers {
    gpu::ImageId wash;  ///< rgba16f
    gpu::ImageId hatch; ///< r16f
    gpu::ImageId lines; ///< rgba8
};

/// Cost: one full-screen dispatch.
[[nodiscard]] CoverLayers add_cover(gpu::Graph& graph, const CoverLayers& drawn, glm::uvec2 size_px);

} // namespace estampe::paper
