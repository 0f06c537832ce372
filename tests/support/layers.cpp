// SPDX-License-Identifier: MIT
#include "support/layers.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/gtc/packing.hpp>

#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"

namespace estampe::test {

template <class Texel>
Layer Layer::of(gpu::Format format, glm::uvec2 size_px, const Painter<Texel>& paint)
{
    std::vector<std::byte> bytes(sizeof(Texel) * size_px.x * size_px.y);
    std::byte* next = bytes.data();
    for (uint32_t y = 0; y < size_px.y; ++y) {
        for (uint32_t x = 0; x < size_px.x; ++x) {
            const Texel texel = paint({x, y});
            std::memcpy(next, &texel, sizeof(Texel));
            next += sizeof(Texel);
        }
    }
    Layer layer;
    layer.image_ =
        gpu::Image(shared_device(), "layer", {.width = size_px.x, .height = size_px.y, .format = format});
    gpu::upload_layers(shared_device(), layer.image_,
                       [&](uint32_t /*layer*/) { return gpu::LayerPixels{{bytes}}; });
    return layer;
}

gpu::ImageId Layer::in(gpu::Graph& graph)
{
    return gpu::import_uploaded(graph, "layer", image_);
}

Layer Layer::coverage(glm::uvec2 size_px, const Painter<float>& paint)
{
    return of<uint16_t>(gpu::Format::r16f, size_px,
                        [&](glm::uvec2 pixel) { return glm::packHalf1x16(paint(pixel)); });
}

Layer Layer::color(glm::uvec2 size_px, const Painter<glm::vec4>& paint)
{
    return of<uint64_t>(gpu::Format::rgba16f, size_px,
                        [&](glm::uvec2 pixel) { return glm::packHalf4x16(paint(pixel)); });
}

Layer Layer::root_color(glm::uvec2 size_px, const Painter<glm::vec4>& paint)
{
    return of<uint32_t>(gpu::Format::rgba8, size_px, [&](glm::uvec2 pixel) {
        const glm::vec4 color = paint(pixel);
        return glm::packUnorm4x8(glm::vec4(glm::sqrt(glm::vec3(color)), color.w));
    });
}

Layer Layer::words(glm::uvec2 size_px, const Painter<uint32_t>& paint)
{
    return of<uint32_t>(gpu::Format::r32ui, size_px, paint);
}

Layer Layer::depth(glm::uvec2 size_px, const Painter<float>& paint)
{
    return of<float>(gpu::Format::r32f, size_px, paint);
}

Layer Layer::places(glm::uvec2 size_px, const Painter<glm::vec4>& paint)
{
    return of<glm::vec4>(gpu::Format::rgba32f, size_px, paint);
}

Layer Layer::normals(glm::uvec2 size_px, const Painter<glm::vec3>& paint)
{
    return of<glm::uvec2>(gpu::Format::rg32ui, size_px, [&](glm::uvec2 pixel) {
        const glm::vec3 n = paint(pixel);
        glm::vec2 e = glm::vec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
        if (n.z < 0.0F) {
            e = {(1.0F - std::abs(e.y)) * (e.x >= 0.0F ? 1.0F : -1.0F),
                 (1.0F - std::abs(e.x)) * (e.y >= 0.0F ? 1.0F : -1.0F)};
        }
        return glm::uvec2(glm::packSnorm2x16(e));
    });
}

Layer Layer::footprints(glm::uvec2 size_px, const Painter<std::pair<glm::vec3, glm::vec3>>& paint)
{
    return of<glm::uvec4>(gpu::Format::rgba32ui, size_px, [&](glm::uvec2 pixel) {
        const auto [dx, dy] = paint(pixel);
        const glm::vec3 largest = glm::max(glm::abs(dx), glm::abs(dy));
        const float scale = std::max({largest.x, largest.y, largest.z, 1e-30F});
        glm::uvec4 packed(glm::packSnorm2x16(glm::vec2(dx) / scale),
                          glm::packSnorm2x16(glm::vec2(dx.z, dy.x) / scale),
                          glm::packSnorm2x16(glm::vec2(dy.y, dy.z) / scale), 0U);
        std::memcpy(&packed.w, &scale, sizeof(scale));
        return packed;
    });
}

std::vector<glm::vec4> run_and_read_colors(gpu::Graph& graph, gpu::ImageId image)
{
    std::vector<glm::vec4> colors;
    for (const uint64_t packed : run_and_read_as<uint64_t>(graph, image)) {
        colors.push_back(glm::unpackHalf4x16(packed));
    }
    return colors;
}

std::vector<float> run_and_read_coverage(gpu::Graph& graph, gpu::ImageId image)
{
    std::vector<float> coverage;
    for (const uint16_t packed : run_and_read_as<uint16_t>(graph, image)) {
        coverage.push_back(glm::unpackHalf1x16(packed));
    }
    return coverage;
}

} // namespace estampe::test
