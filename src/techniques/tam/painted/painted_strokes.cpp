// SPDX-License-Identifier: MIT
#include "techniques/tam/painted/painted_strokes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::tam {
namespace {

/// A line that is one pixel wide: consecutive pixels, whose positions do not wrap.
using Chain = std::vector<glm::ivec2>;

/// A square of texels that repeats across its edges.
class Field {
public:
    Field(std::vector<uint8_t> texels, uint32_t size_px) : texels_(std::move(texels)), size_px_(size_px) {}

    [[nodiscard]] uint32_t size_px() const { return size_px_; }

    [[nodiscard]] const std::vector<uint8_t>& texels() const { return texels_; }

    [[nodiscard]] uint8_t& at(glm::ivec2 place) { return texels_[index(place)]; }

    [[nodiscard]] uint8_t at(glm::ivec2 place) const { return texels_[index(place)]; }

private:
    [[nodiscard]] size_t index(glm::ivec2 place) const
    {
        const uint32_t mask = size_px_ - 1;
        return size_t{static_cast<uint32_t>(place.y) & mask} * size_px_ +
               (static_cast<uint32_t>(place.x) & mask);
    }

    std::vector<uint8_t> texels_;
    uint32_t size_px_;
};

struct End {
    size_t chain = 0;
    bool at_back = false;
    glm::vec2 place{0.0F};
    glm::vec2 outward{0.0F};
};

End end_of(const std::vector<Chain>& chains, size_t index, bool at_back)
{
    constexpr size_t tangent_px = 7;
    const Chain& chain = chains[index];
    const size_t span = std::min(tangent_px, chain.size() - 1);
    const glm::vec2 tip = at_back ? chain.back() : chain.front();
    const glm::vec2 inner = at_back ? chain[chain.size() - 1 - span] : chain[span];
    const glm::vec2 out = tip - inner;
    const float length = glm::length(out);
    return {index, at_back, tip, length > 0.0F ? out / length : glm::vec2(0.0F)};
}

/// Joins chains (lines of pixels) whose ends point at each other.
class Joiner {
public:
    Joiner(std::vector<Chain> chains, const Field& ink, float reach_px)
        : chains_(std::move(chains)), ink_(ink), reach_px_(reach_px),
          size_(static_cast<float>(ink.size_px())), partner_(2 * chains_.size(), none)
    {
        for (size_t i = 0; i < chains_.size(); ++i) {
            ends_.push_back(end_of(chains_, i, false));
            ends_.push_back(end_of(chains_, i, true));
        }
    }

    [[nodiscard]] std::vector<Chain> join()
    {
        pair_ends();
        std::vector<Chain> joined;
        std::vector<bool> used(chains_.size());
        // First follows the sequences of joined chains that have free ends. All remaining sequences are
        // closed rings.
        for (const bool rings : {false, true}) {
            for (size_t end = 0; end < ends_.size(); ++end) {
                if (!used[end / 2] && (rings || partner_[end] == none)) {
                    joined.push_back(follow(end, used));
                }
            }
        }
        return joined;
    }

private:
    static constexpr size_t none = std::numeric_limits<size_t>::max();

    struct Pair {
        float cost = 0.0F;
        size_t a = 0;
        size_t b = 0;
    };

    [[nodiscard]] glm::vec2 wrapped(glm::vec2 difference) const
    {
        return difference - size_ * glm::round(difference / size_);
    }

    /// Measures how badly the ends of two chains of pixels fit together: a smaller value is a better fit.
    /// Returns a negative value if they cannot be joined.
    [[nodiscard]] float misfit(const End& a, const End& b) const
    {
        constexpr float least_agreement = 0.85F;
        const glm::vec2 gap = wrapped(b.place - a.place);
        const float distance = glm::length(gap);
        if (a.chain == b.chain || distance > reach_px_ || distance <= 0.0F) {
            return -1.0F;
        }
        const float agreement =
            std::min({-glm::dot(a.outward, b.outward), glm::dot(a.outward, gap) / distance,
                      -glm::dot(b.outward, gap) / distance});
        if (agreement < least_agreement && (distance > 2.9F || -glm::dot(a.outward, b.outward) < 0.6F)) {
            return -1.0F;
        }
        const int samples = static_cast<int>(distance) + 1;
        for (int i = 1; i < samples; ++i) {
            const glm::vec2 place = a.place + gap * (static_cast<float>(i) / static_cast<float>(samples));
            if (ink_.at(glm::ivec2(glm::round(place))) == 0) {
                return -1.0F;
            }
        }
        return distance * (2.0F - agreement);
    }

    void pair_ends()
    {
        const auto cells = static_cast<size_t>(std::max(1.0F, std::floor(size_ / reach_px_)));
        const auto cell_of = [&](float place) {
            const float share = place / size_ - std::floor(place / size_);
            return std::min(cells - 1, static_cast<size_t>(share * static_cast<float>(cells)));
        };
        std::vector<std::vector<size_t>> grid(cells * cells);
        for (size_t end = 0; end < ends_.size(); ++end) {
            grid[cell_of(ends_[end].place.y) * cells + cell_of(ends_[end].place.x)].push_back(end);
        }
        std::vector<Pair> pairs;
        for (size_t end = 0; end < ends_.size(); ++end) {
            for (size_t dy = 0; dy < std::min<size_t>(3, cells); ++dy) {
                for (size_t dx = 0; dx < std::min<size_t>(3, cells); ++dx) {
                    const size_t row = (cell_of(ends_[end].place.y) + cells + dy - 1) % cells;
                    const size_t column = (cell_of(ends_[end].place.x) + cells + dx - 1) % cells;
                    collect(end, grid[row * cells + column], pairs);
                }
            }
        }
        std::sort(pairs.begin(), pairs.end(), [](const Pair& left, const Pair& right) {
            return std::tie(left.cost, left.a, left.b) < std::tie(right.cost, right.a, right.b);
        });
        for (const Pair& pair : pairs) {
            if (partner_[pair.a] == none && partner_[pair.b] == none) {
                partner_[pair.a] = pair.b;
                partner_[pair.b] = pair.a;
            }
        }
    }

    void collect(size_t end, const std::vector<size_t>& others, std::vector<Pair>& pairs) const
    {
        constexpr size_t most_in_a_cell = 64;
        for (size_t i = 0; i < std::min(most_in_a_cell, others.size()); ++i) {
            const float cost = others[i] > end ? misfit(ends_[end], ends_[others[i]]) : -1.0F;
            if (cost >= 0.0F) {
                pairs.push_back({cost, end, others[i]});
            }
        }
    }

    /// Follows joined chains from one end on, and returns them as one chain with the gaps filled.
    [[nodiscard]] Chain follow(size_t end, std::vector<bool>& used) const
    {
        Chain string;
        while (end != none && !used[end / 2]) {
            used[end / 2] = true;
            Chain chain = chains_[end / 2];
            if (end % 2 == 1) {
                std::reverse(chain.begin(), chain.end());
            }
            append(string, chain);
            end = partner_[end ^ 1U];
        }
        return string;
    }

    void append(Chain& string, const Chain& chain) const
    {
        glm::ivec2 shift(0);
        if (!string.empty()) {
            const glm::vec2 last = string.back();
            const glm::vec2 gap = wrapped(glm::vec2(chain.front()) - last);
            shift = glm::ivec2(glm::round(last + gap)) - chain.front();
            const int samples = static_cast<int>(glm::length(gap));
            for (int i = 1; i < samples; ++i) {
                const float share = static_cast<float>(i) / static_cast<float>(samples);
                string.push_back(glm::ivec2(glm::round(last + gap * share)));
            }
        }
        for (const glm::ivec2 place : chain) {
            string.push_back(place + shift);
        }
    }

    std::vector<Chain> chains_;
    const Field& ink_;
    float reach_px_;
    float size_;
    std::vector<End> ends_;
    std::vector<size_t> partner_;
};

/// Joins chains whose ends point at each other, if the ends are at most `reach_px` apart and ink lies all the
/// way between them. The gaps are filled with a straight line.
std::vector<Chain> join_chains(std::vector<Chain> chains, const Field& ink, float reach_px)
{
    return Joiner(std::move(chains), ink, reach_px).join();
}

constexpr size_t fewest_points = 3;
constexpr size_t most_strokes = 20000;
constexpr float most_half_px = 16.0F;

/// Steps to neighbouring pixels: sides come before corners, so that a walk does not cut a corner and return
/// for it.
constexpr std::array<glm::ivec2, 8> steps{glm::ivec2(1, 0), {0, 1},  {-1, 0},  {0, -1},
                                          {1, 1},           {-1, 1}, {-1, -1}, {1, -1}};

int neighbours(const Field& field, glm::ivec2 place)
{
    int count = 0;
    for (const glm::ivec2 step : steps) {
        count += field.at(place + step) != 0 ? 1 : 0;
    }
    return count;
}

/// Walks along a line of pixels to its end, appends the pixels to `chain` and removes them from `lines`.
void walk(Field& lines, glm::ivec2 place, Chain& chain)
{
    while (true) {
        const auto next = std::find_if(steps.begin(), steps.end(),
                                       [&](glm::ivec2 step) { return lines.at(place + step) != 0; });
        if (next == steps.end()) {
            return;
        }
        place += *next;
        lines.at(place) = 0;
        chain.push_back(place);
    }
}

/// Splits lines of pixels at their crossings. Each resulting chain runs from one end or crossing to another.
std::vector<Chain> trace_chains(Field lines)
{
    const auto size = static_cast<int>(lines.size_px());
    const Field whole = lines;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            if (whole.at({x, y}) != 0 && neighbours(whole, {x, y}) > 2) {
                lines.at({x, y}) = 0;
            }
        }
    }
    std::vector<Chain> chains;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            if (lines.at({x, y}) == 0) {
                continue;
            }
            Chain chain{{x, y}};
            lines.at({x, y}) = 0;
            walk(lines, {x, y}, chain);
            std::reverse(chain.begin(), chain.end());
            walk(lines, {x, y}, chain);
            chains.push_back(std::move(chain));
        }
    }
    return chains;
}

/// Distance from a texel to the nearest texel that does not belong to the field.
float distance_to_paper(const Field& field, glm::ivec2 place)
{
    float nearest = most_half_px * most_half_px;
    for (int radius = 1; static_cast<float>(radius * radius) < nearest; ++radius) {
        for (int i = -radius; i <= radius; ++i) {
            for (const glm::ivec2 step : {glm::ivec2(i, -radius), {i, radius}, {-radius, i}, {radius, i}}) {
                if (field.at(place + step) == 0) {
                    nearest = std::min(nearest, static_cast<float>(step.x * step.x + step.y * step.y));
                }
            }
        }
    }
    return std::sqrt(nearest);
}

/// Smooths a chain: replaces each value by the mean of the value and its two neighbours. A row of pixels
/// follows a stroke's centre only roughly.
template <typename Value>
std::vector<Value> smoothed(const std::vector<Value>& values)
{
    constexpr size_t reach = 3;
    std::vector<Value> result;
    for (size_t i = 0; i < values.size(); ++i) {
        const size_t span = std::min({reach, i, values.size() - 1 - i});
        Value sum = values[i];
        for (size_t j = 1; j <= span; ++j) {
            sum += values[i - j] + values[i + j];
        }
        result.push_back(sum / static_cast<float>(2 * span + 1));
    }
    return result;
}

PaintedStroke stroke_of(const Chain& chain, const Field& fresh)
{
    PaintedStroke stroke;
    const auto size_px = static_cast<float>(fresh.size_px());
    for (const glm::ivec2 place : chain) {
        stroke.points.push_back((glm::vec2(place) + 0.5F) / size_px);
        // A texel in a gap lies where the stroke crosses another stroke. The crossing stroke keeps the width
        // that it had before the gap.
        stroke.half_px.push_back(fresh.at(place) != 0 || stroke.half_px.empty()
                                     ? distance_to_paper(fresh, place)
                                     : stroke.half_px.back());
    }
    stroke.points = smoothed(stroke.points);
    stroke.half_px = smoothed(stroke.half_px);
    return stroke;
}

/// Scales the widths of all strokes so that together they cover `area_px` pixels.
void fit_area(std::vector<PaintedStroke>& strokes, double area_px, uint32_t size_px)
{
    double drawn = 0.0;
    for (const PaintedStroke& stroke : strokes) {
        for (size_t i = 1; i < stroke.points.size(); ++i) {
            const float step_px =
                glm::length(stroke.points[i] - stroke.points[i - 1]) * static_cast<float>(size_px);
            drawn += static_cast<double>(2.0F * stroke.half_px[i] * step_px);
        }
    }
    const auto scale = static_cast<float>(std::clamp(drawn > 0.0 ? area_px / drawn : 1.0, 0.25, 2.0));
    std::vector<float> halves;
    halves.reserve(strokes.size());
    for (const PaintedStroke& stroke : strokes) {
        halves.push_back(stroke.half_px[stroke.half_px.size() / 2]);
    }
    std::sort(halves.begin(), halves.end());
    // Where two strokes touch, both centre lines are far from blank paper, so the measured widths are too
    // large. Widths are limited to 1.5 times the stroke's median width.
    const float most = halves.empty() ? 0.0F : 1.5F * halves[halves.size() / 2];
    for (PaintedStroke& stroke : strokes) {
        for (float& half_px : stroke.half_px) {
            half_px = std::max(0.45F, std::min(half_px, most) * scale);
        }
    }
}

/// Returns `fresh` (the ink that is new in a tone) with the texels of older ink that a new stroke crosses. A
/// texel is added if, along a straight line in one of twelve directions, most texels on both sides are fresh.
Field with_crossings(const Field& fresh, const Field& ink)
{
    constexpr int reach_px = 8;
    constexpr int most_of_a_side = 5;
    constexpr std::array<glm::vec2, 12> directions{
        glm::vec2(1.0F, 0.0F), {0.9659F, 0.2588F},  {0.8660F, 0.5F},  {0.7071F, 0.7071F},
        {0.5F, 0.8660F},       {0.2588F, 0.9659F},  {0.0F, 1.0F},     {-0.2588F, 0.9659F},
        {-0.5F, 0.8660F},      {-0.7071F, 0.7071F}, {-0.8660F, 0.5F}, {-0.9659F, 0.2588F}};
    const auto fresh_on_side = [&](glm::ivec2 place, glm::vec2 direction) {
        int count = 0;
        for (int i = 1; i <= reach_px; ++i) {
            const glm::ivec2 step(glm::round(direction * static_cast<float>(i)));
            count += fresh.at(place + step);
        }
        return count;
    };
    Field whole = fresh;
    const auto size = static_cast<int>(ink.size_px());
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            if (ink.at({x, y}) == 0 || fresh.at({x, y}) != 0) {
                continue;
            }
            const bool crossed = std::any_of(directions.begin(), directions.end(), [&](glm::vec2 direction) {
                return fresh_on_side({x, y}, direction) >= most_of_a_side &&
                       fresh_on_side({x, y}, -direction) >= most_of_a_side;
            });
            whole.at({x, y}) = crossed ? 1 : 0;
        }
    }
    return whole;
}

float mean_half_px(const std::vector<Chain>& chains, const Field& fresh)
{
    double sum = 0.0;
    double count = 1e-9;
    for (const Chain& chain : chains) {
        sum += static_cast<double>(distance_to_paper(fresh, chain[chain.size() / 2]) *
                                   static_cast<float>(chain.size()));
        count += static_cast<double>(chain.size());
    }
    return static_cast<float>(sum / count);
}

/// The eight neighbours of a texel, clockwise from the texel above. The map wraps at its edges.
std::array<uint32_t, 8> around(uint32_t texel, uint32_t size_px)
{
    const uint32_t mask = size_px - 1;
    const uint32_t x = texel & mask;
    const uint32_t y = texel / size_px;
    const uint32_t left = (x - 1) & mask;
    const uint32_t right = (x + 1) & mask;
    const uint32_t up = ((y - 1) & mask) * size_px;
    const uint32_t here = y * size_px;
    const uint32_t down = ((y + 1) & mask) * size_px;
    return {up + x, up + right, here + right, down + right, down + x, down + left, here + left, up + left};
}

/// Whether thinning may remove a texel at the edge of a line. Each thinning round has two halves; `second`
/// selects the half.
bool removable(const std::vector<uint8_t>& mask, uint32_t texel, uint32_t size_px, bool second)
{
    const std::array<uint32_t, 8> places = around(texel, size_px);
    std::array<uint8_t, 9> p{};
    int neighbours = 0;
    for (size_t i = 0; i < 8; ++i) {
        p[i] = mask[places[i]];
        neighbours += p[i];
    }
    p[8] = p[0];
    int rises = 0;
    for (size_t i = 0; i < 8; ++i) {
        rises += p[i] == 0 && p[i + 1] == 1 ? 1 : 0;
    }
    if (neighbours < 2 || neighbours > 6 || rises != 1) {
        return false;
    }
    return second ? (p[0] * p[2] * p[6] == 0 && p[0] * p[4] * p[6] == 0)
                  : (p[0] * p[2] * p[4] == 0 && p[2] * p[4] * p[6] == 0);
}

} // namespace

std::vector<PaintedStroke> find_strokes(const Gray8& lighter, const Gray8& darker, uint32_t size_px)
{
    std::vector<uint8_t> fresh(darker.size());
    std::vector<uint8_t> ink(darker.size());
    double area_px = 0.0;
    for (size_t texel = 0; texel < darker.size(); ++texel) {
        const uint8_t before = lighter.empty() ? uint8_t{0} : lighter[texel];
        ink[texel] = darker[texel] > 127 ? 1 : 0;
        fresh[texel] = ink[texel] != 0 && before <= 127 ? 1 : 0;
        area_px += std::max(0, darker[texel] - before) / 255.0;
    }
    const Field ink_field(std::move(ink), size_px);
    const Field fresh_field = with_crossings(Field(std::move(fresh), size_px), ink_field);
    std::vector<uint8_t> lines = fresh_field.texels();
    thin(lines, size_px);
    std::vector<Chain> chains = trace_chains(Field(std::move(lines), size_px));
    const float reach_px = 4.0F + 5.0F * mean_half_px(chains, fresh_field);
    chains = join_chains(std::move(chains), ink_field, reach_px);
    std::erase_if(chains, [](const Chain& chain) { return chain.size() < fewest_points; });
    std::stable_sort(chains.begin(), chains.end(),
                     [](const Chain& a, const Chain& b) { return a.size() > b.size(); });
    chains.resize(std::min(chains.size(), most_strokes));
    std::vector<PaintedStroke> strokes;
    strokes.reserve(chains.size());
    for (const Chain& chain : chains) {
        strokes.push_back(stroke_of(chain, fresh_field));
    }
    fit_area(strokes, area_px, size_px);
    return strokes;
}

void thin(std::vector<uint8_t>& mask, uint32_t size_px)
{
    std::vector<uint32_t> inked;
    for (uint32_t texel = 0; texel < mask.size(); ++texel) {
        if (mask[texel] != 0) {
            inked.push_back(texel);
        }
    }
    std::vector<uint32_t> gone;
    bool changed = true;
    while (changed) {
        changed = false;
        for (const bool second : {false, true}) {
            gone.clear();
            for (const uint32_t texel : inked) {
                if (removable(mask, texel, size_px, second)) {
                    gone.push_back(texel);
                }
            }
            for (const uint32_t texel : gone) {
                mask[texel] = 0;
            }
            std::erase_if(inked, [&](uint32_t texel) { return mask[texel] == 0; });
            changed = changed || !gone.empty();
        }
    }
}

} // namespace estampe::tam
