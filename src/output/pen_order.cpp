// SPDX-License-Identifier: MIT
#include "output/pen_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>

namespace estampe::output {
namespace {

// Number of nearest ends that are tried for each end of a stroke. Twice as many shorten the travel by at
// most two percent, and take half as long again.
constexpr size_t most_neighbours = 10;
constexpr double least_saving_mm = 1e-4;
constexpr size_t most_moved = 3; // Largest number of consecutive strokes that one step of or-opt moves
// Largest number of steps in the order that all changes together may shift. Pages of 100,000 strokes stay
// below this bound, which keeps the time of much larger pages finite.
constexpr uint64_t most_shifted = 1'000'000'000;

glm::vec2 start_of(std::span<const PenStroke> strokes, const PenStep& step)
{
    return step.is_turned ? strokes[step.stroke].end : strokes[step.stroke].start;
}

glm::vec2 end_of(std::span<const PenStroke> strokes, const PenStep& step)
{
    return step.is_turned ? strokes[step.stroke].start : strokes[step.stroke].end;
}

/// Grid with the ends of strokes, for a fast search of the nearest ends. An end is named by the step that
/// starts there.
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

    /// Finds the stroke end nearest to a place on the page.
    [[nodiscard]] PenStep nearest(const glm::vec2& from) const
    {
        const glm::ivec2 middle = cell_of(from);
        std::optional<PenStep> best;
        float least = std::numeric_limits<float>::max();
        for (int ring = 0; ring < rings(); ++ring) {
            // Stops the search if farther rings of cells cannot contain a nearer end. A ring of cells is at
            // least this far from any place in the middle cell.
            if (best && static_cast<float>(ring - 1) * cell_mm_ > least) {
                break;
            }
            visit_ring(middle, ring, [&](const PenStep& step) {
                const float away = glm::distance(from, start_of(strokes_, step));
                if (away < least) {
                    least = away;
                    best = step;
                }
            });
        }
        return best.value();
    }

    /// Finds up to `most_neighbours` ends of other strokes that are nearest to the end where `from` starts,
    /// nearest first.
    void neighbours(const PenStep& from, std::vector<PenStep>& found) const
    {
        const glm::vec2 place = start_of(strokes_, from);
        const glm::ivec2 middle = cell_of(place);
        found.clear();
        const auto away = [&](const PenStep& step) { return glm::distance(place, start_of(strokes_, step)); };
        for (int ring = 0; ring < rings(); ++ring) {
            if (found.size() == most_neighbours &&
                static_cast<float>(ring - 1) * cell_mm_ > away(found.back())) {
                break;
            }
            visit_ring(middle, ring, [&](const PenStep& step) {
                if (step.stroke != from.stroke) {
                    found.push_back(step);
                }
            });
            std::ranges::stable_sort(found, {}, away);
            found.resize(std::min(found.size(), most_neighbours));
        }
    }

    void remove(uint32_t stroke)
    {
        for (const glm::vec2& end : {strokes_[stroke].start, strokes_[stroke].end}) {
            std::erase_if(cells_[index_of(cell_of(end))],
                          [stroke](const PenStep& step) { return step.stroke == stroke; });
        }
    }

private:
    [[nodiscard]] int rings() const { return std::max(size_.x, size_.y); }

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

/// Shortens an order by 2-opt and or-opt. A link is the way of the lifted pen from one step to the next. The
/// link before the first step comes from the origin; no link follows the last step.
class Shortening {
public:
    Shortening(std::span<const PenStroke> strokes, std::vector<PenStep> order, const glm::vec2& origin)
        : strokes_(strokes), order_(std::move(order)), origin_(origin), places_(strokes.size()),
          near_(2 * strokes.size()), is_waiting_(strokes.size(), true)
    {
        const Ends ends(strokes);
        for (size_t i = 0; i < order_.size(); ++i) {
            places_[order_[i].stroke] = i;
            waiting_.push_back(order_[i].stroke);
        }
        for (uint32_t stroke = 0; stroke < strokes.size(); ++stroke) {
            ends.neighbours({stroke, false}, near_[size_t{2} * stroke]);
            ends.neighbours({stroke, true}, near_[size_t{2} * stroke + 1]);
        }
    }

    [[nodiscard]] std::vector<PenStep> run() &&
    {
        while (!waiting_.empty() && shifted_ < most_shifted) {
            const uint32_t stroke = waiting_.front();
            waiting_.pop_front();
            is_waiting_[stroke] = false;
            while (shifted_ < most_shifted && (reverses_a_part_at(stroke) || moves_a_part_at(stroke))) {
            }
        }
        return std::move(order_);
    }

private:
    using Place = size_t; // index into the order

    [[nodiscard]] glm::vec2 start(Place i) const { return start_of(strokes_, order_[i]); }

    [[nodiscard]] glm::vec2 end(Place i) const { return end_of(strokes_, order_[i]); }

    /// Where the pen lies before the step `i`.
    [[nodiscard]] glm::vec2 before(Place i) const { return i == 0 ? origin_ : end(i - 1); }

    /// Length of the way from `from` to the start of the step `i`, which may be one beyond the last.
    [[nodiscard]] double way_to(const glm::vec2& from, Place i) const
    {
        return i < order_.size() ? glm::distance(from, start(i)) : 0.0;
    }

    [[nodiscard]] double link_to(Place i) const { return i < order_.size() ? way_to(before(i), i) : 0.0; }

    /// Nearest ends to the start or to the end of the step `i`.
    [[nodiscard]] const std::vector<PenStep>& near_start(Place i) const
    {
        return near_[size_t{2} * order_[i].stroke + (order_[i].is_turned ? 1 : 0)];
    }

    [[nodiscard]] const std::vector<PenStep>& near_end(Place i) const
    {
        return near_[size_t{2} * order_[i].stroke + (order_[i].is_turned ? 0 : 1)];
    }

    /// Whether the end of a stroke that `there` names is where the pen starts this stroke in the present
    /// order.
    [[nodiscard]] bool is_start(const PenStep& there) const
    {
        return order_[places_[there.stroke]].is_turned == there.is_turned;
    }

    // 2-opt. Two links are replaced: if two starts become neighbours, everything from the first of them to
    // the step before the second is reversed; likewise for two ends.
    bool reverses_a_part_at(uint32_t stroke)
    {
        const Place i = places_[stroke];
        for (const bool from_start : {true, false}) {
            for (const PenStep& there : from_start ? near_start(i) : near_end(i)) {
                if (is_start(there) != from_start) {
                    continue;
                }
                const Place j = places_[there.stroke];
                const Place first = std::min(i, j) + (from_start ? 0 : 1);
                const Place last = std::max(i, j) - (from_start ? 1 : 0);
                if (link_to(first) + link_to(last + 1) - glm::distance(before(first), end(last)) -
                        way_to(start(first), last + 1) >
                    least_saving_mm) {
                    reverse(first, last);
                    wake_around(first, last);
                    return true;
                }
            }
        }
        return false;
    }

    /// A part of the order, and a change of its place: it is moved before the step `target`, which lies
    /// outside of the part, or behind the last step.
    struct Move {
        Place first = 0;
        Place last = 0;
        Place target = 0;
        bool is_turned = false;
    };

    [[nodiscard]] double saving(const Move& move) const
    {
        const glm::vec2 head = move.is_turned ? end(move.last) : start(move.first);
        const glm::vec2 tail = move.is_turned ? start(move.first) : end(move.last);
        const double removed = link_to(move.first) + link_to(move.last + 1) -
                               way_to(before(move.first), move.last + 1) + link_to(move.target);
        return removed - glm::distance(before(move.target), head) - way_to(tail, move.target);
    }

    // Or-opt. A part of the order moves so that one of its two ends touches a near end of another stroke.
    bool moves_a_part_at(uint32_t stroke)
    {
        const Place i = places_[stroke];
        for (size_t count = 1; count <= most_moved; ++count) {
            const Place begins = i;
            if (begins + count <= order_.size() && moves_part(begins, begins + count - 1)) {
                return true;
            }
            if (count > 1 && i + 1 >= count && moves_part(i + 1 - count, i)) {
                return true;
            }
        }
        return false;
    }

    bool moves_part(Place first, Place last)
    {
        for (const bool from_start : {true, false}) {
            for (const PenStep& there : from_start ? near_start(first) : near_end(last)) {
                const Place k = places_[there.stroke];
                if (k >= first && k <= last) {
                    continue;
                }
                // The part follows the step k if it touches its end, and precedes it if it touches its start.
                const bool precedes = is_start(there);
                const Move move{.first = first,
                                .last = last,
                                .target = precedes ? k : k + 1,
                                .is_turned = precedes == from_start};
                if (move.target == first || move.target == last + 1) {
                    continue;
                }
                if (saving(move) > least_saving_mm) {
                    make(move);
                    return true;
                }
            }
        }
        return false;
    }

    void make(const Move& move)
    {
        if (move.is_turned) {
            reverse(move.first, move.last);
        }
        const auto at = [&](Place i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
        const bool goes_forward = move.target > move.last;
        const Place from = goes_forward ? move.first : move.target;
        const Place to = goes_forward ? move.target : move.last + 1;
        std::rotate(at(from), at(goes_forward ? move.last + 1 : move.first), at(to));
        renumber(from, to);
        const size_t count = move.last - move.first + 1;
        const Place now = goes_forward ? move.target - count : move.target;
        wake_around(now, now + count - 1);
        const Place gap = goes_forward ? move.first : move.last + 1;
        wake_around(gap, gap);
    }

    void reverse(Place first, Place last)
    {
        std::reverse(order_.begin() + static_cast<std::ptrdiff_t>(first),
                     order_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
        for (Place i = first; i <= last; ++i) {
            order_[i].is_turned = !order_[i].is_turned;
        }
        renumber(first, last + 1);
    }

    void renumber(Place first, Place end)
    {
        for (Place i = first; i < end; ++i) {
            places_[order_[i].stroke] = i;
        }
        shifted_ += end - first;
    }

    /// The strokes beside changed links are looked at again.
    void wake_around(Place first, Place last)
    {
        for (const Place i : std::array{first - std::min<Place>(first, 1), first, last, last + 1}) {
            if (i < order_.size() && !is_waiting_[order_[i].stroke]) {
                is_waiting_[order_[i].stroke] = true;
                waiting_.push_back(order_[i].stroke);
            }
        }
    }

    std::span<const PenStroke> strokes_;
    std::vector<PenStep> order_;
    glm::vec2 origin_;
    std::vector<Place> places_;              // of each stroke in the order
    std::vector<std::vector<PenStep>> near_; // of the start and of the end of each stroke
    std::vector<bool> is_waiting_;
    std::deque<uint32_t> waiting_; // strokes beside links that may be shortened
    uint64_t shifted_ = 0;
};

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

std::vector<PenStep> greedy_order(std::span<const PenStroke> strokes, const glm::vec2& origin)
{
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
    return order;
}

std::vector<PenStep> shortest_order(std::span<const PenStroke> strokes, const glm::vec2& origin)
{
    std::vector<PenStep> order = greedy_order(strokes, origin);
    return order.size() < 2 ? order : Shortening(strokes, std::move(order), origin).run();
}

} // namespace estampe::output
