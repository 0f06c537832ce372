// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "techniques/terrain/graph/expression.hpp"
#include "techniques/terrain/graph/node_kinds.hpp"

namespace estampe::terrain {

/// What a call was given, by the names of its kind's parameters.
struct Arguments {
    std::map<std::string_view, const Expression*> values;
    std::map<std::string_view, double> numbers;
    std::map<std::string_view, std::string> texts;
    std::vector<double> rest; ///< beyond the named ones: points of a curve

    [[nodiscard]] const Expression& value(std::string_view name) const { return *values.at(name); }

    [[nodiscard]] double number(std::string_view name) const { return numbers.at(name); }

    [[nodiscard]] const std::string& text(std::string_view name) const { return texts.at(name); }
};

/// Sorts the arguments of `call` to the parameters of `kind`, by place or by name, and checks them.
/// `number_of` gives the number that an expression is; `fail` throws.
[[nodiscard]] Arguments
bind_arguments(const NodeKind& kind, const Expression& call,
               const std::function<double(const Expression&)>& number_of,
               const std::function<void(const Expression&, const std::string&)>& fail);

} // namespace estampe::terrain
