// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/input/input.hpp"

namespace estampe::ply {

enum class Format : uint8_t { ascii, little_endian, big_endian };

enum class Type : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] size_t bytes_of(Type type);

/// One number of a row, or a list of them with its length before it.
struct Property {
    std::string name; ///< in small letters
    Type type = Type::float32;
    std::optional<Type> length_type; ///< set: a list
};

/// A table: so many rows, each with all properties.
struct Element {
    std::string name; ///< in small letters
    uint64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    Format format = Format::ascii;
    std::vector<Element> elements;          ///< in the order of their rows
    std::vector<std::string> texture_files; ///< of comments that programs write for textured scans
};

/// Reads the header and leaves the input at the first byte behind its last line end: data may begin with
/// bytes that look like another. Throws Error naming file and line when it is not a PLY header.
[[nodiscard]] Header read_header(Input& input);

} // namespace estampe::ply
