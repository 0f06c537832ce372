// SPDX-License-Identifier: MIT
#pragma once

// The page: the output of a picture, in bytes or in floats, as a whole or by layers. The page may be drawn in
// tiles. All plans are made for the whole page. A tile is a window into the page. A tile has the page's
// camera with a cropped projection, and the offset of the tile's first pixel.

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

/// Returns the number of the draw call that a pixel of the image surface::Surface::draw shows, counted from
/// 1; 0 if it shows no surface.
[[nodiscard]] inline uint32_t draw_number(uint32_t word)
{
    constexpr uint32_t mask = (1U << 26U) - 1U; // DRAW_NUMBER_MASK of shaders/surface_images.glsl
    return word & mask;
}

/// Images and buffers for the output of a picture, reused for the next picture of the same size.
struct Page {
    gpu::Image sums;    ///< running sums of the samples of a picture; one texel if there is a single sample
    gpu::Buffer pixels; ///< pixels of the picture, four bytes each, for reading back
};

/// Longest side of a page that can be drawn in tiles.
inline constexpr uint32_t longest_page_px = 65535;

/// Checks the size of a page. Throws Error for a page without pixels or without samples, and for a page
/// larger than longest_page_px.
void check_page(const RenderSettings& settings);

/// Approximate memory in bytes, on the device and beside it, that one pixel needs while a picture is drawn.
inline constexpr uint64_t bytes_a_pixel = 160;

/// Throws Error if drawing a picture or a tile of this size in one pass needs more memory than the limit of
/// the current thread (JobLimits) leaves.
void check_page_memory(glm::uvec2 size_px);

/// Size limits of a picture that is drawn in one pass, without tiles.
struct PageLimits {
    uint32_t side_px = 0;
    uint64_t pixels = 0;
};

[[nodiscard]] PageLimits page_limits(const gpu::Device& device);

/// Checks that a picture can be drawn without tiles. Throws Error for a picture without samples, and names
/// the device's limit for a picture that is too large.
void check_size(const gpu::Device& device, const RenderSettings& settings);

/// The part of a page inside the paper's margin, in pixels of the tile that is drawn.
struct SeenWindow {
    glm::uvec2 min_px{0};
    glm::uvec2 max_px{0}; ///< lower right corner of the window, just outside it
};

/// Returns the window of a tile whose first pixel is at `from_px` on the page. Pixels outside the window are
/// never visible.
[[nodiscard]] SeenWindow seen_window(const paper::PaperStyle& style, glm::uvec2 page_px, float pixels_per_mm,
                                     glm::vec2 from_px);

/// Returns the pixels of the whole page inside the paper's margin.
[[nodiscard]] SeenWindow window_within_margin(const paper::PaperStyle& style, const RenderSettings& settings);

/// Creates images and buffers for a picture of this size, unless `page` already has them.
void ensure_page(gpu::Device& device, Page& page, glm::uvec2 size_px, uint32_t samples);

struct Tile {
    /// Rectangle that is drawn: the rectangle `kept` and an overlap around it, because pixels depend on their
    /// neighbours.
    features::PixelRect drawn;
    /// Rectangle that is copied to the page; the kept rectangles of all tiles cover each pixel exactly once.
    features::PixelRect kept;
};

/// Returns a tile that covers the whole page.
[[nodiscard]] Tile whole_page(glm::uvec2 page_px);

/// Width of the overlap around a tile: the largest distance between a pixel and another pixel that it depends
/// on in this style. Covers bleeding ink, overshooting strokes and lines found between pixels. Data that is
/// computed for the whole page needs no overlap.
[[nodiscard]] uint32_t overlap_px(const features::StyleTables& style, float pixels_per_mm);

/// Divides the page into tiles, row by row from the upper left; no side of a drawn tile is longer than
/// `most_px`. All tiles are drawn at one size, so that resources are reused: tiles at the right and bottom
/// edge get a larger overlap. Throws Error when the overlap is so large that no pixels of a tile can be kept.
[[nodiscard]] std::vector<Tile> tiles_of(glm::uvec2 page_px, uint32_t most_px, uint32_t overlap);

/// Plans a survey: a picture of the whole page at reduced resolution, as large as `most_pixels` and the
/// longest side `most_px` allow.
[[nodiscard]] features::Survey survey_of(glm::uvec2 page_px, uint32_t most_px, uint64_t most_pixels);

/// Output of a picture in floats, which are stored in addition to bytes.
struct LinearPage {
    struct Stage {
        paper::Stage stage = paper::Stage::lines;
        gpu::Image sums; ///< running sums of the samples of a picture; one texel if there is a single sample
        gpu::Buffer pixels; ///< pixels of the picture, four floats each, for reading back
    };

    std::vector<Stage> stages;
    /// Draw number of each pixel in the last sample, see shaders/surface_images.glsl; empty without layers.
    gpu::Buffer draws;
    /// Sunlight at each pixel in the last sample, see light::LitPixels; empty without layers.
    gpu::Buffer sun;
    gpu::Buffer
        /// Ambient occlusion at each pixel in the last sample, as half floats; empty without layers or
        /// without occlusion.
        occlusion;
    /// Cloud cover of each pixel in the last sample, as half floats; empty without layers.
    gpu::Buffer cloud_cover;
    bool has_clouds = false; ///< `cloud_cover` holds the coverage of clouds

    [[nodiscard]] bool has_layers() const { return !draws.empty(); }
};

/// Tells which images a page in floats contains.
struct LinearPageKind {
    bool has_layers = false; ///< the page holds an image after each layer; otherwise only the picture
    bool has_ink = false;    ///< the page also holds an image after flowing ink
    bool has_smoke = false;  ///< the page also holds an image after smoke
    bool has_occlusion = false;
    bool is_transparent = false; ///< the picture has alpha
};

/// Creates a page in floats for the whole picture, or for each of its layers. Throws Error naming the
/// device's limit when its floats do not fit the memory.
[[nodiscard]] LinearPage make_linear_page(gpu::Device& device, const RenderSettings& settings,
                                          LinearPageKind kind);

/// Declares the passes that compose the layers of a sample on paper and add the result to the previous
/// samples. The last sample writes to `target`, or to the page's pixels if `target` is null.
void declare_page(gpu::Graph& graph, const paper::ComposeInputs& layers, const paper::PaperStyle& style,
                  const paper::Accumulation& accumulation, Page& page, const VulkanPicture* target);

/// The inputs of a page in floats.
struct LinearPageInputs {
    paper::ComposeInputs layers;
    gpu::ImageId draw;
    gpu::ImageId sun;
    std::optional<gpu::ImageId> occlusion;
    std::optional<gpu::ImageId> cloud_cover;
};

/// Declares the passes that fill `page` with floats. `page` must outlive the graph.
void declare_linear_page(gpu::Graph& graph, const LinearPageInputs& in, const paper::PaperStyle& style,
                         const paper::Accumulation& accumulation, LinearPage& page);

} // namespace estampe::frame
