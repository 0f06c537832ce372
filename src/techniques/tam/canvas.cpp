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
template <typename Cell>
float lookup(const std::vector<Cell>& grid, uint32_t size, float x, float y)
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
    return upper + (lower - upper) * ty;
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
    const auto turning = static_cast<size_t>(
        std::count_if(marks.begin(), marks.end(), [&](const Mark& mark) { return turns(mark); }));
    const auto texels = static_cast<double>(ink_.size());
    const double share = (static_cast<double>(turned_count_) + 0.5 * static_cast<double>(turning)) / texels;
    const auto threshold = static_cast<uint8_t>(std::lround(255.0 * share));
    for (const Mark& mark : marks) {
        if (turns(mark)) {
            turned_[mark.texel] = threshold;
        }
        uint16_t& ink = ink_[mark.texel];
        const uint32_t more = added(ink, mark.ink);
        ink = static_cast<uint16_t>(ink + more);
        sum_ += more;
    }
    turned_count_ += turning;
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

Gray8 Canvas::thresholds() const
{
    Gray8 image = turned_;
    const float share = static_cast<float>(turned_count_) / static_cast<float>(ink_.size());
    for (size_t texel = 0; texel < image.size(); ++texel) {
        if (ink_[texel] <= half) {
            const float paper = 1.0F - 2.0F * static_cast<float>(ink_[texel]) / static_cast<float>(full);
            image[texel] = static_cast<uint8_t>(
                std::lround(255.0F * (share + (1.0F - share) * std::clamp(paper, 0.02F, 1.0F))));
        }
    }
    return image;
}

Spacing::Spacing(uint32_t size_px)
{
    constexpr uint32_t coarsest = 4;
    for (uint32_t size = size_px; size >= coarsest; size /= 2) {
        const size_t cells = size_t{size} * size;
        scales_.push_back({size, std::vector<uint16_t>(cells), std::vector<uint32_t>(cells)});
    }
}

void Spacing::add(const std::function<void(uint32_t size_px, std::vector<Mark>& marks)>& draw)
{
    for (Scale& scale : scales_) {
        draw(scale.size_px, marks_);
        for (const Mark& mark : marks_) {
            uint16_t& cell = scale.picture[mark.texel];
            cell = static_cast<uint16_t>(cell + added(cell, mark.ink));
        }
        if (&scale == &scales_.front()) {
            spread(marks_);
        }
    }
}

void Spacing::spread(std::span<const Mark> marks)
{
    const uint32_t size_px = scales_.front().size_px;
    for (const Mark& mark : marks) {
        const uint32_t ink =
            mark.ink >> 4U; // sums of a whole level of 2048 px stay within 32 bits at scale 4
        ink_ += ink;
        uint32_t x = mark.texel % size_px;
        uint32_t y = mark.texel / size_px;
        for (Scale& scale : scales_) {
            scale.ink[size_t{y} * scale.size_px + x] += ink;
            x /= 2;
            y /= 2;
        }
    }
}

float Spacing::room(std::span<const glm::vec2> points) const
{
    constexpr size_t fewest = 6;
    constexpr float weight_of_ink = 6.0F;
    constexpr size_t finest_of_ink = 2;
    float sum = 0.0F;
    size_t stride = 1;
    for (size_t i = 0; i < scales_.size(); ++i) {
        const Scale& scale = scales_[i];
        const auto size = static_cast<float>(scale.size_px);
        float taken = 0.0F;
        float ink = 0.0F;
        float count = 0.0F;
        for (size_t point = stride / 2; point < points.size(); point += stride) {
            const glm::vec2 place = points[point] * size;
            taken += lookup(scale.picture, scale.size_px, place.x, place.y);
            ink += i < finest_of_ink ? 0.0F : lookup(scale.ink, scale.size_px, place.x, place.y);
            count += 1.0F;
        }
        sum -= taken / (count * static_cast<float>(full));
        const float mean_ink = static_cast<float>(ink_) / (size * size);
        sum -= ink_ > 0 ? weight_of_ink * ink / (count * mean_ink) : 0.0F;
        stride = points.size() / (2 * stride) >= fewest ? 2 * stride : stride;
    }
    return sum;
}

} // namespace estampe::tam
