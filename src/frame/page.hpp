// SPDX-License-Identifier: MIT
#pragma once

// The page is the output of a picture, in bytes or in floats, whole or layer by layer. It may be drawn in
// tiles. All plans are made for the whole page; a tile is a window into it, seen by the same camera with a
// cropped projection and an offset of its first pixel on the page.

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

/// The output of a picture, reused for the next picture of the same size.
struct Page {
    gpu::Image sums;    ///< running sums of a picture of several samples; one texel for a single sample
    gpu::Buffer pixels; ///< four bytes per pixel, for reading back
};

/// Longest side of a page that can be drawn in tiles.
inline constexpr uint32_t longest_page_px = 65535;

/// Throws Error for a page without pixels or without samples, and for a page larger than longest_page_px.
void check_page(const RenderSettings& settings);

/// The largest picture that is drawn in one pass, without tiles.
struct PageLimits {
    uint32_t side_px = 0;
    uint64_t pixels = 0;
};

[[nodiscard]] PageLimits page_limits(const gpu::Device& device);

/// Throws Error for a picture without samples, and names the device's limit for one that is too large to be
/// drawn without tiles.
void check_size(const gpu::Device& device, const RenderSettings& settings);

/// The part of a page inside the paper's margin, in pixels of a tile.
struct SeenWindow {
    glm::uvec2 min_px{0};
    glm::uvec2 max_px{0}; ///< exclusive
};

/// Returns the window of a tile whose first pixel is at `from_px` on the page. Pixels outside the window are
/// never visible.
[[nodiscard]] SeenWindow seen_window(const paper::PaperStyle& style, glm::uvec2 page_px, float pixels_per_mm,
                                     glm::vec2 from_px);

/// Creates the images and buffers that `page` lacks for a picture of this size.
void ensure_page(gpu::Device& device, Page& page, glm::uvec2 size_px, uint32_t samples);

struct Tile {
    features::PixelRect drawn; ///< `kept` with the overlap around it that its pixels depend on
    features::PixelRect kept;  ///< the kept parts of all tiles cover each pixel of the page exactly once
};

/// The whole page as a single tile.
[[nodiscard]] Tile whole_page(glm::uvec2 page_px);

/// Width of the overlap around a tile: how far away the pixels may lie that one pixel depends on in this
/// style. Covers bleeding ink, overshooting strokes and lines found between pixels. Data that is computed for
/// the whole page needs no overlap.
[[nodiscard]] uint32_t overlap_px(const features::StyleTables& style, float pixels_per_mm);

/// Divides the page into tiles, row by row from the upper left, none drawn with a side above `most_px`. All
/// are drawn at one size, so that resources are reused: tiles at the right and bottom edge get a larger
/// overlap. Throws Error when the overlap leaves no kept pixels.
[[nodiscard]] std::vector<Tile> tiles_of(glm::uvec2 page_px, uint32_t most_px, uint32_t overlap);

/// Plans the whole page in fewer pixels: as many as `most_pixels` and the longest side `most_px` allow.
[[nodiscard]] features::Survey survey_of(glm::uvec2 page_px, uint32_t most_px, uint64_t most_pixels);

/// Output of one picture in floats, in addition to its bytes.
struct LinearPage {
    struct Stage {
        paper::Stage stage = paper::Stage::lines;
        gpu::Image sums;    ///< running sums of a picture of several samples; one texel for a single sample
        gpu::Buffer pixels; ///< four floats per pixel, for reading back
    };

    std::vector<Stage> stages;
    gpu::Buffer draws; ///< draw of each pixel in the last sample, see shaders/surface_images.glsl; empty
                       ///< without layers
    gpu::Buffer sun;   ///< sunlight in the last sample, see light::LitPixels; empty without layers
    gpu::Buffer
        occlusion; ///< occlusion in the last sample, half floats; empty without layers or without occlusion
    gpu::Buffer cloud_cover; ///< cloud cover in the last sample, half floats; empty without layers
    bool has_clouds = false; ///< otherwise `cloud_cover` has no content

    [[nodiscard]] bool has_layers() const { return !draws.empty(); }
};

/// Which images a linear page holds.
struct LinearPageKind {
    bool has_layers = false; ///< a stage per layer; otherwise only the picture
    bool has_ink = false;    ///< a stage of flowing ink in addition
    bool has_smoke = false;  ///< a stage of smoke in addition
    bool has_occlusion = false;
    bool is_transparent = false; ///< the picture has alpha
};

/// Creates a page for the whole picture, or for each of its layers. Throws Error naming the device's limit
/// when its floats do not fit the memory.
[[nodiscard]] LinearPage make_linear_page(gpu::Device& device, const RenderSettings& settings,
                                          LinearPageKind kind);

/// Declares the passes that compose the layers of a sample on paper and add the result to the previous
/// samples. The last sample writes to `target`, or to the page's pixels if that is null.
void declare_page(gpu::Graph& graph, const paper::ComposeInputs& layers, const paper::PaperStyle& style,
                  const paper::Accumulation& accumulation, Page& page, const VulkanPicture* target);

/// The inputs of a linear page.
struct LinearPageInputs {
    paper::ComposeInputs layers;
    gpu::ImageId draw;
    gpu::ImageId sun;
    std::optional<gpu::ImageId> occlusion;
    std::optional<gpu::ImageId> cloud_cover;
};

/// Declares the passes that fill `page`, which must outlive the graph.
void declare_linear_page(gpu::Graph& graph, const LinearPageInputs& in, const paper::PaperStyle& style,
                         const paper::Accumulation& accumulation, LinearPage& page);

} // namespace estampe::frame
