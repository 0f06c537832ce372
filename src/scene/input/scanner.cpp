// SPDX-License-Identifier: MIT
#include "scene/input/scanner.hpp"

namespace estampe {

double number_of_word(std::string_view word)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (word.starts_with('+'))
        word.remove_prefix(1);
    double value = nan;
    const char* const end = word.data() + word.size();
    const auto [stopped, error] = std::from_chars(word.data(), end, value);
    if (error == std::errc::result_out_of_range && stopped == end) {
        const bool is_tiny = word.find("e-") != std::string_view::npos ||
                             word.find("E-") != std::string_view::npos ||
                             word.find_first_of("eE") == std::string_view::npos;
        return is_tiny ? 0.0 : std::numeric_limits<double>::infinity();
    }
    if (error == std::errc() && stopped == end)
        return value;
    // Programs that write in the language of their user put a comma before the fraction.
    const size_t comma = word.find(',');
    if (comma == std::string_view::npos || comma + 1 == word.size() ||
        word.find('.') != std::string_view::npos)
        return nan;
    std::string with_point(word);
    with_point[comma] = '.';
    return with_point.find(',') == std::string::npos ? number_of_word(with_point) : nan;
}

} // namespace estampe
