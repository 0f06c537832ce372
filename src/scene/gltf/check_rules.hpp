// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace estampe::gltf {

/// What one property of a glTF object may be.
enum class Kind : uint8_t { index, integer, number, text, boolean, choice, object, index_map, list };

inline constexpr double max_number = 3.0e38;      ///< what a float can hold
inline constexpr double max_count = 2147483647.0; ///< what a glTF file can address
inline constexpr double max_offset = 1099511627776.0;

struct Rule {
    std::string_view key;
    Kind kind = Kind::object;
    std::string target; ///< the array an index points into, the schema of an object, or the words of a choice
    bool required = false;
    double min = -max_number;
    double max = max_number;
    Kind entry = Kind::object; ///< of a list
    int length = -1;           ///< of a list; negative: any
};

/// The rules of one kind of object: "root", "accessor", "node", ...
[[nodiscard]] std::span<const Rule> rules_of(std::string_view schema);

} // namespace estampe::gltf
