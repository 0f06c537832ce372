// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "wall.hpp"

namespace temple {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Heights at which courses meet: at the springing of the arches, and evenly between.
std::vector<float> beds(const Wall& wall)
{
    std::vector<float> fixed{0.0F, wall.height_m};
    for (const Arch& arch : wall.arches) {
        fixed.push_back(arch.springing_m);
        if (arch.ring_m == 0.0F) {
            fixed.push_back(arch.springing_m + wall.course_m);
        }
    }
    std::ranges::sort(fixed);
    std::vector<float> all{wall.foot_m, 0.0F};
    for (const float next : fixed) {
        const float last = all.back();
        if (next - last < 0.2F) {
            continue;
        }
        const float count = std::max(1.0F, std::round((next - last) / wall.course_m));
        for (float i = 1.0F; i <= count; i += 1.0F) {
            all.push_back(last + (next - last) * i / count);
        }
    }
    return all;
}

/// A piece of a course between openings.
struct Span {
    float left_m, right_m;
    int arch_left, arch_right;
};

std::vector<Span> spans(const Wall& wall, float low_m, float high_m)
{
    std::vector<Span> all;
    Span next{0.0F, 0.0F, -1, -1};
    const float middle_m = 0.5F * (low_m + high_m);
    for (size_t i = 0; i < wall.arches.size(); ++i) {
        const Arch& arch = wall.arches[i];
        if (cut_half_m(arch, low_m + 1e-3F) <= 0.0F) {
            continue;
        }
        const float half_m = cut_half_m(arch, middle_m);
        next.right_m = arch.x_m - half_m;
        next.arch_right = static_cast<int>(i);
        all.push_back(next);
        next.left_m = arch.x_m + half_m;
        next.arch_left = static_cast<int>(i);
        next.arch_right = -1;
    }
    next.right_m = wall.length_m;
    all.push_back(next);
    return all;
}

std::vector<Stone> course_of(const Wall& wall, float low_m, float high_m, bool is_odd, Dice& dice)
{
    std::vector<Stone> course;
    for (const Span& span : spans(wall, low_m, high_m)) {
        const float length_m = span.right_m - span.left_m;
        if (length_m < 0.02F) {
            continue;
        }
        const int count = std::max(1, static_cast<int>(std::lround(length_m / wall.stone_m)));
        float left_m = span.left_m;
        for (int i = 0; i < count; ++i) {
            const bool is_last = i + 1 == count;
            const float bond = (is_odd ? 0.72F : 1.0F) + dice.between(-0.16F, 0.16F);
            const float right_m =
                is_last ? span.right_m
                        : span.left_m + length_m * (static_cast<float>(i) + bond) / static_cast<float>(count);
            course.push_back({.low_m = low_m,
                              .high_m = high_m,
                              .left_m = left_m,
                              .right_m = right_m,
                              .arch_left = i == 0 ? span.arch_left : -1,
                              .arch_right = is_last ? span.arch_right : -1});
            left_m = right_m;
        }
    }
    return course;
}

/// The share of a stone under which there is something that carries it.
float carried(const Stone& stone, const std::vector<Stone>& below, const Wall& wall,
              const std::vector<bool>& is_whole)
{
    float held_m = 0.0F;
    const auto hold = [&](float left_m, float right_m) {
        held_m += std::max(0.0F, std::min(right_m, stone.right_m) - std::max(left_m, stone.left_m));
    };
    for (const Stone& other : below) {
        hold(other.left_m, other.right_m);
    }
    for (size_t i = 0; i < wall.arches.size(); ++i) {
        const Arch& arch = wall.arches[i];
        const float half_m = cut_half_m(arch, stone.low_m - 0.3F);
        if (is_whole[i] && half_m > 0.0F && stone.low_m > arch.springing_m - 0.01F) {
            hold(arch.x_m - half_m, arch.x_m + half_m);
        }
    }
    return held_m / (stone.right_m - stone.left_m);
}

void find_open_sides(std::vector<Stone>& course)
{
    constexpr float near_m = 0.01F;
    for (size_t i = 0; i < course.size(); ++i) {
        Stone& stone = course[i];
        const bool has_left = i > 0 && stone.left_m - course[i - 1].right_m < near_m;
        const bool has_right = i + 1 < course.size() && course[i + 1].left_m - stone.right_m < near_m;
        stone.ends_left = !has_left;
        stone.ends_right = !has_right;
    }
}

/// The stones of the arches; of broken ones those that still hold on to their piers.
void lay_arches(const Wall& wall, Dice& dice, Laid& laid)
{
    for (size_t i = 0; i < wall.arches.size(); ++i) {
        const Arch& arch = wall.arches[i];
        if (arch.ring_m == 0.0F) {
            continue;
        }
        const int stones = 2 * std::max(3, static_cast<int>(arch.half_m * 2.6F)) + 1;
        const int left = laid.is_whole[i] ? stones : 1 + dice.below(2);
        const int right = laid.is_whole[i] ? 0 : 1 + dice.below(3);
        const bool stands_left = !wall.top_m || wall.top_m(arch.x_m - arch.half_m) > arch.springing_m;
        const bool stands_right = !wall.top_m || wall.top_m(arch.x_m + arch.half_m) > arch.springing_m;
        for (int k = 0; k < stones; ++k) {
            // Counted from +x: the right pier carries the first ones.
            const bool holds =
                laid.is_whole[i] || (k < right && stands_right) || (k >= stones - left && stands_left);
            if (!holds) {
                continue;
            }
            const float longer = k == stones / 2 ? 1.35F : k % 2 == 0 ? 1.08F : 0.92F;
            laid.voussoirs.push_back({.arch = static_cast<int>(i),
                                      .from_rad = pi * static_cast<float>(k) / static_cast<float>(stones),
                                      .to_rad = pi * static_cast<float>(k + 1) / static_cast<float>(stones),
                                      .outer_m = arch.half_m + arch.ring_m * longer});
        }
    }
}

} // namespace

float cut_half_m(const Arch& arch, float height_m)
{
    if (height_m < arch.springing_m) {
        return arch.half_m;
    }
    // The wall reaches in behind the ring, so that nothing shows between.
    const float radius_m = arch.half_m + 0.5F * arch.ring_m;
    const float rise_m = height_m - arch.springing_m;
    return arch.ring_m == 0.0F || rise_m >= radius_m ? 0.0F
                                                     : std::sqrt(radius_m * radius_m - rise_m * rise_m);
}

Laid lay(const Wall& wall, Dice dice)
{
    Laid laid;
    for (const Arch& arch : wall.arches) {
        // A crown wants some wall above it.
        bool is_whole = true;
        for (const float side : {-1.0F, 0.0F, 1.0F}) {
            is_whole = is_whole && (!wall.top_m || wall.top_m(arch.x_m + side * arch.half_m) >
                                                       arch.crown_m() + (side == 0.0F ? 0.2F : -0.6F));
        }
        laid.is_whole.push_back(is_whole);
    }
    const std::vector<float> heights = beds(wall);
    std::vector<Stone> below;
    for (size_t i = 0; i + 1 < heights.size(); ++i) {
        std::vector<Stone> course = course_of(wall, heights[i], heights[i + 1], i % 2 == 1, dice);
        if (i > 0) {
            std::erase_if(course, [&](const Stone& stone) {
                const float middle_m = 0.5F * (stone.left_m + stone.right_m);
                const bool is_gone = wall.top_m && wall.top_m(middle_m) < stone.high_m - 0.3F;
                return is_gone || carried(stone, below, wall, laid.is_whole) < 0.55F;
            });
        }
        find_open_sides(course);
        below = course;
        laid.courses.push_back(std::move(course));
    }
    lay_arches(wall, dice, laid);
    return laid;
}

} // namespace temple
