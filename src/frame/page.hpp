// SPDX-License-Identifier: MIT
#pragma once

// The page: what a picture ends in, in bytes or in floats, whole or layer by layer; and its tiles, where it
// is drawn in parts. All plans are of the whole page; a tile is a window into it, by the same camera: the
// projection cropped, and the place of the tile's first pixel on the page.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/renderer.hpp>

#include "features/common/style_tables.hpp"
#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "techniques/paper/paper.hpp"

namespace estampe::frame {

/// What a picture ends in, kept from one to the next of the same size.
struct Page {
    gpu::Image sums;    ///< of a picture of several samples; one texel for others
    gpu::Buffer pixels; ///< four bytes a pixel, for reading back
};

/// The longest side of a page that is drawn in tiles.
inline constexpr uint32_t longest_page_px = 65535;

/// Throws Error for a page without pixels or samples, and one that is too large for any device.
void check_page(const RenderSettings& settings);

/// The most that is drawn at once.
struct PageLimits {
    uint32_t side_px = 0;
    uint64_t pixels = 0;
};

[[nodiscard]] PageLimits page_limits(const gpu::Device& device);

/// Throws Error naming the device's limit when it cannot draw a picture of this size in one go, or
/// of no sample.
void check_size(const gpu::Device& device, const RenderSettings& settings);

/// What the paper's margin leaves of a page to be seen, in pixels of a part of it.
struct SeenWindow {
    glm::uvec2 min_px{0};
    glm::uvec2 max_px{0}; ///< past the last
};

/// `from_px` is where the part begins on the page. What is beyond the window is never seen.
[[nodiscard]] SeenWindow seen_window(const paper::PaperStyle& style, glm::uvec2 page_px, float pixels_per_mm,
                                     glm::vec2 from_px);

/// Makes what `page` lacks for what is drawn at once.
void ensure_page(gpu::Device& device, Page& page, glm::uvec2 size_px, uint32_t samples);

struct Tile {
    features::PixelRect drawn; ///< what is kept, and as much around it as its pixels hang on
    features::PixelRect kept;  ///< all tiles of a page together: the page, each pixel once
};

/// The page as one tile.
[[nodiscard]] Tile whole_page(glm::uvec2 page_px);

/// How far off the page the pixels may lie that one of this style hangs on, beside what is found for the
/// whole page: as far as ink runs and strokes run over, and half a line that is found between pixels.
[[nodiscard]] uint32_t overlap_px(const features::StyleTables& style, float pixels_per_mm);

/// Tiles row by row from the upper left, none drawn larger than `most_px` a side. All are drawn at one size,
/// those at the right and the bottom with more around them, so that what is made for one serves the next.
/// Throws Error when the overlap leaves nothing of a tile.
[[nodiscard]] std::vector<Tile> tiles_of(glm::uvec2 page_px, uint32_t most_px, uint32_t overlap);

/// As fine as one of up to `most_pixels`, and of no side longer than `most_px`, can be.
[[nodiscard]] features::Survey survey_of(glm::uvec2 page_px, uint32_t most_px, uint64_t most_pixels);

/// Where one picture ends in floats, beside its bytes.
struct LinearPage {
    struct Stage {
        paper::Stage stage = paper::Stage::lines;
        gpu::Image sums;    ///< of a picture of several samples; one texel for others
        gpu::Buffer pixels; ///< four floats a pixel, for reading back
    };

    std::vector<Stage> stages;
    gpu::Buffer
        draws; ///< of the last sample, see shaders/surface_images.glsl; empty where no layers are wanted
    gpu::Buffer sun;       ///< of the last sample, see light::LitPixels; empty where no layers are wanted
    gpu::Buffer occlusion; ///< of the last sample, halves; empty where no layers are wanted, or no occlusion
    gpu::Buffer cloud_cover; ///< of the last sample, halves; empty where no layers are wanted
    bool has_clouds = false; ///< else that holds nothing

    [[nodiscard]] bool has_layers() const { return !draws.empty(); }
};

/// What a linear page holds.
struct LinearPageKind {
    bool has_layers = false; ///< each of them; else the picture alone
    bool has_ink = false;    ///< one of ink that flows besides
    bool has_smoke = false;  ///< and one of smoke
    bool has_occlusion = false;
    bool is_transparent = false; ///< the picture has alpha
};

/// A page for the whole picture, or for each of its layers. Throws Error naming the device's limit when there
/// is no room for its floats.
[[nodiscard]] LinearPage make_linear_page(gpu::Device& device, const RenderSettings& settings,
                                          LinearPageKind kind);

/// Declares what lays the layers of a sample on paper and adds that to the samples before. Those of the last
/// one end in the `target`, or where that is null in the page's pixels.
void declare_page(gpu::Graph& graph, const paper::ComposeInputs& layers, const paper::PaperStyle& style,
                  const paper::Accumulation& accumulation, Page& page, const VulkanPicture* target);

/// What a linear page is made from.
struct LinearPageInputs {
    paper::ComposeInputs layers;
    gpu::ImageId draw;
    gpu::ImageId sun;
    std::optional<gpu::ImageId> occlusion;
    std::optional<gpu::ImageId> cloud_cover;
};

/// Declares what fills `page`, which must outlive the graph.
void declare_linear_page(gpu::Graph& graph, const LinearPageInputs& in, const paper::PaperStyle& style,
                         const paper::Accumulation& accumulation, LinearPage& page);

} // namespace estampe::frame
