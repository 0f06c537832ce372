// SPDX-License-Identifier: MIT
#include "techniques/tam/stroke.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "techniques/tam/random.hpp"

namespace estampe::tam {
namespace {

/// Where the stroke runs and how wide it is, pixel by pixel along its chord.
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

/// The texels that the middle of a stroke runs through: of each column of the picture, or each row when the
/// stroke runs upright, those from the lowest to the highest.
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
    std::unordered_map<int, glm::ivec2> rows_; ///< lowest and highest
};

/// Walks the columns of the picture that a stroke crosses, or its rows when it runs upright, so that each
/// texel is met once.
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

    /// Where the stroke crosses a column, along the minor axis. The bend is small: two rounds find it.
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
