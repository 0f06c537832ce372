// SPDX-License-Identifier: MIT
// Draws tonal art maps after Praun, Hoppe, Webb and Finkelstein, "Real-Time Hatching", SIGGRAPH 2001: tones
// from light to dark, levels from coarse to fine. For each stroke, many random strokes are tried, and the
// stroke that is best spaced at all scales is drawn.
#include "techniques/tam/maker.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "techniques/tam/stroke.hpp"

namespace estampe::tam {
namespace {

constexpr uint32_t full = 65535;
constexpr uint32_t half = full / 2; ///< a texel with more than half of the full ink counts as black

/// The ink that a mark adds to a texel that already has `ink`.
uint32_t added(uint32_t ink, uint32_t mark)
{
    return (full - ink) * mark / full;
}

/// Bilinear lookup in a grid that wraps. `size` is the number of cells per side, a power of two; `x` and `y`
/// are in cells.
template <typename Cell>
float lookup(const std::vector<Cell>& grid, uint32_t size, float x, float y)
{
    const float left = std::floor(x - 0.5F);
    const float top = std::floor(y - 0.5F);
    const float tx = x - 0.5F - left;
    const float ty = y - 0.5F - top;
    const uint32_t mask = size - 1;
    const uint32_t x0 = static_cast<uint32_t>(static_cast<int32_t>(left)) & mask;
    const uint32_t y0 = static_cast<uint32_t>(static_cast<int32_t>(top)) & mask;
    const uint32_t x1 = (x0 + 1) & mask;
    const uint32_t y1 = (y0 + 1) & mask;
    const auto at = [&](uint32_t column, uint32_t row) {
        return static_cast<float>(grid[row * size + column]);
    };
    const float upper = at(x0, y0) + (at(x1, y0) - at(x0, y0)) * tx;
    const float lower = at(x0, y1) + (at(x1, y1) - at(x0, y1)) * tx;
    return upper + (lower - upper) * ty;
}

} // namespace

Canvas::Canvas(uint32_t size_px)
    : size_px_(size_px), ink_(size_t{size_px} * size_px), turned_(ink_.size(), 255)
{
}

double Canvas::mean() const
{
    return static_cast<double>(sum_) / (static_cast<double>(full) * static_cast<double>(ink_.size()));
}

double Canvas::gain(std::span<const Mark> marks) const
{
    uint64_t sum = 0;
    for (const Mark& mark : marks) {
        sum += added(ink_[mark.texel], mark.ink);
    }
    return static_cast<double>(sum) / (static_cast<double>(full) * static_cast<double>(ink_.size()));
}

void Canvas::draw(std::span<const Mark> marks)
{
    const auto turning = static_cast<size_t>(
        std::count_if(marks.begin(), marks.end(), [&](const Mark& mark) { return turns(mark); }));
    const auto texels = static_cast<double>(ink_.size());
    const double share = (static_cast<double>(turned_count_) + 0.5 * static_cast<double>(turning)) / texels;
    const auto threshold = static_cast<uint8_t>(std::lround(255.0 * share));
    for (const Mark& mark : marks) {
        if (turns(mark)) {
            turned_[mark.texel] = threshold;
        }
        uint16_t& ink = ink_[mark.texel];
        const uint32_t more = added(ink, mark.ink);
        ink = static_cast<uint16_t>(ink + more);
        sum_ += more;
    }
    turned_count_ += turning;
}

bool Canvas::turns(const Mark& mark) const
{
    const uint32_t ink = ink_[mark.texel];
    return ink <= half && ink + added(ink, mark.ink) > half;
}

Gray8 Canvas::coverage() const
{
    Gray8 image(ink_.size());
    std::transform(ink_.begin(), ink_.end(), image.begin(),
                   [](uint32_t ink) { return static_cast<uint8_t>((ink * 255 + full / 2) / full); });
    return image;
}

Gray8 Canvas::thresholds() const
{
    Gray8 image = turned_;
    const float share = static_cast<float>(turned_count_) / static_cast<float>(ink_.size());
    for (size_t texel = 0; texel < image.size(); ++texel) {
        if (ink_[texel] <= half) {
            const float paper = 1.0F - 2.0F * static_cast<float>(ink_[texel]) / static_cast<float>(full);
            image[texel] = static_cast<uint8_t>(
                std::lround(255.0F * (share + (1.0F - share) * std::clamp(paper, 0.02F, 1.0F))));
        }
    }
    return image;
}

Spacing::Spacing(uint32_t size_px)
{
    constexpr uint32_t coarsest = 4;
    for (uint32_t size = size_px; size >= coarsest; size /= 2) {
        const size_t cells = size_t{size} * size;
        scales_.push_back({size, std::vector<uint16_t>(cells), std::vector<uint32_t>(cells)});
    }
}

void Spacing::add(const std::function<void(uint32_t size_px, std::vector<Mark>& marks)>& draw)
{
    for (Scale& scale : scales_) {
        draw(scale.size_px, marks_);
        for (const Mark& mark : marks_) {
            uint16_t& cell = scale.picture[mark.texel];
            cell = static_cast<uint16_t>(cell + added(cell, mark.ink));
        }
        if (&scale == &scales_.front()) {
            spread(marks_);
        }
    }
}

void Spacing::spread(std::span<const Mark> marks)
{
    const uint32_t size_px = scales_.front().size_px;
    for (const Mark& mark : marks) {
        const uint32_t ink =
            mark.ink >> 4U; // divided by 16, so that a sum over 2048 x 2048 texels fits in 32 bits
        ink_ += ink;
        uint32_t x = mark.texel % size_px;
        uint32_t y = mark.texel / size_px;
        for (Scale& scale : scales_) {
            scale.ink[size_t{y} * scale.size_px + x] += ink;
            x /= 2;
            y /= 2;
        }
    }
}

float Spacing::room(std::span<const glm::vec2> points) const
{
    constexpr size_t fewest = 6;
    constexpr float weight_of_ink = 6.0F;
    constexpr size_t finest_of_ink = 2;
    float sum = 0.0F;
    size_t stride = 1;
    for (size_t i = 0; i < scales_.size(); ++i) {
        const Scale& scale = scales_[i];
        const auto size = static_cast<float>(scale.size_px);
        float taken = 0.0F;
        float ink = 0.0F;
        float count = 0.0F;
        for (size_t point = stride / 2; point < points.size(); point += stride) {
            const glm::vec2 place = points[point] * size;
            taken += lookup(scale.picture, scale.size_px, place.x, place.y);
            ink += i < finest_of_ink ? 0.0F : lookup(scale.ink, scale.size_px, place.x, place.y);
            count += 1.0F;
        }
        sum -= taken / (count * static_cast<float>(full));
        const float mean_ink = static_cast<float>(ink_) / (size * size);
        sum -= ink_ > 0 ? weight_of_ink * ink / (count * mean_ink) : 0.0F;
        stride = points.size() / (2 * stride) >= fewest ? 2 * stride : stride;
    }
    return sum;
}

namespace {

constexpr size_t most_layers = 3;

/// Cosine and sine of an angle, rounded so that they do not depend on the last bits of the maths library.
glm::vec2 direction_of(float degrees)
{
    constexpr double steps = 1048576.0;
    const double radians = static_cast<double>(degrees) * 3.14159265358979323846 / 180.0;
    const double x = std::round(std::cos(radians) * steps) / steps;
    const double y = std::round(std::sin(radians) * steps) / steps;
    const double length = std::sqrt(x * x + y * y);
    return {static_cast<float>(x / length), static_cast<float>(y / length)};
}

/// One mip level of the map: its picture, and the positions of the strokes of each layer.
struct Level {
    Canvas canvas;
    std::vector<Spacing> spacing_of_layer;
    std::array<double, most_layers> ink_of_layer{};
    std::vector<float> tooth;
};

class Maker {
public:
    Maker(const TamStyle& style, const Image* picture, std::vector<PlacedStroke>* strokes)
        : style_(style), brush_(style, picture), round_(round_style(style)), strokes_(strokes),
          random_(static_cast<uint32_t>(style.seed))
    {
        const auto size_px = static_cast<uint32_t>(style.size_px);
        for (uint32_t size = size_px; size >= least_drawn_px; size /= 2) {
            Level level{.canvas = Canvas(size), .spacing_of_layer = {}, .tooth = {}};
            level.spacing_of_layer.assign(most_layers, Spacing(size));
            if (brush_.tooth_cell_px() > 0) {
                level.tooth = paper_tooth(size, brush_.tooth_cell_px(), hash(random_.bits()));
            }
            levels_.push_back(std::move(level));
        }
    }

    [[nodiscard]] TonalArtMap run()
    {
        TonalArtMap map;
        map.size_px = static_cast<uint32_t>(style_.size_px);
        map.darkness = darkness_of_tones(style_);
        for (tone_ = 0; tone_ < map.darkness.size(); ++tone_) {
            for (size_t level = levels_.size(); level-- > 0;) {
                fill(level, static_cast<double>(map.darkness[tone_]));
            }
            map.level_of_tone.push_back(snapshot());
        }
        for (size_t level = 0; level < level_count(map.size_px); ++level) {
            map.threshold_of_level.push_back(level < levels_.size() ? levels_[level].canvas.thresholds()
                                                                    : interpolated_thresholds(map, level));
        }
        return map;
    }

private:
    /// A brush that draws a plain solid line; its marks measure the spacing of strokes.
    static Brush round_style(TamStyle style)
    {
        style.tool = Tool::pen;
        style.opacity = 1.0F;
        style.pressure = 0.0F;
        return Brush(style);
    }

    /// Among the layers of strokes that the tone draws, finds the layer that lacks most of its planned ink.
    [[nodiscard]] size_t next_layer(const Level& level) const
    {
        constexpr std::array<double, most_layers> share{1.0, 0.75, 0.5};
        const std::array<bool, most_layers> drawn{true, static_cast<int>(tone_) + 1 >= style_.second_from,
                                                  static_cast<int>(tone_) + 1 >= style_.third_from};
        size_t chosen = 0;
        for (size_t layer = 1; layer < most_layers; ++layer) {
            if (drawn[layer] &&
                level.ink_of_layer[layer] / share[layer] < level.ink_of_layer[chosen] / share[chosen]) {
                chosen = layer;
            }
        }
        return chosen;
    }

    [[nodiscard]] Stroke random_stroke(uint32_t size_px, size_t layer)
    {
        constexpr float longest = 0.6F;
        const std::array<float, most_layers> turn{0.0F, style_.second_deg, style_.third_deg};
        const float length_px = style_.length_px * (1.0F + style_.length_spread * random_.sign());
        float spread = 0.5F * random_.sign();
        spread += 0.5F * random_.sign();
        Stroke stroke;
        stroke.length =
            std::min(length_px / static_cast<float>(size_px), longest * (1.0F - 0.4F * random_.unit()));
        stroke.direction = direction_of(style_.angle_deg + turn[layer] + style_.angle_spread_deg * spread);
        // Each random number has its own statement, because the order in which C++ evaluates function
        // arguments is unspecified.
        const float x = random_.unit();
        const glm::vec2 middle(x, random_.unit());
        stroke.start = middle - 0.5F * stroke.length * stroke.direction;
        stroke.bow = style_.bow * (0.9F + 0.9F * random_.sign());
        stroke.wobble = style_.wobble;
        stroke.seed = random_.bits();
        return stroke;
    }

    /// Computes points along the chord and arc of a stroke, two or three pixels apart.
    void trace(const Stroke& stroke, uint32_t size_px)
    {
        constexpr float step_px = 2.5F;
        const float length_px = stroke.length * static_cast<float>(size_px);
        const auto count = static_cast<size_t>(std::clamp(length_px / step_px, 4.0F, 64.0F));
        const glm::vec2 across(-stroke.direction.y, stroke.direction.x);
        points_.clear();
        for (size_t i = 0; i < count; ++i) {
            const float along = (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
            const float arc = 4.0F * along * (1.0F - along) * stroke.bow;
            points_.push_back(stroke.start + stroke.length * (stroke.direction * along + across * arc));
        }
    }

    [[nodiscard]] Stroke best_stroke(const Level& level, size_t layer)
    {
        Stroke best;
        float most_room = std::numeric_limits<float>::lowest();
        for (int i = 0; i < style_.candidates; ++i) {
            const Stroke candidate = random_stroke(level.canvas.size_px(), layer);
            trace(candidate, level.canvas.size_px());
            const float room = level.spacing_of_layer[layer].room(points_);
            if (room > most_room) {
                most_room = room;
                best = candidate;
            }
        }
        return best;
    }

    /// Computes the ink marks of a stroke on a level, and stores them in marks_.
    void mark(const Stroke& stroke, const Level& level)
    {
        const uint32_t size_px = level.canvas.size_px();
        draw_stroke(stroke, nib_at(style_, size_px), brush_, level.tooth, size_px, marks_);
    }

    /// Draws a stroke on the mip level `coarsest` and on all finer levels.
    void place(const Stroke& stroke, size_t layer, size_t coarsest)
    {
        for (size_t i = 0; i <= coarsest; ++i) {
            Level& level = levels_[i];
            mark(stroke, level);
            level.ink_of_layer[layer] += level.canvas.gain(marks_);
            level.canvas.draw(marks_);
            const Nib nib = nib_at(style_, level.canvas.size_px());
            level.spacing_of_layer[layer].add([&](uint32_t size_px, std::vector<Mark>& marks) {
                draw_stroke(stroke, nib, round_, {}, size_px, marks);
            });
        }
        if (strokes_ != nullptr) {
            strokes_->push_back({stroke, tone_, coarsest});
        }
    }

    void fill(size_t index, double target)
    {
        Level& level = levels_[index];
        const double texels = static_cast<double>(level.canvas.size_px()) * level.canvas.size_px();
        const double least_gain = 0.25 / texels;
        const auto most_strokes = static_cast<size_t>(200.0 + 4.0 * texels);
        for (size_t count = 0; level.canvas.mean() + least_gain < target; ++count) {
            if (count > most_strokes) {
                throw Error(fmt::format("tone {} of darkness {:.2f} cannot be reached", tone_ + 1, target),
                            "tam.darkest", "ask for a lighter one, or a wider or more opaque stroke");
            }
            const size_t layer = next_layer(level);
            Stroke stroke = best_stroke(level, layer);
            mark(stroke, level);
            const double missing = target - level.canvas.mean();
            const double gain = level.canvas.gain(marks_);
            if (gain * 1.6 <= missing) {
                place(stroke, layer, index);
                continue;
            }
            // If two more strokes can complete the tone, they share the missing ink, so that neither is a
            // short stub.
            if (gain <= missing) {
                static_cast<void>(shorten(stroke, level, 0.5 * missing));
                place(stroke, layer, index);
                continue;
            }
            if (shorten(stroke, level, missing)) {
                place(stroke, layer, index);
            } else {
                tint(index, target);
            }
            return;
        }
    }

    /// Shortens a stroke until it adds no more than the missing ink. Returns false if only a dot would be
    /// left.
    [[nodiscard]] bool shorten(Stroke& stroke, const Level& level, double missing)
    {
        constexpr float shortest_px = 6.0F;
        constexpr float shortest_in_widths = 2.5F;
        constexpr int rounds = 10;
        const auto size_px = static_cast<float>(level.canvas.size_px());
        const Nib nib = nib_at(style_, level.canvas.size_px());
        float low = std::min({shortest_px, shortest_in_widths * nib.width_px, 0.25F * size_px}) / size_px;
        float high = stroke.length;
        const auto overshoots = [&](float length) {
            stroke.length = length;
            mark(stroke, level);
            return level.canvas.gain(marks_) > missing;
        };
        if (low >= high || overshoots(low)) {
            return false;
        }
        for (int round = 0; round < rounds; ++round) {
            const float middle = 0.5F * (low + high);
            (overshoots(middle) ? high : low) = middle;
        }
        stroke.length = low;
        return true;
    }

    /// Brings the mean ink of a coarse mip level to `target` with dots that are too faint to count as ink. A
    /// level with few texels cannot reach a tone with whole strokes. Finer levels get no dots, because their
    /// missing ink is negligible.
    void tint(size_t index, double target)
    {
        constexpr uint32_t finest_px = 128;
        constexpr float dot_px = 2.5F;
        constexpr double faint = 0.45;
        constexpr int most_dots = 64;
        Level& level = levels_[index];
        const uint32_t size_px = level.canvas.size_px();
        for (int dot = 0; size_px <= finest_px && dot < most_dots; ++dot) {
            const double missing = target - level.canvas.mean();
            if (missing <= 0.0) {
                return;
            }
            Stroke stroke = best_stroke(level, next_layer(level));
            stroke.length = dot_px / static_cast<float>(size_px);
            mark(stroke, level);
            const double gain = level.canvas.gain(marks_);
            const double share = gain > 0.0 ? std::min(faint, missing / gain) : 0.0;
            for (Mark& mark : marks_) {
                mark.ink = static_cast<uint16_t>(share * mark.ink);
            }
            std::erase_if(marks_, [&](const Mark& mark) { return level.canvas.turns(mark); });
            level.canvas.draw(marks_);
        }
    }

    [[nodiscard]] std::vector<Gray8> snapshot() const
    {
        std::vector<Gray8> images;
        for (const Level& level : levels_) {
            images.push_back(level.canvas.coverage());
        }
        for (uint32_t size = least_drawn_px; size > 1; size /= 2) {
            images.push_back(half_size(images.back(), size));
        }
        return images;
    }

    const TamStyle& style_;
    Brush brush_;
    Brush round_;
    std::vector<PlacedStroke>* strokes_;
    Random random_;
    std::vector<Level> levels_;
    size_t tone_ = 0;
    std::vector<glm::vec2> points_;
    std::vector<Mark> marks_;
};

} // namespace

std::vector<float> darkness_of_tones(const TamStyle& style)
{
    std::vector<float> darkness;
    for (int tone = 0; tone < style.tones; ++tone) {
        const float share = static_cast<float>(tone) / static_cast<float>(std::max(1, style.tones - 1));
        const float curved = std::round(std::pow(share, style.curve) * 4096.0F) / 4096.0F;
        darkness.push_back(style.lightest + (style.darkest - style.lightest) * curved);
    }
    return darkness;
}

Nib nib_at(const TamStyle& style, uint32_t size_px)
{
    constexpr float widest_share = 1.0F / 6.0F;
    const float widest_px = std::max(1.4F, widest_share * static_cast<float>(size_px));
    return {.width_px = std::min(style.width_px, widest_px), .taper_px = style.taper_px, .tip = style.tip};
}

TonalArtMap make_map(const TamStyle& style, const Image* picture, std::vector<PlacedStroke>* strokes)
{
    if (!std::has_single_bit(static_cast<uint32_t>(style.size_px))) {
        throw Error(fmt::format("tam.size_px = {} is not a power of two", style.size_px), {},
                    "32, 64, 128, 256, 512, 1024 or 2048");
    }
    if (style.darkest <= style.lightest) {
        throw Error(
            fmt::format("tam.darkest = {} is not above tam.lightest = {}", style.darkest, style.lightest));
    }
    return Maker(style, picture, strokes).run();
}

} // namespace estampe::tam
