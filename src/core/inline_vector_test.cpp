// SPDX-License-Identifier: MIT
#include "core/inline_vector.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace estampe {
namespace {

struct Pair {
    int number;
    double share;

    bool operator==(const Pair&) const = default;
};

TEST(InlineVector, HoldsWhatIsGivenInItsOrder)
{
    InlineVector<Pair, 3> few{{1, 0.5}, {2, 0.25}};
    few.push_back({3, 0.125});
    ASSERT_EQ(few.size(), 3U);
    EXPECT_TRUE(std::ranges::equal(few, std::array{Pair{1, 0.5}, Pair{2, 0.25}, Pair{3, 0.125}}));
    EXPECT_EQ(few.front(), (Pair{1, 0.5}));
    const InlineVector<Pair, 3> other = few;
    EXPECT_EQ(other[2], (Pair{3, 0.125}));
    EXPECT_FALSE(other.empty());
    EXPECT_TRUE((InlineVector<Pair, 3>().empty()));
}

TEST(InlineVector, TakesNoMoreThanItHasRoomFor)
{
    InlineVector<int, 2> few{1, 2};
    EXPECT_THROW(few.push_back(3), std::length_error);
    EXPECT_EQ(few.size(), 2U);
    EXPECT_THROW((InlineVector<int, 1>{1, 2}), std::length_error);
}

} // namespace
} // namespace estampe
