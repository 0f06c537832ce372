// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "style/sheet.hpp"

namespace estampe::viewer {

/// Whether each word of `search` is found in the name of the parameter, its section or its help.
[[nodiscard]] bool matches(const style::Sheet::Section& section, const style::Parameter& parameter,
                           const std::string& search);

/// Whether any of its parameters does.
[[nodiscard]] bool matches(const style::Sheet::Section& section, const std::string& search);

} // namespace estampe::viewer
