// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/ink/brushes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "gpu/upload.hpp"

namespace estampe::contour {
namespace {

/// Half as many columns and rows, none fewer than one.
std::vector<float> halved(const std::vector<float>& fine, size_t columns, size_t rows)
{
    const size_t step_x = columns > 1 ? 2 : 1;
    const size_t step_y = rows > 1 ? 2 : 1;
    std::vector<float> coarse;
    coarse.reserve(fine.size() / (step_x * step_y));
    for (size_t y = 0; y < rows; y += step_y) {
        for (size_t x = 0; x < columns; x += step_x) {
            const size_t right = x + step_x - 1;
            const size_t below = y + step_y - 1;
            coarse.push_back(0.25F * (fine[y * columns + x] + fine[y * columns + right] +
                                      fine[below * columns + x] + fine[below * columns + right]));
        }
    }
    return coarse;
}

std::vector<std::byte> bytes_of(const std::vector<float>& ink)
{
    std::vector<std::byte> bytes;
    bytes.reserve(ink.size());
    for (const float value : ink) {
        bytes.push_back(static_cast<std::byte>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F))));
    }
    return bytes;
}

gpu::LayerPixels levels_of(const BrushStrip& strip)
{
    gpu::LayerPixels pixels;
    std::vector<float> level = strip.ink;
    size_t columns = shared::brush_columns;
    size_t rows = shared::brush_rows;
    pixels.levels.push_back(bytes_of(level));
    while (columns > 1 || rows > 1) {
        level = halved(level, columns, rows);
        columns = std::max<size_t>(columns / 2, 1);
        rows = std::max<size_t>(rows / 2, 1);
        pixels.levels.push_back(bytes_of(level));
    }
    return pixels;
}

} // namespace

BrushImages upload_brushes(gpu::Device& device, const BrushSet& brushes)
{
    const gpu::ImageDesc desc{.width = shared::brush_columns,
                              .height = shared::brush_rows,
                              .format = gpu::Format::r8,
                              .layers = static_cast<uint32_t>(brushes.strips.size()),
                              .mips = static_cast<uint32_t>(std::bit_width(shared::brush_columns))};
    BrushImages images{.strips = gpu::Image(device, "brushes of lines", desc, true),
                       .layer_of_use = brushes.strip_of_use};
    gpu::upload_layers(device, images.strips,
                       [&](uint32_t layer) { return levels_of(brushes.strips[layer]); });
    for (size_t use = 0; use < images.widths_of_use.size(); ++use) {
        const auto& strip = brushes.strip_of_use.at(use);
        images.widths_of_use.at(use) = strip ? brushes.strips[*strip].widths : 1.0F;
    }
    return images;
}

} // namespace estampe::contour
