// SPDX-License-Identifier: MIT
#include "sand.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "kit.hpp"
#include "site.hpp"
#include "weather.hpp"

namespace temple {
namespace {

constexpr float mask_m = 264.0F;
constexpr int mask_texels = 528;

/// Returns the distance from a place to a rectangle; negative inside.
float distance_m(const glm::vec2& place, const glm::vec2& low, const glm::vec2& high)
{
    const glm::vec2 off = glm::abs(place - 0.5F * (low + high)) - 0.5F * (high - low);
    return glm::length(glm::max(off, 0.0F)) + std::min(std::max(off.x, off.y), 0.0F);
}

/// Smooth noise in [-1, 1], as a sum of waves in several directions.
class Waves {
public:
    explicit Waves(Dice dice)
    {
        for (glm::vec3& wave : waves_) {
            const float angle = dice.between(0.0F, 3.14159F);
            wave = {std::cos(angle), std::sin(angle), dice.between(0.0F, 6.2831F)};
        }
    }

    [[nodiscard]] float at(const glm::vec2& place, float length_m) const
    {
        float sum = 0.0F;
        float factor = 6.2831F / length_m;
        for (const glm::vec3& wave : waves_) {
            sum += std::sin(factor * (wave.x * place.x + wave.y * place.y) + wave.z);
            factor *= 1.31F;
        }
        return sum / static_cast<float>(std::size(waves_));
    }

private:
    glm::vec3 waves_[4];
};

/// Returns the height of a sand bank at the distance `way_m` from a wall. The height is `high_m` at the wall,
/// and half of `high_m` at the distance `half_way_m`.
float bank_m(float way_m, float high_m, float half_way_m)
{
    return high_m * std::exp2(-std::max(way_m, 0.0F) / half_way_m);
}

/// Returns the height of the sand banks at the walls on the windward and lee sides. The height varies along
/// the walls.
float banks_m(const glm::vec2& place, const Waves& waves)
{
    const float uneven = 0.65F + 0.7F * waves.at(place, 26.0F);
    const glm::vec2 prison_low(-0.5F * module_m * modules_x, front_z_m - module_m * modules_z);
    const glm::vec2 prison_high(-prison_low.x, front_z_m);
    float level = 0.0F;
    // The eastern side of the prison faces the wind; deep sand lies on its lee side.
    const float behind = glm::smoothstep(front_z_m + 10.0F, front_z_m - 2.0F, place.y);
    if (behind > 0.0F) {
        const float way = distance_m(place, prison_low, prison_high);
        const float is_east = glm::smoothstep(prison_high.x - 14.0F, prison_high.x, place.x);
        const float is_north = glm::smoothstep(prison_low.y + 8.0F, prison_low.y - 2.0F, place.y);
        level = std::max(level, behind * bank_m(way,
                                                glm::mix(1.2F, 5.6F, std::max(is_east, 0.75F * is_north)) *
                                                    (0.8F + 0.3F * waves.at(place, 31.0F)),
                                                4.2F));
    }
    // The western arcade catches the sand that blows across the court.
    const float along_court = glm::smoothstep(court_south_m + 5.0F, court_south_m - 4.0F, std::abs(place.y));
    const float before_west = place.x - (court_west_m + 0.5F);
    level = std::max(level, along_court * bank_m(std::abs(before_west), 1.5F * uneven, 1.5F));
    // The eastern arcade stands in a separate sand bank.
    const float from_east = place.x - court_east_m;
    level = std::max(
        level, along_court * bank_m(from_east > 0.0F ? from_east : -2.2F * from_east, 1.9F * uneven, 3.8F));
    // In corners, the sand is higher than along walls.
    const auto corner = [&](float x, float z, float high, float half_way) {
        level = std::max(level, bank_m(glm::distance(place, glm::vec2(x, z)), high, half_way));
    };
    corner(court_west_m + 1.0F, front_z_m + 1.0F, 3.4F, 3.0F);
    corner(court_west_m + 1.0F, court_south_m - 1.0F, 2.8F, 3.0F);
    corner(court_east_m, front_z_m + 1.0F, 3.0F, 3.4F);
    corner(stairs_half_m + 1.0F, stairs_foot_m - 4.0F, 1.5F, 2.6F);
    corner(-stairs_half_m + 2.5F, stairs_foot_m - 0.2F, 1.3F, 2.2F);
    const float beside_gate = glm::smoothstep(gate_half_m + 1.0F, gate_half_m + 7.0F, std::abs(place.x)) *
                              glm::smoothstep(34.0F, 24.0F, std::abs(place.x));
    level = std::max(level, beside_gate * bank_m(std::abs(place.y - court_south_m), 1.3F * uneven, 3.0F));
    return level;
}

/// Returns the height above the floor of the sand that has blown in through the portal: a heap on the
/// doorsill, flat enough to walk over. Where no sand has blown in, returns a height far below the floor.
float tongue_m(const Plan& plan, const Waves& waves, const glm::vec2& place)
{
    const glm::vec2 in = glm::vec2(1.0F, -1.0F) * (place - plan.doors.front().place_m);
    const float run = in.y > 0.0F ? 0.09F * in.y : -0.24F * in.y;
    return 0.42F - run - 0.16F * std::abs(in.x + 0.35F * in.y) + 0.06F * waves.at(place, 3.0F);
}

/// Factor that lowers the sand at doors: 0 in a doorway, 1 where high sand blocks no door. The change is so
/// gradual that a person can walk up the sand.
float clear_of_doors(const Plan& plan, const glm::vec2& place)
{
    float nearest_m = 100.0F;
    for (const Door& door : plan.doors) {
        nearest_m = std::min(nearest_m, glm::distance(place, door.place_m));
    }
    return glm::smoothstep(1.0F, 6.5F, nearest_m);
}

/// Returns the height of the sand inside the prison. The sand is below the floors, except where it came in
/// through the portal or a collapsed roof.
float indoors_m(const Plan& plan, const Waves& waves, const glm::vec2& place)
{
    constexpr float hidden_m = floor_m - 1.4F;
    float level = hidden_m;
    for (const Room& room : plan.rooms) {
        const float inside = -distance_m(place, room.low_m(), room.high_m());
        if (inside < 0.0F || room.is_roofed()) {
            continue;
        }
        // Sand that fell in through the open roof is highest in one corner.
        const glm::vec2 share = (place - room.low_m()) / (room.high_m() - room.low_m());
        const float heap = 1.5F * share.x * (1.0F - 0.5F * share.y) + 0.25F * waves.at(place, 7.0F) - 0.15F;
        level = std::max(level,
                         floor_m + heap * glm::smoothstep(0.0F, 1.2F, inside) * clear_of_doors(plan, place));
    }
    level = std::max(level, floor_m + tongue_m(plan, waves, place));
    return level;
}

/// Writes a number in the syntax of the terrain's height expressions.
std::string decimal(float value)
{
    std::array<char, 32> text{};
    const auto [end, error] =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 4);
    return {text.data(), end};
}

/// Writes nodes of the terrain's graph that make a hollow: a bowl, with a rim of the same volume of sand. A
/// hollow without depth has the same nodes, but is too small to be seen, so that the compiled graph can be
/// kept.
std::string hollow_nodes(const std::string& number, const Hollow& hollow)
{
    constexpr float least_m = 0.0002F;
    const float depth_m = std::max(hollow.depth_m, least_m);
    const auto at = [&](float radii) { return decimal(radii * hollow.radius_m); };
    const std::string away = "away" + number;
    return away + " = \"polar(x, " + decimal(hollow.place_m.x) + ", " + decimal(hollow.place_m.y) +
           ")\"\nhollow" + number + " = \"" + decimal(depth_m) + " * (0.35 * smoothstep(" + at(0.8F) + ", " +
           at(1.35F) + ", " + away + ") - 0.35 * smoothstep(" + at(1.35F) + ", " + at(2.4F) + ", " + away +
           ") + smoothstep(" + at(0.3F) + ", " + at(1.2F) + ", " + away + ") - 1)\"\n";
}

/// Makes the track of footprints of an earlier visitor: down the avenue, through the gate, past the obstacles
/// in the court, to the stairs.
estampe::TerrainTrack pilgrim()
{
    return {.name = "pilgrim",
            .path_m = {{-4.0, 108.0},
                       {1.2, 95.0},
                       {-1.6, 81.0},
                       {-0.6, 66.0},
                       {0.9, 52.0},
                       {0.2, 40.0},
                       {-0.5, 30.0},
                       {0.3, 22.0},
                       {-1.4, 12.0},
                       {-0.6, 0.0},
                       {0.8, -9.0},
                       {0.5, -16.0}}};
}

} // namespace

float sand_level_m(const Plan& plan, uint64_t seed, const glm::vec2& place_m)
{
    const Waves waves(Dice(seed, 30));
    const glm::vec2 low(-0.5F * module_m * modules_x - 0.15F, front_z_m - module_m * modules_z - 0.15F);
    const glm::vec2 high(-low.x, front_z_m + 0.15F);
    if (distance_m(place_m, low, high) < 0.0F) {
        return indoors_m(plan, waves, place_m);
    }
    // The sand in the court is level. Outside the court there are dunes, which move.
    const float out_m = distance_m(place_m, {court_west_m - 6.0F, front_z_m}, {court_east_m, court_south_m});
    const float way_m = std::abs(place_m.x) - 4.0F; // The avenue is fairly level
    const float wild = glm::smoothstep(2.0F, 30.0F, out_m) *
                       glm::smoothstep(0.0F, 30.0F, way_m + std::max(0.0F, -place_m.y));
    const float roll = (0.1F + 1.3F * wild) * waves.at(place_m, 46.0F) + 0.08F * waves.at(place_m, 11.0F);
    const bool is_platform = std::abs(place_m.x) < stairs_half_m - 1.0F && place_m.y < stairs_foot_m - 2.6F &&
                             place_m.y > front_z_m;
    const float level = roll + banks_m(place_m, waves);
    if (!is_platform) {
        return level;
    }
    return std::max(std::min(level, floor_m - 0.9F), floor_m + tongue_m(plan, waves, place_m));
}

Desert::Desert(const Plan& plan, uint64_t seed) : seed_(seed)
{
    levels_m_.reserve(static_cast<size_t>(mask_texels) * mask_texels);
    for (int row = 0; row < mask_texels; ++row) {
        for (int column = 0; column < mask_texels; ++column) {
            const glm::vec2 share = (glm::vec2(column, row) + 0.5F) / static_cast<float>(mask_texels);
            levels_m_.push_back(sand_level_m(plan, seed, mask_m * (share - 0.5F)));
        }
    }
}

estampe::Terrain Desert::with(std::span<const Hollow> hollows, bool is_trodden) const
{
    Dice dice(seed_, 31);
    const std::string seed_of_dunes = ", seed = " + std::to_string(dice.below(1000)) + ")";
    std::string pressed;
    std::string nodes;
    for (size_t i = 0; i < most_hollows; ++i) {
        const std::string number = std::to_string(i);
        pressed += " + hollow" + number;
        nodes += hollow_nodes(number, i < hollows.size() ? hollows[i] : Hollow{});
    }
    const std::string text =
        "[terrain]\n"
        "height = \"lerp(wild, temple, near)" +
        pressed +
        "\"\n"
        "color = \"#dcb982\"\n"
        "[nodes]\n"
        "temple = \"mask('temple', 264, texels = 528)\"\n"
        "near = \"1 - smoothstep(84, 126, polar(x, 0, 4))\"\n"
        "swell = \"5 * fbm(520, octaves = 2" +
        seed_of_dunes +
        "\"\n"
        "great = \"warp(dunes(95, 11, celerity = 0.02, meander = 0.35, variation = 0.9, "
        "crest = 160" +
        seed_of_dunes +
        ", 14 * noise(260), 0)\"\n"
        "small = \"dunes(14, 0.45, celerity = 0.1, seed = 7) * smoothstep(0.5, 3, great)\"\n"
        "wild = \"swell + great + small - 1\"\n" +
        nodes +
        "[wind]\n"
        "towards_deg = " +
        decimal(90.0F - wind_to_deg) +
        "\n"
        "speed_m_per_s = " +
        decimal(calm_m_per_s) +
        "\n"
        "[ripples]\n" // The terrain has no ripples, because ripples of the sand are drawn as pen strokes
        "height_m = 0\n";
    estampe::TerrainDescription description = estampe::parse_terrain(text, "temple");
    if (is_trodden) {
        description.tracks.push_back(pilgrim());
    }
    estampe::Terrain desert(description);
    desert.paint_mask("temple", levels_m_);
    return desert;
}

estampe::Terrain make_desert(const Plan& plan, uint64_t seed)
{
    return Desert(plan, seed).with({});
}

} // namespace temple
