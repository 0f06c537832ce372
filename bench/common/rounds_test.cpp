// SPDX-License-Identifier: MIT
#include "common/measuring.hpp"

#include <gtest/gtest.h>

namespace estampe::bench {
namespace {

TEST(Rounds, TellMedianAndQuartiles)
{
    Rounds rounds;
    for (const double ms : {5.0, 1.0, 4.0, 2.0, 3.0}) {
        rounds.add(ms);
    }
    EXPECT_EQ(rounds.text(), "3.000 ms (2.000 to 4.000)");
    EXPECT_EQ(rounds.mean_ms(), 3.0);
    EXPECT_EQ(rounds.most_ms(), 5.0);
    EXPECT_EQ(rounds.passes_table(), "");
}

TEST(Rounds, ListPassesByTheirMeanAndTheSlowestRound)
{
    Rounds rounds;
    rounds.add(3.0, {{"light", 1.0}, {"hatch", 2.0}});
    rounds.add(9.0, {{"light", 7.0}, {"hatch", 1.0}, {"hatch", 1.0}}); // a pass may run twice
    rounds.add(2.0, {{"light", 1.0}, {"hatch", 1.0}});
    const std::string table = rounds.passes_table();
    const size_t light = table.find("light");
    const size_t hatch = table.find("hatch");
    ASSERT_NE(light, std::string::npos) << table;
    ASSERT_NE(hatch, std::string::npos) << table;
    EXPECT_LT(light, hatch) << "the more expensive one comes first";
    EXPECT_NE(table.find("3.0000 ms, 7.0000 in the slowest round"), std::string::npos) << table;
    EXPECT_NE(table.find("1.6667 ms, 2.0000 in the slowest round"), std::string::npos) << table;
}

TEST(Rounds, BatchesComeToTheTotal)
{
    std::vector<std::pair<uint32_t, bool>> batches;
    in_batches(7, 3, [&](uint32_t count, bool is_last) { batches.emplace_back(count, is_last); });
    const std::vector<std::pair<uint32_t, bool>> wanted{{3, false}, {3, false}, {1, true}};
    EXPECT_EQ(batches, wanted);
    in_batches(0, 3, [](uint32_t, bool) { FAIL() << "there is nothing to do"; });
}

} // namespace
} // namespace estampe::bench
