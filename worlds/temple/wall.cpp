// SPDX-License-Identifier: MIT
#include "wall.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace temple {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Returns the heights of the joints between the wall's courses (rows of stones): at the heights where the
/// arches begin, and evenly spaced between these heights.
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

/// A part of a course (row of stones) between two openings.
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

/// Returns the share of a stone's width that the course below supports.
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

/// Lays the stones of the arches; if an arch is broken, only the stones near its piers.
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
            // The stones of an arch are counted from +x: the right pier carries the first stones.
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
    // The wall overlaps the arch's ring of stones, so that no gap is visible.
    const float radius_m = arch.half_m + 0.5F * arch.ring_m;
    const float rise_m = height_m - arch.springing_m;
    return arch.ring_m == 0.0F || rise_m >= radius_m ? 0.0F
                                                     : std::sqrt(radius_m * radius_m - rise_m * rise_m);
}

Laid lay(const Wall& wall, Dice dice)
{
    Laid laid;
    for (const Arch& arch : wall.arches) {
        // An arch stays whole only if some wall remains above its highest point.
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

namespace {

/// Tilts the shading normal of a stone's face a little at random, so that no two stones look alike.
glm::vec3 hewn(const glm::vec3& normal, const glm::vec3& along, Dice& dice)
{
    constexpr float lean = 0.045F;
    const glm::vec3 up = glm::cross(normal, along);
    return glm::normalize(normal + dice.between(-lean, lean) * along + dice.between(-lean, lean) * up);
}

/// Returns half the width of an arch beside a stone at a height; the sides of stones in the piers end where
/// the arch's curve begins.
float half_beside_m(const Arch& arch, const Stone& stone, float height_m)
{
    return stone.low_m < arch.springing_m - 0.01F ? arch.half_m : cut_half_m(arch, height_m);
}

/// Returns x of a stone's left side at a height.
float left_at(const Wall& wall, const Stone& stone, float height_m)
{
    if (stone.arch_left < 0) {
        return stone.left_m;
    }
    const Arch& arch = wall.arches[static_cast<size_t>(stone.arch_left)];
    return std::min(arch.x_m + half_beside_m(arch, stone, height_m), stone.right_m);
}

float right_at(const Wall& wall, const Stone& stone, float height_m)
{
    if (stone.arch_right < 0) {
        return stone.right_m;
    }
    const Arch& arch = wall.arches[static_cast<size_t>(stone.arch_right)];
    return std::max(arch.x_m - half_beside_m(arch, stone, height_m), stone.left_m);
}

/// Returns whether other stones cover less than 98 % of a stone's top; true if there is no course above.
bool is_open_above(const Stone& stone, const std::vector<Stone>* above)
{
    if (above == nullptr) {
        return true;
    }
    float covered_m = 0.0F;
    for (const Stone& other : *above) {
        covered_m +=
            std::max(0.0F, std::min(other.right_m, stone.right_m) - std::max(other.left_m, stone.left_m));
    }
    return covered_m < 0.98F * (stone.right_m - stone.left_m);
}

class Mason {
public:
    Mason(const Wall& wall, Dice dice) : wall_(wall), dice_(dice), half_m_(0.5F * wall.thickness_m) {}

    void set(const Stone& stone, const std::vector<Stone>* above)
    {
        const bool is_cut = cuts(stone);
        const int rows = is_cut ? 4 : 1;
        const bool is_open = is_open_above(stone, above);
        for (const float side : {1.0F, -1.0F}) {
            set_face(stone, side, rows, is_open);
        }
        if (stone.ends_left || stone.arch_left >= 0) {
            set_end(stone, rows, -1.0F);
        }
        if (stone.ends_right || stone.arch_right >= 0) {
            set_end(stone, rows, 1.0F);
        }
        if (is_open) {
            const float left = left_at(wall_, stone, stone.high_m);
            const float right = right_at(wall_, stone, stone.high_m);
            const std::array<glm::vec3, 4> top{{{left, stone.high_m, half_m_},
                                                {right, stone.high_m, half_m_},
                                                {right, stone.high_m, -half_m_},
                                                {left, stone.high_m, -half_m_}}};
            kit_.add_face(Stuff::stone, top, hewn({0, 1, 0}, {1, 0, 0}, dice_),
                          {{1, 0, 0}, {0, 0, -1}, chance()}, 0b0101);
        }
    }

    void set(const Voussoir& voussoir)
    {
        constexpr float proud_m = 0.07F;
        const Arch& arch = wall_.arches[static_cast<size_t>(voussoir.arch)];
        const auto spot = [&](float radius_m, float angle_rad, float z_m) {
            return glm::vec3(arch.x_m + radius_m * std::cos(angle_rad),
                             arch.springing_m + radius_m * std::sin(angle_rad), z_m);
        };
        const float z = half_m_ + proud_m;
        const float middle = 0.5F * (voussoir.from_rad + voussoir.to_rad);
        const glm::vec3 out(std::cos(middle), std::sin(middle), 0.0F);
        const glm::vec3 round(-out.y, out.x, 0.0F);
        for (const float side : {1.0F, -1.0F}) {
            std::array<glm::vec3, 4> face{spot(arch.half_m, voussoir.from_rad, side * z),
                                          spot(voussoir.outer_m, voussoir.from_rad, side * z),
                                          spot(voussoir.outer_m, voussoir.to_rad, side * z),
                                          spot(arch.half_m, voussoir.to_rad, side * z)};
            if (side < 0.0F) {
                std::reverse(face.begin(), face.end());
            }
            const glm::vec3 normal(0.0F, 0.0F, side);
            kit_.add_face(Stuff::stone, face, hewn(normal, {1, 0, 0}, dice_), {out, side * round, chance()},
                          0b1111);
        }
        add_ring_side(spot, voussoir, arch.half_m, z, -out);
        add_ring_side(spot, voussoir, voussoir.outer_m, z, out);
        for (const bool is_first : {true, false}) {
            const float angle = is_first ? voussoir.from_rad : voussoir.to_rad;
            std::array<glm::vec3, 4> side{spot(arch.half_m, angle, -z), spot(voussoir.outer_m, angle, -z),
                                          spot(voussoir.outer_m, angle, z), spot(arch.half_m, angle, z)};
            glm::vec3 normal(std::sin(angle), -std::cos(angle), 0.0F);
            if (!is_first) {
                std::reverse(side.begin(), side.end());
                normal = -normal;
            }
            kit_.add_face(Stuff::stone, side, normal,
                          {{std::cos(angle), std::sin(angle), 0.0F}, {0, 0, 1}, chance()}, 0b1010);
        }
    }

    [[nodiscard]] Kit take() { return std::move(kit_); }

private:
    [[nodiscard]] glm::vec2 chance() { return {dice_.between(0.0F, 8.0F), dice_.between(-0.4F, 0.4F)}; }

    [[nodiscard]] bool cuts(const Stone& stone) const
    {
        for (const int arch : {stone.arch_left, stone.arch_right}) {
            if (arch >= 0 && stone.high_m > wall_.arches[static_cast<size_t>(arch)].springing_m + 0.01F) {
                return true;
            }
        }
        return false;
    }

    /// Returns whether the joint at this point is drawn. As in drawings by hand, joints are drawn only in
    /// groups.
    [[nodiscard]] bool is_drawn(float x_m, float y_m)
    {
        const float cluster = 0.5F + 0.5F * std::sin(0.61F * x_m + 1.7F * std::sin(0.23F * y_m + phase_)) *
                                         std::cos(0.83F * y_m + 0.37F * x_m + phase_);
        return dice_.share() < wall_.joints * 1.6F * cluster * cluster + 0.1F * wall_.joints;
    }

    void set_face(const Stone& stone, float side, int rows, bool is_open)
    {
        const glm::vec3 normal = hewn({0, 0, side}, {side, 0, 0}, dice_);
        const float x = 0.5F * (stone.left_m + stone.right_m);
        const Grain grain{{side, 0, 0}, {0, 1, 0}, chance()};
        const bool draws_bed = stone.low_m > 0.05F && is_drawn(x, stone.low_m);
        const bool draws_joint = is_drawn(x, stone.high_m);
        for (int row = 0; row < rows; ++row) {
            const float low =
                glm::mix(stone.low_m, stone.high_m, static_cast<float>(row) / static_cast<float>(rows));
            const float high =
                glm::mix(stone.low_m, stone.high_m, static_cast<float>(row + 1) / static_cast<float>(rows));
            std::array<glm::vec3, 4> face{{{left_at(wall_, stone, low), low, side * half_m_},
                                           {right_at(wall_, stone, low), low, side * half_m_},
                                           {right_at(wall_, stone, high), high, side * half_m_},
                                           {left_at(wall_, stone, high), high, side * half_m_}}};
            // The corners of a stone are the lower left, the lower right, the upper right and the upper left,
            // seen from +z.
            uint32_t drawn = 0;
            drawn |= row == 0 && draws_bed ? 1U : 0U;
            drawn |= stone.ends_right && stone.arch_right < 0 ? 2U : 0U;
            drawn |= row + 1 == rows && is_open ? 4U : 0U;
            const bool is_end = stone.ends_left && stone.arch_left < 0;
            drawn |= is_end || (stone.arch_left < 0 && draws_joint) ? 8U : 0U;
            if (!is_cut_by_ring(stone.arch_left, high)) {
                drawn |= stone.arch_left >= 0 ? 8U : 0U;
            }
            if (!is_cut_by_ring(stone.arch_right, high)) {
                drawn |= stone.arch_right >= 0 ? 2U : 0U;
            }
            if (side < 0.0F) {
                std::reverse(face.begin(), face.end());
                // Reorders the bits of the stone's drawn edges to match the order of the corners: top, right,
                // bottom, left.
                drawn = (drawn & 4U) >> 2U | (drawn & 2U) | (drawn & 1U) << 2U | (drawn & 8U);
            }
            kit_.add_face(Stuff::stone, face, normal, grain, drawn);
        }
    }

    [[nodiscard]] bool is_cut_by_ring(int arch, float height_m) const
    {
        return arch >= 0 && height_m > wall_.arches[static_cast<size_t>(arch)].springing_m + 0.01F;
    }

    void set_end(const Stone& stone, int rows, float side)
    {
        const auto x_at = [&](float height_m) {
            return side < 0.0F ? left_at(wall_, stone, height_m) : right_at(wall_, stone, height_m);
        };
        const Grain grain{{0, 0, -side}, {0, 1, 0}, chance()};
        for (int row = 0; row < rows; ++row) {
            const float low =
                glm::mix(stone.low_m, stone.high_m, static_cast<float>(row) / static_cast<float>(rows));
            const float high =
                glm::mix(stone.low_m, stone.high_m, static_cast<float>(row + 1) / static_cast<float>(rows));
            const float z = side * half_m_;
            const std::array<glm::vec3, 4> face{
                {{x_at(low), low, z}, {x_at(low), low, -z}, {x_at(high), high, -z}, {x_at(high), high, z}}};
            kit_.add_face(Stuff::stone, face, hewn({side, 0, 0}, {0, 0, -side}, dice_), grain,
                          row == 0 && stone.low_m > 0.05F && dice_.chance(0.4F) ? 1U : 0U);
        }
    }

    template <typename Spot>
    void add_ring_side(const Spot& spot, const Voussoir& voussoir, float radius_m, float z_m,
                       const glm::vec3& normal)
    {
        constexpr int pieces = 2;
        const bool is_inner =
            glm::dot(normal, spot(1.0F, voussoir.from_rad, 0.0F) - spot(0.0F, 0.0F, 0.0F)) < 0.0F;
        for (int i = 0; i < pieces; ++i) {
            const auto angle_at = [&](int k) {
                return glm::mix(voussoir.from_rad, voussoir.to_rad, static_cast<float>(k) / pieces);
            };
            const float from = angle_at(i);
            const float to = angle_at(i + 1);
            std::array<glm::vec3, 4> face{spot(radius_m, from, z_m), spot(radius_m, from, -z_m),
                                          spot(radius_m, to, -z_m), spot(radius_m, to, z_m)};
            if (is_inner) {
                std::reverse(face.begin(), face.end());
            }
            const glm::vec3 round(-normal.y, normal.x, 0.0F);
            kit_.add_face(Stuff::stone, face, normal, {{0, 0, 1}, round, {}}, 0U);
        }
    }

    const Wall& wall_;
    Dice dice_;
    float half_m_;
    float phase_ = 6.0F * dice_.share();
    Kit kit_;
};

} // namespace

Kit build_wall(const Wall& wall, const Laid& laid, Dice dice)
{
    Mason mason(wall, dice);
    for (size_t i = 0; i < laid.courses.size(); ++i) {
        const std::vector<Stone>* above = i + 1 < laid.courses.size() ? &laid.courses[i + 1] : nullptr;
        for (const Stone& stone : laid.courses[i]) {
            mason.set(stone, above);
        }
    }
    for (const Voussoir& voussoir : laid.voussoirs) {
        mason.set(voussoir);
    }
    Kit kit = mason.take();
    const float half_m = 0.5F * wall.thickness_m;
    for (const Arch& arch : wall.arches) {
        if (arch.ring_m == 0.0F) { // The lintel of a door protrudes a little
            add_block(kit, Stuff::stone, {arch.x_m - arch.half_m - 0.35F, arch.springing_m, -half_m - 0.06F},
                      {arch.x_m + arch.half_m + 0.35F, arch.springing_m + wall.course_m, half_m + 0.06F});
        }
    }
    if (wall.cornice) {
        add_block(kit, Stuff::stone, {-0.2F, wall.height_m, -half_m - 0.2F},
                  {wall.length_m + 0.2F, wall.height_m + 0.28F, half_m + 0.2F});
        add_block(kit, Stuff::stone, {-0.5F, wall.height_m + 0.28F, -half_m - 0.5F},
                  {wall.length_m + 0.5F, wall.height_m + 0.6F, half_m + 0.5F});
    }
    return kit;
}

} // namespace temple
