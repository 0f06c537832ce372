// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/renderer.hpp>

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

} // namespace estampe::frame
