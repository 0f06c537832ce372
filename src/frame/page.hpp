// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/renderer.hpp>

#include "gpu/resources.hpp"

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

/// Makes what `page` lacks for what is drawn at once.
void provide_page(gpu::Device& device, Page& page, glm::uvec2 size_px, uint32_t samples);

} // namespace estampe::frame
