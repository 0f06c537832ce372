// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace estampe {

/// A number in the spellings that 3D files have: those of std::from_chars, with a plus before it, a decimal
/// comma, or beyond the range of doubles. Whatever else a word is, the number is NaN.
[[nodiscard]] double number_of_word(std::string_view word);

/// Cuts a line at blanks. Inline, as a file has millions of words.
class Scanner {
public:
    explicit Scanner(std::string_view line) : at_(line.data()), end_(line.data() + line.size()) {}

    /// Whether nothing but blanks is left.
    [[nodiscard]] bool is_done()
    {
        skip_blanks();
        return at_ == end_;
    }

    /// The next word; empty at the end.
    [[nodiscard]] std::string_view word()
    {
        skip_blanks();
        const char* const begin = at_;
        while (at_ != end_ && !is_blank(*at_))
            ++at_;
        return {begin, static_cast<size_t>(at_ - begin)};
    }

    /// Reads the next word as a number, NaN if it is none; false at the end.
    [[nodiscard]] bool number(double& value)
    {
        skip_blanks();
        if (at_ == end_)
            return false;
        if (!plain_decimal(value))
            value = number_of_word(word());
        return true;
    }

    /// All that is left, without blanks around it.
    [[nodiscard]] std::string_view rest()
    {
        skip_blanks();
        const char* last = end_;
        while (last != at_ && is_blank(last[-1]))
            --last;
        return {at_, static_cast<size_t>(last - at_)};
    }

    static bool is_blank(char letter)
    {
        return letter == ' ' || letter == '\t' || letter == '\v' || letter == '\f';
    }

private:
    void skip_blanks()
    {
        while (at_ != end_ && is_blank(*at_))
            ++at_;
    }

    /// Reads digits with a point among them, up to fifteen: both the digits and the power of ten are doubles
    /// without error, so that their quotient is rounded once, as std::from_chars rounds (Clinger 1990).
    /// Nothing is consumed when the word is of another kind.
    bool plain_decimal(double& value)
    {
        static constexpr std::array<double, 16> powers{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                       1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
        const char* at = at_;
        const bool is_negative = *at == '-';
        at += is_negative ? 1 : 0;
        uint64_t digits = 0;
        const char* const begin = at;
        const auto read_digits = [&] {
            for (; at != end_ && *at >= '0' && *at <= '9' && at - begin < 17; ++at)
                digits = 10 * digits + static_cast<uint64_t>(*at - '0');
        };
        read_digits();
        const std::ptrdiff_t before_point = at - begin;
        std::ptrdiff_t behind_point = 0;
        if (at != end_ && *at == '.') {
            ++at;
            const char* const point = at;
            read_digits();
            behind_point = at - point;
        }
        const std::ptrdiff_t count = before_point + behind_point;
        if (count == 0 || count > 15 || (at != end_ && !is_blank(*at)))
            return false;
        const double size = static_cast<double>(digits) / powers[static_cast<size_t>(behind_point)];
        value = is_negative ? -size : size;
        at_ = at;
        return true;
    }

    const char* at_;
    const char* end_;
};

} // namespace estampe
