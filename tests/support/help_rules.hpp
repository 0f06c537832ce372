// SPDX-License-Identifier: MIT
#pragma once

// Rules for every help line: it is a clause that stands alone, because it is also shown as a tooltip and as a
// schema's description.

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <string_view>

#include "core/text.hpp"

namespace estampe::test {

/// The help text joined into one line, without the default value in brackets at its end.
inline std::string clause_of(std::string_view line)
{
    std::istringstream words{std::string(line)};
    std::string clause;
    for (std::string word; words >> word;) {
        clause += (clause.empty() ? "" : " ") + word;
    }
    if (const size_t bracket = clause.rfind(" ["); bracket != std::string::npos && clause.ends_with(']')) {
        clause.resize(bracket);
    }
    return clause;
}

/// The fault of a help line; empty if there is none. A single sentence must end without a full stop, several
/// sentences with a full stop.
inline std::string fault_of_help(std::string_view line, size_t least_words = 4)
{
    const std::string clause = clause_of(line);
    const std::string low = lower_case(clause);
    const size_t words = 1 + static_cast<size_t>(std::ranges::count(clause, ' '));
    if (clause.empty() || words < least_words) {
        return "has too few words";
    }
    constexpr std::array leaning{"and",  "of",    "the same", "then",     "whether", "it",   "its",
                                 "they", "their", "them",     "as above", "this",    "that", "those"};
    for (const std::string opening : leaning) {
        if (low.starts_with(opening + " ") || low.starts_with(opening + ",")) {
            return "begins with \"" + opening + "\" and so leans on what stands before";
        }
    }
    for (const char* pointer : {"the same as above", "see above", "see below", "likewise"}) {
        if (low.find(pointer) != std::string::npos) {
            return std::string("points elsewhere by \"") + pointer + "\"";
        }
    }
    const bool has_several = clause.find(". ") != std::string::npos;
    if (has_several != clause.ends_with('.')) {
        return has_several ? "has several sentences and no full stop at the end"
                           : "is one sentence and has a full stop at the end";
    }
    return {};
}

} // namespace estampe::test
