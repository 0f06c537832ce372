// SPDX-License-Identifier: MIT
#include "techniques/tam/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace estampe::tam {
namespace {

constexpr uint32_t full = 65535;
constexpr uint32_t half = full / 2; ///< above it a texel is ink

/// What a mark adds to a texel.
uint32_t added(uint32_t ink, uint32_t mark)
{
    return (full - ink) * mark / full;
}

/// Bilinear lookup in a grid of `size` cells a side, a power of two; `x` and `y` in cells, wrapped.
float lookup(const std::vector<uint16_t>& grid, uint32_t size, float x, float y)
{
    const float left = std::floor(x - 0.5F);
    const float top = std::floor(y - 0.5F);
    const float tx = x - 0.5F - left;
    const float ty = y - 0.5F - top;
    const uint32_t mask = size - 1;
    const uint32_t x0 = static_cast<uint32_t>(static_cast<int32_t>(left)) & mask;
    const uint32_t y0 = static_cast<uint32_t>(static_cast<int32_t>(top)) & mask;
    const uint32_t x1 = (x0 + 1) & mask;
    const uint32_t y1 = (y0 + 1) & mask;
    const auto at = [&](uint32_t column, uint32_t row) {
        return static_cast<float>(grid[row * size + column]);
    };
    const float upper = at(x0, y0) + (at(x1, y0) - at(x0, y0)) * tx;
    const float lower = at(x0, y1) + (at(x1, y1) - at(x0, y1)) * tx;
    return (upper + (lower - upper) * ty) * (1.0F / static_cast<float>(full));
}

} // namespace

Canvas::Canvas(uint32_t size_px)
    : size_px_(size_px), ink_(size_t{size_px} * size_px), turned_(ink_.size(), 255)
{
}

double Canvas::mean() const
{
    return static_cast<double>(sum_) / (static_cast<double>(full) * static_cast<double>(ink_.size()));
}

double Canvas::gain(std::span<const Mark> marks) const
{
    uint64_t sum = 0;
    for (const Mark& mark : marks) {
        sum += added(ink_[mark.texel], mark.ink);
    }
    return static_cast<double>(sum) / (static_cast<double>(full) * static_cast<double>(ink_.size()));
}

void Canvas::draw(std::span<const Mark> marks)
{
    const double darkness = std::min(1.0, mean() + 0.5 * gain(marks));
    const auto threshold = static_cast<uint8_t>(std::lround(255.0 * darkness));
    for (const Mark& mark : marks) {
        uint16_t& ink = ink_[mark.texel];
        const uint32_t more = added(ink, mark.ink);
        if (turns(mark)) {
            turned_[mark.texel] = threshold;
        }
        ink = static_cast<uint16_t>(ink + more);
        sum_ += more;
    }
}

bool Canvas::turns(const Mark& mark) const
{
    const uint32_t ink = ink_[mark.texel];
    return ink <= half && ink + added(ink, mark.ink) > half;
}

Gray8 Canvas::coverage() const
{
    Gray8 image(ink_.size());
    std::transform(ink_.begin(), ink_.end(), image.begin(),
                   [](uint32_t ink) { return static_cast<uint8_t>((ink * 255 + full / 2) / full); });
    return image;
}

Gray8 Canvas::thresholds(float darkest) const
{
    Gray8 image = turned_;
    for (size_t texel = 0; texel < image.size(); ++texel) {
        const float coverage = static_cast<float>(ink_[texel]) / static_cast<float>(full);
        if (ink_[texel] <= half) {
            image[texel] = static_cast<uint8_t>(
                std::lround(255.0F * (darkest + (1.0F - darkest) * (1.0F - 2.0F * coverage))));
        }
    }
    return image;
}

Spacing::Spacing(uint32_t size_px) : size_px_(size_px)
{
    constexpr uint32_t coarsest = 8;
    for (uint32_t size = size_px; size >= std::min(coarsest, size_px); size /= 2) {
        scales_.emplace_back(size_t{size} * size);
    }
}

void Spacing::add(const std::function<void(uint32_t size_px, std::vector<Mark>& marks)>& draw)
{
    uint32_t size = size_px_;
    for (std::vector<uint16_t>& grid : scales_) {
        draw(size, marks_);
        for (const Mark& mark : marks_) {
            grid[mark.texel] = static_cast<uint16_t>(grid[mark.texel] + added(grid[mark.texel], mark.ink));
        }
        size /= 2;
    }
}

float Spacing::room(std::span<const glm::vec2> points) const
{
    constexpr size_t fewest = 6;
    float sum = 0.0F;
    uint32_t size = size_px_;
    size_t stride = 1;
    for (const std::vector<uint16_t>& grid : scales_) {
        float taken = 0.0F;
        float count = 0.0F;
        for (size_t i = stride / 2; i < points.size(); i += stride) {
            taken += lookup(grid, size, points[i].x * static_cast<float>(size),
                            points[i].y * static_cast<float>(size));
            count += 1.0F;
        }
        sum += 1.0F - taken / count;
        size /= 2;
        stride = points.size() / (2 * stride) >= fewest ? 2 * stride : stride;
    }
    return sum;
}

} // namespace estampe::tam
