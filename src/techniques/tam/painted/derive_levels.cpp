// SPDX-License-Identifier: MIT
#include "techniques/tam/painted/painted_strokes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "techniques/tam/maker.hpp"
#include "techniques/tam/stroke.hpp"

namespace estampe::tam {
namespace {

constexpr size_t direction_count = 3;

/// The half circle of stroke directions is divided into three equal parts. Returns the number of the part
/// that contains the stroke's direction.
size_t direction_of(const PaintedStroke& stroke)
{
    const glm::vec2 chord = stroke.points.back() - stroke.points.front();
    const float x = chord.y < 0.0F ? -chord.x : chord.x;
    const float y = std::abs(chord.y);
    constexpr float tangent_of_30 = 0.57735F;
    if (y < tangent_of_30 * std::abs(x)) {
        return 0;
    }
    return x > 0.0F ? 1 : 2;
}

/// Draws a painted stroke as a row of discs, and computes one mark per texel.
class DiscPen {
public:
    explicit DiscPen(uint32_t size_px) : ink_(size_t{size_px} * size_px), size_px_(size_px) {}

    /// Marks the first `count` points of a stroke, with at most `most_half_px` of ink on either side of its
    /// centre line.
    void draw(const PaintedStroke& stroke, size_t count, float most_half_px, std::vector<Mark>& marks)
    {
        for (size_t i = 0; i < count; ++i) {
            disc(stroke.points[i] * static_cast<float>(size_px_), std::min(most_half_px, stroke.half_px[i]));
        }
        marks.clear();
        for (const uint32_t texel : touched_) {
            marks.push_back({texel, ink_[texel]});
            ink_[texel] = 0;
        }
        touched_.clear();
    }

private:
    void disc(glm::vec2 middle, float half_px)
    {
        const float reach = half_px + 0.5F;
        const glm::ivec2 low(glm::floor(middle - reach));
        const glm::ivec2 high(glm::ceil(middle + reach));
        const uint32_t mask = size_px_ - 1;
        for (int y = low.y; y < high.y; ++y) {
            for (int x = low.x; x < high.x; ++x) {
                const float distance = glm::length(glm::vec2(x, y) + 0.5F - middle);
                const float cover = std::clamp(reach - distance, 0.0F, std::min(1.0F, 2.0F * half_px));
                const auto amount = static_cast<uint16_t>(std::lround(cover * 65535.0F));
                const uint32_t texel =
                    (static_cast<uint32_t>(y) & mask) * size_px_ + (static_cast<uint32_t>(x) & mask);
                if (amount > ink_[texel]) {
                    if (ink_[texel] == 0) {
                        touched_.push_back(texel);
                    }
                    ink_[texel] = amount;
                }
            }
        }
    }

    std::vector<uint16_t> ink_;
    std::vector<uint32_t> touched_;
    uint32_t size_px_;
};

class DerivedLevel {
public:
    explicit DerivedLevel(uint32_t size_px)
        : canvas_(size_px), spacing_(direction_count, Spacing(size_px)), random_(size_px)
    {
        for (uint32_t size = size_px; size >= 1; size /= 2) {
            pens_.emplace_back(size);
        }
    }

    /// Draws the best spaced strokes of `offered` until the mean coverage is `target`, and returns these
    /// strokes in the order of `offered`. `offered` must be sorted, longest first. Short scraps of strokes
    /// are used only after all longer strokes.
    [[nodiscard]] std::vector<const PaintedStroke*> keep(std::vector<const PaintedStroke*> offered,
                                                         double target)
    {
        std::vector<const PaintedStroke*> kept;
        shortest_long_ = 0;
        while (!offered.empty() && canvas_.mean() < target) {
            const auto chosen =
                offered.begin() + static_cast<std::ptrdiff_t>(best(offered, long_ones(offered)));
            kept.push_back(*chosen);
            offered.erase(chosen);
            if (!place(*kept.back(), target)) {
                break;
            }
        }
        std::stable_sort(kept.begin(), kept.end(), [](const PaintedStroke* a, const PaintedStroke* b) {
            return a->points.size() > b->points.size();
        });
        return kept;
    }

    [[nodiscard]] Gray8 coverage() const { return canvas_.coverage(); }

private:
    /// Counts the strokes in `offered` that are longer than a third of a typical stroke. Half of the ink lies
    /// in strokes that are longer than a typical stroke. If no long stroke is left, returns the number of all
    /// strokes.
    [[nodiscard]] size_t long_ones(const std::vector<const PaintedStroke*>& offered)
    {
        if (shortest_long_ == 0) {
            size_t total = 0;
            for (const PaintedStroke* stroke : offered) {
                total += stroke->points.size();
            }
            size_t sum = 0;
            for (size_t i = 0; 2 * sum < total; ++i) {
                sum += offered[i]->points.size();
                shortest_long_ = std::max<size_t>(1, offered[i]->points.size() / 3);
            }
        }
        const auto end =
            std::partition_point(offered.begin(), offered.end(), [&](const PaintedStroke* stroke) {
                return stroke->points.size() >= shortest_long_;
            });
        return end == offered.begin() ? offered.size() : static_cast<size_t>(end - offered.begin());
    }

    /// Finds the best spaced stroke among a sample of the first `count` strokes.
    [[nodiscard]] size_t best(const std::vector<const PaintedStroke*>& offered, size_t count)
    {
        constexpr size_t candidates = 48;
        const size_t tries = std::min(candidates, count);
        size_t chosen = 0;
        float most_room = std::numeric_limits<float>::lowest();
        for (size_t i = 0; i < tries; ++i) {
            const size_t candidate = tries == count ? i : random_.bits() % count;
            const PaintedStroke& stroke = *offered[candidate];
            const float room = spacing_[direction_of(stroke)].room(stroke.points);
            if (room > most_room) {
                most_room = room;
                chosen = candidate;
            }
        }
        return chosen;
    }

    [[nodiscard]] static float most_half_px(uint32_t size_px)
    {
        return std::max(0.7F, static_cast<float>(size_px) / 12.0F);
    }

    void mark(const PaintedStroke& stroke, size_t count)
    {
        pens_.front().draw(stroke, count, most_half_px(canvas_.size_px()), marks_);
    }

    /// Draws a stroke, or only a part of the stroke if the tone needs no more ink. Returns false if the tone
    /// is reached.
    [[nodiscard]] bool place(const PaintedStroke& stroke, double target)
    {
        constexpr size_t fewest_points = 3;
        const double missing = target - canvas_.mean();
        mark(stroke, stroke.points.size());
        const bool all = canvas_.gain(marks_) <= missing;
        if (!all) {
            size_t low = std::min(fewest_points, stroke.points.size());
            size_t high = stroke.points.size();
            while (high - low > 1) {
                const size_t middle = (low + high) / 2;
                mark(stroke, middle);
                (canvas_.gain(marks_) > missing ? high : low) = middle;
            }
            mark(stroke, low);
            soften(missing);
        }
        canvas_.draw(marks_);
        size_t scale = 0;
        spacing_[direction_of(stroke)].add([&](uint32_t size_px, std::vector<Mark>& marks) {
            pens_[scale++].draw(stroke, stroke.points.size(), most_half_px(size_px), marks);
        });
        return all;
    }

    /// If the marks (ink of a stroke per texel) would add more ink than is missing, makes them so faint that
    /// they do not count as ink.
    void soften(double missing)
    {
        constexpr double faint = 0.45;
        const double gain = canvas_.gain(marks_);
        if (gain <= missing * 1.05) {
            return;
        }
        for (Mark& mark : marks_) {
            mark.ink = static_cast<uint16_t>(std::min(faint, missing / gain) * mark.ink);
        }
        std::erase_if(marks_, [&](const Mark& mark) { return canvas_.turns(mark); });
    }

    Canvas canvas_;
    std::vector<Spacing> spacing_;
    Random random_;
    std::vector<DiscPen> pens_;
    std::vector<Mark> marks_;
    size_t shortest_long_ = 0;
};

} // namespace

void derive_levels(TonalArtMap& map)
{
    const size_t painted = map.level_of_tone.front().size();
    const uint32_t painted_px = map.size_px >> (painted - 1);
    std::vector<DerivedLevel> levels;
    for (uint32_t size = painted_px / 2; size >= least_drawn_px; size /= 2) {
        levels.emplace_back(size);
    }
    Gray8 lighter;
    for (size_t tone = 0; tone < map.level_of_tone.size(); ++tone) {
        std::vector<Gray8>& images = map.level_of_tone[tone];
        const std::vector<PaintedStroke> strokes = find_strokes(lighter, images.back(), painted_px);
        lighter = images.back();
        std::vector<const PaintedStroke*> offered;
        offered.reserve(strokes.size());
        for (const PaintedStroke& stroke : strokes) {
            offered.push_back(&stroke);
        }
        for (DerivedLevel& level : levels) {
            offered = level.keep(std::move(offered), static_cast<double>(map.darkness[tone]));
            images.push_back(level.coverage());
        }
        for (uint32_t size = map.size_px >> (images.size() - 1); size > 1; size /= 2) {
            images.push_back(half_size(images.back(), size));
        }
    }
}

} // namespace estampe::tam
