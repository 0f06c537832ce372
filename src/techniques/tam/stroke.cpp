// SPDX-License-Identifier: MIT
#include "techniques/tam/stroke.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <estampe/error.hpp>

namespace estampe::tam {
namespace {

constexpr size_t picture_columns = 256;

/// Smallest ink on a stroke's centre line. The smallest ink is more than one half even after rounding.
/// Otherwise a thin stroke tip could count as ink in one mip level and not in the next.
constexpr float least_ink = 0.53F;

float smooth(float from, float to, float x)
{
    const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

/// Share of a pixel's width that a line covers. The pixel's position relative to the line is in `touch`.
float line_coverage(const Touch& touch)
{
    const float reach = touch.half_px + 0.5F - std::abs(touch.across_px);
    return std::clamp(reach, 0.0F, std::min(1.0F, 2.0F * touch.half_px));
}

/// Mean of `values` (rows of `width` values) over the rectangle from (x0, y0) to (x1, y1).
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

/// Ink of each pixel of a picture: its alpha, or its darkness if the whole picture is opaque.
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
            // The height of the paper is a sum of random bumps, and sums of random bumps cluster around one
            // half. The factor spreads the heights over the range from 0 to 1.
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
    case Tool::burin: // a burin's line swells, and is thickest beyond its middle
        return 1.0F - pressure_ * (1.0F - smooth(0.0F, 0.55F, along) * smooth(1.0F, 0.55F, along));
    case Tool::brush: // a brush starts at full width and is lifted along the stroke
        return 1.0F - pressure_ * (0.75F * smooth(0.25F, 1.0F, along) + 0.25F * noise);
    case Tool::pen:
    case Tool::pencil:
    case Tool::charcoal:
        break;
    }
    return 1.0F - pressure_ * noise;
}

/// Ink of a pencil or charcoal: only bumps of the paper that are high enough for the pressure take ink. The
/// pressure is strongest on the centre line.
float Brush::grained(const Touch& touch, float roughness) const
{
    const float side = std::min(1.0F, std::abs(touch.across_px) / (touch.half_px + 0.5F));
    const float reach = 1.0F - side * side;
    const float valley = grain_ * touch.tooth;
    const float edge = smooth(valley * roughness - 0.25F, valley * roughness + 0.25F, reach);
    const float darkness = opacity_ - (opacity_ - least_ink) * std::min(1.0F, 1.3F * valley);
    return line_coverage(touch) * edge * darkness;
}

/// Ink of a brush: its hairs separate towards the end of the stroke, where the ink runs out.
float Brush::hairs(const Touch& touch, uint32_t seed) const
{
    const float side = touch.across_px / touch.half_px;
    const float hair = 0.5F + 0.5F * line_noise(seed + 23U, 2.3F * touch.hairs * side + 40.0F);
    const float along = 0.5F + 0.5F * line_noise(seed + 29U, 5.0F * touch.along + 2.0F * side + 60.0F);
    // A brush that is only one or two hairs wide does not separate.
    const float wide = smooth(1.2F, 2.4F, touch.half_px);
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

namespace {

/// Course and width of a stroke, stored for each pixel along its chord (the straight line between its ends).
class Path {
public:
    Path(const Stroke& stroke, const Nib& nib, const Brush& brush, uint32_t size_px)
        : length_px_(stroke.length * static_cast<float>(size_px))
    {
        constexpr float least_half_px = 0.45F;
        const float taper_px = std::max(0.01F, std::min(nib.taper_px, 0.45F * length_px_));
        const auto count = static_cast<size_t>(std::ceil(length_px_)) + 2;
        offset_px_.resize(count);
        half_px_.resize(count);
        for (size_t i = 0; i < count; ++i) {
            const float along_px = std::min(static_cast<float>(i), length_px_);
            const float along = along_px / length_px_;
            offset_px_[i] = stroke.offset(along) * static_cast<float>(size_px);
            const float to_end = std::min(1.0F, std::min(along_px, length_px_ - along_px) / taper_px);
            const float taper = nib.tip + (1.0F - nib.tip) * to_end * (2.0F - to_end);
            half_px_[i] =
                std::max(least_half_px, 0.5F * nib.width_px * taper * brush.pressure(along, stroke.seed));
            widest_px_ = std::max(widest_px_, half_px_[i]);
        }
    }

    [[nodiscard]] float length_px() const { return length_px_; }

    [[nodiscard]] float widest_px() const { return widest_px_; }

    [[nodiscard]] float offset_px(float along_px) const { return at(offset_px_, along_px); }

    [[nodiscard]] float half_px(float along_px) const { return at(half_px_, along_px); }

private:
    [[nodiscard]] float at(const std::vector<float>& values, float along_px) const
    {
        const float inside = std::clamp(along_px, 0.0F, length_px_);
        const auto i = static_cast<size_t>(inside);
        return values[i] + (values[i + 1] - values[i]) * (inside - static_cast<float>(i));
    }

    float length_px_;
    float widest_px_ = 0.0F;
    std::vector<float> offset_px_;
    std::vector<float> half_px_;
};

/// The texels through which a stroke's centre line runs. For each column of the picture (each row, if the
/// stroke is steep), stores the lowest and the highest texel of the centre line.
class Middle {
public:
    Middle(const Stroke& stroke, uint32_t size_px, int major) : major_(major)
    {
        constexpr float samples_a_px = 4.0F;
        const auto size = static_cast<float>(size_px);
        const auto count = static_cast<size_t>(std::ceil(samples_a_px * stroke.length * size)) + 1;
        glm::vec2 before = size * stroke.point(0.0F);
        enter(before, column_of(before));
        for (size_t i = 1; i <= count; ++i) {
            const glm::vec2 here = size * stroke.point(static_cast<float>(i) / static_cast<float>(count));
            const int from = column_of(before);
            const int to = column_of(here);
            if (from != to) {
                const auto border = static_cast<float>(std::max(from, to));
                const glm::vec2 crossing =
                    glm::mix(before, here, (border - before[major]) / (here[major] - before[major]));
                enter(crossing, from);
                enter(crossing, to);
            }
            enter(here, to);
            before = here;
        }
    }

    [[nodiscard]] bool runs_through(glm::ivec2 texel) const
    {
        const auto found = rows_.find(texel[major_]);
        return found != rows_.end() && texel[1 - major_] >= found->second.x &&
               texel[1 - major_] <= found->second.y;
    }

private:
    [[nodiscard]] int column_of(glm::vec2 place_px) const
    {
        return static_cast<int>(std::floor(place_px[major_]));
    }

    void enter(glm::vec2 place_px, int column)
    {
        const int row = static_cast<int>(std::floor(place_px[1 - major_]));
        const auto [rows, is_new] = rows_.try_emplace(column, row, row);
        rows->second = {std::min(rows->second.x, row), std::max(rows->second.y, row)};
    }

    int major_;
    /// For each column: lowest and highest row of the centre line. For steep strokes, rows and columns are
    /// swapped.
    std::unordered_map<int, glm::ivec2> rows_;
};

/// Visits the texels near a stroke, column by column (row by row, if the stroke is steep), so that each texel
/// is visited once.
class Walk {
public:
    Walk(const Stroke& stroke, const Path& path, const Brush& brush, const std::vector<float>& tooth,
         uint32_t size_px, std::vector<Mark>& marks)
        : path_(path), brush_(brush), tooth_(tooth), marks_(marks), seed_(stroke.seed), size_px_(size_px),
          start_px_(stroke.start * static_cast<float>(size_px)), direction_(stroke.direction),
          across_(-stroke.direction.y, stroke.direction.x),
          major_(std::abs(direction_.x) >= std::abs(direction_.y) ? 0 : 1), middle_(stroke, size_px, major_)
    {
    }

    void run()
    {
        const int minor = 1 - major_;
        const float from = start_px_[major_];
        const float to = from + direction_[major_] * path_.length_px();
        const float margin = path_.widest_px() + std::abs(across_[major_]) * bend() + 1.0F;
        const int first = static_cast<int>(std::floor(std::min(from, to) - margin));
        const int last = static_cast<int>(std::ceil(std::max(from, to) + margin));
        const float reach = (path_.widest_px() + 1.5F) / std::abs(direction_[major_]) + 1.0F;
        for (int column = first; column <= last; ++column) {
            const float middle = middle_of(static_cast<float>(column) + 0.5F);
            const int low = static_cast<int>(std::floor(middle - reach));
            const int high = static_cast<int>(std::ceil(middle + reach));
            glm::ivec2 texel;
            texel[major_] = column;
            for (texel[minor] = low; texel[minor] <= high; ++texel[minor]) {
                touch(texel);
            }
        }
    }

private:
    [[nodiscard]] float bend() const
    {
        float most = 0.0F;
        for (int i = 0; i <= 8; ++i) {
            most =
                std::max(most, std::abs(path_.offset_px(path_.length_px() * static_cast<float>(i) / 8.0F)));
        }
        return 1.5F * most;
    }

    /// Row at which the stroke crosses a column (rows and columns are swapped for steep strokes). The bend of
    /// a stroke is small, so two iterations suffice.
    [[nodiscard]] float middle_of(float column) const
    {
        const int minor = 1 - major_;
        float along_px = (column - start_px_[major_]) / direction_[major_];
        for (int round = 0; round < 2; ++round) {
            along_px = (column - start_px_[major_] - across_[major_] * path_.offset_px(along_px)) /
                       direction_[major_];
        }
        return start_px_[minor] + direction_[minor] * along_px + across_[minor] * path_.offset_px(along_px);
    }

    void touch(glm::ivec2 texel)
    {
        const glm::vec2 from_start = glm::vec2(texel) + 0.5F - start_px_;
        const float along_px = glm::dot(from_start, direction_);
        const float inside = std::min(along_px, path_.length_px() - along_px) + 0.5F;
        const bool on_middle = middle_.runs_through(texel);
        if (inside <= 0.0F && !on_middle) {
            return;
        }
        const float across_px = glm::dot(from_start, across_) - path_.offset_px(along_px);
        const float half_px = path_.half_px(along_px);
        if (std::abs(across_px) >= half_px + 0.5F && !on_middle) {
            return;
        }
        const uint32_t mask = size_px_ - 1;
        const uint32_t index =
            (static_cast<uint32_t>(texel.y) & mask) * size_px_ + (static_cast<uint32_t>(texel.x) & mask);
        const Touch touch{.along = std::clamp(along_px / path_.length_px(), 0.0F, 1.0F),
                          .across_px = across_px,
                          .half_px = half_px,
                          .tooth = tooth_.empty() ? 0.0F : tooth_[index],
                          .on_middle = on_middle};
        const float ink = brush_.ink(touch, seed_) * (on_middle ? 1.0F : std::min(inside, 1.0F));
        const auto amount = static_cast<uint16_t>(std::lround(std::clamp(ink, 0.0F, 1.0F) * 65535.0F));
        if (amount > 0) {
            marks_.push_back({index, amount});
        }
    }

    const Path& path_;
    const Brush& brush_;
    const std::vector<float>& tooth_;
    std::vector<Mark>& marks_;
    uint32_t seed_;
    uint32_t size_px_;
    glm::vec2 start_px_;
    glm::vec2 direction_;
    glm::vec2 across_;
    int major_;
    Middle middle_;
};

} // namespace

float Stroke::offset(float along) const
{
    const float arc = 4.0F * along * (1.0F - along);
    const float slow = line_noise(seed, 2.0F * along + 0.61F);
    const float quick = line_noise(seed + 5U, 6.0F * along + 0.13F);
    return length * (bow * arc + wobble * (0.7F * slow + 0.3F * quick));
}

glm::vec2 Stroke::point(float along) const
{
    return start + direction * (length * along) + glm::vec2(-direction.y, direction.x) * offset(along);
}

void draw_stroke(const Stroke& stroke, const Nib& nib, const Brush& brush, const std::vector<float>& tooth,
                 uint32_t size_px, std::vector<Mark>& marks)
{
    marks.clear();
    const Path path(stroke, nib, brush, size_px);
    Walk(stroke, path, brush, tooth, size_px, marks).run();
}

} // namespace estampe::tam
