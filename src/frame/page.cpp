// SPDX-License-Identifier: MIT
#include "frame/page.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe::frame {

void check_size(const gpu::Device& device, const RenderSettings& settings)
{
    const uint32_t limit = std::min(device.limits().maxImageDimension2D, 16384U);
    if (settings.width == 0 || settings.height == 0 || settings.width > limit || settings.height > limit) {
        throw Error(
            fmt::format("a picture of {} x {} pixels cannot be drawn", settings.width, settings.height),
            "size", fmt::format("{} draws from 1 x 1 to {} x {}", device.info().name, limit, limit));
    }
    const uint64_t most_pixels = std::min<uint64_t>(device.limits().maxStorageBufferRange / sizeof(uint64_t),
                                                    device.limits().maxTexelBufferElements);
    if (static_cast<uint64_t>(settings.width) * settings.height > most_pixels) {
        throw Error(fmt::format("a picture of {} x {} pixels is too large", settings.width, settings.height),
                    "size",
                    fmt::format("{} draws at most {:.1f} megapixels", device.info().name,
                                static_cast<double>(most_pixels) * 1e-6));
    }
    if (settings.samples == 0) {
        throw Error("a picture needs at least one sample", "samples");
    }
}

void provide_page(gpu::Device& device, Page& page, const RenderSettings& settings)
{
    const uint64_t count = static_cast<uint64_t>(settings.width) * settings.height;
    const bool has_sums = settings.samples > 1;
    const gpu::ImageDesc sum_desc{.width = has_sums ? settings.width : 1,
                                  .height = has_sums ? settings.height : 1,
                                  .format = gpu::Format::rgba32f};
    if (page.sums.empty() || page.sums.desc() != sum_desc) {
        page.sums = gpu::Image(device, "sums", sum_desc);
    }
    if (page.pixels.empty() || page.pixels.size_bytes() != std::max<uint64_t>(4 * count, 16)) {
        page.pixels = gpu::Buffer(device, "pixels", 4 * count, gpu::MemoryUse::readback);
    }
}

} // namespace estampe::frame
