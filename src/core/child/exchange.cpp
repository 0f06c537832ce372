// SPDX-License-Identifier: MIT
#include "core/child/exchange.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include <estampe/error.hpp>

namespace estampe {
namespace exchange {
namespace {

/// Size of the pieces in which small values are passed on.
constexpr size_t piece_bytes = size_t{1} << 16U;

/// Returns whether all numbers are finite. The loop compares exponents without a branch, so that the compiler
/// uses vector instructions.
template <typename Number, typename Bits>
bool are_finite(std::span<const Number> numbers, Bits exponent)
{
    Bits any = 0;
    for (const Number number : numbers)
        any |= static_cast<Bits>((std::bit_cast<Bits>(number) & exponent) == exponent ? 1 : 0);
    return any == 0;
}

template <typename Number>
void replace_infinite(std::span<Number> numbers)
{
    constexpr Number largest = std::numeric_limits<Number>::max();
    for (Number& number : numbers)
        number = std::isnan(number) ? Number{0} : std::clamp(number, -largest, largest);
}

} // namespace
} // namespace exchange

void make_finite(std::span<float> numbers)
{
    if (!exchange::are_finite<float, uint32_t>(numbers, 0x7f800000U))
        exchange::replace_infinite(numbers);
}

void make_finite(std::span<double> numbers)
{
    if (!exchange::are_finite<double, uint64_t>(numbers, 0x7ff0000000000000U))
        exchange::replace_infinite(numbers);
}

void ByteWriter::bytes(std::span<const std::byte> bytes)
{
    const bool is_large = bytes.size() > exchange::piece_bytes / 2;
    if (is_large || collected_.size() + bytes.size() > exchange::piece_bytes)
        flush();
    if (is_large)
        write_(bytes);
    else
        collected_.insert(collected_.end(), bytes.begin(), bytes.end());
}

void ByteWriter::flush()
{
    if (!collected_.empty())
        write_(collected_);
    collected_.clear();
}

void ByteReader::bytes(std::span<std::byte> target)
{
    while (!target.empty()) {
        const size_t count = read_ahead(target);
        if (count == 0)
            damaged();
        target = target.subspan(count);
    }
}

size_t ByteReader::read_ahead(std::span<std::byte> target)
{
    if (next_ == ahead_.size()) {
        if (target.size() > exchange::piece_bytes / 2)
            return read_(target);
        ahead_.resize(exchange::piece_bytes);
        ahead_.resize(read_(ahead_));
        next_ = 0;
    }
    const size_t count = std::min(target.size(), ahead_.size() - next_);
    if (count > 0)
        std::memcpy(target.data(), ahead_.data() + next_, count);
    next_ += count;
    return count;
}

void ByteReader::claim(uint64_t count, uint64_t bytes_each)
{
    if (count > budget_bytes_ / bytes_each)
        damaged();
    budget_bytes_ -= count * bytes_each;
}

void ByteReader::damaged() const
{
    throw Error("what was read from it came back damaged", where_);
}

} // namespace estampe
