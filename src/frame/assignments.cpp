// SPDX-License-Identifier: MIT
#include "frame/assignments.hpp"

#include <algorithm>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "style/raw.hpp"
#include "style/suggest.hpp"

namespace estampe::frame {
namespace {

std::string_view trimmed(std::string_view text)
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
    while (!trimmed(text).empty()) {
        const std::string_view item = text.substr(0, text.find(','));
        text.remove_prefix(std::min(item.size() + 1, text.size()));
        const size_t equals = item.rfind('=');
        if (equals == std::string_view::npos) {
            throw Error(fmt::format("{} is not of the form {}", style::in_quotes(item), form), key,
                        fmt::format("write for instance {}", style::in_quotes(example)));
        }
        parts.push_back(
            {std::string(trimmed(item.substr(0, equals))), std::string(trimmed(item.substr(equals + 1)))});
    }
    return parts;
}

void fail_unknown(const std::string& wanted, const std::string& name, const std::string& key,
                  const std::vector<std::string>& names)
{
    const std::string meant = style::nearest(name, names);
    throw Error(fmt::format("{} {}", wanted, style::in_quotes(name)), key,
                meant.empty() ? fmt::format("it has {}", fmt::join(names, ", "))
                              : fmt::format("did you mean {}?", style::in_quotes(meant)));
}

} // namespace estampe::frame
