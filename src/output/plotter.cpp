// SPDX-License-Identifier: MIT
#include "output/plotter.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include <estampe/vector_drawing.hpp>

#include "output/drawn_pieces.hpp"
#include "output/pen_order.hpp"

namespace estampe::output {
namespace {

// Smallest length of an overlap that is removed. Shorter overlaps are crossings at a small angle, which stay.
constexpr double least_overlap_mm = 1.0;
constexpr float sample_mm = 0.25F;
// Between two strokes, a hatching stroke clogs if both are nearer than this, in widths of the pen.
constexpr float clogged_widths = 0.8F;

constexpr double least_stroke_mm = 1.0; // A shorter stroke is a dot of the pen, which gives no direction

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

double length_mm(const VectorStroke& stroke, size_t first, size_t last)
{
    double sum = 0.0;
    for (size_t i = first; i < last; ++i) {
        sum += static_cast<double>(glm::distance(stroke.points[i].page_mm, stroke.points[i + 1].page_mm));
    }
    return sum;
}

double length_mm(const VectorStroke& stroke)
{
    return length_mm(stroke, 0, stroke.points.size() - 1);
}

/// Keeps covered parts of a stroke that are too short to be seen as a double line, unless the part is the
/// whole stroke.
void keep_short_runs(const VectorStroke& stroke, std::vector<bool>& is_kept)
{
    const auto end = is_kept.end();
    for (auto run = std::find(is_kept.begin(), end, false); run != end;) {
        const auto stop = std::find(run, end, true);
        const bool is_all = run == is_kept.begin() && stop == end;
        const double length = length_mm(stroke, static_cast<size_t>(run - is_kept.begin()),
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

/// Returns the direction of a stroke at one of its points.
glm::vec2 way_at(const VectorStroke& stroke, size_t point)
{
    const size_t before = point > 0 ? point - 1 : 0;
    const size_t after = std::min(point + 1, stroke.points.size() - 1);
    return DrawnPieces::direction(stroke.points[before].page_mm, stroke.points[after].page_mm);
}

} // namespace

void remove_overlaps(VectorDrawing& drawing)
{
    std::vector<DrawnPieces> drawn(drawing.inks_srgb.size(), DrawnPieces(1.0F));
    std::vector<VectorStroke> kept;
    kept.reserve(drawing.strokes.size());
    for (const VectorStroke& stroke : drawing.strokes) {
        DrawnPieces& pieces = drawn.at(stroke.ink);
        const VectorStroke fine = refined(stroke, sample_mm);
        std::vector<bool> is_free(fine.points.size());
        bool all_free = true;
        for (size_t i = 0; i < fine.points.size(); ++i) {
            is_free[i] =
                !pieces.covers(fine.points[i].page_mm, way_at(fine, i), fine.points[i].width_mm / 3.0F);
            all_free = all_free && is_free[i];
        }
        keep_short_runs(fine, is_free);
        const std::vector<VectorStroke> parts =
            all_free ? std::vector<VectorStroke>{stroke} : kept_stretches(fine, is_free);
        for (const VectorStroke& part : parts) {
            pieces.add(part, 0);
            kept.push_back(part);
        }
    }
    drawing.strokes = std::move(kept);
}

void thin_hatching(VectorDrawing& drawing)
{
    const float reach_mm = clogged_widths * drawing.hatch_width_mm;
    std::vector<DrawnPieces> drawn(drawing.inks_srgb.size(), DrawnPieces(std::max(1.0F, reach_mm)));
    std::vector<VectorStroke> fine;
    fine.reserve(drawing.strokes.size());
    for (uint32_t i = 0; i < drawing.strokes.size(); ++i) {
        fine.push_back(refined(drawing.strokes[i], sample_mm));
        drawn.at(fine[i].ink).add(fine[i], i);
    }
    std::vector<VectorStroke> kept;
    kept.reserve(fine.size());
    for (uint32_t i = 0; i < fine.size(); ++i) {
        const VectorStroke& stroke = fine[i];
        DrawnPieces& pieces = drawn.at(stroke.ink);
        std::vector<bool> is_free(stroke.points.size(), true);
        for (size_t k = 0; stroke.kind == StrokeKind::hatch && k < is_free.size(); ++k) {
            is_free[k] = !pieces.encloses(i, stroke.points[k].page_mm, way_at(stroke, k), reach_mm);
        }
        keep_short_runs(stroke, is_free);
        const bool all_free = std::ranges::find(is_free, false) == is_free.end();
        for (size_t k = 0; k + 1 < is_free.size(); ++k) {
            if (!is_free[k] || !is_free[k + 1]) {
                pieces.remove(0.5F * (stroke.points[k].page_mm + stroke.points[k + 1].page_mm), i);
            }
        }
        const std::vector<VectorStroke> parts =
            all_free ? std::vector<VectorStroke>{drawing.strokes[i]} : kept_stretches(stroke, is_free);
        kept.insert(kept.end(), parts.begin(), parts.end());
    }
    drawing.strokes = std::move(kept);
}

namespace {

/// One of the two ends of a stroke, as the place in the list of strokes.
struct StrokeEnd {
    uint32_t stroke = 0;
    bool is_last = false; // the end at the last point of the stroke, not at the first
};

// Length of the part of a stroke that gives the direction of the stroke's end.
constexpr float direction_over_mm = 0.5F;
constexpr float corner_gap_mm = 0.15F; // Largest gap between two strokes that touch at a corner

/// Returns the direction in which a stroke would run on beyond one of its ends.
glm::vec2 way_out(const VectorStroke& stroke, bool is_last)
{
    const size_t count = stroke.points.size();
    const auto point = [&](size_t i) { return stroke.points[is_last ? count - 1 - i : i].page_mm; };
    size_t inside = 1;
    while (inside + 1 < count && glm::distance(point(0), point(inside)) < direction_over_mm) {
        ++inside;
    }
    return DrawnPieces::direction(point(inside), point(0));
}

const VectorPoint& point_of(const VectorStroke& stroke, bool is_last)
{
    return is_last ? stroke.points.back() : stroke.points.front();
}

/// Two ends of strokes that may be joined.
struct Joint {
    StrokeEnd one;
    StrokeEnd other;
    float cost = 0.0F; // in millimetres
};

/// Returns how far a pair of ends is from one line without a break, or nothing if the ends must not be
/// joined. Two ends continue each other if the bend is at most 26 degrees, and if the gap is at most the
/// width of the pen, or twice this width for hatching. Lines that touch at a corner are joined if one of the
/// two lines is too short to be drawn by itself.
std::optional<float> joint_cost(const VectorStroke& a, bool a_last, const VectorStroke& b, bool b_last,
                                float pen_mm)
{
    constexpr float least_cosine = 0.9F;
    constexpr float corner_cost_mm = 2.0F;
    const bool is_hatch = a.kind == StrokeKind::hatch;
    if (a.ink != b.ink || is_hatch != (b.kind == StrokeKind::hatch)) {
        return std::nullopt;
    }
    const glm::vec2 from = point_of(a, a_last).page_mm;
    const glm::vec2 to = point_of(b, b_last).page_mm;
    const float gap_mm = glm::distance(from, to);
    const glm::vec2 out = way_out(a, a_last);
    const float straight = -glm::dot(out, way_out(b, b_last));
    const float ahead = gap_mm > 0.5F * pen_mm ? glm::dot(out, to - from) / gap_mm : 1.0F;
    if (gap_mm <= (is_hatch ? 2.0F : 1.0F) * pen_mm && straight >= least_cosine && ahead >= least_cosine) {
        return gap_mm + 1.0F - straight;
    }
    if (!is_hatch && gap_mm <= corner_gap_mm &&
        (length_mm(a) < least_stroke_mm || length_mm(b) < least_stroke_mm)) {
        return corner_cost_mm + gap_mm + 1.0F - straight;
    }
    return std::nullopt;
}

/// Finds all pairs of ends that may be joined, the best pairs first.
std::vector<Joint> joints_of(const VectorDrawing& drawing)
{
    const std::vector<VectorStroke>& strokes = drawing.strokes;
    const float reach_mm = std::max(2.0F * drawing.hatch_width_mm, corner_gap_mm);
    std::unordered_map<uint64_t, std::vector<StrokeEnd>> cells;
    std::vector<Joint> joints;
    for (uint32_t i = 0; i < strokes.size(); ++i) {
        if (strokes[i].is_closed || strokes[i].is_hidden) { // dashes of hidden lines stay apart
            continue;
        }
        for (const bool is_last : {false, true}) {
            const glm::ivec2 cell(glm::floor(point_of(strokes[i], is_last).page_mm / reach_mm));
            for (int k = 0; k < 9; ++k) {
                const auto found = cells.find(DrawnPieces::key_of(cell + glm::ivec2(k % 3 - 1, k / 3 - 1)));
                if (found == cells.end()) {
                    continue;
                }
                for (const StrokeEnd& other : found->second) {
                    const auto cost = other.stroke == i
                                          ? std::nullopt
                                          : joint_cost(strokes[i], is_last, strokes[other.stroke],
                                                       other.is_last, drawing.hatch_width_mm);
                    if (cost) {
                        joints.push_back({{i, is_last}, other, *cost});
                    }
                }
            }
            cells[DrawnPieces::key_of(cell)].push_back({i, is_last});
        }
    }
    std::ranges::stable_sort(joints, {}, &Joint::cost);
    return joints;
}

/// Strokes, each with the strokes that continue it at its two ends.
class JoinedStrokes {
public:
    explicit JoinedStrokes(const std::vector<VectorStroke>& strokes)
        : strokes_(strokes), next_(2 * strokes.size()), whole_(strokes.size())
    {
        std::iota(whole_.begin(), whole_.end(), 0U);
    }

    /// Joins two ends, unless one of them is joined already or the joint would close a loop.
    void join(const StrokeEnd& one, const StrokeEnd& other)
    {
        const uint32_t a = whole_of(one.stroke);
        const uint32_t b = whole_of(other.stroke);
        if (a != b && !next_[index_of(one)] && !next_[index_of(other)]) {
            next_[index_of(one)] = other;
            next_[index_of(other)] = one;
            whole_[std::max(a, b)] = std::min(a, b);
        }
    }

    /// Returns the joined strokes, in the order of their first parts. The longest part gives a joined stroke
    /// its kind and object.
    [[nodiscard]] std::vector<VectorStroke> wholes() const
    {
        std::vector<VectorStroke> wholes;
        std::vector<bool> is_done(strokes_.size());
        for (uint32_t i = 0; i < strokes_.size(); ++i) {
            if (is_done[i]) {
                continue;
            }
            StrokeEnd start{i, false};
            while (const auto before = next_[index_of(start)]) {
                start = {before->stroke, !before->is_last};
            }
            wholes.push_back(whole_from(start, is_done));
        }
        return wholes;
    }

private:
    [[nodiscard]] static size_t index_of(const StrokeEnd& end)
    {
        return size_t{2} * end.stroke + (end.is_last ? 1 : 0);
    }

    uint32_t whole_of(uint32_t stroke)
    {
        while (whole_[stroke] != stroke) {
            whole_[stroke] = whole_[whole_[stroke]];
            stroke = whole_[stroke];
        }
        return stroke;
    }

    [[nodiscard]] VectorStroke whole_from(const StrokeEnd& start, std::vector<bool>& is_done) const
    {
        std::optional<StrokeEnd> at = start;
        VectorStroke whole = without_points(strokes_[start.stroke]);
        whole.is_closed = strokes_[start.stroke].is_closed;
        double longest_mm = -1.0;
        while (at) {
            const VectorStroke& part = strokes_[at->stroke];
            is_done[at->stroke] = true;
            const double part_mm = length_mm(part);
            if (part_mm > longest_mm) {
                longest_mm = part_mm;
                whole.kind = part.kind;
                whole.object = part.object;
            }
            std::vector<VectorPoint> points = part.points;
            if (at->is_last) {
                std::reverse(points.begin(), points.end());
            }
            const bool touches =
                !whole.points.empty() && whole.points.back().page_mm == points.front().page_mm;
            whole.points.insert(whole.points.end(), points.begin() + (touches ? 1 : 0), points.end());
            at = next_[index_of({at->stroke, !at->is_last})];
        }
        return whole;
    }

    const std::vector<VectorStroke>& strokes_;
    std::vector<std::optional<StrokeEnd>> next_; // of the first and of the last point of each stroke
    std::vector<uint32_t> whole_;                // a joined stroke has the number of its first part
};

} // namespace

void join_strokes(VectorDrawing& drawing)
{
    JoinedStrokes joined(drawing.strokes);
    for (const Joint& joint : joints_of(drawing)) {
        joined.join(joint.one, joint.other);
    }
    drawing.strokes = joined.wholes();
}

void remove_scraps(VectorDrawing& drawing)
{
    constexpr float beside_mm = 1.5F;
    DrawnPieces lines(beside_mm);
    for (uint32_t i = 0; i < drawing.strokes.size(); ++i) {
        if (drawing.strokes[i].kind != StrokeKind::hatch) {
            lines.add(drawing.strokes[i], i);
        }
    }
    std::vector<VectorStroke> kept;
    kept.reserve(drawing.strokes.size());
    for (uint32_t i = 0; i < drawing.strokes.size(); ++i) {
        const VectorStroke& stroke = drawing.strokes[i];
        const glm::vec2 middle = stroke.points[stroke.points.size() / 2].page_mm;
        if (stroke.is_hidden || length_mm(stroke) >= least_stroke_mm ||
            (stroke.kind != StrokeKind::hatch && !lines.has_another(i, middle, beside_mm))) {
            kept.push_back(stroke);
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

} // namespace estampe::output

namespace estampe {
namespace {

std::vector<output::PenStroke> pen_strokes(const std::vector<VectorStroke>& strokes)
{
    std::vector<output::PenStroke> ends;
    ends.reserve(strokes.size());
    for (const VectorStroke& stroke : strokes) {
        ends.push_back({stroke.points.front().page_mm, stroke.points.back().page_mm});
    }
    return ends;
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
        work.drawn_mm += output::length_mm(stroke);
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
    output::thin_hatching(drawing);
    output::join_strokes(drawing);
    output::remove_scraps(drawing);
    std::vector<std::vector<VectorStroke>> pens = by_pen(drawing);
    drawing.strokes.clear();
    for (std::vector<VectorStroke>& strokes : pens) {
        for (const output::PenStep& step : output::shortest_order(pen_strokes(strokes), glm::vec2(0.0F))) {
            VectorStroke stroke = std::move(strokes[step.stroke]);
            if (step.is_turned) {
                std::reverse(stroke.points.begin(), stroke.points.end());
            }
            drawing.strokes.push_back(std::move(stroke));
        }
    }
}

} // namespace estampe
