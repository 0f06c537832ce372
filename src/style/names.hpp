// SPDX-License-Identifier: MIT
#pragma once

// Names in texts: lists of names, assignments to names ("Skin=form, Sea=wind"), and suggestions for a
// misspelt name.

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

/// All names that name_today() knows, each with its present key.
[[nodiscard]] std::vector<std::pair<std::string_view, std::string_view>> names_known_otherwise();

struct Assignment {
    std::string name;
    std::string value;
};

/// Splits `text` at commas; the last "=" of each part ends its name. Throws Error with `key` as its place
/// when a part has no "="; the message names the required `form` ("material=kind") and shows `example`.
[[nodiscard]] std::vector<Assignment> assignments(std::string_view text, const std::string& key,
                                                  const std::string& form, const std::string& example);

/// Throws Error with the message `wanted` ("the scene has no material") and `name`. Suggests the nearest of
/// `names`, or lists all.
[[noreturn]] void fail_unknown(const std::string& wanted, const std::string& name, const std::string& key,
                               const std::vector<std::string>& names);

/// Splits a list of a style at commas, trims spaces, and skips empty parts.
[[nodiscard]] std::vector<std::string> between_commas(std::string_view text);

} // namespace estampe::style
