// SPDX-License-Identifier: MIT
#include "style/name_lists.hpp"

#include <algorithm>
#include <sstream>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "style/raw.hpp"
#include "style/suggest.hpp"

namespace estampe::style {
namespace {

std::string_view without_outer_spaces(std::string_view text)
{
    while (!text.empty() && text.front() == ' ') {
        text.remove_prefix(1);
    }
    while (!text.empty() && text.back() == ' ') {
        text.remove_suffix(1);
    }
    return text;
}

} // namespace

std::vector<Assignment> assignments(std::string_view text, const std::string& key, const std::string& form,
                                    const std::string& example)
{
    std::vector<Assignment> parts;
    while (!without_outer_spaces(text).empty()) {
        const std::string_view item = text.substr(0, text.find(','));
        text.remove_prefix(std::min(item.size() + 1, text.size()));
        const size_t equals = item.rfind('=');
        if (equals == std::string_view::npos) {
            throw Error(fmt::format("{} is not of the form {}", in_quotes(item), form), key,
                        fmt::format("write for instance {}", in_quotes(example)));
        }
        parts.push_back({std::string(without_outer_spaces(item.substr(0, equals))),
                         std::string(without_outer_spaces(item.substr(equals + 1)))});
    }
    return parts;
}

void fail_unknown(const std::string& wanted, const std::string& name, const std::string& key,
                  const std::vector<std::string>& names)
{
    const std::string meant = nearest(name, names);
    throw Error(fmt::format("{} {}", wanted, in_quotes(name)), key,
                meant.empty() ? fmt::format("it has {}", fmt::join(names, ", "))
                              : fmt::format("did you mean {}?", in_quotes(meant)));
}

std::vector<std::string> between_commas(std::string_view text)
{
    std::vector<std::string> parts;
    std::istringstream stream{std::string(text)};
    for (std::string part; std::getline(stream, part, ',');) {
        const size_t first = part.find_first_not_of(' ');
        if (first != std::string::npos) {
            parts.push_back(part.substr(first, part.find_last_not_of(' ') + 1 - first));
        }
    }
    return parts;
}

} // namespace estampe::style
