// SPDX-License-Identifier: MIT
#include "core/child/exchange.hpp"

#include <cmath>
#include <limits>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "core/child/exchange_test_support.hpp"

namespace estampe {
namespace {

using Bytes = std::vector<std::byte>;
using test::sent;

enum class Fruit : uint8_t { apple, pear };

bool is_valid(Fruit fruit)
{
    return fruit == Fruit::apple || fruit == Fruit::pear;
}

struct Inner {
    std::vector<glm::vec3> points;
    std::optional<double> number;

    bool operator==(const Inner&) const = default;
};

struct Outer {
    bool is_set = false;
    Fruit fruit = Fruit::apple;
    std::string text;
    std::filesystem::path path;
    std::vector<Inner> inner;
    std::array<std::vector<uint16_t>, 2> pair;

    bool operator==(const Outer&) const = default;
};

template <Either<Inner> T>
auto members(T& inner)
{
    auto& [points, number] = inner;
    return std::tie(points, number);
}

template <Either<Outer> T>
auto members(T& outer)
{
    auto& [is_set, fruit, text, path, inner, pair] = outer;
    return std::tie(is_set, fruit, text, path, inner, pair);
}

/// Receives a value from bytes that arrive in pieces of `piece` bytes.
template <typename T>
T received(std::span<const std::byte> bytes, uint64_t budget_bytes = 1U << 26U, size_t piece = 1000)
{
    ByteReader reader = test::reader_of(bytes, budget_bytes, "there", piece);
    T value{};
    receive(reader, value);
    return value;
}

Outer sample()
{
    Outer outer{.is_set = true, .fruit = Fruit::pear, .text = "text", .path = "a/b"};
    outer.inner.resize(3);
    outer.inner[1].points.assign(100'000, glm::vec3(1.0F, 2.0F, 3.0F));
    outer.inner[2].number = 7.5;
    outer.pair[1] = {1, 2, 3};
    return outer;
}

TEST(Exchange, ValuesArriveAsTheyWereSent)
{
    const Outer outer = sample();
    for (const size_t piece : {size_t{1} << 30U, size_t{1000}, size_t{7}})
        EXPECT_EQ(received<Outer>(sent(outer), 1U << 26U, piece), outer) << piece;
}

TEST(Exchange, TruncatedBytesAreAnError)
{
    Outer outer = sample();
    outer.inner[1].points.resize(5);
    const Bytes bytes = sent(outer);
    for (size_t size = 0; size < bytes.size(); ++size)
        EXPECT_THROW((void)received<Outer>(std::span(bytes).first(size)), Error) << size;
}

TEST(Exchange, UnknownBoolsAndEnumerationsAreErrors)
{
    EXPECT_THROW((void)received<bool>(sent(uint8_t{2})), Error);
    EXPECT_THROW((void)received<Fruit>(sent(uint8_t{2})), Error);
    EXPECT_EQ(received<Fruit>(sent(uint8_t{1})), Fruit::pear);
}

TEST(Exchange, CountsBeyondTheBudgetAreErrors)
{
    for (const uint64_t count : {uint64_t{1} << 20U, uint64_t{1} << 40U, uint64_t{1} << 62U, ~uint64_t{0}}) {
        EXPECT_THROW((void)received<std::vector<double>>(sent(count), 1U << 20U), Error) << count;
        EXPECT_THROW((void)received<std::vector<Inner>>(sent(count), 1U << 20U), Error) << count;
        EXPECT_THROW((void)received<std::string>(sent(count), 1U << 19U), Error) << count;
    }
    std::vector<std::vector<uint8_t>> many(8, std::vector<uint8_t>(1000));
    EXPECT_NO_THROW((void)received<std::vector<std::vector<uint8_t>>>(sent(many), 9000));
    EXPECT_THROW((void)received<std::vector<std::vector<uint8_t>>>(sent(many), 7000), Error);
}

TEST(Exchange, NumbersThatAreNotFiniteAreReplaced)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float largest = std::numeric_limits<float>::max();
    const std::vector<glm::vec2> numbers{{std::nanf(""), 1.0F}, {infinity, -infinity}};
    const auto arrived = received<std::vector<glm::vec2>>(sent(numbers));
    EXPECT_EQ(arrived, (std::vector<glm::vec2>{{0.0F, 1.0F}, {largest, -largest}}));
    EXPECT_EQ(received<double>(sent(std::numeric_limits<double>::quiet_NaN())), 0.0);
}

} // namespace
} // namespace estampe
