// SPDX-License-Identifier: MIT
#include "frame/page.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/free_memory.hpp"
#include "core/job_limits.hpp"
#include "gpu/transfers.hpp"
#include "techniques/halo/halo.hpp"
#include "techniques/lens/lens.hpp"
#include "techniques/occlusion/occlusion.hpp"
#include "techniques/smoke/smoke.hpp"
#include "techniques/subsurface/subsurface.hpp"

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

void check_page_memory(glm::uvec2 size_px)
{
    if (is_memory_limited()) {
        require_memory(bytes_a_pixel * size_px.x * size_px.y,
                       fmt::format("drawing {} x {} pixels at once", size_px.x, size_px.y), "size",
                       "draw a smaller picture, or smaller tiles");
    }
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
    // Margin for the uneven edge of the picture. The edge deviates from a straight line by less than this;
    // see edge_stray_mm in compose.comp.
    constexpr float strays_mm = 0.3F;
    const paper::Window window = paper::window_of(style, static_cast<float>(page_px.x) / pixels_per_mm);
    const glm::vec2 min_px = (window.min_mm - strays_mm) * pixels_per_mm - from_px;
    const glm::vec2 max_px = (window.max_mm + strays_mm) * pixels_per_mm - from_px;
    return {.min_px = glm::uvec2(glm::max(min_px, 0.0F)),
            .max_px = glm::uvec2(glm::max(glm::ceil(max_px), 0.0F))};
}

SeenWindow window_within_margin(const paper::PaperStyle& style, const RenderSettings& settings)
{
    const float px_per_mm = static_cast<float>(settings.height) / style.height_mm;
    const paper::Window window = paper::window_of(style, static_cast<float>(settings.width) / px_per_mm);
    const glm::vec2 size_px(settings.width, settings.height);
    return {.min_px = glm::uvec2(glm::floor(window.min_mm * px_per_mm)),
            .max_px = glm::uvec2(glm::min(glm::ceil(window.max_mm * px_per_mm), size_px))};
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

Tile whole_page(glm::uvec2 page_px)
{
    const features::PixelRect all{.size_px = page_px};
    return {all, all};
}

uint32_t overlap_px(const features::StyleTables& style, float pixels_per_mm)
{
    // Smallest overlap of tiles, because a pixel also depends on its neighbours: for a surface's slope, and
    // for edges between pixels.
    constexpr uint32_t neighbours_px = 4;
    return bleed::reach_px(style.bleed, pixels_per_mm) + pigment::reach_px(style.pigment, pixels_per_mm) +
           paper::reach_px(style.paper, pixels_per_mm) +
           std::max(hatch::reach_px(style.hatch, pixels_per_mm),
                    contour::reach_px(style.contour, pixels_per_mm)) +
           hatch::group_reach_px(style.hatch, pixels_per_mm) +
           halo::reach_px(std::max(style.hatch.halo_mm, style.sky.halo_mm), pixels_per_mm) +
           smoke::reach_px(style.smoke, pixels_per_mm) + lens::reach_px(style.lens, pixels_per_mm) +
           occlusion::reach_px(style.occlusion, pixels_per_mm) +
           subsurface::reach_px(style.subsurface, pixels_per_mm) + neighbours_px;
}

std::vector<Tile> tiles_of(glm::uvec2 page_px, uint32_t most_px, uint32_t overlap)
{
    if (most_px <= 2 * overlap) {
        throw Error(
            fmt::format("tiles of {} pixels are too small for strokes that reach {} pixels beyond them",
                        most_px, overlap),
            "tiles", "draw at fewer pixels a millimetre, or in a style whose ink runs less far");
    }
    const glm::uvec2 drawn_px = glm::min(page_px, glm::uvec2(most_px));
    const auto step = [&](int axis) {
        return drawn_px[axis] < page_px[axis] ? most_px - 2 * overlap : page_px[axis];
    };
    std::vector<Tile> tiles;
    for (uint32_t y = 0; y < page_px.y; y += step(1)) {
        for (uint32_t x = 0; x < page_px.x; x += step(0)) {
            const glm::uvec2 from(x, y);
            const glm::uvec2 size = glm::min(glm::uvec2(step(0), step(1)), page_px - from);
            const glm::uvec2 drawn_from =
                glm::min(from - glm::min(from, glm::uvec2(overlap)), page_px - drawn_px);
            tiles.push_back({.drawn = {drawn_from, drawn_px}, .kept = {from, size}});
        }
    }
    return tiles;
}

features::Survey survey_of(glm::uvec2 page_px, uint32_t most_px, uint64_t most_pixels)
{
    const auto size_at = [&](uint32_t shrink) { return (page_px + (shrink - 1)) / shrink; };
    const auto is_small = [&](glm::uvec2 size) {
        return std::max(size.x, size.y) <= most_px && uint64_t{size.x} * size.y <= most_pixels;
    };
    uint32_t shrink = 1;
    while (!is_small(size_at(shrink))) {
        ++shrink;
    }
    return {.part = {.size_px = shrink * size_at(shrink)}, .shrink = shrink};
}

LinearPage make_linear_page(gpu::Device& device, const RenderSettings& settings, LinearPageKind kind)
{
    const uint64_t count = uint64_t{settings.width} * settings.height;
    const uint64_t most = device.limits().maxStorageBufferRange / sizeof(glm::vec4);
    if (count > most) {
        throw Error(fmt::format("a picture of {} x {} pixels is too large in floats", settings.width,
                                settings.height),
                    "size",
                    fmt::format("{} draws at most {:.1f} megapixels so", device.info().name,
                                static_cast<double>(most) * 1e-6));
    }
    constexpr std::array all{paper::Stage::paper, paper::Stage::wash,  paper::Stage::ink,
                             paper::Stage::hatch, paper::Stage::lines, paper::Stage::smoke};
    const paper::Stage last = kind.has_smoke ? paper::Stage::smoke : paper::Stage::lines;
    const bool has_alpha = kind.is_transparent && !kind.has_layers;
    const bool has_sums = settings.samples > 1;
    LinearPage page;
    for (const paper::Stage stage : all) {
        const bool is_there =
            (stage != paper::Stage::ink || kind.has_ink) && (stage != paper::Stage::smoke || kind.has_smoke);
        if ((kind.has_layers && is_there) || stage == last) {
            page.stages.push_back({.stage = has_alpha ? paper::Stage::picture : stage,
                                   .sums = gpu::Image(device, "linear sums",
                                                      {.width = has_sums ? settings.width : 1,
                                                       .height = has_sums ? settings.height : 1,
                                                       .format = gpu::Format::rgba32f}),
                                   .pixels = gpu::Buffer(device, "linear pixels", sizeof(glm::vec4) * count,
                                                         gpu::MemoryUse::readback)});
        }
    }
    if (kind.has_layers) {
        page.draws =
            gpu::Buffer(device, "draws of layers", sizeof(uint32_t) * count, gpu::MemoryUse::readback);
        page.sun = gpu::Buffer(device, "sun of layers", sizeof(float) * count, gpu::MemoryUse::readback);
        page.cloud_cover =
            gpu::Buffer(device, "clouds of layers", sizeof(uint16_t) * count, gpu::MemoryUse::readback);
        if (kind.has_occlusion) {
            page.occlusion = gpu::Buffer(device, "occlusion of layers", sizeof(uint16_t) * count,
                                         gpu::MemoryUse::readback);
        }
    }
    return page;
}

void declare_page(gpu::Graph& graph, const paper::ComposeInputs& layers, const paper::PaperStyle& style,
                  const paper::Accumulation& accumulation, Page& page, const VulkanPicture* target)
{
    const glm::uvec2 size_px = layers.size_px;
    const bool is_last = accumulation.is_last();
    // Only the last sample of a picture writes visible pixels; earlier samples are only added to the sums.
    gpu::BufferId pixels = target == nullptr && is_last
                               ? gpu::import_whole(graph, "pixels", page.pixels)
                               : graph.buffer("pixels", {.size_bytes = 4ULL * size_px.x * size_px.y});
    pixels =
        accumulation.sample_count == 1
            ? paper::add_pixels(graph, layers, style, pixels)
            : paper::add_develop(graph, paper::add_compose(graph, layers, style),
                                 paper::import_sums(graph, page.sums, accumulation), pixels, size_px,
                                 accumulation, paper::PixelForm::srgb_bytes, paper::transparent_color(style))
                  .pixels;
    if (is_last && target != nullptr) {
        gpu::add_hand_over(graph, pixels, *target, size_px);
    } else if (is_last) {
        gpu::add_host_read(graph, "read back", pixels);
    }
}

void declare_linear_page(gpu::Graph& graph, const LinearPageInputs& in, const paper::PaperStyle& style,
                         const paper::Accumulation& accumulation, LinearPage& page)
{
    const glm::uvec2 size_px = in.layers.size_px;
    const uint64_t size_bytes = sizeof(glm::vec4) * size_px.x * size_px.y;
    for (LinearPage::Stage& stage : page.stages) {
        const gpu::ImageId picture = paper::add_compose_stage(graph, in.layers, style, stage.stage);
        const paper::Developed developed =
            paper::add_develop(graph, picture, paper::import_sums(graph, stage.sums, accumulation),
                               graph.buffer("linear pixels", {.size_bytes = size_bytes}), size_px,
                               accumulation, paper::PixelForm::linear_floats,
                               page.has_layers() ? std::nullopt : paper::transparent_color(style));
        if (accumulation.is_last()) {
            gpu::add_read_back(graph, "read back floats", developed.pixels, stage.pixels);
        }
    }
    if (page.has_layers()) {
        gpu::add_read_back(graph, "read back draws", in.draw, page.draws);
        gpu::add_read_back(graph, "read back sun", in.sun, page.sun);
        if (in.occlusion) {
            gpu::add_read_back(graph, "read back occlusion", *in.occlusion, page.occlusion);
        }
        page.has_clouds = in.cloud_cover.has_value();
        if (in.cloud_cover) {
            gpu::add_read_back(graph, "read back clouds", *in.cloud_cover, page.cloud_cover);
        }
    }
}

} // namespace estampe::frame
