// SPDX-License-Identifier: MIT
#pragma once

// Names in texts: lists of them, what is said of each ("Skin=form, Sea=wind"), and the known one that was
// meant.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace estampe::style {

/// How many letters to insert, delete, replace or swap with the next one to turn `a` into `b` (optimal string
/// alignment).
[[nodiscard]] size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`, the first of equals; empty when none is near enough to be what was meant.
[[nodiscard]] std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// Today's full key of a parameter that had the key `key` before, or that other programs call so
/// ("line_width", with or without a section); empty when there is none.
[[nodiscard]] std::string_view name_today(std::string_view key);

/// Names that name_today() knows, each with its answer.
[[nodiscard]] std::vector<std::pair<std::string_view, std::string_view>> names_known_otherwise();

struct Assignment {
    std::string name;
    std::string value;
};

/// The parts of `text`, which commas divide; the last "=" of each ends its name. Throws Error, whose place is
/// `key`, when a part has none: it is not of the `form` ("material=kind"), which `example` shows.
[[nodiscard]] std::vector<Assignment> assignments(std::string_view text, const std::string& key,
                                                  const std::string& form, const std::string& example);

/// Throws Error: `wanted` ("the scene has no material") is not among `names`; the remedy is the nearest or
/// all.
[[noreturn]] void fail_unknown(const std::string& wanted, const std::string& name, const std::string& key,
                               const std::vector<std::string>& names);

/// The parts of a list in a style, without spaces about them; empty ones are left out.
[[nodiscard]] std::vector<std::string> between_commas(std::string_view text);

} // namespace estampe::style
