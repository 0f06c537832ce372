// SPDX-License-Identifier: MIT
#pragma once

// The language of height expressions: numbers, names, + - * / ^, and calls with arguments by position or by
// name. The functions are described here. An example is `lerp(texture("a.png", 200), fbm(80, octaves = 4),
// sin(time))`.

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <estampe/terrain.hpp>

namespace estampe::terrain {

struct Expression;

/// An argument of a call; `name` is empty if it is given by position.
struct Argument {
    std::string name;
    std::unique_ptr<Expression> value;
    size_t column = 0;
};

/// A node of the syntax tree.
struct Expression {
    enum class Kind { number, text, name, call };

    Kind kind = Kind::number;
    double number = 0.0;
    std::string word; ///< a text, a name, or the called function or operator: "+", "-", "*", "/", "^"
    std::vector<Argument> arguments; ///< only for calls
    size_t column = 1;               ///< first column in the text, counted from 1
};

/// Returns whether a node may have this name: letters, digits and _, not beginning with a digit.
[[nodiscard]] bool is_name(std::string_view text);

/// Parses the expression of a node. Throws Error with the node's place, its name and the character, for
/// invalid syntax, for more than 1,000 operators and calls, and for more than 200 levels of nesting.
[[nodiscard]] std::unique_ptr<Expression> parse_expression(const HeightNode& node);

enum class NodeForm : uint8_t {
    arithmetic, ///< arithmetic on values
    curve,      ///< a curve through points
    leaf,       ///< a function of the coordinates
    texture,
    mask,
    sand,
    dunes,
    translate, ///< this form and those below change the coordinates of the nodes inside them
    rotate,
    scale,
    polar,
    warp,
    downwind
};

enum class ParameterForm : uint8_t { value, number, text };

struct NodeParameter {
    std::string_view name;
    ParameterForm form = ParameterForm::value;
    std::optional<double> default_number = {}; ///< none: the number must be given
    double minimum = -std::numeric_limits<double>::max();
    double maximum = std::numeric_limits<double>::max();
    std::string_view default_text = {};       ///< if not empty, the text is optional
    std::vector<std::string_view> words = {}; ///< allowed texts; empty allows any
};

struct NodeKind {
    std::string_view name;
    NodeForm form = NodeForm::arithmetic;
    uint32_t op = 0; ///< operation in terrain.glsl.h
    std::vector<NodeParameter> parameters;
    std::string_view help; ///< one line
};

/// All kinds of nodes, in the order of the manual.
[[nodiscard]] std::span<const NodeKind> node_kinds();

/// How a kind is called, "fbm(wavelength, octaves = 5, gain = 0.447, seed = 0)"; for an operator its sign.
[[nodiscard]] std::string signature(const NodeKind& kind);

/// Finds a kind by name; null for an unknown name.
[[nodiscard]] const NodeKind* find_node_kind(std::string_view name);

/// The arguments of a call, by the names of its kind's parameters.
struct Arguments {
    std::map<std::string_view, const Expression*> values;
    std::map<std::string_view, double> numbers;
    std::map<std::string_view, std::string> texts;
    std::vector<double> rest; ///< further numbers after the named ones: points of a curve

    [[nodiscard]] const Expression& value(std::string_view name) const { return *values.at(name); }

    [[nodiscard]] double number(std::string_view name) const { return numbers.at(name); }

    [[nodiscard]] const std::string& text(std::string_view name) const { return texts.at(name); }
};

/// Assigns the arguments of `call` to the parameters of `kind`, by position or by name, and checks them.
/// `number_of` evaluates an expression to a number; `fail` throws.
[[nodiscard]] Arguments
bind_arguments(const NodeKind& kind, const Expression& call,
               const std::function<double(const Expression&)>& number_of,
               const std::function<void(const Expression&, const std::string&)>& fail);

} // namespace estampe::terrain
