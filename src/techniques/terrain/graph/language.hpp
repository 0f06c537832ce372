// SPDX-License-Identifier: MIT
#pragma once

// The language of height expressions: numbers, names, the operators + - * / ^, and calls with arguments by
// position or by name. The file language.hpp lists the functions and their parameters. An example of an
// expression is `lerp(texture("a.png", 200), fbm(80, octaves = 4), sin(time))`.

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

/// An argument of a call. `name` is empty if the argument is given by its position.
struct Argument {
    std::string name;
    std::unique_ptr<Expression> value;
    size_t column = 0;
};

/// A node of the syntax tree of an expression.
struct Expression {
    enum class Kind { number, text, name, call };

    Kind kind = Kind::number;
    double number = 0.0;
    /// A text, the name of a node, the name of a called function, or an operator: "+", "-", "*", "/", "^".
    std::string word;
    std::vector<Argument> arguments; ///< arguments of a call; empty for other kinds
    size_t column = 1;               ///< column of the first character in the text, counted from 1
};

/// Returns whether `text` is a valid name for a node: letters, digits and _, not beginning with a digit.
[[nodiscard]] bool is_name(std::string_view text);

/// Parses the expression of a node. Throws Error for invalid syntax, for more than 1,000 operators and calls,
/// and for more than 200 levels of nesting. The Error names the node, its place in the file and the
/// character.
[[nodiscard]] std::unique_ptr<Expression> parse_expression(const HeightNode& node);

enum class NodeForm : uint8_t {
    arithmetic, ///< a function of values, such as a sum or a sine
    curve,      ///< a curve through points
    leaf,       ///< a function of the coordinates, such as noise
    texture,
    mask,
    sand,
    dunes,
    translate, ///< moves the coordinates of the nodes inside it, as do all later kinds of this list
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
    /// Value if the argument is missing; none: the argument is required.
    std::optional<double> default_number = {};
    double minimum = -std::numeric_limits<double>::max();
    double maximum = std::numeric_limits<double>::max();
    /// Text if the argument is missing; empty: the argument is required.
    std::string_view default_text = {};
    std::vector<std::string_view> words = {}; ///< allowed texts; empty: any text
};

struct NodeKind {
    std::string_view name;
    NodeForm form = NodeForm::arithmetic;
    uint32_t op = 0; ///< number of the operation, see terrain.glsl.h
    std::vector<NodeParameter> parameters;
    std::string_view help; ///< help text of one line
};

/// All functions and operators of height expressions, in the order of the manual.
[[nodiscard]] std::span<const NodeKind> node_kinds();

/// How a function is called, as text: "fbm(wavelength, octaves = 5, gain = 0.447, seed = 0)". For an
/// operator, returns its sign.
[[nodiscard]] std::string signature(const NodeKind& kind);

/// Finds a function or operator by its name. Returns null for an unknown name.
[[nodiscard]] const NodeKind* find_node_kind(std::string_view name);

/// The arguments of a call, found by the names of the function's parameters.
struct Arguments {
    std::map<std::string_view, const Expression*> values;
    std::map<std::string_view, double> numbers;
    std::map<std::string_view, std::string> texts;
    std::vector<double> rest; ///< numbers after the named arguments: the points of a curve

    [[nodiscard]] const Expression& value(std::string_view name) const { return *values.at(name); }

    [[nodiscard]] double number(std::string_view name) const { return numbers.at(name); }

    [[nodiscard]] const std::string& text(std::string_view name) const { return texts.at(name); }
};

/// Assigns the arguments of `call` to the parameters of `kind`, by position or by name, and checks them.
/// `number_of` evaluates an expression to a number. `fail` throws an Error about an expression.
[[nodiscard]] Arguments
bind_arguments(const NodeKind& kind, const Expression& call,
               const std::function<double(const Expression&)>& number_of,
               const std::function<void(const Expression&, const std::string&)>& fail);

} // namespace estampe::terrain
