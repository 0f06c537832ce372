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

/// Edit distance: how many letters to insert, delete, replace or swap with the next one to turn `a` into `b`
/// (optimal string alignment).
[[nodiscard]] size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`, the first of equals; empty when none is similar enough to be meant.
[[nodiscard]] std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// The present full key of a parameter, given its former key or another program's name for it ("line_width",
/// with or without a section); empty when `key` is unknown.
[[nodiscard]] std::string_view name_today(std::string_view key);

/// How to write what a former key said, if the value has another form today; empty for other keys.
[[nodiscard]] std::string_view advice_for(std::string_view key);

/// All names that name_today() knows, each with its present key.
[[nodiscard]] std::vector<std::pair<std::string_view, std::string_view>> names_known_otherwise();

/// Splits a list of a style at commas, trims spaces, and skips empty parts.
[[nodiscard]] std::vector<std::string> between_commas(std::string_view text);

} // namespace estampe::style
