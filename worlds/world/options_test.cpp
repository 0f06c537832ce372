// SPDX-License-Identifier: MIT
#include "registry.hpp"

#include <stdexcept>
#include <tuple>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

namespace worlds {
namespace {

const std::vector<Option> options{
    {.key = "seed", .allowed = WholeRange{}, .initial = "1"},
    {.key = "rooms", .allowed = WholeRange{2, 9}},
    {.key = "hour", .allowed = NumberRange{0.0, 24.0}, .changes_scene = false},
    {.key = "weather", .allowed = Words{"calm", "storm"}},
};

Values values(const std::vector<std::string>& assignments)
{
    return {options, assignments};
}

/// The error message for invalid assignments.
std::string refusal(const std::vector<std::string>& assignments)
{
    try {
        std::ignore = values(assignments);
    } catch (const estampe::Error& problem) {
        return problem.what();
    }
    return "taken";
}

TEST(WorldOptions, AreWhatIsWrittenElseTheirInitialValues)
{
    EXPECT_EQ(values({}).whole("seed"), 1U);
    EXPECT_EQ(values({}).whole("rooms"), std::nullopt);
    EXPECT_EQ(values({}).number("hour"), std::nullopt);
    EXPECT_EQ(values({}).word("weather"), std::nullopt);
    const Values all = values({"weather=storm", "seed=18446744073709551615", "hour=6.5", "rooms=9"});
    EXPECT_EQ(all.whole("seed"), 18446744073709551615U);
    EXPECT_EQ(all.whole("rooms"), 9U);
    EXPECT_EQ(all.number("hour"), 6.5);
    EXPECT_EQ(all.word("weather"), "storm");
    EXPECT_EQ(values({"seed=3", "seed=4"}).whole("seed"), 4U) << "the last one counts";
    EXPECT_THROW(std::ignore = values({}).whole("colour"), std::logic_error);
}

TEST(WorldOptions, UnknownKeysAreRefusedWithTheKnownOnes)
{
    EXPECT_EQ(refusal({"wether=calm"}),
              "the world has no option \"wether\"; its options: seed, rooms, hour, weather");
    EXPECT_EQ(refusal({"storm"}),
              "\"storm\" is not of the form KEY=VALUE; its options: seed, rooms, hour, weather");
    EXPECT_NE(refusal({"=3"}), "taken");
    EXPECT_NE(refusal({"seed="}), "taken");
    try {
        const Values none({}, std::vector<std::string>{"seed=1"});
        FAIL() << "taken";
    } catch (const estampe::Error& problem) {
        EXPECT_STREQ(problem.what(), "the world has no option \"seed\"; it has no options");
    }
}

TEST(WorldOptions, ValuesThatAreNotAllowedAreRefused)
{
    EXPECT_EQ(refusal({"weather=rain"}), "there is no weather \"rain\"; allowed: calm, storm");
    EXPECT_EQ(refusal({"hour=24.1"}), "hour=24.1: 24.1 is out of range; allowed: 0 to 24");
    EXPECT_EQ(refusal({"hour=noon"}), "hour=noon: \"noon\" is not a number; allowed: 0 to 24");
    EXPECT_EQ(refusal({"hour=24"}), "taken");
    EXPECT_EQ(refusal({"rooms=1"}), "rooms=1: 1 is out of range; allowed: 2 to 9");
    EXPECT_EQ(refusal({"rooms=2"}), "taken");
    EXPECT_EQ(refusal({"rooms=2.5"}), "rooms=2.5: \"2.5\" is not a whole number; allowed: 2 to 9");
    for (const char* bad : {"hour=nan", "hour=inf", "hour=1e999", "hour=6h", "hour=-0.1", "seed=-1",
                            "seed= 1", "seed=18446744073709551616"}) {
        EXPECT_NE(refusal({bad}), "taken") << bad;
    }
}

TEST(WorldOptions, TellWhetherTheSceneStaysTheSame)
{
    EXPECT_TRUE(values({}).make_same_scene(values({"seed=1"})));
    EXPECT_TRUE(values({"hour=3"}).make_same_scene(values({"hour=9"})));
    EXPECT_FALSE(values({"seed=2"}).make_same_scene(values({})));
    EXPECT_FALSE(values({"weather=calm"}).make_same_scene(values({})));
}

TEST(WorldOptions, ShowHowTheyAreWritten)
{
    std::vector<std::string> written;
    for (const Option& option : options) {
        written.push_back(option.syntax());
    }
    EXPECT_EQ(written,
              (std::vector<std::string>{"seed=N", "rooms=2..9", "hour=0..24", "weather=calm|storm"}));
}

} // namespace
} // namespace worlds
