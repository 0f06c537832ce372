// SPDX-License-Identifier: MIT
#pragma once

// What heights are made of: every function of the language, described once.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace estampe::terrain {

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
    uint32_t op = 0; ///< of program.glsl.h
    std::vector<NodeParameter> parameters;
    std::string_view help; ///< one line
};

/// All of them, in the order of the manual.
[[nodiscard]] std::span<const NodeKind> node_kinds();

/// "fbm(wavelength, octaves = 5, gain = 0.447, seed = 0)"; of a sign the sign.
[[nodiscard]] std::string signature(const NodeKind& kind);

/// Null where there is none of that name.
[[nodiscard]] const NodeKind* find_node_kind(std::string_view name);

} // namespace estampe::terrain
