// SPDX-License-Identifier: MIT
#pragma once

// The language that heights are written in: numbers, names, + - * / ^, and calls with arguments by place or
// by name. `lerp(texture("a.png", 200), fbm(80, octaves = 4), sin(time))` is one.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <estampe/terrain.hpp>

namespace estampe::terrain {

struct Expression;

/// Of a call: `name` is empty where it is given by its place.
struct Argument {
    std::string name;
    std::unique_ptr<Expression> value;
    size_t column = 0;
};

/// A node of what was written.
struct Expression {
    enum class Kind { number, text, name, call };

    Kind kind = Kind::number;
    double number = 0.0;
    std::string word; ///< a text, a name, or what is called; operators are called "+", "-", "*", "/" and "^"
    std::vector<Argument> arguments; ///< of a call
    size_t column = 1;               ///< where in the text it begins, counted from 1
};

/// Whether a node may be called so: letters, digits and _, of which a digit is not the first.
[[nodiscard]] bool is_name(std::string_view text);

/// Reads the expression of a node. Throws Error with the node's place, its name and the character, for what
/// is no expression, has more than 1,000 signs and calls, or is deeper than 200 levels.
[[nodiscard]] std::unique_ptr<Expression> parse_expression(const HeightNode& node);

} // namespace estampe::terrain
