// SPDX-License-Identifier: MIT
// Tests which texels of the ground a picture looks up.
#include <algorithm>
#include <random>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "techniques/shadow/ground/ground_shadow.hpp"

namespace estampe::shadow {
namespace {

constexpr uint32_t sector_map_size = 512;
constexpr double relief_m = 30.0;
const LevelNumbers all_levels{0, 1, 2, 3, 4};

struct Look {
    glm::dvec3 eye{20.0, 4.0, -7.0};
    glm::dvec3 way{0.0};

    [[nodiscard]] glm::dmat4 clip() const
    {
        glm::dmat4 clip_from_view(0.0);
        clip_from_view[0][0] = 1.2;
        clip_from_view[1][1] = -2.1;
        clip_from_view[2][3] = -1.0;
        clip_from_view[3][2] = 0.01;
        return clip_from_view * glm::lookAt(eye, eye + way, glm::dvec3(0, 1, 0));
    }
};

glm::dvec3 sun_at(double azimuth, double elevation)
{
    return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
            std::cos(elevation) * std::sin(azimuth)};
}

bool is_within(const shared::FieldSector& sector, size_t field, const glm::vec2& texel)
{
    return glm::dot(sector.sides[0], texel) + sector.offsets[field].x >= 0.0F &&
           glm::dot(sector.sides[1], texel) + sector.offsets[field].y >= 0.0F;
}

TEST(GroundSector, HoldsWhatIsLookedUpForWhateverIsSeen)
{
    std::mt19937 random(1); // NOLINT(cert-msc32-c,cert-msc51-cpp): identical places in each run
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    size_t looked_up = 0;
    for (int k = 0; k < 60; ++k) {
        const Look look{.way =
                            glm::normalize(glm::dvec3(between(-1, 1), between(-0.3, 0.3), between(-1, 1)))};
        const glm::dvec3 sun = sun_at(between(0.0, 6.28), between(0.05, 1.2));
        const GroundLevels levels =
            ground_levels_about({look.eye.x, look.eye.z}, {0.0, 0.0}, sun, sector_map_size, 0.125);
        const shared::FieldSector sector = seen_sector(
            {.clip_from_anchor = glm::mat4(look.clip()), .towards_sun = sun, .relief_m = relief_m}, levels,
            all_levels);
        const glm::dmat4 anchor_from_clip = glm::inverse(look.clip());
        for (int i = 0; i < 500; ++i) {
            const glm::dvec4 seen = anchor_from_clip * glm::dvec4(between(-1, 1), between(-1, 1),
                                                                  0.01 / std::exp(between(0, 9)), 1);
            const glm::dvec2 place = glm::dvec2(seen.x, seen.z) / seen.w -
                                     between(0.0, relief_m) / sun.y * glm::dvec2(sun.x, sun.z);
            for (size_t field = 0; field < levels.size(); ++field) {
                const glm::dvec2 texel =
                    (place - glm::dvec2(levels[field].origin_m)) / static_cast<double>(levels[field].texel_m);
                if (std::min(texel.x, texel.y) < 0.0 || std::max(texel.x, texel.y) >= sector_map_size - 1.0) {
                    continue;
                }
                ++looked_up;
                for (const glm::dvec2 corner : {glm::dvec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
                    EXPECT_TRUE(is_within(sector, field, glm::vec2(glm::floor(texel) + corner))) << k;
                }
            }
        }
    }
    EXPECT_GT(looked_up, 20000U);
}

TEST(GroundSector, LeavesOutMostOfWhatLiesBehind)
{
    const glm::dvec3 sun = sun_at(1.0, 0.3);
    const Look look{.way = {1.0, -0.1, 0.2}};
    const GroundLevels levels =
        ground_levels_about({look.eye.x, look.eye.z}, {0.0, 0.0}, sun, sector_map_size, 0.125);
    const auto share = [&](const shared::FieldSector& sector, size_t field) {
        size_t count = 0;
        for (uint32_t i = 0; i < sector_map_size * sector_map_size; ++i) {
            count += is_within(sector, field, glm::vec2(i % sector_map_size, i / sector_map_size)) ? 1U : 0U;
        }
        return static_cast<double>(count) / (sector_map_size * sector_map_size);
    };
    const shared::FieldSector sector =
        seen_sector({.clip_from_anchor = glm::mat4(look.clip()), .towards_sun = sun, .relief_m = relief_m},
                    levels, all_levels);
    EXPECT_LT(share(sector, 4), 0.45);
    EXPECT_LT(share(sector, 0), 0.9);
    EXPECT_LT(share(sunward_of(sector, sun), 4), 0.8);
}

TEST(GroundSector, IsAllOfItWhereTheEyeLooksDownOrInParallel)
{
    const glm::dvec3 sun = sun_at(1.0, 0.3);
    const GroundLevels levels = ground_levels_about({0.0, 0.0}, {0.0, 0.0}, sun, sector_map_size, 0.125);
    const Look down{.way = {0.2, -1.0, 0.1}};
    for (const glm::mat4& clip : {glm::mat4(down.clip()), glm::mat4(1.0F)}) {
        const shared::FieldSector sector = seen_sector(
            {.clip_from_anchor = clip, .towards_sun = sun, .relief_m = relief_m}, levels, all_levels);
        for (const glm::vec2 texel : {glm::vec2(0, 0), {511, 0}, {0, 511}, {511, 511}}) {
            EXPECT_TRUE(is_within(sector, 0, texel));
            EXPECT_TRUE(is_within(sunward_of(sector, sun), 4, texel));
        }
    }
}

} // namespace
} // namespace estampe::shadow
