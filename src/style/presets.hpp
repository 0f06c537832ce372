// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace estampe::style {

/// Names of the presets built in: the files presets/*.toml of the source tree, in alphabetical order.
[[nodiscard]] std::vector<std::string> preset_names();

/// The TOML text of a preset; nothing when there is none of that name.
[[nodiscard]] std::optional<std::string_view> preset_text(std::string_view name);

} // namespace estampe::style
