// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "scene/input/scanner.hpp"
#include "scene/stl/stl_data.hpp"

namespace estampe::stl {
namespace {

constexpr size_t bytes_before_facets = 84;
constexpr uint64_t bytes_of_facet = 50;

/// Compares with a word in small letters.
bool is_word(std::string_view text, std::string_view word)
{
    return text.size() == word.size() &&
           std::equal(text.begin(), text.end(), word.begin(),
                      [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

class TextParser {
public:
    explicit TextParser(Input& input) : input_(input) {}

    Data run()
    {
        std::string_view line;
        while (input_.next_line(line)) {
            Scanner words(line);
            // Whole facets may stand in one line.
            for (std::string_view word = words.word(); !word.empty(); word = words.word())
                if (!read_word(word, words))
                    break;
        }
        finish();
        return std::move(data_);
    }

private:
    /// False when the rest of the line is nothing to read.
    bool read_word(std::string_view word, Scanner& words)
    {
        if (is_word(word, "vertex")) {
            read_vertex(words);
        } else if (is_word(word, "facet")) {
            is_complete_ = false;
            end_facet();
        } else if (is_word(word, "endfacet")) {
            is_complete_ = true;
            end_facet();
        } else if (is_word(word, "solid")) {
            end_facet();
            begin_solid(words.rest());
            return false;
        } else if (is_word(word, "endsolid")) {
            end_facet();
            is_in_solid_ = false;
            return false;
        } else if (is_word(word, "color")) {
            return false;
        } else if (!is_word(word, "normal") && !is_word(word, "outer") && !is_word(word, "loop") &&
                   !is_word(word, "endloop")) {
            return note_unread(word);
        } else if (is_word(word, "normal")) {
            double number = 0.0;
            for (int i = 0; i < 3; ++i)
                (void)words.number(number);
        }
        return true;
    }

    bool note_unread(std::string_view word)
    {
        if (unread_ == 0)
            first_unread_ = fmt::format("\"{}\" in line {}", word.substr(0, 40), input_.line_number());
        ++unread_;
        return false;
    }

    void begin_solid(std::string_view name)
    {
        is_in_solid_ = true;
        data_.solids.emplace_back().name = name;
    }

    void read_vertex(Scanner& words)
    {
        glm::dvec3 position(std::numeric_limits<double>::quiet_NaN());
        int count = 0;
        while (count < 3 && words.number(position[count]))
            ++count;
        // The last number of a file that is cut off lacks digits.
        const bool is_cut = !input_.line_was_ended() && words.is_done();
        if (count == 3 && !is_cut)
            corners_.push_back(position);
        else if (count < 3 || is_cut)
            ++bad_vertices_;
    }

    /// Adds the facet that was read; more than three corners are cut as a fan.
    void end_facet()
    {
        if (corners_.size() >= 3 && bad_vertices_ == 0) {
            if (data_.solids.empty())
                data_.solids.emplace_back();
            std::vector<glm::dvec3>& positions = data_.solids.back().positions;
            for (size_t i = 1; i + 1 < corners_.size(); ++i)
                positions.insert(positions.end(), {corners_[0], corners_[i], corners_[i + 1]});
        } else if (!corners_.empty() || bad_vertices_ > 0) {
            ++bad_facets_;
        }
        corners_.clear();
        bad_vertices_ = 0;
    }

    void finish()
    {
        const bool ends_in_facet = !is_complete_;
        end_facet();
        uint64_t facets = 0;
        for (const Solid& solid : data_.solids)
            facets += solid.positions.size() / 3;
        if (ends_in_facet || (is_in_solid_ && facets > 0))
            data_.warnings.push_back(fmt::format("is cut off: ends {}, after {} facets",
                                                 ends_in_facet ? "in a facet" : "without endsolid", facets));
        if (bad_facets_ > 0)
            data_.warnings.push_back(
                fmt::format("{} facets left out: they have fewer than three corners", bad_facets_));
        if (unread_ > 0)
            data_.warnings.push_back(fmt::format("{} words are not STL, the first of them {}: passed over",
                                                 unread_, first_unread_));
        std::erase_if(data_.solids, [](const Solid& solid) { return solid.positions.empty(); });
    }

    Input& input_;
    Data data_;
    std::vector<glm::dvec3> corners_;
    uint64_t bad_vertices_ = 0; ///< of this facet
    uint64_t bad_facets_ = 0;
    uint64_t unread_ = 0;
    std::string first_unread_;
    bool is_complete_ = true; ///< no facet is open
    bool is_in_solid_ = false;
};

std::string start_of(Input& input)
{
    std::string start(input.peek(1024).substr(0, 1024));
    std::transform(start.begin(), start.end(), start.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return start;
}

/// Whether a file is text: it begins with "solid", as many a binary one does too, and a word of a facet or
/// the end of the solid follows in the next lines, without a zero byte.
bool is_text(const std::string& start)
{
    const size_t first = start.find_first_not_of(" \t\r\n");
    if (first == std::string::npos || start.find('\0') != std::string::npos)
        return false;
    if (start.compare(first, 5, "solid") != 0 && start.compare(first, 5, "facet") != 0)
        return false;
    const size_t end_of_line = start.find_first_of("\r\n", first);
    return end_of_line != std::string::npos && (start.find("facet", end_of_line) != std::string::npos ||
                                                start.find("vertex", end_of_line) != std::string::npos ||
                                                start.find("endsolid", end_of_line) != std::string::npos);
}

/// Whether all of it could be printed, as a page of the web that was saved in place of a model.
bool is_other_text(const std::string& start)
{
    return std::all_of(start.begin(), start.end(), [](unsigned char letter) {
        return letter >= 0x20 || letter == '\n' || letter == '\r' || letter == '\t';
    });
}

/// Whether the count at byte 80 and the size agree exactly.
bool is_exactly_binary(Input& input)
{
    const std::string_view start = input.peek(bytes_before_facets);
    if (start.size() < bytes_before_facets)
        return false;
    uint32_t count = 0;
    for (size_t i = 4; i > 0; --i)
        count = count << 8U | static_cast<uint8_t>(start[80 + i - 1]);
    return input.size() == bytes_before_facets + bytes_of_facet * count;
}

} // namespace

Data parse_text(Input& input)
{
    return TextParser(input).run();
}

Data parse(Input& input)
{
    if (is_exactly_binary(input))
        return parse_binary(input);
    input.detect_encoding();
    const std::string start = start_of(input);
    if (is_text(start))
        return parse_text(input);
    if (input.size() < bytes_before_facets || is_other_text(start))
        throw Error("is no STL file: neither text that begins with \"solid\", nor 84 bytes before facets",
                    input.name(), "check that the file is whole");
    return parse_binary(input);
}

} // namespace estampe::stl
