// SPDX-License-Identifier: MIT
#include "scene/ply/ply_parse.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/text.hpp"
#include "scene/input/input.hpp"

namespace estampe::ply {
namespace {

constexpr size_t longest_line = 65536;
constexpr uint64_t most_lines = 100000;

std::optional<Type> type_of(std::string_view word)
{
    constexpr std::array<std::pair<std::string_view, Type>, 16> types{{{"char", Type::int8},
                                                                       {"uchar", Type::uint8},
                                                                       {"short", Type::int16},
                                                                       {"ushort", Type::uint16},
                                                                       {"int", Type::int32},
                                                                       {"uint", Type::uint32},
                                                                       {"float", Type::float32},
                                                                       {"double", Type::float64},
                                                                       {"int8", Type::int8},
                                                                       {"uint8", Type::uint8},
                                                                       {"int16", Type::int16},
                                                                       {"uint16", Type::uint16},
                                                                       {"int32", Type::int32},
                                                                       {"uint32", Type::uint32},
                                                                       {"float32", Type::float32},
                                                                       {"float64", Type::float64}}};
    const std::string name = lower_case(word);
    const auto* const found =
        std::find_if(types.begin(), types.end(), [&name](const auto& type) { return type.first == name; });
    return found == types.end() ? std::nullopt : std::optional(found->second);
}

class HeaderReader {
public:
    explicit HeaderReader(Input& input) : input_(input) {}

    Header run()
    {
        read_magic();
        while (true) {
            Scanner words(next_line());
            const std::string keyword = lower_case(words.word());
            if (keyword == "end_header")
                break;
            read_line(keyword, words);
        }
        if (!has_format_)
            refuse("its header does not say its format");
        return std::move(header_);
    }

private:
    /// Throws Error for the line that was read last. The message quotes nothing, because a file with the
    /// ending of PLY may be anything.
    [[noreturn]] void refuse(const std::string& what) const
    {
        throw Error(what, fmt::format("{}:{}", input_.name(), line_number_), "check that the file is whole");
    }

    /// Checks that the file begins with "ply". Skips line ends before this word.
    void read_magic()
    {
        std::string_view start = input_.peek(1);
        while (!start.empty() && (start[0] == '\n' || start[0] == '\r')) {
            line_number_ += start[0] == '\n' ? 1 : 0;
            input_.skip(1);
            start = input_.peek(1);
        }
        if (lower_case(input_.peek(3).substr(0, 3)) != "ply")
            refuse("is not a PLY file");
        // The line end of the first line is used for the whole header: LF or CR LF, or CR alone.
        start = input_.peek(longest_line);
        const size_t end = start.find_first_of("\r\n");
        ends_with_cr_ = end != std::string_view::npos && start[end] == '\r' &&
                        (end + 1 == start.size() || start[end + 1] != '\n');
        (void)next_line();
    }

    std::string_view next_line()
    {
        ++line_number_;
        const std::string_view ahead = input_.peek(longest_line);
        const size_t end = ahead.substr(0, longest_line).find(ends_with_cr_ ? '\r' : '\n');
        if (end == std::string_view::npos || line_number_ > most_lines)
            refuse("its header has no end");
        line_ = ahead.substr(0, end);
        input_.skip(end + 1);
        if (line_.ends_with('\r'))
            line_.pop_back();
        return line_;
    }

    void read_line(const std::string& keyword, Scanner& words)
    {
        if (keyword == "format")
            read_format(words);
        else if (keyword == "element")
            read_element(words);
        else if (keyword == "property")
            read_property(words);
        else if (keyword == "comment" && lower_case(words.word()) == "texturefile")
            header_.texture_files.emplace_back(words.rest());
        else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty())
            refuse("the line is none of a header");
    }

    void read_format(Scanner& words)
    {
        const std::string name = lower_case(words.word());
        if (name == "ascii")
            header_.format = Format::ascii;
        else if (name == "binary_little_endian")
            header_.format = Format::little_endian;
        else if (name == "binary_big_endian")
            header_.format = Format::big_endian;
        else
            refuse("the line names no known format");
        has_format_ = true;
    }

    void read_element(Scanner& words)
    {
        Element& element = header_.elements.emplace_back();
        element.name = lower_case(words.word());
        const auto count = number_from<decltype(element.count)>(words.word());
        if (element.name.empty() || !count)
            refuse("the line has no usable count");
        element.count = *count;
    }

    void read_property(Scanner& words)
    {
        if (header_.elements.empty())
            refuse("a property comes before any element");
        Property property;
        std::string_view word = words.word();
        if (lower_case(word) == "list") {
            property.length_type = type_of(words.word());
            if (!property.length_type || *property.length_type >= Type::float32)
                refuse("the line has no usable type of its length");
            word = words.word();
        }
        const std::optional<Type> type = type_of(word);
        if (!type)
            refuse("the line has no known type");
        property.type = *type;
        property.name = lower_case(words.rest());
        header_.elements.back().properties.push_back(std::move(property));
    }

    Input& input_;
    Header header_;
    std::string line_;
    uint64_t line_number_ = 0;
    bool ends_with_cr_ = false;
    bool has_format_ = false;
};

} // namespace

size_t bytes_of(Type type)
{
    constexpr std::array<size_t, 8> bytes{1, 1, 2, 2, 4, 4, 4, 8};
    return bytes[static_cast<size_t>(type)];
}

Header read_header(Input& input)
{
    input.detect_encoding();
    return HeaderReader(input).run();
}

} // namespace estampe::ply
