// SPDX-License-Identifier: MIT
#pragma once

// What a PLY file says, before it is a scene: its header, its rows, all of it.

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <estampe/scene.hpp>

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

/// Rows of numbers in text: one a line.
class TextRows {
public:
    explicit TextRows(Input& input) : input_(input) {}

    /// Goes to the next row; false at the end of the file.
    bool next()
    {
        std::string_view line;
        do {
            if (!input_.next_line(line))
                return false;
            words_ = Scanner(line);
        } while (words_.is_done());
        return true;
    }

    /// Reads a number; false when the row has no more.
    bool read(Type /*type*/, double& value) { return words_.number(value); }

    /// Whether so many numbers can still come.
    [[nodiscard]] bool has_room(uint64_t count, Type /*type*/) const { return count <= input_.size(); }

    /// Whether the row may lack its end, where the file ends.
    [[nodiscard]] bool may_be_cut() const { return !input_.line_was_ended(); }

    /// A row that is short has an end all the same.
    static constexpr bool goes_on_after_short_row = true;

private:
    Input& input_;
    Scanner words_{std::string_view()};
};

/// Rows of numbers as bytes.
class BinaryRows {
public:
    BinaryRows(Input& input, bool is_big_endian)
        : input_(input), is_swapped_(is_big_endian == (std::endian::native == std::endian::little))
    {
    }

    ~BinaryRows() { release(); }

    BinaryRows(const BinaryRows&) = delete;
    BinaryRows& operator=(const BinaryRows&) = delete;

    bool next() { return left() > 0 || refill(1); }

    bool read(Type type, double& value)
    {
        const size_t size = bytes_of(type);
        if (left() < size && !refill(size))
            return false;
        unsigned char bytes[8] = {};
        std::memcpy(bytes, ahead_.data() + used_, size);
        used_ += size;
        if (is_swapped_)
            for (size_t i = 0; i < size / 2; ++i)
                std::swap(bytes[i], bytes[size - 1 - i]);
        value = number_of(type, bytes);
        return true;
    }

    [[nodiscard]] bool has_room(uint64_t count, Type type) const
    {
        return count <= (input_.bytes_left() - used_) / bytes_of(type);
    }

    [[nodiscard]] bool may_be_cut() const { return false; }

    static constexpr bool goes_on_after_short_row = false;

private:
    [[nodiscard]] size_t left() const { return ahead_.size() - used_; }

    void release()
    {
        input_.skip(used_);
        used_ = 0;
        ahead_ = {};
    }

    bool refill(size_t wanted)
    {
        release();
        ahead_ = input_.peek(wanted);
        return ahead_.size() >= wanted;
    }

    template <typename Value>
    static double as(const unsigned char* bytes)
    {
        Value value;
        std::memcpy(&value, bytes, sizeof value);
        return static_cast<double>(value);
    }

    static double number_of(Type type, const unsigned char* bytes)
    {
        switch (type) {
        case Type::int8:
            return as<int8_t>(bytes);
        case Type::uint8:
            return as<uint8_t>(bytes);
        case Type::int16:
            return as<int16_t>(bytes);
        case Type::uint16:
            return as<uint16_t>(bytes);
        case Type::int32:
            return as<int32_t>(bytes);
        case Type::uint32:
            return as<uint32_t>(bytes);
        case Type::float32:
            return as<float>(bytes);
        case Type::float64:
            return as<double>(bytes);
        }
        return std::numeric_limits<double>::quiet_NaN();
    }

    Input& input_;
    bool is_swapped_;
    std::string_view ahead_;
    size_t used_ = 0;
};

/// Attributes of vertices are empty or one for each vertex. Indices are in range.
struct Data {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;    ///< v runs up, as in the file
    std::vector<glm::vec4> colors; ///< linear
    std::vector<uint32_t> triangles;
    std::vector<glm::vec2> corner_uvs;   ///< empty, or one for each entry of `triangles`
    std::vector<glm::vec4> face_colors;  ///< empty, or one for each triangle; linear
    std::vector<uint32_t> face_textures; ///< empty, or a place in `texture_files` for each triangle
    std::vector<uint32_t> lines;
    std::vector<std::string> texture_files;
    bool promises_faces = false; ///< the header has faces, strips or edges, whether they came or not
    std::vector<std::string> warnings;
};

/// Reads a whole file. Throws Error naming file and line when its header is none or has no vertices. What is
/// cut off, and elements that name vertices which are not there, are counted in the warnings. Memory: about
/// twice the arrays of the result. Cost: about 0.15 s for a million triangles in binary, 0.4 s as text.
[[nodiscard]] Data parse(Input& input);

} // namespace estampe::ply
