// SPDX-License-Identifier: MIT
#include "column.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <estampe/shapes.hpp>

namespace temple {
namespace {

namespace shapes = estampe::shapes;

constexpr float turn_rad = 2.0F * std::numbers::pi_v<float>;

/// The shaft of a column, as distances of its surface from its axis: flutes, slightly displaced drums, chips,
/// a broken top.
class Shaft {
public:
    Shaft(float radius_m, float height_m, int flutes, float wear, bool is_broken, Dice dice)
        : radius_m_(radius_m), height_m_(height_m), flutes_(flutes), wear_(wear), is_broken_(is_broken),
          dice_(dice)
    {
        const auto drums = static_cast<size_t>(std::max(2L, std::lround(height_m / (2.1F * radius_m))));
        for (size_t i = 0; i <= drums; ++i) {
            joints_m_.push_back(
                height_m *
                (static_cast<float>(i) + (i > 0 && i < drums ? dice_.between(-0.15F, 0.15F) : 0.0F)) /
                static_cast<float>(drums));
            turns_.push_back(is_broken ? dice_.between(-0.06F, 0.06F) : dice_.between(-0.015F, 0.015F));
            swells_.push_back(dice_.between(-0.012F, 0.012F));
        }
        for (float& phase : phases_) {
            phase = turn_rad * dice_.share();
        }
        const int chips = static_cast<int>(wear * 9.0F);
        for (int i = 0; i < chips; ++i) {
            // A shaft is chipped mostly at the joints between its drums (the cylinders of stone).
            const auto joint = static_cast<size_t>(dice_.below(static_cast<int>(drums) + 1));
            chips_.push_back({turn_rad * dice_.share(), joints_m_[joint] + dice_.between(-0.2F, 0.2F),
                              radius_m * dice_.between(0.25F, 0.8F), radius_m * dice_.between(0.06F, 0.22F)});
        }
    }

    [[nodiscard]] estampe::Primitive build() const
    {
        const int columns = flutes_ > 0 ? 4 * flutes_ : 28;
        std::vector<float> rows;
        for (size_t i = 0; i + 1 < joints_m_.size(); ++i) {
            const float low = joints_m_[i];
            const float high = joints_m_[i + 1];
            for (const float share : {0.0F, 0.08F, 0.36F, 0.64F, 0.92F}) {
                rows.push_back(glm::mix(low, high, share));
            }
        }
        rows.push_back(height_m_);
        estampe::Primitive mesh;
        for (const float row : rows) {
            for (int i = 0; i <= columns; ++i) {
                const float angle = turn_rad * static_cast<float>(i % columns) / static_cast<float>(columns);
                const float height = std::min(row, top_m(angle));
                mesh.positions.push_back(place(angle, height));
                mesh.normals.push_back(normal(angle, height));
                // UVs are chosen so that pen strokes run around the shaft, rise slightly, and bend into the
                // flutes.
                const float around =
                    radius_m_ * turn_rad * static_cast<float>(i) / static_cast<float>(columns);
                mesh.uvs[0].emplace_back(around, height + 0.12F * around);
            }
        }
        const auto width = static_cast<uint32_t>(columns + 1);
        for (uint32_t row = 0; row + 1 < rows.size(); ++row) {
            for (uint32_t i = 0; i < width - 1; ++i) {
                const uint32_t a = row * width + i;
                mesh.indices.insert(mesh.indices.end(),
                                    {a, a + 1, a + width + 1, a, a + width + 1, a + width});
            }
        }
        add_top(mesh, columns);
        return mesh;
    }

private:
    struct Chip {
        float angle, height_m, size_m, depth_m;
    };

    [[nodiscard]] float radius_at(float angle, float height_m) const
    {
        // Normals are also computed below the foot of the shaft.
        const float up = std::max(height_m / height_m_, 0.0F);
        const float taper = 1.0F - 0.17F * std::pow(up, 1.4F);
        const auto after = std::ranges::upper_bound(joints_m_, height_m);
        const size_t drum = static_cast<size_t>(std::max<std::ptrdiff_t>(after - joints_m_.begin() - 1, 0));
        float radius = radius_m_ * (taper + swells_[drum]);
        if (flutes_ > 0) {
            const float phase = static_cast<float>(flutes_) * (angle + turns_[drum]) / turn_rad;
            // Position across a flute: 0 in its middle, -1 and 1 at the sharp edges on both sides.
            const float across = 2.0F * (phase - std::floor(phase)) - 1.0F;
            radius *= 1.0F - 0.09F * (1.0F - across * across);
        }
        for (const Chip& chip : chips_) {
            const float turned = std::remainder(angle - chip.angle, turn_rad);
            const glm::vec2 off(turned * radius_m_, height_m - chip.height_m);
            const float near = 1.0F - glm::dot(off, off) / (chip.size_m * chip.size_m);
            radius -= std::max(0.0F, near) * chip.depth_m;
        }
        radius -= 0.02F * wear_ * radius_m_ *
                  (std::sin(3.0F * angle + 2.3F * height_m + phases_[0]) +
                   std::sin(5.0F * angle - 1.7F * height_m));
        return radius;
    }

    /// Returns the height at which the broken shaft ends in a direction.
    [[nodiscard]] float top_m(float angle) const
    {
        if (!is_broken_) {
            return height_m_;
        }
        const float jags = 0.5F * std::sin(angle + phases_[1]) + 0.25F * std::sin(3.0F * angle + phases_[2]) +
                           0.16F * std::sin(7.0F * angle + phases_[3]);
        return height_m_ - radius_m_ * (0.9F - jags);
    }

    [[nodiscard]] glm::vec3 place(float angle, float height_m) const
    {
        const float radius = radius_at(angle, height_m);
        return {radius * std::sin(angle), height_m, radius * std::cos(angle)};
    }

    [[nodiscard]] glm::vec3 normal(float angle, float height_m) const
    {
        constexpr float step_rad = 0.02F;
        constexpr float step_m = 0.04F;
        const glm::vec3 around = place(angle + step_rad, height_m) - place(angle - step_rad, height_m);
        const glm::vec3 up = place(angle, height_m + step_m) - place(angle, height_m - step_m);
        return glm::normalize(glm::cross(around, up));
    }

    void add_top(estampe::Primitive& mesh, int columns) const
    {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        float middle_m = 0.0F;
        for (int i = 0; i <= columns; ++i) {
            const float angle = turn_rad * static_cast<float>(i % columns) / static_cast<float>(columns);
            const glm::vec3 spot = place(angle, top_m(angle));
            middle_m += spot.y / static_cast<float>(columns + 1);
            mesh.positions.push_back(spot);
            mesh.normals.push_back(
                glm::normalize(glm::vec3(0.0F, 1.0F, 0.0F) + 0.25F * (spot - glm::vec3(0, spot.y, 0))));
            mesh.uvs[0].emplace_back(spot.x, spot.z);
        }
        mesh.positions.emplace_back(0.0F, middle_m - (is_broken_ ? 0.25F * radius_m_ : 0.0F), 0.0F);
        mesh.normals.emplace_back(0.0F, 1.0F, 0.0F);
        mesh.uvs[0].emplace_back(0.0F, 0.0F);
        const auto middle = static_cast<uint32_t>(mesh.positions.size() - 1);
        for (uint32_t i = 0; i < static_cast<uint32_t>(columns); ++i) {
            mesh.indices.insert(mesh.indices.end(), {first + i, first + i + 1, middle});
        }
    }

    float radius_m_;
    float height_m_;
    int flutes_;
    float wear_;
    bool is_broken_;
    Dice dice_;
    std::vector<float> joints_m_;
    std::vector<float> turns_, swells_; ///< Rotation and extra radius of each drum of the shaft
    std::vector<Chip> chips_;
    std::array<float, 4> phases_{};
};

/// Base and capital of a column, as profiles of (radius, height). The unit is the radius of the shaft at its
/// lower or upper end.
struct Profile {
    std::vector<glm::vec2> base, capital;
    /// Heights of the lowest block (plinth) and of the topmost block (abacus).
    float plinth = 0.0F, abacus = 0.0F;
    /// Half the side lengths of the lowest and the topmost block.
    float plinth_half = 0.0F, abacus_half = 0.0F;
};

Profile profile_of(Order order)
{
    const std::vector<glm::vec2> torus{{0.0F, 0.0F},   {1.2F, 0.0F},   {1.3F, 0.1F},   {1.3F, 0.2F},
                                       {1.18F, 0.31F}, {1.06F, 0.36F}, {1.04F, 0.46F}, {0.0F, 0.46F}};
    switch (order) {
    case Order::tuscan:
        return {
            torus,
            {{0.0F, 0.0F}, {1.02F, 0.0F}, {1.1F, 0.06F}, {1.02F, 0.12F}, {1.0F, 0.3F}, {1.3F, 0.5F}, {0.0F, 0.5F}},
            0.4F,
            0.3F,
            1.42F,
            1.4F};
    case Order::doric:
        return {{},
                {{0.0F, 0.0F},
                 {1.0F, 0.0F},
                 {1.04F, 0.12F},
                 {1.3F, 0.38F},
                 {1.46F, 0.62F},
                 {1.5F, 0.72F},
                 {0.0F, 0.72F}},
                0.45F,
                0.42F,
                1.5F,
                1.55F};
    case Order::ionic:
        return {
            torus, {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.06F, 0.08F}, {1.0F, 0.16F}, {1.2F, 0.34F}, {0.0F, 0.34F}},
            0.4F,  0.22F,
            1.42F, 1.32F};
    case Order::bell:
        return {{{0.0F, 0.0F}, {1.35F, 0.0F}, {1.3F, 0.18F}, {1.1F, 0.28F}, {0.0F, 0.28F}},
                {{0.0F, 0.0F},
                 {1.0F, 0.0F},
                 {1.04F, 0.1F},
                 {1.0F, 0.2F},
                 {1.05F, 0.6F},
                 {1.22F, 1.0F},
                 {1.6F, 1.32F},
                 {1.62F, 1.42F},
                 {0.0F, 1.42F}},
                0.3F,
                0.45F,
                1.5F,
                1.05F};
    }
    return {};
}

float height_of(const std::vector<glm::vec2>& profile)
{
    return profile.empty() ? 0.0F : profile.back().y;
}

estampe::Primitive turned(std::vector<glm::vec2> profile, float radius_m)
{
    for (glm::vec2& point : profile) {
        point *= radius_m;
    }
    return shapes::lathe(profile, 32, 0.8F);
}

void add_scrolls(Kit& kit, float radius_m, float foot_m)
{
    const estampe::Primitive roll = turned({{0.0F, 0.0F},
                                            {0.42F, 0.0F},
                                            {0.36F, 0.4F},
                                            {0.3F, 1.1F},
                                            {0.36F, 1.8F},
                                            {0.42F, 2.2F},
                                            {0.0F, 2.2F}},
                                           radius_m);
    for (const float side : {-1.0F, 1.0F}) {
        glm::mat4 placed = at({side * 1.05F * radius_m, foot_m + 0.02F * radius_m, -1.1F * radius_m});
        placed = glm::rotate(placed, glm::radians(90.0F), {1.0F, 0.0F, 0.0F});
        kit.add(Stuff::marble, roll, placed);
    }
}

} // namespace

Column throw_column(Dice& dice, float radius_m, float height_m, float ruin)
{
    constexpr std::array<int, 6> flutes{0, 16, 18, 20, 22, 24};
    Column column{.order = static_cast<Order>(dice.below(4)),
                  .radius_m = radius_m * dice.between(0.94F, 1.06F),
                  .height_m = height_m,
                  .chance = dice.number()};
    const int most = static_cast<int>(flutes.size());
    column.flutes = column.order == Order::tuscan ? 0 : flutes[static_cast<size_t>(1 + dice.below(most - 1))];
    column.wear = dice.between(0.1F, 0.4F) + 0.6F * ruin * dice.share();
    if (dice.chance(ruin)) {
        column.left = dice.between(0.22F, 0.8F);
    }
    column.lean_deg = ruin * dice.between(0.0F, 5.0F);
    column.lean_to_deg = dice.between(0.0F, 360.0F);
    return column;
}

float foot_half_m(const Column& column)
{
    return profile_of(column.order).plinth_half * column.radius_m;
}

Kit build_column(const Column& column)
{
    const Profile profile = profile_of(column.order);
    const float radius = column.radius_m;
    const float top_radius = 0.83F * radius;
    const float base = (profile.plinth + height_of(profile.base)) * radius;
    const float scrolls = column.order == Order::ionic ? 0.55F : 0.0F;
    const float capital = (height_of(profile.capital) + profile.abacus + scrolls) * top_radius;
    const float shaft = column.height_m - base - capital;
    const bool is_whole = column.left >= 1.0F;
    const Dice dice(column.chance);

    Kit straight;
    const float half = profile.plinth_half * radius;
    // The column's lowest block reaches into the ground, so that a leaning column does not lift it into the
    // air.
    add_block(straight, Stuff::marble, {-half, -1.2F, -half}, {half, profile.plinth * radius, half});
    if (!profile.base.empty()) {
        straight.add(Stuff::marble, turned(profile.base, radius), at({0.0F, profile.plinth * radius, 0.0F}));
    }
    const float stands = is_whole ? shaft : column.left * shaft;
    straight.add(Stuff::marble, Shaft(radius, stands, column.flutes, column.wear, !is_whole, dice).build(),
                 at({0.0F, base, 0.0F}));
    if (is_whole) {
        const float foot = base + shaft;
        straight.add(Stuff::marble, turned(profile.capital, top_radius), at({0.0F, foot, 0.0F}));
        float top = foot + height_of(profile.capital) * top_radius;
        if (column.order == Order::ionic) {
            add_scrolls(straight, top_radius, top);
            const float bed = 1.2F * top_radius;
            add_block(straight, Stuff::marble, {-bed, top, -bed}, {bed, top + scrolls * top_radius, bed});
            top += scrolls * top_radius;
        }
        const float slab = profile.abacus_half * top_radius;
        add_block(straight, Stuff::marble, {-slab, top, -slab},
                  {slab, top + profile.abacus * top_radius, slab});
    }
    Kit kit;
    const float bearing = glm::radians(column.lean_to_deg);
    const glm::vec3 axis(std::cos(bearing), 0.0F, -std::sin(bearing));
    kit.add(straight, glm::rotate(glm::mat4(1.0F), glm::radians(column.lean_deg), axis));
    return kit;
}

Kit build_drum(float radius_m, float length_m, Dice dice)
{
    Kit kit;
    const int flutes = 16 + 2 * dice.below(4);
    glm::mat4 lying = glm::translate(glm::mat4(1.0F), {-0.5F * length_m, radius_m * 0.93F, 0.0F});
    lying = glm::rotate(lying, glm::radians(-90.0F), {0.0F, 0.0F, 1.0F});
    kit.add(Stuff::marble, Shaft(radius_m, length_m, flutes, 0.6F, true, dice).build(), lying);
    const std::array<glm::vec2, 3> foot{{{0.0F, 0.0F}, {0.93F * radius_m, 0.0F}, {0.0F, 0.02F}}};
    kit.add(Stuff::marble, shapes::lathe(foot, 40), lying);
    return kit;
}

} // namespace temple
