// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/stroke/line_paths.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <glm/gtc/packing.hpp>

namespace estampe::contour {
namespace {

// Largest length of a line from one sample to the next, in usual sample distances. A longer line leaves the
// page and returns, so the line is not drawn. The constant is equal in split.comp.
constexpr float most_stretch = 3.0F;

bool has(const shared::LineSample& sample, uint32_t bit)
{
    return (sample.state & bit) != 0;
}

/// Counts the kinds of line along a path, to find the most frequent kind.
class KindCount {
public:
    void add(uint32_t kind) { ++counts_.at(kind); }

    [[nodiscard]] uint32_t most() const
    {
        return static_cast<uint32_t>(std::ranges::max_element(counts_) - counts_.begin());
    }

private:
    std::array<uint32_t, shared::line_kind_count> counts_{};
};

class Reader {
public:
    Reader(const LineLists& lists, const EdgeMesh& mesh) : lists_(lists), mesh_(mesh) {}

    /// Appends the paths of all strokes that lie between the samples `first` and `last`.
    void add_strokes(uint32_t first, uint32_t last, std::vector<LinePath>& paths) const
    {
        for (uint32_t start = first; start < last;) {
            if (!has(lists_.samples[start], shared::piece_is_there)) {
                ++start;
                continue;
            }
            uint32_t end = start + 1;
            while (end < last && has(lists_.samples[end], shared::piece_is_there) &&
                   lists_.strokes_before[end + 1] == lists_.strokes_before[start + 1]) {
                ++end;
            }
            paths.push_back(stroke(start, end));
            start = end;
        }
    }

    void add_hidden(uint32_t first, uint32_t last, const LineWidths& widths_px,
                    std::vector<LinePath>& paths) const
    {
        for (uint32_t start = first; start < last;) {
            uint32_t end = start;
            KindCount kinds;
            while (end < last && is_hidden_piece(end)) {
                kinds.add(kind_at(end));
                ++end;
            }
            if (end > start) {
                LinePath path{
                    .kind = kinds.most(), .triangle = triangle_of(lists_.samples[start]), .is_hidden = true};
                for (uint32_t i = start; i <= end; ++i) {
                    path.points.push_back({lists_.samples[i].page_px, widths_px.at(path.kind)});
                }
                paths.push_back(std::move(path));
            }
            start = std::max(end, start + 1);
        }
    }

private:
    [[nodiscard]] static uint32_t triangle_of(const shared::LineSample& sample)
    {
        return (sample.source & 0x0fffffffU) >> 2U;
    }

    [[nodiscard]] bool is_front(uint32_t triangle) const
    {
        const bool is_turned = (mesh_.neighbors[triangle].w & neighbor_is_turned) != 0;
        return ((lists_.facing[triangle / 32] >> (triangle & 31U) & 1U) != 0) != is_turned;
    }

    /// The kind of line at a sample. As in shape.comp, a fold or boundary counts as an outline if the surface
    /// behind it faces away from the eye.
    [[nodiscard]] uint32_t kind_at(uint32_t sample) const
    {
        const uint32_t kind = lists_.samples[sample].source >> 28U;
        const uint32_t side = lists_.samples[sample].source & 0x0fffffffU;
        if (kind == shared::line_silhouette || kind == shared::line_border || (side & 3U) == 3U) {
            return kind;
        }
        const uint32_t beyond = mesh_.neighbors[side >> 2U][static_cast<int>(side & 3U)];
        return beyond != no_side && is_front(side >> 2U) != is_front(beyond >> 2U) ? shared::line_silhouette
                                                                                   : kind;
    }

    [[nodiscard]] LinePath stroke(uint32_t start, uint32_t end) const
    {
        LinePath path{.triangle = triangle_of(lists_.samples[start]),
                      .ink = lists_.points[2UL * start].ink,
                      .is_closed = has(lists_.samples[start], shared::sample_in_ring)};
        KindCount kinds;
        path.points.reserve(end - start + 1);
        for (uint32_t i = start; i <= end; ++i) {
            const shared::LinePoint& point = lists_.points[2UL * i + (i == start ? 0 : 1)];
            path.points.push_back({point.page_px, 2.0F * point.half_width_px});
            if (i < end) {
                kinds.add(kind_at(i));
            }
        }
        path.kind = kinds.most();
        return path;
    }

    [[nodiscard]] bool is_hidden_piece(uint32_t i) const
    {
        const shared::LineSample& from = lists_.samples[i];
        const shared::LineSample& to = lists_.samples[i + 1];
        const float spacing_px = glm::unpackHalf1x16(static_cast<uint16_t>(from.state >> 16U));
        return !has(from, shared::piece_is_there) && !has(from, shared::sample_is_off_page) &&
               !has(to, shared::sample_is_off_page) &&
               glm::distance(from.page_px, to.page_px) < most_stretch * std::max(spacing_px, 1.0F);
    }

    const LineLists& lists_;
    const EdgeMesh& mesh_;
};

} // namespace

std::vector<LinePath> line_paths(const LineLists& lists, const EdgeMesh& mesh,
                                 const std::optional<LineWidths>& hidden_widths_px)
{
    const Reader reader(lists, mesh);
    std::vector<LinePath> paths;
    const uint32_t slots = lists.sizes[shared::list_slots].count;
    const uint32_t samples = lists.sizes[shared::list_samples].count;
    for (uint32_t slot = 0; slot < slots; ++slot) {
        const uint32_t first = lists.samples_before[slot];
        const uint32_t end = lists.samples_before[slot + 1];
        if (end > samples || end < first + 2) {
            continue;
        }
        reader.add_strokes(first, end - 1, paths);
        if (hidden_widths_px) {
            reader.add_hidden(first, end - 1, *hidden_widths_px, paths);
        }
    }
    return paths;
}

namespace {

// Largest distance, in pixels, between ends of lines that count as one place. The constant is equal in
// joints.comp.
constexpr float one_place_px = 1.5F;
constexpr float cell_px = 4.0F;
// Angle of 130 degrees between two lines at a place: with a greater angle, one goes straight on as the other.
constexpr float least_straight_rad = 2.27F;

/// Number of an end of a path: the path with number i starts at end 2 i and finishes at end 2 i + 1.
using EndNumber = size_t;

class Joiner {
public:
    Joiner(std::vector<LinePath> paths, const JoinRule& rule) : paths_(std::move(paths)), rule_(rule)
    {
        may_join_.resize(paths_.size());
        for (size_t i = 0; i < paths_.size(); ++i) {
            may_join_[i] = !paths_[i].is_closed && !paths_[i].is_hidden && paths_[i].points.size() > 1;
            if (may_join_[i]) {
                for (const EndNumber end : {2 * i, 2 * i + 1}) {
                    if (point(end).width_px > 0.0F) {
                        ends_.emplace(cell_of(point(end).page_px), end);
                    }
                }
            }
        }
        std::vector<std::optional<EndNumber>> wanted(2 * paths_.size());
        for (const auto& [cell, end] : ends_) {
            wanted[end] = partner_of(end);
        }
        partners_.resize(wanted.size());
        for (EndNumber end = 0; end < wanted.size(); ++end) {
            if (wanted[end] && wanted[*wanted[end]] == end) {
                partners_[end] = wanted[end];
            }
        }
        join_short_paths();
    }

    [[nodiscard]] std::vector<LinePath> join()
    {
        std::vector<LinePath> joined;
        is_taken_.assign(paths_.size(), false);
        for (size_t i = 0; i < paths_.size(); ++i) { // joins the paths that have a free end first
            if (!is_taken_[i] && (!partners_[2 * i] || !partners_[2 * i + 1])) {
                joined.push_back(walk(partners_[2 * i] ? 2 * i + 1 : 2 * i));
            }
        }
        for (size_t i = 0; i < paths_.size(); ++i) { // joins the remaining paths, which form closed rings
            if (!is_taken_[i]) {
                joined.push_back(around(i));
            }
        }
        return joined;
    }

private:
    using Cell = std::pair<int, int>;

    static Cell cell_of(const glm::vec2& page_px)
    {
        return {static_cast<int>(std::floor(page_px.x / cell_px)),
                static_cast<int>(std::floor(page_px.y / cell_px))};
    }

    [[nodiscard]] const PathPoint& point(EndNumber end) const
    {
        const LinePath& path = paths_[end / 2];
        return end % 2 == 0 ? path.points.front() : path.points.back();
    }

    [[nodiscard]] glm::vec2 inwards(EndNumber end) const
    {
        const auto& points = paths_[end / 2].points;
        return end % 2 == 0 ? points[1].page_px - points[0].page_px
                            : points[points.size() - 2].page_px - points.back().page_px;
    }

    [[nodiscard]] std::optional<EndNumber> partner_of(EndNumber own) const
    {
        const std::optional<EndNumber> ahead = rule_.goes_straight_on ? straight_ahead_of(own) : std::nullopt;
        return ahead ? ahead : enclosing_partner_of(own);
    }

    /// Calls `take(other, angle)` for all ends of other paths at the place of `own`. The angle is that from
    /// the path of `own` to the other path.
    template <class Take>
    void visit_ends_at(EndNumber own, const Take& take) const
    {
        const glm::vec2 way = inwards(own);
        const Cell middle = cell_of(point(own).page_px);
        for (int i = 0; i < 9; ++i) {
            const auto [first, last] =
                ends_.equal_range({middle.first + i % 3 - 1, middle.second + i / 3 - 1});
            for (auto it = first; it != last; ++it) {
                const EndNumber other = it->second;
                if (other / 2 != own / 2 &&
                    glm::distance(point(other).page_px, point(own).page_px) <= one_place_px) {
                    const glm::vec2 there = inwards(other);
                    take(other, std::atan2(way.x * there.y - way.y * there.x, glm::dot(way, there)));
                }
            }
        }
    }

    /// The end with which the line goes on most nearly straight.
    [[nodiscard]] std::optional<EndNumber> straight_ahead_of(EndNumber own) const
    {
        std::optional<EndNumber> straightest;
        float most_rad = least_straight_rad;
        visit_ends_at(own, [&](EndNumber other, float angle) {
            if (std::abs(angle) > most_rad && goes_with(own, other)) {
                straightest = other;
                most_rad = std::abs(angle);
            }
        });
        return straightest;
    }

    /// Among the ends at the place of `own`, finds the end that, together with `own`, encloses all ends at
    /// the place. Finds none if lines leave in all directions.
    [[nodiscard]] std::optional<EndNumber> enclosing_partner_of(EndNumber own) const
    {
        std::optional<EndNumber> left;
        std::optional<EndNumber> right;
        float left_rad = 0.0F;
        float right_rad = 0.0F;
        visit_ends_at(own, [&](EndNumber other, float angle) {
            if (angle > left_rad) {
                left = other;
                left_rad = angle;
            } else if (angle < right_rad) {
                right = other;
                right_rad = angle;
            }
        });
        const std::optional<EndNumber> partner = left && right ? std::nullopt : left ? left : right;
        return partner && goes_with(own, *partner) ? partner : std::nullopt;
    }

    [[nodiscard]] bool goes_with(EndNumber a, EndNumber b) const
    {
        return is_alike(a, b) && (paths_[a / 2].kind == paths_[b / 2].kind || !rule_.only_one_kind);
    }

    /// Whether both ends have one ink and much the same width.
    [[nodiscard]] bool is_alike(EndNumber a, EndNumber b) const
    {
        const float wider_px = std::max(point(a).width_px, point(b).width_px);
        return paths_[a / 2].ink == paths_[b / 2].ink &&
               std::abs(point(a).width_px - point(b).width_px) <= rule_.most_width_change * wider_px;
    }

    [[nodiscard]] static float length_px(const LinePath& path)
    {
        float length = 0.0F;
        for (size_t i = 1; i < path.points.size(); ++i) {
            length += glm::distance(path.points[i - 1].page_px, path.points[i].page_px);
        }
        return length;
    }

    /// Pairs each free end of a short path with the free end there that bends least, so that no scrap is
    /// left.
    void join_short_paths()
    {
        for (EndNumber end = 0; end < partners_.size(); ++end) {
            if (partners_[end] || !may_join_[end / 2] || length_px(paths_[end / 2]) >= rule_.shortest_px) {
                continue;
            }
            std::optional<EndNumber> straightest;
            float most_rad = 0.0F;
            visit_ends_at(end, [&](EndNumber other, float angle) {
                if (!partners_[other] && std::abs(angle) > most_rad && is_alike(end, other)) {
                    straightest = other;
                    most_rad = std::abs(angle);
                }
            });
            if (straightest) {
                partners_[end] = straightest;
                partners_[*straightest] = end;
            }
        }
    }

    /// Joins all paths that follow each other, from the free end `start` on. The result has the kind of line
    /// of its longest part.
    [[nodiscard]] LinePath walk(EndNumber start)
    {
        LinePath path = paths_[start / 2];
        path.points.clear();
        size_t most_points = 0;
        std::optional<EndNumber> next = start;
        while (next && !is_taken_[*next / 2]) {
            is_taken_[*next / 2] = true;
            const LinePath& part = paths_[*next / 2];
            std::vector<PathPoint> points = part.points;
            if (points.size() > most_points) {
                most_points = points.size();
                path.kind = part.kind;
                path.triangle = part.triangle;
            }
            if (*next % 2 == 1) {
                std::ranges::reverse(points);
            }
            path.points.insert(path.points.end(), points.begin() + (path.points.empty() ? 0 : 1),
                               points.end());
            next = partners_[*next ^ 1U];
        }
        return path;
    }

    /// Joins the closed ring of paths that contains path `i`. The result starts in the middle of path `i`.
    [[nodiscard]] LinePath around(size_t i)
    {
        const auto half = static_cast<std::ptrdiff_t>(paths_[i].points.size() / 2);
        LinePath path = walk(2 * i);
        path.points.pop_back(); // the last point repeats the first point, apart from rounding
        std::rotate(path.points.begin(), path.points.begin() + half, path.points.end());
        path.points.push_back(path.points.front());
        path.is_closed = true;
        return path;
    }

    std::vector<LinePath> paths_;
    JoinRule rule_;
    std::multimap<Cell, EndNumber> ends_;
    std::vector<std::optional<EndNumber>> partners_;
    std::vector<bool> may_join_; ///< for each path: neither closed nor hidden
    std::vector<bool> is_taken_;
};

} // namespace

std::vector<LinePath> join_paths(std::vector<LinePath> paths, const JoinRule& rule)
{
    return Joiner(std::move(paths), rule).join();
}

} // namespace estampe::contour
