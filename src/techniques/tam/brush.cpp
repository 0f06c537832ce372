// SPDX-License-Identifier: MIT
#include "techniques/tam/brush.hpp"

#include <algorithm>
#include <cmath>

#include <estampe/error.hpp>

#include "techniques/tam/random.hpp"

namespace estampe::tam {
namespace {

constexpr size_t picture_columns = 256;

/// The least ink where the middle of a stroke runs: above one half by more than rounding takes away. Without
/// it the tip of a stroke, less than a pixel wide, would be ink in one level and not in the next.
constexpr float least_ink = 0.53F;

float smooth(float from, float to, float x)
{
    const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

/// Share of a pixel's width that a line covers whose edge is `half_px` from its middle.
float line_coverage(const Touch& touch)
{
    const float reach = touch.half_px + 0.5F - std::abs(touch.across_px);
    return std::clamp(reach, 0.0F, std::min(1.0F, 2.0F * touch.half_px));
}

/// Mean of the rectangle of `values` (size x size columns and rows) from (x0, y0) to (x1, y1).
float box_mean(const std::vector<float>& values, size_t width, size_t x0, size_t x1, size_t y0, size_t y1)
{
    double sum = 0.0;
    for (size_t y = y0; y < y1; ++y) {
        for (size_t x = x0; x < x1; ++x) {
            sum += static_cast<double>(values[y * width + x]);
        }
    }
    return static_cast<float>(sum / static_cast<double>((x1 - x0) * (y1 - y0)));
}

/// Ink of each pixel of a picture: its alpha, or its darkness where nothing is transparent.
std::vector<float> ink_of(const Image& picture)
{
    bool opaque = true;
    for (size_t i = 3; i < picture.rgba.size(); i += 4) {
        opaque = opaque && picture.rgba[i] == 255;
    }
    std::vector<float> ink;
    ink.reserve(picture.rgba.size() / 4);
    for (size_t i = 0; i < picture.rgba.size(); i += 4) {
        const int grey = (2 * picture.rgba[i] + 5 * picture.rgba[i + 1] + picture.rgba[i + 2]) / 8;
        ink.push_back(static_cast<float>(opaque ? 255 - grey : picture.rgba[i + 3]) / 255.0F);
    }
    return ink;
}

} // namespace

std::vector<float> paper_tooth(uint32_t size_px, uint32_t cell_px, uint32_t seed)
{
    const auto bumps = [&](uint32_t x, uint32_t y, uint32_t cell, uint32_t salt) {
        const uint32_t cells = std::max(1U, size_px / cell);
        const auto knot = [&](uint32_t column, uint32_t row) {
            return unit_float(hash(seed + salt + column % cells, row % cells + 7919U));
        };
        const uint32_t cx = x / cell;
        const uint32_t cy = y / cell;
        const float tx = (static_cast<float>(x % cell) + 0.5F) / static_cast<float>(cell);
        const float ty = (static_cast<float>(y % cell) + 0.5F) / static_cast<float>(cell);
        const float upper = std::lerp(knot(cx, cy), knot(cx + 1, cy), tx);
        const float lower = std::lerp(knot(cx, cy + 1), knot(cx + 1, cy + 1), tx);
        return std::lerp(upper, lower, ty);
    };
    std::vector<float> tooth(size_t{size_px} * size_px);
    for (uint32_t y = 0; y < size_px; ++y) {
        for (uint32_t x = 0; x < size_px; ++x) {
            const float height = 0.5F * bumps(x, y, cell_px, 0) +
                                 0.35F * bumps(x, y, std::max(1U, cell_px / 2), 101U) +
                                 0.15F * bumps(x, y, 1, 211U);
            // Sums of bumps crowd about the middle: spread them out.
            tooth[size_t{y} * size_px + x] = std::clamp(0.5F + 1.7F * (height - 0.5F), 0.0F, 1.0F);
        }
    }
    return tooth;
}

Brush::Brush(const TamStyle& style, const Image* picture)
    : tool_(style.tool), opacity_(style.opacity), grain_(style.grain), pressure_(style.pressure),
      width_px_(style.width_px)
{
    if (picture != nullptr) {
        picture_rows_ = static_cast<size_t>(std::ceil(2.0F * width_px_)) + 1;
        picture_ = stroke_of(*picture, picture_columns, picture_rows_);
    }
}

std::vector<float> stroke_of(const Image& picture, size_t columns, size_t rows, const std::string& where)
{
    if (picture.empty()) {
        throw Error("the picture of a brush is empty", where);
    }
    const std::vector<float> ink = ink_of(picture);
    std::vector<float> stroke(rows * columns);
    float most = 0.0F;
    for (size_t row = 0; row < rows; ++row) {
        const size_t y0 = row * picture.height / rows;
        const size_t y1 = std::max(y0 + 1, (row + 1) * picture.height / rows);
        for (size_t column = 0; column < columns; ++column) {
            const size_t x0 = column * picture.width / columns;
            const size_t x1 = std::max(x0 + 1, (column + 1) * picture.width / columns);
            stroke[row * columns + column] = box_mean(ink, picture.width, x0, x1, y0, y1);
            most = std::max(most, stroke[row * columns + column]);
        }
    }
    if (most < 0.1F) {
        throw Error("the picture of a brush has no ink", where,
                    "paint the stroke from left to right, in its alpha or in black on white");
    }
    return stroke;
}

uint32_t Brush::tooth_cell_px() const
{
    if (!picture_.empty() || grain_ <= 0.0F) {
        return 0;
    }
    return tool_ == Tool::pencil ? 2U : (tool_ == Tool::charcoal ? 4U : 0U);
}

float Brush::pressure(float along, uint32_t seed) const
{
    const float noise = 0.5F + 0.5F * line_noise(seed + 11U, 3.0F * along + 0.37F);
    switch (tool_) {
    case Tool::burin: // the plate is turned against the steel: a swell, thickest past the middle
        return 1.0F - pressure_ * (1.0F - smooth(0.0F, 0.55F, along) * smooth(1.0F, 0.55F, along));
    case Tool::brush: // set down full, lifted as it goes
        return 1.0F - pressure_ * (0.75F * smooth(0.25F, 1.0F, along) + 0.25F * noise);
    case Tool::pen:
    case Tool::pencil:
    case Tool::charcoal:
        break;
    }
    return 1.0F - pressure_ * noise;
}

/// Ink stays on the bumps of the paper that the pressure, strongest in the middle, reaches down to.
float Brush::grained(const Touch& touch, float roughness) const
{
    const float side = std::min(1.0F, std::abs(touch.across_px) / (touch.half_px + 0.5F));
    const float reach = 1.0F - side * side;
    const float valley = grain_ * touch.tooth;
    const float edge = smooth(valley * roughness - 0.25F, valley * roughness + 0.25F, reach);
    const float darkness = opacity_ - (opacity_ - least_ink) * std::min(1.0F, 1.3F * valley);
    return line_coverage(touch) * edge * darkness;
}

/// Hairs part towards the end of the stroke, where the ink runs out.
float Brush::hairs(const Touch& touch, uint32_t seed) const
{
    const float side = touch.across_px / touch.half_px;
    const float hair = 0.5F + 0.5F * line_noise(seed + 23U, 2.3F * touch.hairs * side + 40.0F);
    const float along = 0.5F + 0.5F * line_noise(seed + 29U, 5.0F * touch.along + 2.0F * side + 60.0F);
    const float wide = smooth(1.2F, 2.4F, touch.half_px); // one hair or two do not part
    const float dry = grain_ * wide * smooth(0.3F, 0.9F, touch.along) * std::min(1.0F, 2.5F * std::abs(side));
    const float left = smooth(dry - 0.35F, dry + 0.1F, 0.7F * hair + 0.3F * along);
    return line_coverage(touch) * left * opacity_;
}

float Brush::pictured(const Touch& touch) const
{
    const auto rows = static_cast<float>(picture_rows_);
    const float y = (0.5F + 0.5F * touch.across_px / touch.half_px) * rows - 0.5F;
    const float row = std::clamp(y, 0.0F, rows - 1.0F);
    const auto upper = static_cast<size_t>(row);
    const size_t lower = std::min(upper + 1, picture_rows_ - 1);
    const auto column = static_cast<size_t>(
        std::lround(std::clamp(touch.along, 0.0F, 1.0F) * static_cast<float>(picture_columns - 1)));
    const float ink = std::lerp(picture_[upper * picture_columns + column],
                                picture_[lower * picture_columns + column], row - static_cast<float>(upper));
    return line_coverage(touch) * ink * opacity_;
}

float Brush::ink(const Touch& touch, uint32_t seed) const
{
    if (!picture_.empty()) {
        return pictured(touch);
    }
    const float ink = formula(touch, seed);
    return touch.on_middle ? std::max(ink, least_ink) : ink;
}

float Brush::formula(const Touch& touch, uint32_t seed) const
{
    switch (tool_) {
    case Tool::pencil:
        return grained(touch, 0.9F);
    case Tool::charcoal:
        return grained(touch, 1.25F);
    case Tool::brush:
        return hairs(touch, seed);
    case Tool::pen:
    case Tool::burin:
        break;
    }
    return line_coverage(touch) * opacity_;
}

} // namespace estampe::tam
