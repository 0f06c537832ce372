// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace estampe::frame {

/// The parts of a list in a style, without spaces about them; empty ones are left out.
[[nodiscard]] std::vector<std::string> between_commas(std::string_view text);

} // namespace estampe::frame
