// SPDX-License-Identifier: MIT
#include "techniques/shadow/atlas.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace estampe::shadow {
namespace {

constexpr uint64_t plenty = 1ULL << 24U;

void expect_apart(const std::vector<Allotment>& lots, const std::vector<AtlasRequest>& requests,
                  uint64_t budget_texels)
{
    for (size_t a = 0; a < lots.size(); ++a) {
        const uint64_t end_a =
            lots[a].first_texel + uint64_t{requests[a].map_count} * lots[a].size * lots[a].size;
        EXPECT_LE(lots[a].size > 0 ? end_a : 0, budget_texels);
        for (size_t b = 0; b < a; ++b) {
            const uint64_t end_b =
                lots[b].first_texel + uint64_t{requests[b].map_count} * lots[b].size * lots[b].size;
            EXPECT_TRUE(lots[a].size == 0 || lots[b].size == 0 || lots[b].first_texel >= end_a ||
                        lots[a].first_texel >= end_b);
        }
    }
}

TEST(Atlas, GivesThePowerOfTwoNextToWhatIsWanted)
{
    Atlas atlas;
    const std::vector<AtlasRequest> requests{{1, 500.0F, 2048, 1.0F},
                                             {6, 90.0F, 512, 1.0F},
                                             {6, 9000.0F, 512, 1.0F},
                                             {1, 1.0F, 512, 1.0F},
                                             {0, 500.0F, 512, 1.0F}};
    const auto lots = atlas.allot(requests, {plenty});
    EXPECT_EQ(lots[0].size, 512U);
    EXPECT_EQ(lots[1].size, 64U);
    EXPECT_EQ(lots[2].size, 512U);
    EXPECT_EQ(lots[3].size, smallest_map);
    EXPECT_EQ(lots[4].size, 0U);
    expect_apart(lots, requests, plenty);
}

TEST(Atlas, DoesNotFlicker)
{
    Atlas atlas;
    std::vector<AtlasRequest> requests{{6, 256.0F, 1024, 1.0F}, {1, 256.0F, 1024, 1.0F}};
    const auto first = atlas.allot(requests, {plenty});
    // Moves the size back and forth across the threshold at which a choice without hysteresis would change.
    for (const float wanted : {350.0F, 380.0F, 350.0F, 180.0F, 160.0F, 400.0F}) {
        requests[0].wanted_size = wanted;
        EXPECT_EQ(atlas.allot(requests, {plenty}), first) << wanted;
    }
    requests[0].wanted_size = 600.0F;
    EXPECT_EQ(atlas.allot(requests, {plenty})[0].size, 512U);
}

TEST(Atlas, HoldsToItsBudgetAndDropsTheLeastImportant)
{
    Atlas atlas;
    std::vector<AtlasRequest> requests;
    for (int i = 0; i < 20; ++i) {
        requests.push_back({6, 512.0F, 512, static_cast<float>(i)});
    }
    const uint64_t half = 10ULL * 6 * 512 * 512;
    auto lots = atlas.allot(requests, {half});
    expect_apart(lots, requests, half);
    EXPECT_GT(lots.back().size, lots.front().size);
    EXPECT_TRUE(std::ranges::all_of(lots, [](const Allotment& lot) { return lot.size > 0; }));
    const uint64_t tiny = 5ULL * 6 * smallest_map * smallest_map;
    lots = atlas.allot(requests, {tiny});
    expect_apart(lots, requests, tiny);
    for (size_t i = 0; i < 20; ++i) {
        EXPECT_EQ(lots[i].size, i < 15 ? 0U : smallest_map) << i;
    }
}

TEST(Atlas, ServesNoMoreLightsThanItMay)
{
    Atlas atlas;
    std::vector<AtlasRequest> requests{{1, 64.0F, 64, 1.0F}, {1, 64.0F, 64, 1.1F}, {1, 64.0F, 64, 3.0F}};
    auto lots = atlas.allot(requests, {plenty, 2});
    EXPECT_EQ(lots[0].size, 0U);
    EXPECT_EQ(lots[1].size, 64U);
    // A light that has a map does not lose the map to a light that is slightly more important.
    requests[0].importance = 1.2F;
    lots = atlas.allot(requests, {plenty, 2});
    EXPECT_EQ(lots[0].size, 0U);
    requests[0].importance = 2.0F;
    lots = atlas.allot(requests, {plenty, 2});
    EXPECT_EQ(lots[0].size, 64U);
    EXPECT_EQ(lots[1].size, 0U);
}

TEST(Atlas, KeepsPlacesWhileOthersComeAndGo)
{
    Atlas atlas;
    std::mt19937 random(3);
    std::vector<AtlasRequest> requests(30, AtlasRequest{6, 256.0F, 512, 1.0F});
    auto before = atlas.allot(requests, {plenty});
    for (int frame = 0; frame < 60; ++frame) {
        for (size_t i = 10; i < requests.size(); ++i) {
            requests[i].map_count = random() % 3 == 0 ? 0 : random() % 2 == 0 ? 1 : 6;
            requests[i].wanted_size = static_cast<float>(32U << random() % 5);
        }
        const auto lots = atlas.allot(requests, {plenty});
        expect_apart(lots, requests, plenty);
        EXPECT_TRUE(std::equal(lots.begin(), lots.begin() + 10, before.begin()));
    }
}

} // namespace
} // namespace estampe::shadow
