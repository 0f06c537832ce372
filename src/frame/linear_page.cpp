// SPDX-License-Identifier: MIT
#include "frame/linear_page.hpp"

#include <array>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "gpu/read_back.hpp"

namespace estampe::frame {

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
            page.open = gpu::Buffer(device, "occlusion of layers", sizeof(uint16_t) * count,
                                    gpu::MemoryUse::readback);
        }
    }
    return page;
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
        if (in.open) {
            gpu::add_read_back(graph, "read back occlusion", *in.open, page.open);
        }
        page.has_clouds = in.cloud_cover.has_value();
        if (in.cloud_cover) {
            gpu::add_read_back(graph, "read back clouds", *in.cloud_cover, page.cloud_cover);
        }
    }
}

} // namespace estampe::frame
