// SPDX-License-Identifier: MIT
#include "techniques/hatch/trace/trace.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include <glm/gtc/packing.hpp>

#include "gpu/graph/execute.hpp"
#include "shaders/trace_comp.hpp"
#include "techniques/hatch/hatch.hpp"

namespace estampe::hatch {
namespace {

// Largest number of crossings at a black pixel with strokes one pixel wide.
constexpr float crossings_per_width = 4.0F;
constexpr float least_step_px = 0.6F;
constexpr size_t none = ~size_t{0};

auto order_of(const shared::Crossing& crossing)
{
    return std::tie(crossing.draw, crossing.line, crossing.number, crossing.edge, crossing.place_and_width);
}

bool is_same_line(const shared::Crossing& a, const shared::Crossing& b)
{
    return a.draw == b.draw && a.line == b.line && a.number == b.number;
}

/// A crossing (point where a line passes between two pixels) on the border of a square of four pixels.
struct Corner {
    uint32_t square = 0; ///< index of the upper left pixel of the square
    size_t crossing = 0;
};

using Links = std::array<size_t, 2>;

class Stringing {
public:
    Stringing(std::span<const shared::Crossing> sorted, const glm::uvec2& size_px)
        : crossings_(sorted), size_px_(size_px), links_(sorted.size(), {none, none}),
          is_linked_(sorted.size(), false)
    {
        points_.reserve(sorted.size());
        for (const shared::Crossing& crossing : sorted) {
            points_.push_back(point_of(crossing));
        }
    }

    /// Links the crossings of one line to strokes and appends the strokes to `strokes`. The line consists of
    /// the crossings from index `first` to before index `last`.
    void add_line(size_t first, size_t last, std::vector<TracedStroke>& strokes)
    {
        corners_.clear();
        for (size_t i = first; i < last; ++i) {
            const uint32_t pixel = crossings_[i].edge / 2;
            const bool is_down = crossings_[i].edge % 2 != 0;
            corners_.push_back({pixel, i});
            if (is_down ? pixel % size_px_.x > 0 : pixel >= size_px_.x) {
                corners_.push_back({is_down ? pixel - 1 : pixel - size_px_.x, i});
            }
        }
        std::ranges::sort(corners_, {},
                          [](const Corner& corner) { return std::pair(corner.square, corner.crossing); });
        for (size_t i = 0; i < corners_.size();) {
            size_t end = i;
            while (end < corners_.size() && corners_[end].square == corners_[i].square) {
                ++end;
            }
            link_square(std::span(corners_).subspan(i, end - i));
            i = end;
        }
        for (const bool wants_end : {true, false}) {
            for (size_t i = first; i < last; ++i) {
                if (!is_linked_[i] && (!wants_end || links_[i][1] == none)) {
                    add_stroke(i, strokes);
                }
            }
        }
    }

private:
    [[nodiscard]] TracedPoint point_of(const shared::Crossing& crossing) const
    {
        const uint32_t pixel = crossing.edge / 2;
        const float along = static_cast<float>(crossing.place_and_width & 0xffffU) / 65535.0F;
        glm::vec2 place = glm::vec2(pixel % size_px_.x, pixel / size_px_.x) + 0.5F;
        (crossing.edge % 2 != 0 ? place.y : place.x) += along;
        return {place, glm::unpackHalf1x16(static_cast<uint16_t>(crossing.place_and_width >> 16U))};
    }

    void link(size_t a, size_t b)
    {
        (links_[a][0] == none ? links_[a][0] : links_[a][1]) = b;
        (links_[b][0] == none ? links_[b][0] : links_[b][1]) = a;
    }

    /// Links the crossings on the border of one square of four pixels in pairs. The two nearest crossings are
    /// linked first, then the nearest two of the rest.
    void link_square(std::span<const Corner> around)
    {
        std::vector<size_t> open;
        open.reserve(around.size());
        for (const Corner& corner : around) {
            open.push_back(corner.crossing);
        }
        while (open.size() > 1) {
            std::pair<size_t, size_t> best{0, 0};
            float least = 1e9F;
            for (size_t i = 0; i < open.size(); ++i) {
                for (size_t k = i + 1; k < open.size(); ++k) {
                    const float away = glm::distance(points_[open[i]].page_px, points_[open[k]].page_px);
                    if (crossings_[open[i]].edge != crossings_[open[k]].edge && away < least) {
                        least = away;
                        best = {i, k};
                    }
                }
            }
            if (best.second == 0) {
                return;
            }
            link(open[best.first], open[best.second]);
            open.erase(open.begin() + static_cast<std::ptrdiff_t>(best.second));
            open.erase(open.begin() + static_cast<std::ptrdiff_t>(best.first));
        }
    }

    void add_stroke(size_t start, std::vector<TracedStroke>& strokes)
    {
        const shared::Crossing& crossing = crossings_[start];
        TracedStroke stroke{.draw = crossing.draw - 1, .family = crossing.line & 0xffU};
        size_t before = none;
        size_t at = start;
        while (at != none && !is_linked_[at]) {
            is_linked_[at] = true;
            stroke.points.push_back(points_[at]);
            const size_t next =
                links_[at][0] != before || links_[at][0] == links_[at][1] ? links_[at][0] : links_[at][1];
            before = std::exchange(at, next);
        }
        stroke.is_closed = at == start && stroke.points.size() > 3;
        if (stroke.is_closed) {
            stroke.points.push_back(stroke.points.front());
        }
        space_out(stroke.points);
        if (stroke.points.size() > 1) {
            strokes.push_back(std::move(stroke));
        }
    }

    /// Removes points that are too close to the previous point of the stroke. Points too close to each other
    /// occur at corners of the pixel grid. The direction between two close points is unreliable.
    static void space_out(std::vector<TracedPoint>& points)
    {
        const TracedPoint last = points.back();
        std::vector<TracedPoint> kept{points.front()};
        for (const TracedPoint& point : points) {
            if (glm::distance(point.page_px, kept.back().page_px) >= least_step_px) {
                kept.push_back(point);
            }
        }
        if (kept.size() > 1) {
            kept.back() = last;
        }
        points = std::move(kept);
    }

    std::span<const shared::Crossing> crossings_;
    glm::uvec2 size_px_;
    std::vector<Links> links_;
    std::vector<bool> is_linked_;
    std::vector<TracedPoint> points_;
    std::vector<Corner> corners_;
};

/// Adds the pass that finds the crossings (points where lines pass between pixels) of one style variant.
gpu::BufferId add_crossings(gpu::Graph& graph, const HatchInputs& in, const HatchStyle& style,
                            gpu::BufferId before)
{
    const Darkness darkness = add_darkness(graph, in, style);
    const gpu::ImageId source = add_overrun(graph, in, darkness.image, style);
    auto pass = graph.compute("hatch/trace", shaders::trace_comp);
    pass.sample(darkness.image).sample(in.draw).sample(in.normal).sample(in.coordinate).sample(in.footprint);
    pass.sample(source).sample(in.strongest_light.value_or(in.draw));
    const gpu::BufferId crossings = pass.modify(before);
    pass.variant(line_variant(in, style));
    pass.push(line_constants(in, style)).dispatch_over(in.size_px.x, in.size_px.y);
    return crossings;
}

} // namespace

gpu::BufferId add_trace(gpu::Graph& graph, const HatchInputs& in, const std::vector<HatchVariant>& variants,
                        uint64_t most_bytes)
{
    float width_px = variants.front().style.width_mm * in.pixels_per_mm;
    for (const HatchVariant& variant : variants) {
        width_px = std::min(width_px, variant.style.width_mm * in.pixels_per_mm);
    }
    const double per_pixel = std::clamp(crossings_per_width / width_px, 2.0F, 64.0F);
    const uint64_t room = std::min(static_cast<uint64_t>(per_pixel * in.size_px.x * in.size_px.y),
                                   (most_bytes - sizeof(uint32_t)) / sizeof(shared::Crossing));
    auto clear = graph.custom("hatch/clear crossings");
    gpu::BufferId crossings = clear.touch_write(
        graph.buffer("hatch/crossings", {.size_bytes = sizeof(uint32_t) + room * sizeof(shared::Crossing)}),
        gpu::Access::transfer_write);
    clear.execute([crossings](gpu::Recorder& recorder) {
        vkCmdFillBuffer(recorder.commands(), recorder.buffer(crossings).handle(), 0, sizeof(uint32_t), 0);
    });
    for (uint32_t variant = 0; variant < variants.size(); ++variant) {
        if (variants[variant].style.enabled) {
            crossings = add_crossings(graph, inputs_of_variant(in, variants, variant, {}),
                                      variants[variant].style, crossings);
        }
    }
    return crossings;
}

std::vector<TracedStroke> string_crossings(std::span<const shared::Crossing> crossings,
                                           const glm::uvec2& size_px)
{
    std::vector<shared::Crossing> sorted(crossings.begin(), crossings.end());
    std::ranges::sort(sorted, {}, order_of);
    Stringing stringing(sorted, size_px);
    std::vector<TracedStroke> strokes;
    for (size_t first = 0; first < sorted.size();) {
        size_t last = first;
        while (last < sorted.size() && is_same_line(sorted[first], sorted[last])) {
            ++last;
        }
        stringing.add_line(first, last, strokes);
        first = last;
    }
    return strokes;
}

} // namespace estampe::hatch
