// SPDX-License-Identifier: MIT
#pragma once

// The content of a PLY file before conversion to a scene: its header, its rows, and the parser.

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

/// A property in each row of an element: one number, or a list of numbers preceded by its length.
struct Property {
    std::string name; ///< name of the property, in lower case
    Type type = Type::float32;
    std::optional<Type> length_type; ///< type of a list's length; not set for a single number
};

/// A PLY element: a table of `count` rows. Each row has all properties.
struct Element {
    std::string name; ///< name of the element, in lower case
    uint64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    Format format = Format::ascii;
    std::vector<Element> elements;          ///< elements in the order in which their rows are stored
    std::vector<std::string> texture_files; ///< names of textures, from comments that begin with TextureFile
};

/// Reads the header of a PLY file. Afterwards the input is at the first byte after the line end of the
/// header. Further line ends are not skipped, because binary data may begin with bytes that look like a line
/// end. Throws Error naming file and line when the header is not a PLY header.
[[nodiscard]] Header read_header(Input& input);

/// Rows of numbers as text, one row per line.
class TextRows {
public:
    explicit TextRows(Input& input) : input_(input) {}

    /// Advances to the next row; returns false at the end of the file.
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

    /// Reads the next number of the row. Returns false at the end of the row.
    bool read(Type /*type*/, double& value) { return words_.number(value); }

    /// Returns whether the file is large enough to contain `count` more numbers.
    [[nodiscard]] bool has_room(uint64_t count, Type /*type*/) const { return count <= input_.size(); }

    /// Returns whether the end of the file may have truncated this row.
    [[nodiscard]] bool may_be_cut() const { return !input_.line_was_ended(); }

    /// Returns whether numbers of the row are left that read() has not returned.
    [[nodiscard]] bool has_more_in_row() { return !words_.is_done(); }

    /// Returns whether rows follow.
    [[nodiscard]] bool goes_on() { return next(); }

    /// If a text row is too short, the parser can continue with the next line as a new row.
    static constexpr bool goes_on_after_short_row = true;

private:
    Input& input_;
    Scanner words_{std::string_view()};
};

/// Rows of numbers in binary.
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

    [[nodiscard]] bool has_more_in_row() const { return false; }

    /// Returns whether bytes other than line ends and spaces follow, which some programs write at the end.
    [[nodiscard]] bool goes_on()
    {
        for (; next(); ++used_)
            if (std::string_view(" \t\r\n").find(ahead_[used_]) == std::string_view::npos)
                return true;
        return false;
    }

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

/// The content of a PLY file. Attributes of vertices are empty or have one entry per vertex. All indices are
/// in range.
struct Data {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;    ///< texture coordinates of vertices; v points up, as in the PLY file
    std::vector<glm::vec4> colors; ///< linear colours of vertices
    std::vector<uint32_t> triangles;
    std::vector<glm::vec2> corner_uvs;   ///< texture coordinates for each entry of `triangles`; may be empty
    std::vector<glm::vec4> face_colors;  ///< linear colour of each triangle; may be empty
    std::vector<uint32_t> face_textures; ///< for each triangle: an index into `texture_files`; may be empty
    std::vector<uint32_t> lines;
    std::vector<std::string> texture_files;
    bool promises_faces = false; ///< the header declares faces, strips or edges, even if there are none
    std::vector<std::string> warnings;
};

/// Reads a whole file. Throws Error naming file and line when the header is invalid or has no vertices.
/// Truncated data and elements that use missing vertices are counted in the warnings. Memory: about twice the
/// arrays of the result. Cost: about 0.15 s for a million triangles in binary, 0.4 s as text.
[[nodiscard]] Data parse(Input& input);

} // namespace estampe::ply
