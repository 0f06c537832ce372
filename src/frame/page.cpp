// SPDX-License-Identifier: MIT
#include "frame/page.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe::frame {

void check_page(const RenderSettings& settings)
{
    if (std::min(settings.width, settings.height) == 0 ||
        std::max(settings.width, settings.height) > longest_page_px) {
        throw Error(
            fmt::format("a picture of {} x {} pixels cannot be drawn", settings.width, settings.height),
            "size", fmt::format("each side may have 1 to {} pixels", longest_page_px));
    }
    if (settings.samples == 0) {
        throw Error("a picture needs at least one sample", "samples");
    }
}

PageLimits page_limits(const gpu::Device& device)
{
    const VkPhysicalDeviceLimits& limits = device.limits();
    return {.side_px = std::min(limits.maxImageDimension2D, 16384U),
            .pixels = std::min<uint64_t>(limits.maxStorageBufferRange / sizeof(uint64_t),
                                         limits.maxTexelBufferElements)};
}

void check_size(const gpu::Device& device, const RenderSettings& settings)
{
    check_page(settings);
    const PageLimits limits = page_limits(device);
    if (std::max(settings.width, settings.height) > limits.side_px) {
        throw Error(fmt::format("a picture of {} x {} pixels cannot be drawn in one go", settings.width,
                                settings.height),
                    "size",
                    fmt::format("{} draws from 1 x 1 to {} x {} so", device.info().name, limits.side_px,
                                limits.side_px));
    }
    if (static_cast<uint64_t>(settings.width) * settings.height > limits.pixels) {
        throw Error(fmt::format("a picture of {} x {} pixels is too large to be drawn in one go",
                                settings.width, settings.height),
                    "size",
                    fmt::format("{} draws at most {:.1f} megapixels so", device.info().name,
                                static_cast<double>(limits.pixels) * 1e-6));
    }
}

SeenWindow seen_window(const paper::PaperStyle& style, glm::uvec2 page_px, float pixels_per_mm,
                       glm::vec2 from_px)
{
    constexpr float strays_mm = 0.3F; // the edge, and more than that
    const paper::Window window = paper::window_of(style, static_cast<float>(page_px.x) / pixels_per_mm);
    const glm::vec2 min_px = (window.min_mm - strays_mm) * pixels_per_mm - from_px;
    const glm::vec2 max_px = (window.max_mm + strays_mm) * pixels_per_mm - from_px;
    return {.min_px = glm::uvec2(glm::max(min_px, 0.0F)),
            .max_px = glm::uvec2(glm::max(glm::ceil(max_px), 0.0F))};
}

void ensure_page(gpu::Device& device, Page& page, glm::uvec2 size_px, uint32_t samples)
{
    const uint64_t count = uint64_t{size_px.x} * size_px.y;
    const bool has_sums = samples > 1;
    const gpu::ImageDesc sum_desc{.width = has_sums ? size_px.x : 1,
                                  .height = has_sums ? size_px.y : 1,
                                  .format = gpu::Format::rgba32f};
    if (page.sums.empty() || page.sums.desc() != sum_desc) {
        page.sums = gpu::Image(device, "sums", sum_desc);
    }
    if (page.pixels.empty() || page.pixels.size_bytes() != std::max<uint64_t>(4 * count, 16)) {
        page.pixels = gpu::Buffer(device, "pixels", 4 * count, gpu::MemoryUse::readback);
    }
}

} // namespace estampe::frame
