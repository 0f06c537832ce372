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

/// Throws Error naming the device's limit when it cannot draw a picture of this size, or of no sample.
void check_size(const gpu::Device& device, const RenderSettings& settings);

/// Makes what `page` lacks for a picture of this size.
void provide_page(gpu::Device& device, Page& page, const RenderSettings& settings);

} // namespace estampe::frame
