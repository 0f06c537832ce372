// SPDX-License-Identifier: MIT
#include "output/plotter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include <estampe/vector_drawing.hpp>

namespace estampe::output {
namespace {

// Two strokes are parallel if the cosine of the angle between them is at least this; the angle is at most 6
// degrees.
constexpr float parallel_cosine = 0.995F;
// Smallest length of an overlap that is removed. Shorter overlaps are crossings at a small angle, which stay.
constexpr float least_overlap_mm = 1.0F;
constexpr float cell_mm = 1.0F;
constexpr float sample_mm = 0.25F;

/// A short piece of a stroke that is already drawn.
struct Piece {
    glm::vec2 from{0.0F};
    glm::vec2 to{0.0F};
};

class DrawnPieces {
public:
    /// Returns whether a piece of an earlier stroke lies within `reach_mm` of `place` and is parallel to the
    /// direction `way`.
    [[nodiscard]] bool covers(const glm::vec2& place, const glm::vec2& way, float reach_mm) const
    {
        const glm::ivec2 middle = cell_of(place);
        for (int i = 0; i < 9; ++i) {
            const auto found = cells_.find(key_of(middle + glm::ivec2(i % 3 - 1, i / 3 - 1)));
            if (found != cells_.end() && std::ranges::any_of(found->second, [&](const Piece& piece) {
                    return std::abs(glm::dot(way, direction(piece.from, piece.to))) > parallel_cosine &&
                           distance_to(place, piece) <= reach_mm;
                })) {
                return true;
            }
        }
        return false;
    }

    void add(const VectorStroke& stroke)
    {
        for (size_t i = 1; i < stroke.points.size(); ++i) {
            const Piece piece{stroke.points[i - 1].page_mm, stroke.points[i].page_mm};
            const int steps = 1 + static_cast<int>(glm::distance(piece.from, piece.to) / (0.5F * cell_mm));
            for (int k = 0; k < steps; ++k) {
                const Piece part{
                    glm::mix(piece.from, piece.to, static_cast<float>(k) / static_cast<float>(steps)),
                    glm::mix(piece.from, piece.to, static_cast<float>(k + 1) / static_cast<float>(steps))};
                cells_[key_of(cell_of(0.5F * (part.from + part.to)))].push_back(part);
            }
        }
    }

    [[nodiscard]] static glm::vec2 direction(const glm::vec2& from, const glm::vec2& to)
    {
        const float length = glm::distance(from, to);
        return length > 0.0F ? (to - from) / length : glm::vec2(0.0F);
    }

private:
    [[nodiscard]] static float distance_to(const glm::vec2& place, const Piece& piece)
    {
        const glm::vec2 way = piece.to - piece.from;
        const float along =
            glm::clamp(glm::dot(place - piece.from, way) / std::max(glm::dot(way, way), 1e-12F), 0.0F, 1.0F);
        return glm::distance(place, piece.from + along * way);
    }

    [[nodiscard]] static glm::ivec2 cell_of(const glm::vec2& place) { return {glm::floor(place / cell_mm)}; }

    [[nodiscard]] static uint64_t key_of(const glm::ivec2& cell)
    {
        return static_cast<uint64_t>(static_cast<uint32_t>(cell.x)) << 32U | static_cast<uint32_t>(cell.y);
    }

    std::unordered_map<uint64_t, std::vector<Piece>> cells_;
};

VectorStroke without_points(const VectorStroke& stroke)
{
    VectorStroke copy = stroke;
    copy.points.clear();
    copy.is_closed = false;
    return copy;
}

/// Resamples a stroke with points at most `step_mm` apart.
VectorStroke refined(const VectorStroke& stroke, float step_mm)
{
    VectorStroke fine = stroke;
    fine.points.clear();
    for (size_t i = 0; i + 1 < stroke.points.size(); ++i) {
        const VectorPoint& a = stroke.points[i];
        const VectorPoint& b = stroke.points[i + 1];
        const int steps = 1 + static_cast<int>(glm::distance(a.page_mm, b.page_mm) / step_mm);
        for (int k = 0; k < steps; ++k) {
            const float share = static_cast<float>(k) / static_cast<float>(steps);
            fine.points.push_back(
                {glm::mix(a.page_mm, b.page_mm, share), glm::mix(a.width_mm, b.width_mm, share)});
        }
    }
    fine.points.push_back(stroke.points.back());
    return fine;
}

float length_mm(const VectorStroke& stroke, size_t first, size_t last)
{
    float sum = 0.0F;
    for (size_t i = first; i < last; ++i) {
        sum += glm::distance(stroke.points[i].page_mm, stroke.points[i + 1].page_mm);
    }
    return sum;
}

/// Keeps covered parts of a stroke that are too short to be seen as a double line, unless the part is the
/// whole stroke.
void keep_short_runs(const VectorStroke& stroke, std::vector<bool>& is_kept)
{
    const auto end = is_kept.end();
    for (auto run = std::find(is_kept.begin(), end, false); run != end;) {
        const auto stop = std::find(run, end, true);
        const bool is_all = run == is_kept.begin() && stop == end;
        const float length = length_mm(stroke, static_cast<size_t>(run - is_kept.begin()),
                                       static_cast<size_t>(stop - is_kept.begin()) - 1);
        if (!is_all && length < least_overlap_mm) {
            std::fill(run, stop, true);
        }
        run = std::find(stop, end, false);
    }
}

/// Returns the parts of `stroke` whose points are kept, as separate strokes; parts of a single point are
/// dropped.
std::vector<VectorStroke> kept_stretches(const VectorStroke& stroke, const std::vector<bool>& is_kept)
{
    std::vector<VectorStroke> kept;
    if (std::ranges::find(is_kept, false) == is_kept.end()) {
        kept.push_back(stroke);
        return kept;
    }
    VectorStroke open = without_points(stroke);
    for (size_t i = 0; i <= stroke.points.size(); ++i) {
        if (i < stroke.points.size() && is_kept[i]) {
            open.points.push_back(stroke.points[i]);
            continue;
        }
        if (open.points.size() > 1) {
            kept.push_back(open);
        }
        open.points.clear();
    }
    return kept;
}

} // namespace

void remove_overlaps(VectorDrawing& drawing)
{
    std::vector<DrawnPieces> drawn(drawing.inks_srgb.size());
    std::vector<VectorStroke> kept;
    kept.reserve(drawing.strokes.size());
    for (const VectorStroke& stroke : drawing.strokes) {
        DrawnPieces& pieces = drawn.at(stroke.ink);
        const VectorStroke fine = refined(stroke, sample_mm);
        std::vector<bool> is_free(fine.points.size());
        bool all_free = true;
        for (size_t i = 0; i < fine.points.size(); ++i) {
            const size_t before = i > 0 ? i - 1 : 0;
            const size_t after = std::min(i + 1, fine.points.size() - 1);
            const glm::vec2 way =
                DrawnPieces::direction(fine.points[before].page_mm, fine.points[after].page_mm);
            is_free[i] = !pieces.covers(fine.points[i].page_mm, way, fine.points[i].width_mm / 3.0F);
            all_free = all_free && is_free[i];
        }
        keep_short_runs(fine, is_free);
        const std::vector<VectorStroke> parts =
            all_free ? std::vector<VectorStroke>{stroke} : kept_stretches(fine, is_free);
        for (const VectorStroke& part : parts) {
            pieces.add(part);
            kept.push_back(part);
        }
    }
    drawing.strokes = std::move(kept);
}

void cut_dashes(VectorDrawing& drawing)
{
    std::vector<VectorStroke> cut;
    cut.reserve(drawing.strokes.size());
    for (const VectorStroke& stroke : drawing.strokes) {
        if (!stroke.is_hidden) {
            cut.push_back(stroke);
            continue;
        }
        const VectorStroke fine = refined(stroke, 0.1F);
        std::vector<bool> is_kept(fine.points.size());
        float at_mm = 0.0F;
        for (size_t i = 0; i < fine.points.size(); ++i) {
            at_mm += i > 0 ? glm::distance(fine.points[i - 1].page_mm, fine.points[i].page_mm) : 0.0F;
            is_kept[i] = std::fmod(at_mm, drawing.dash_mm + drawing.dash_gap_mm) <= drawing.dash_mm;
        }
        const std::vector<VectorStroke> dashes = kept_stretches(fine, is_kept);
        cut.insert(cut.end(), dashes.begin(), dashes.end());
    }
    drawing.strokes = std::move(cut);
}

void remove_thin_hatching(VectorDrawing& drawing)
{
    std::vector<VectorStroke> kept;
    kept.reserve(drawing.strokes.size());
    for (const VectorStroke& stroke : drawing.strokes) {
        std::vector<bool> is_kept(stroke.points.size(), true);
        if (stroke.kind == StrokeKind::hatch) {
            for (size_t i = 0; i < is_kept.size(); ++i) {
                is_kept[i] = stroke.points[i].width_mm >= 0.5F * drawing.hatch_width_mm;
            }
        }
        const std::vector<VectorStroke> parts = kept_stretches(stroke, is_kept);
        kept.insert(kept.end(), parts.begin(), parts.end());
    }
    drawing.strokes = std::move(kept);
}

// Source: Croes, "A Method for Solving Traveling-Salesman Problems", Operations Research 6, 1958.

namespace {

/// Grid with the ends of the strokes that are not drawn yet, for a fast search of the nearest end.
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
        const int rings = std::max(size_.x, size_.y);
        for (int ring = 0; ring <= rings; ++ring) {
            // Stops the search if farther rings of cells cannot contain a nearer end. A ring of cells is at
            // least this far from any place in the middle cell.
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

/// Length of pen travel that is saved if the steps from `first` to `last` are reversed.
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
    constexpr size_t farthest = 1500; // Largest number of consecutive strokes that one step of 2-opt reverses
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

namespace estampe {
namespace {

constexpr uint64_t turn_budget = 200'000'000; // Number of comparisons in 2-opt; they take about one second

std::vector<output::PenStroke> pen_strokes(const std::vector<VectorStroke>& strokes)
{
    std::vector<output::PenStroke> ends;
    ends.reserve(strokes.size());
    for (const VectorStroke& stroke : strokes) {
        ends.push_back({stroke.points.front().page_mm, stroke.points.back().page_mm});
    }
    return ends;
}

double length_mm(const VectorStroke& stroke)
{
    double sum = 0.0;
    for (size_t i = 1; i < stroke.points.size(); ++i) {
        sum += glm::distance(stroke.points[i - 1].page_mm, stroke.points[i].page_mm);
    }
    return sum;
}

/// Sorts the strokes by pen; the strokes of each pen keep their order.
std::vector<std::vector<VectorStroke>> by_pen(const VectorDrawing& drawing)
{
    std::vector<std::vector<VectorStroke>> pens(drawing.inks_srgb.size());
    for (const VectorStroke& stroke : drawing.strokes) {
        pens.at(stroke.ink).push_back(stroke);
    }
    return pens;
}

} // namespace

PlotterWork plotter_work(const VectorDrawing& drawing)
{
    PlotterWork work{.strokes = drawing.strokes.size()};
    for (const VectorStroke& stroke : drawing.strokes) {
        work.drawn_mm += length_mm(stroke);
    }
    for (const auto& strokes : by_pen(drawing)) {
        std::vector<output::PenStep> order(strokes.size());
        for (uint32_t i = 0; i < order.size(); ++i) {
            order[i].stroke = i;
        }
        work.lifted_mm += output::travel_mm(pen_strokes(strokes), order, glm::vec2(0.0F));
    }
    return work;
}

void prepare_for_plotter(VectorDrawing& drawing)
{
    output::remove_thin_hatching(drawing);
    output::cut_dashes(drawing);
    output::remove_overlaps(drawing);
    std::erase_if(drawing.strokes, [&](const VectorStroke& stroke) {
        // A stroke shorter than the hatching width would be drawn as a blot.
        return length_mm(stroke) < drawing.hatch_width_mm;
    });
    std::vector<std::vector<VectorStroke>> pens = by_pen(drawing);
    drawing.strokes.clear();
    for (std::vector<VectorStroke>& strokes : pens) {
        for (const output::PenStep& step :
             output::shortest_order(pen_strokes(strokes), glm::vec2(0.0F), turn_budget)) {
            VectorStroke stroke = std::move(strokes[step.stroke]);
            if (step.is_turned) {
                std::reverse(stroke.points.begin(), stroke.points.end());
            }
            drawing.strokes.push_back(std::move(stroke));
        }
    }
}

} // namespace estampe
