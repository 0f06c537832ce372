// SPDX-License-Identifier: MIT
// Croes, "A Method for Solving Traveling-Salesman Problems", Operations Research 6, 1958.
#include "output/pen_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace estampe::output {
namespace {

/// Ends of strokes not yet drawn, by the cell of a grid that they lie in.
class Ends {
public:
    explicit Ends(std::span<const PenStroke> strokes) : strokes_(strokes)
    {
        glm::vec2 low(std::numeric_limits<float>::max());
        glm::vec2 high(-std::numeric_limits<float>::max());
        for (const PenStroke& stroke : strokes) {
            low = glm::min(low, glm::min(stroke.start, stroke.end));
            high = glm::max(high, glm::max(stroke.start, stroke.end));
        }
        const double side = std::sqrt(0.5 * static_cast<double>(strokes.size()));
        const int most = std::clamp(static_cast<int>(side), 1, 1024);
        low_ = low;
        cell_mm_ = std::max({(high.x - low.x), (high.y - low.y), 1e-3F}) / static_cast<float>(most);
        size_ = glm::ivec2((high - low) / cell_mm_) + 1;
        cells_.resize(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y));
        for (uint32_t i = 0; i < strokes.size(); ++i) {
            cells_[index_of(cell_of(strokes[i].start))].push_back({i, false});
            cells_[index_of(cell_of(strokes[i].end))].push_back({i, true});
        }
    }

    /// The end nearest to a place.
    [[nodiscard]] PenStep nearest(const glm::vec2& from) const
    {
        const glm::ivec2 middle = cell_of(from);
        std::optional<PenStep> best;
        float least = std::numeric_limits<float>::max();
        const int rings = std::max(size_.x, size_.y);
        for (int ring = 0; ring <= rings; ++ring) {
            // No end in a ring is nearer than the ring is to a place within the middle cell.
            if (best && static_cast<float>(ring - 1) * cell_mm_ > least) {
                break;
            }
            visit_ring(middle, ring, [&](const PenStep& step) {
                const float away = glm::distance(from, start_of(step));
                if (away < least) {
                    least = away;
                    best = step;
                }
            });
        }
        return best.value();
    }

    void remove(uint32_t stroke)
    {
        for (const glm::vec2& end : {strokes_[stroke].start, strokes_[stroke].end}) {
            std::erase_if(cells_[index_of(cell_of(end))],
                          [stroke](const PenStep& step) { return step.stroke == stroke; });
        }
    }

private:
    [[nodiscard]] glm::vec2 start_of(const PenStep& step) const
    {
        return step.is_turned ? strokes_[step.stroke].end : strokes_[step.stroke].start;
    }

    [[nodiscard]] glm::ivec2 cell_of(const glm::vec2& place) const
    {
        return glm::clamp(glm::ivec2(glm::floor((place - low_) / cell_mm_)), glm::ivec2(0), size_ - 1);
    }

    [[nodiscard]] size_t index_of(const glm::ivec2& cell) const
    {
        return static_cast<size_t>(cell.y) * static_cast<size_t>(size_.x) + static_cast<size_t>(cell.x);
    }

    template <class Visit>
    void visit_ring(const glm::ivec2& middle, int ring, const Visit& visit) const
    {
        const int top = std::max(middle.y - ring, 0);
        const int bottom = std::min(middle.y + ring, size_.y - 1);
        for (int y = top; y <= bottom; ++y) {
            const bool is_whole_row = std::abs(y - middle.y) == ring;
            const int step = is_whole_row || ring == 0 ? 1 : 2 * ring;
            for (int x = middle.x - ring; x <= middle.x + ring; x += step) {
                if (x >= 0 && x < size_.x) {
                    std::ranges::for_each(cells_[index_of({x, y})], visit);
                }
            }
        }
    }

    std::span<const PenStroke> strokes_;
    glm::vec2 low_{0.0F};
    float cell_mm_ = 1.0F;
    glm::ivec2 size_{1};
    std::vector<std::vector<PenStep>> cells_;
};

glm::vec2 start_of(std::span<const PenStroke> strokes, const PenStep& step)
{
    return step.is_turned ? strokes[step.stroke].end : strokes[step.stroke].start;
}

glm::vec2 end_of(std::span<const PenStroke> strokes, const PenStep& step)
{
    return step.is_turned ? strokes[step.stroke].start : strokes[step.stroke].end;
}

void turn(std::vector<PenStep>& order, size_t first, size_t last)
{
    std::reverse(order.begin() + static_cast<std::ptrdiff_t>(first),
                 order.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    for (size_t i = first; i <= last; ++i) {
        order[i].is_turned = !order[i].is_turned;
    }
}

/// What turning the stretch from `first` to `last` around saves.
double saving(std::span<const PenStroke> strokes, std::span<const PenStep> order, size_t first, size_t last,
              const glm::vec2& origin)
{
    const glm::vec2 before = first == 0 ? origin : end_of(strokes, order[first - 1]);
    const glm::vec2 start = start_of(strokes, order[first]);
    const glm::vec2 end = end_of(strokes, order[last]);
    double saved = glm::distance(before, start) - glm::distance(before, end);
    if (last + 1 < order.size()) {
        const glm::vec2 after = start_of(strokes, order[last + 1]);
        saved += glm::distance(end, after) - glm::distance(start, after);
    }
    return saved;
}

} // namespace

double travel_mm(std::span<const PenStroke> strokes, std::span<const PenStep> order, const glm::vec2& origin)
{
    double sum = 0.0;
    glm::vec2 at = origin;
    for (const PenStep& step : order) {
        sum += glm::distance(at, start_of(strokes, step));
        at = end_of(strokes, step);
    }
    return sum;
}

std::vector<PenStep> shortest_order(std::span<const PenStroke> strokes, const glm::vec2& origin,
                                    uint64_t turn_budget)
{
    constexpr size_t farthest = 1500; // strokes that are turned around at once
    constexpr double least_saving_mm = 1e-4;
    std::vector<PenStep> order;
    if (strokes.empty()) {
        return order;
    }
    order.reserve(strokes.size());
    Ends ends(strokes);
    glm::vec2 at = origin;
    while (order.size() < strokes.size()) {
        order.push_back(ends.nearest(at));
        ends.remove(order.back().stroke);
        at = end_of(strokes, order.back());
    }
    bool is_better = true;
    while (is_better && turn_budget > 0) {
        is_better = false;
        for (size_t first = 0; first < order.size() && turn_budget > 0; ++first) {
            const size_t end = std::min(first + farthest, order.size());
            for (size_t last = first; last < end && turn_budget > 0; ++last, --turn_budget) {
                if (saving(strokes, order, first, last, origin) > least_saving_mm) {
                    turn(order, first, last);
                    is_better = true;
                }
            }
        }
    }
    return order;
}

} // namespace estampe::output
