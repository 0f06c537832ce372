// SPDX-License-Identifier: MIT
#include "techniques/lightmap/lightmap.hpp"

#include <algorithm>
#include <cstring>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include "gpu/resources.hpp"
#include "shaders/lightmap_comp.hpp"
#include "style/parameter.hpp"

namespace estampe::lightmap {
namespace {

glm::vec3 between(const LightImage& image, const glm::vec2& place)
{
    const glm::vec2 size(image.width, image.height);
    const glm::vec2 texel = glm::clamp(place * size - 0.5F, glm::vec2(0.0F), size - 1.0F);
    const glm::uvec2 corner(texel);
    const glm::uvec2 next = glm::min(corner + 1U, glm::uvec2(image.width, image.height) - 1U);
    const glm::vec2 f = texel - glm::vec2(corner);
    const auto at = [&](uint32_t x, uint32_t y) {
        return image.texels[static_cast<size_t>(y) * image.width + x];
    };
    return glm::mix(glm::mix(at(corner.x, corner.y), at(next.x, corner.y), f.x),
                    glm::mix(at(corner.x, next.y), at(next.x, next.y), f.x), f.y);
}

LightImage stretched(const LightImage& image, uint32_t width, uint32_t height)
{
    if (image.width == width && image.height == height) {
        return image;
    }
    LightImage result{.width = width, .height = height};
    result.texels.reserve(static_cast<size_t>(width) * height);
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            result.texels.push_back(between(image, (glm::vec2(x, y) + 0.5F) / glm::vec2(width, height)));
        }
    }
    return result;
}

std::vector<std::byte> halves(const LightImage& image)
{
    constexpr float largest_half = 65504.0F;
    std::vector<std::byte> bytes(image.texels.size() * sizeof(uint64_t));
    for (size_t i = 0; i < image.texels.size(); ++i) {
        const uint64_t packed =
            glm::packHalf4x16(glm::vec4(glm::min(image.texels[i], glm::vec3(largest_half)), 1.0F));
        std::memcpy(bytes.data() + i * sizeof packed, &packed, sizeof packed);
    }
    return bytes;
}

} // namespace

MapBuffers upload_maps(gpu::Device& device, const MapData& data)
{
    uint32_t width = 1;
    uint32_t height = 1;
    for (const LightImage& layer : data.layers) {
        width = std::max(width, layer.width);
        height = std::max(height, layer.height);
    }
    const uint32_t most_px = device.limits().maxImageDimension2D;
    const uint32_t most_layers = device.limits().maxImageArrayLayers;
    if (width > most_px || height > most_px || data.layers.size() > most_layers) {
        throw Error(fmt::format("{} lightmaps of {} x {} texels are beyond the device", data.layers.size(),
                                width, height),
                    "lightmap", fmt::format("it takes {} of {} x {}", most_layers, most_px, most_px));
    }
    const bool has_coarser = width > 1 && height > 1;
    const gpu::ImageDesc desc{.width = width,
                              .height = height,
                              .format = gpu::Format::rgba16f,
                              .layers = std::max<uint32_t>(1, static_cast<uint32_t>(data.layers.size())),
                              .mips = has_coarser ? 2U : 1U};
    MapBuffers buffers;
    buffers.slots = gpu::upload_buffer(device, "lightmap slots", data.slots);
    buffers.corners = gpu::upload_buffer(device, "lightmap corners", data.corners);
    buffers.maps = gpu::Image(device, "lightmaps", desc, true);
    gpu::upload_layers(device, buffers.maps, [&](uint32_t layer) {
        const LightImage fine = layer < data.layers.size() ? stretched(data.layers[layer], width, height)
                                                           : LightImage{1, 1, {glm::vec3(0.0F)}};
        gpu::LayerPixels pixels;
        pixels.levels.push_back(halves(fine));
        if (has_coarser) {
            pixels.levels.push_back(halves(stretched(fine, width / 2, height / 2)));
        }
        return pixels;
    });
    return buffers;
}

gpu::ImageId add_lightmap(gpu::Graph& graph, const LightmapInputs& in, MapBuffers& maps)
{
    auto pass = graph.compute("lightmap", shaders::lightmap_comp);
    pass.uniform(in.frame).read(in.visibility).sample(in.triangles).sample(in.posed_vertices);
    pass.read(gpu::import_whole(graph, "lightmap slots", maps.slots))
        .read(gpu::import_whole(graph, "lightmap corners", maps.corners))
        .sample(gpu::import_uploaded(graph, "lightmaps", maps.maps), gpu::Sampling::linear);
    const gpu::ImageId light = pass.write(graph.image(
        "lightmap", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba16f}));
    pass.push(in.scale).dispatch_over(in.size_px.x, in.size_px.y);
    return light;
}

const style::Table<LightmapStyle>& lightmap_table()
{
    static const auto table =
        style::Table<LightmapStyle>("lightmap", "Baked light of scenes that have a lightmap")
            .number("strength", &LightmapStyle::strength, {0.0F, 10.0F}, "",
                    "Brightness of the baked light (light that was computed before and stored). 0 leaves out "
                    "the baked light, 1 keeps its brightness, more is brighter.")
            .toggle(
                "balance", &LightmapStyle::balance,
                "If true, all light is dimmed so that baked (stored) light does not brighten the picture as "
                "a whole. If false, baked light is added to the other light, which brightens the picture.");
    return table;
}

} // namespace estampe::lightmap
