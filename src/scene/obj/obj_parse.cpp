// SPDX-License-Identifier: MIT
#include "scene/obj/obj_parse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "core/srgb.hpp"
#include "scene/input/scanner.hpp"
#include "scene/obj/piece_builder.hpp"

namespace estampe::obj {
namespace {

constexpr std::string_view object_without_name = "defaultobject";

/// Statements that say nothing about surfaces as they are drawn.
constexpr std::array<std::string_view, 24> passed_over{
    "vp",   "cstype",     "deg",       "bmat",  "step",  "parm",   "trim",     "hole",
    "scrv", "sp",         "end",       "con",   "mg",    "bevel",  "c_interp", "d_interp",
    "lod",  "shadow_obj", "trace_obj", "ctech", "stech", "maplib", "usemap",   "call"};

bool ends_in_backslash(std::string_view line)
{
    while (!line.empty() && Scanner::is_blank(line.back()))
        line.remove_suffix(1);
    return line.ends_with('\\');
}

/// A number of a face: from 1, or from -1 backwards; 0 when there is none or it is out of range.
int64_t read_index(const char*& at, const char* end)
{
    const bool is_negative = at != end && *at == '-';
    if (is_negative || (at != end && *at == '+'))
        ++at;
    int64_t value = 0;
    for (; at != end && *at >= '0' && *at <= '9'; ++at)
        value = std::min<int64_t>(10 * value + (*at - '0'), int64_t{1} << 40);
    return is_negative ? -value : value;
}

/// Where an index points that counts from 1, or from -1 backwards in a list of `count`; no_index if nowhere.
/// What lies behind the list may still come.
uint32_t resolved(int64_t index, size_t count)
{
    const int64_t place = index > 0 ? index - 1 : index + static_cast<int64_t>(count);
    return index == 0 || place < 0 || place >= int64_t{no_index} ? no_index : static_cast<uint32_t>(place);
}

class Parser {
public:
    explicit Parser(Input& input) : input_(input), builder_(data_) {}

    Data run()
    {
        data_.objects.push_back({.name = std::string(object_without_name)});
        std::string_view line;
        while (input_.next_line(line)) {
            if (ends_in_backslash(line))
                read_continued(line);
            else
                read_line(line);
        }
        builder_.finish();
        finish_colors();
        return std::move(data_);
    }

private:
    /// Joins a line that ends in a backslash with the next ones.
    void read_continued(std::string_view line)
    {
        std::string joined;
        const bool is_comment = Scanner(line).word().starts_with('#');
        bool goes_on = !is_comment;
        joined = line;
        while (goes_on) {
            joined.resize(joined.rfind('\\'));
            joined += ' ';
            goes_on = input_.next_line(line);
            if (goes_on) {
                joined += line;
                goes_on = ends_in_backslash(line);
            }
        }
        read_line(joined);
    }

    void read_line(std::string_view line)
    {
        Scanner words(line);
        const std::string_view keyword = words.word();
        if (keyword.empty())
            return;
        if (keyword.starts_with('#'))
            read_comment(words);
        else if (keyword == "v")
            read_position(words);
        else if (keyword == "vt")
            read_uv(words);
        else if (keyword == "vn")
            read_normal(words);
        else if (keyword == "f" || keyword == "fo")
            read_face(words);
        else if (!read_statement(keyword, words))
            note_unread();
    }

    /// "# Vertices: 8" and "# Faces: 12" are all that tells of a file that is cut off between two lines.
    void read_comment(Scanner& words)
    {
        const std::string_view subject = words.word();
        if (subject != "Vertices:" && subject != "Faces:")
            return;
        const double count = number_of_word(words.word());
        if (count >= 0.0 && count < 1e12 && words.is_done())
            (subject == "Faces:" ? data_.losses.said_faces : data_.losses.said_vertices) =
                static_cast<uint64_t>(count);
    }

    bool read_statement(std::string_view keyword, Scanner& words)
    {
        if (keyword == "l") {
            if (read_corners(words, 2))
                builder_.add_line(corners_);
        } else if (keyword == "p") {
            if (read_corners(words, 1))
                builder_.add_points(corners_);
        } else if (keyword == "o") {
            named_object_ = object_of(words.rest(), no_index);
            builder_.set_object(named_object_);
        } else if (keyword == "g") {
            builder_.set_object(object_of(words.rest(), named_object_));
        } else if (keyword == "s") {
            builder_.set_smoothing_group(smoothing_group_of(words.word()));
        } else if (keyword == "usemtl") {
            builder_.set_material(material_of(words.rest()));
        } else if (keyword == "mtllib") {
            data_.libraries.emplace_back(words.rest());
        } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
            ++data_.losses.curves;
        } else {
            return std::find(passed_over.begin(), passed_over.end(), keyword) != passed_over.end();
        }
        return true;
    }

    void note_unread()
    {
        Losses& losses = data_.losses;
        losses.first_unread_line = losses.unread_lines == 0 ? input_.line_number() : losses.first_unread_line;
        ++losses.unread_lines;
        losses.is_cut_off = losses.is_cut_off || !input_.line_was_ended();
    }

    /// Reads up to N numbers of the line and says how many there are.
    template <size_t N>
    static size_t read_numbers(Scanner& words, std::array<double, N>& values)
    {
        size_t count = 0;
        while (count < N && words.number(values[count]))
            ++count;
        return count;
    }

    void read_position(Scanner& words)
    {
        std::array<double, 7> values{};
        const size_t count = read_numbers(words, values);
        if (count < 3) {
            note_unread();
            std::fill(values.begin(), values.begin() + 3, std::numeric_limits<double>::quiet_NaN());
        }
        data_.positions.emplace_back(values[0], values[1], values[2]);
        if (count < 6 || !std::isfinite(values[3] + values[4] + values[5]))
            return;
        data_.colors.resize(data_.positions.size() - 1, glm::vec4(1.0F));
        const bool has_alpha = count == 7 && std::isfinite(values[6]);
        data_.colors.emplace_back(values[3], values[4], values[5], has_alpha ? values[6] : 1.0);
    }

    void read_uv(Scanner& words)
    {
        std::array<double, 2> values{};
        if (read_numbers(words, values) == 0)
            note_unread();
        data_.uvs.emplace_back(values[0], values[1]);
    }

    void read_normal(Scanner& words)
    {
        std::array<double, 3> values{};
        if (read_numbers(words, values) < 3)
            note_unread();
        data_.normals.emplace_back(values[0], values[1], values[2]);
    }

    /// Reads the corners of an element; false when it cannot be drawn.
    bool read_corners(Scanner& words, size_t least)
    {
        corners_.clear();
        bool has_missing = false;
        for (std::string_view word = words.word(); !word.empty() && !word.starts_with('#');
             word = words.word()) {
            const Corner corner = corner_of(word);
            has_missing = has_missing || corner.position == no_index;
            corners_.push_back(corner);
        }
        if (corners_.size() < least) {
            ++data_.losses.short_faces;
            data_.losses.is_cut_off = data_.losses.is_cut_off || !input_.line_was_ended();
            return false;
        }
        data_.losses.faces_of_missing_vertices += has_missing ? 1 : 0;
        return !has_missing;
    }

    Corner corner_of(std::string_view word)
    {
        const char* at = word.data();
        const char* const end = at + word.size();
        Corner corner{.position = resolved(read_index(at, end), data_.positions.size())};
        if (at != end && *at == '/') {
            ++at;
            const bool has_uv = at != end && *at != '/';
            if (has_uv) {
                corner.uv = resolved(read_index(at, end), data_.uvs.size());
                data_.losses.corners_of_missing_attributes += corner.uv == no_index ? 1 : 0;
            }
            if (at != end && *at == '/') {
                ++at;
                if (at != end) {
                    corner.normal = resolved(read_index(at, end), data_.normals.size());
                    data_.losses.corners_of_missing_attributes += corner.normal == no_index ? 1 : 0;
                }
            }
        }
        if (at != end)
            corner.position = no_index; // something else than an index
        return corner;
    }

    void read_face(Scanner& words)
    {
        ++data_.losses.faces;
        if (read_corners(words, 3))
            builder_.add_face(corners_);
    }

    static uint32_t smoothing_group_of(std::string_view word)
    {
        if (word == "off" || word.empty())
            return 0;
        if (word == "on")
            return 1;
        const double group = number_of_word(word);
        return group >= 0.0 && group < static_cast<double>(no_smoothing_group) ? static_cast<uint32_t>(group)
                                                                               : no_smoothing_group;
    }

    uint32_t material_of(std::string_view name)
    {
        const auto [found, is_new] =
            material_of_name_.try_emplace(std::string(name), static_cast<uint32_t>(data_.materials.size()));
        if (is_new)
            data_.materials.emplace_back(name);
        return found->second;
    }

    uint32_t object_of(std::string_view name, uint32_t parent)
    {
        std::string key = std::to_string(parent) + ' ';
        key += name;
        const auto [found, is_new] =
            object_of_name_.try_emplace(std::move(key), static_cast<uint32_t>(data_.objects.size()));
        if (is_new)
            data_.objects.push_back({.name = std::string(name), .parent = parent});
        return found->second;
    }

    /// Colours are sRGB, of 1 or of 255, as programs that scan and sculpt write them.
    void finish_colors()
    {
        if (data_.colors.empty())
            return;
        data_.colors.resize(data_.positions.size(), glm::vec4(1.0F));
        float most = 0.0F;
        for (const glm::vec4& color : data_.colors)
            most = std::max({most, color.x, color.y, color.z});
        const float scale = most > 1.0F ? 1.0F / 255.0F : 1.0F;
        for (glm::vec4& color : data_.colors) {
            for (int i = 0; i < 3; ++i)
                color[i] = linear_from_srgb(std::clamp(scale * color[i], 0.0F, 1.0F));
            color.w = std::clamp(color.w > 1.0F ? scale * color.w : color.w, 0.0F, 1.0F);
        }
    }

    Input& input_;
    Data data_;
    PieceBuilder builder_;
    std::vector<Corner> corners_;
    uint32_t named_object_ = no_index; ///< by `o`
    std::unordered_map<std::string, uint32_t> material_of_name_;
    std::unordered_map<std::string, uint32_t> object_of_name_;
};

} // namespace

Data parse(Input& input)
{
    input.detect_encoding();
    return Parser(input).run();
}

} // namespace estampe::obj
