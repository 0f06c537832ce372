// SPDX-License-Identifier: MIT
#pragma once

// Names in texts: lists of names, and suggestions for misspelt and for former names.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace estampe::style {

/// Edit distance between two words: the number of letters that must be inserted, deleted, replaced or swapped
/// with the next letter to turn `a` into `b` (optimal string alignment).
[[nodiscard]] size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the candidate whose spelling is nearest to `word`; the first candidate if several are equally
/// near. Empty if no candidate is similar enough.
[[nodiscard]] std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// Returns the present full key of a parameter, given its former key or another program's name for it
/// ("line_width", with or without a section); empty when `key` is unknown.
[[nodiscard]] std::string_view name_today(std::string_view key);

/// Returns advice on how to write a former key whose values are written differently today; empty for other
/// keys.
[[nodiscard]] std::string_view advice_for(std::string_view key);

/// All names that name_today() knows, each with its present key.
[[nodiscard]] std::vector<std::pair<std::string_view, std::string_view>> names_known_otherwise();

/// Splits a list in a style parameter at commas, trims spaces, and skips empty parts.
[[nodiscard]] std::vector<std::string> between_commas(std::string_view text);

} // namespace estampe::style
