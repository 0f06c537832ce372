// SPDX-License-Identifier: MIT
// Draws a scene in dots: stipple SCENE PICTURE.png [KEY=VALUE...], as stipple.spacing_mm=0.6
//
// The renderer draws the scene's tone, as a picture without strokes. A separate graph draws the dots.

#include <algorithm>
#include <cstdio>
#include <exception>

#include <estampe/error.hpp>
#include <estampe/renderer.hpp>
#include <glm/gtc/packing.hpp>

#include "gpu/graph/execute.hpp"
#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "stipple.hpp"
#include "style/schema.hpp"

namespace {

constexpr glm::uvec2 size_px(960, 720);
constexpr float page_height_mm = 100.0F;

/// Darkness of each pixel (1 minus its lightness), as half floats.
std::vector<std::byte> darkness_of(const estampe::Image& picture)
{
    std::vector<uint16_t> halves;
    for (size_t i = 0; i < picture.rgba.size(); i += 4) {
        const float lightness =
            (0.3F * picture.rgba[i] + 0.6F * picture.rgba[i + 1] + 0.1F * picture.rgba[i + 2]) / 255.0F;
        halves.push_back(glm::packHalf1x16(1.0F - lightness));
    }
    const auto bytes = std::as_bytes(std::span(halves));
    return {bytes.begin(), bytes.end()};
}

/// Draws `picture` in dots with add_stipple(), on a device of the same kind.
estampe::Image dotted(const estampe::Image& picture, const estampe::stipple::StippleStyle& style)
{
    namespace gpu = estampe::gpu;
    gpu::Device device(estampe::RendererOptions{});
    gpu::Executor executor(device);
    gpu::Image darkness(device, "darkness",
                        {.width = size_px.x, .height = size_px.y, .format = gpu::Format::r16f});
    gpu::upload_layers(device, darkness,
                       [&](uint32_t /*layer*/) { return gpu::LayerPixels{{darkness_of(picture)}}; });
    gpu::Buffer inked(device, "ink", sizeof(uint16_t) * size_px.x * size_px.y, gpu::MemoryUse::readback);

    gpu::Graph graph;
    const gpu::ImageId ink =
        estampe::stipple::add_stipple(graph,
                                      {.darkness = gpu::import_uploaded(graph, "darkness", darkness),
                                       .pixels_per_mm = size_px.y / page_height_mm,
                                       .size_px = size_px},
                                      style);
    gpu::add_read_back(graph, "read back", ink, inked);
    executor.run(graph);

    estampe::Image page = picture;
    const auto halves = gpu::items_of<uint16_t>(inked);
    for (size_t i = 0; i < page.rgba.size(); ++i) {
        const float paper = 1.0F - glm::unpackHalf1x16(halves[i / 4]);
        page.rgba[i] = i % 4 == 3 ? 255 : static_cast<uint8_t>(255.0F * std::clamp(paper, 0.0F, 1.0F));
    }
    return page;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc < 3) {
        std::fputs("usage: stipple SCENE PICTURE.png [KEY=VALUE...]\n", stderr);
        return 2;
    }
    try {
        estampe::stipple::StippleStyle dots;
        const estampe::style::Schema schema(estampe::stipple::stipple_table());
        for (int i = 3; i < argc; ++i) {
            schema.set(dots, argv[i]);
        }
        const estampe::Scene scene = estampe::load_scene(argv[1]);
        estampe::Renderer renderer;
        renderer.set_scene(scene);
        const auto camera = estampe::framing_camera(scene, estampe::pose_scene(scene, 0.0),
                                                    static_cast<double>(size_px.x) / size_px.y);
        const estampe::Image picture =
            renderer.render(camera, estampe::Style::load("cel"), {.width = size_px.x, .height = size_px.y});
        estampe::save_png(dotted(picture, dots), argv[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "stipple: %s\n", error.what());
        return 1;
    }
    return 0;
}
