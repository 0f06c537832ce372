// SPDX-License-Identifier: MIT
#include "scene/obj/obj_parse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "core/color.hpp"
#include "scene/input/input.hpp"

namespace estampe::obj {
namespace {

/// Largest number of vertices at one position that are compared with a new vertex. Without a limit, a file
/// that combines one position with many texture coordinates would be slow. Missed duplicates are merged
/// later, when the mesh is repaired.
constexpr int most_compared = 32;

size_t corners_of(Topology topology)
{
    return topology == Topology::triangles ? 3 : topology == Topology::lines ? 2 : 1;
}

} // namespace

void PieceBuilder::set_object(uint32_t object)
{
    object_ = object;
    current_pieces_.fill(no_index);
}

void PieceBuilder::set_material(uint32_t material)
{
    material_ = material;
    current_pieces_.fill(no_index);
}

uint32_t PieceBuilder::piece_of(Topology topology, bool has_normals)
{
    uint32_t& current = current_pieces_[2 * static_cast<size_t>(topology) + (has_normals ? 1 : 0)];
    if (current != no_index)
        return current;
    const auto count = static_cast<uint32_t>(data_.pieces.size());
    const auto [found, is_new] = pieces_.try_emplace({object_, material_, topology, has_normals}, count);
    if (is_new)
        data_.pieces.push_back({.object = object_,
                                .material = material_,
                                .topology = topology,
                                .has_normals = has_normals,
                                .vertices = {},
                                .indices = {},
                                .smoothing_groups = {}});
    current = found->second;
    return current;
}

uint32_t PieceBuilder::vertex_of(uint32_t piece, Corner corner)
{
    std::vector<Corner>& vertices = data_.pieces[piece].vertices;
    const auto vertex = static_cast<uint32_t>(vertices.size());
    if (corner.position >= data_.positions.size()) { // the position may come later in the file
        vertices.push_back(corner);
        return vertex;
    }
    if (corner.position >= first_entries_.size()) {
        first_entries_.reserve(data_.positions.capacity());
        first_entries_.resize(data_.positions.size(), no_index);
    }
    uint32_t& first = first_entries_[corner.position];
    int compared = 0;
    for (uint32_t i = first; i != no_index && compared < most_compared; i = entries_[i].next, ++compared)
        if (entries_[i].piece == piece && vertices[entries_[i].vertex] == corner)
            return entries_[i].vertex;
    entries_.push_back({.next = first, .piece = piece, .vertex = vertex});
    first = static_cast<uint32_t>(entries_.size() - 1);
    vertices.push_back(corner);
    return vertex;
}

void PieceBuilder::add_triangle(uint32_t piece, const Corner& a, const Corner& b, const Corner& c,
                                uint32_t group)
{
    const uint32_t corners[3] = {vertex_of(piece, a), vertex_of(piece, b), vertex_of(piece, c)};
    Piece& target = data_.pieces[piece];
    if (group != no_smoothing_group || !target.smoothing_groups.empty()) {
        target.smoothing_groups.resize(target.indices.size() / 3, no_smoothing_group);
        target.smoothing_groups.push_back(group);
    }
    target.indices.insert(target.indices.end(), corners, corners + 3);
}

void PieceBuilder::cut(uint32_t piece, std::span<const Corner> corners, uint32_t group)
{
    polygon_.clear();
    for (const Corner& corner : corners)
        polygon_.push_back(data_.positions[corner.position]);
    triangles_.clear();
    triangulation_.cut(polygon_, triangles_);
    for (size_t i = 0; i + 2 < triangles_.size(); i += 3)
        add_triangle(piece, corners[triangles_[i]], corners[triangles_[i + 1]], corners[triangles_[i + 2]],
                     group);
}

void PieceBuilder::add_face(std::span<const Corner> corners)
{
    const bool has_normals = std::all_of(corners.begin(), corners.end(),
                                         [](const Corner& corner) { return corner.normal != no_index; });
    const uint32_t piece = piece_of(Topology::triangles, has_normals);
    if (corners.size() == 3) {
        add_triangle(piece, corners[0], corners[1], corners[2], smoothing_group_);
        return;
    }
    if (std::all_of(corners.begin(), corners.end(),
                    [this](const Corner& corner) { return corner.position < data_.positions.size(); })) {
        cut(piece, corners, smoothing_group_);
        return;
    }
    waiting_.push_back({.piece = piece,
                        .smoothing_group = smoothing_group_,
                        .first = waiting_corners_.size(),
                        .count = corners.size()});
    waiting_corners_.insert(waiting_corners_.end(), corners.begin(), corners.end());
}

void PieceBuilder::add_line(std::span<const Corner> corners)
{
    const uint32_t piece = piece_of(Topology::lines, false);
    for (size_t i = 0; i + 1 < corners.size(); ++i) {
        const uint32_t ends[2] = {vertex_of(piece, corners[i]), vertex_of(piece, corners[i + 1])};
        data_.pieces[piece].indices.insert(data_.pieces[piece].indices.end(), ends, ends + 2);
    }
}

void PieceBuilder::add_points(std::span<const Corner> corners)
{
    const uint32_t piece = piece_of(Topology::points, false);
    for (const Corner& corner : corners)
        data_.pieces[piece].indices.push_back(vertex_of(piece, corner));
}

void PieceBuilder::drop_missing(Piece& piece)
{
    const auto is_missing = [this](const Corner& corner) {
        return corner.position >= data_.positions.size();
    };
    for (Corner& corner : piece.vertices) {
        const bool lacks_uv = corner.uv != no_index && corner.uv >= data_.uvs.size();
        const bool lacks_normal = corner.normal != no_index && corner.normal >= data_.normals.size();
        if (lacks_uv)
            corner.uv = no_index;
        if (lacks_normal)
            corner.normal = no_index;
        data_.losses.corners_of_missing_attributes += lacks_uv || lacks_normal ? 1 : 0;
    }
    if (std::none_of(piece.vertices.begin(), piece.vertices.end(), is_missing))
        return;
    const size_t corners = corners_of(piece.topology);
    size_t kept = 0;
    for (size_t i = 0; i < piece.indices.size() / corners; ++i) {
        const auto first = piece.indices.begin() + static_cast<std::ptrdiff_t>(i * corners);
        if (std::any_of(first, first + static_cast<std::ptrdiff_t>(corners),
                        [&](uint32_t vertex) { return is_missing(piece.vertices[vertex]); })) {
            ++data_.losses.faces_of_missing_vertices;
            continue;
        }
        std::copy_n(first, corners, piece.indices.begin() + static_cast<std::ptrdiff_t>(kept * corners));
        if (!piece.smoothing_groups.empty())
            piece.smoothing_groups[kept] = piece.smoothing_groups[i];
        ++kept;
    }
    piece.indices.resize(kept * corners);
    if (!piece.smoothing_groups.empty())
        piece.smoothing_groups.resize(kept);
    if (kept == 0)
        piece.vertices.clear();
    for (Corner& corner : piece.vertices)
        if (is_missing(corner))
            // No element uses this corner, so any valid position will do.
            corner = {.position = 0, .uv = no_index, .normal = no_index};
}

void PieceBuilder::finish()
{
    for (const Waiting& face : waiting_) {
        const std::span<const Corner> corners(waiting_corners_.data() + face.first, face.count);
        if (std::all_of(corners.begin(), corners.end(),
                        [this](const Corner& corner) { return corner.position < data_.positions.size(); }))
            cut(face.piece, corners, face.smoothing_group);
        else
            ++data_.losses.faces_of_missing_vertices;
    }
    data_.losses.unclean_polygons = triangulation_.unclean();
    for (Piece& piece : data_.pieces) {
        if (!piece.smoothing_groups.empty())
            piece.smoothing_groups.resize(piece.indices.size() / 3, no_smoothing_group);
        drop_missing(piece);
    }
}

namespace {

constexpr std::string_view object_without_name = "defaultobject";

/// OBJ statements that do not affect the drawing and are skipped.
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

/// Reads an index of a corner. Indices count from 1; negative indices count backwards from the end of the
/// list. Returns 0 when there is no index or it is out of range.
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

/// Converts an index of an OBJ file to an index from 0 in a list of `count` entries. In the file, indices
/// count from 1; negative indices count backwards from the end. Returns no_index if it is invalid. An index
/// beyond the list is valid, because the file may list more entries later.
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
    /// Appends the following lines to a line that ends in a backslash.
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

    /// Reads comments such as "# Vertices: 8" and "# Faces: 12". If a file is truncated between two lines,
    /// only the counts in comments reveal the loss.
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

    /// Reads up to N numbers from the line. Returns the number of numbers that were read.
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

    /// Reads the corners of a face, line or point. Returns false if the element cannot be drawn.
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
            corner.position = no_index; // the word is not a valid index
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

    /// Converts vertex colours from sRGB to linear. Scanning and sculpting programs write vertex colours from
    /// 0 to 1 or from 0 to 255.
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
    uint32_t named_object_ = no_index; ///< the last object named by an `o` statement
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
