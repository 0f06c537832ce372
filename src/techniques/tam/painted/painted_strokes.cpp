// SPDX-License-Identifier: MIT
#include "techniques/tam/painted/painted_strokes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "techniques/tam/painted/chains.hpp"

namespace estampe::tam {
namespace {

constexpr size_t fewest_points = 3;
constexpr size_t most_strokes = 20000;
constexpr float most_half_px = 16.0F;

/// Sides before corners, so that a walk does not cut a corner and come back for it.
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

/// Walks a line to its end, and takes it out of the field.
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

/// Lines between crossings, each from one end to the other.
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

/// Distance from a texel to the nearest that is not of the field.
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

/// The mean of each value and its neighbours: a row of pixels is only roughly in the middle of a stroke.
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
        // A texel of a gap is a crossing, where the stroke is as wide as before it.
        stroke.half_px.push_back(fresh.at(place) != 0 || stroke.half_px.empty()
                                     ? distance_to_paper(fresh, place)
                                     : stroke.half_px.back());
    }
    stroke.points = smoothed(stroke.points);
    stroke.half_px = smoothed(stroke.half_px);
    return stroke;
}

/// Scales widths so that the strokes cover `area_px` pixels.
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
    // Where strokes touch, the middle of both is far from paper.
    const float most = halves.empty() ? 0.0F : 1.5F * halves[halves.size() / 2];
    for (PaintedStroke& stroke : strokes) {
        for (float& half_px : stroke.half_px) {
            half_px = std::max(0.45F, std::min(half_px, most) * scale);
        }
    }
}

/// Adds to `fresh` the texels of older ink that a fresh stroke runs over: a straight line through them, in
/// one of twelve directions, is mostly fresh, on both sides.
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

/// The eight neighbours of a texel, clockwise from the one above; the map wraps.
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

/// Whether a texel of the edge may go in this half of a round.
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
