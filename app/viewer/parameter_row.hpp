// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "style/parameter.hpp"

namespace estampe::viewer {

/// What a person did to a row.
struct RowEdit {
    std::optional<style::Value> value; ///< another one
    bool is_finished = false;          ///< a drag at its end, what is picked or typed at once
};

/// A line of a panel: the name of a parameter, a control of its kind, and a way back to `base` where it
/// differs.
[[nodiscard]] RowEdit show_parameter_row(const std::string& section, const style::Parameter& parameter,
                                         const style::Value& held, const style::Value& base);

} // namespace estampe::viewer
