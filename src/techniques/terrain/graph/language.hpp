// SPDX-License-Identifier: MIT
#pragma once

// The language that heights are written in: numbers, names, + - * / ^, and calls with arguments by place or
// by name, of functions that are described here once. `lerp(texture("a.png", 200), fbm(80, octaves = 4),
// sin(time))` is one.

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

enum class NodeForm : uint8_t {
    arithmetic, ///< of values
    curve,      ///< through points
    leaf,       ///< looked up in the plane
    texture,
    mask,
    sand,
    dunes,
    translate, ///< from here on: of the coordinates that what is inside is looked up by
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
    std::optional<double> default_number = {}; ///< numbers without one must be given
    double minimum = -std::numeric_limits<double>::max();
    double maximum = std::numeric_limits<double>::max();
    std::string_view default_text = {};       ///< texts that have one need not be given
    std::vector<std::string_view> words = {}; ///< of a text; none: any
};

struct NodeKind {
    std::string_view name;
    NodeForm form = NodeForm::arithmetic;
    uint32_t op = 0; ///< of terrain.glsl.h
    std::vector<NodeParameter> parameters;
    std::string_view help; ///< one line
};

/// All of them, in the order of the manual.
[[nodiscard]] std::span<const NodeKind> node_kinds();

/// "fbm(wavelength, octaves = 5, gain = 0.447, seed = 0)"; of a sign the sign.
[[nodiscard]] std::string signature(const NodeKind& kind);

/// Null where there is none of that name.
[[nodiscard]] const NodeKind* find_node_kind(std::string_view name);

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
