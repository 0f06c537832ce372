// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace estampe::app {

/// Writes "estampe: warning: ..." to standard error for each.
void print_warnings(const std::vector<std::string>& warnings);

/// Writes "estampe: note: ..." to standard error for each.
void print_notes(const std::vector<std::string>& notes);

} // namespace estampe::app
