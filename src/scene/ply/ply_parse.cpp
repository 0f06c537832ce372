// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/color.hpp"
#include "scene/mending/triangulate.hpp"
#include "scene/ply/ply_parse.hpp"

namespace estampe::ply {
namespace {

/// The meaning of a property. A property is one number in each row.
enum class Use : uint8_t {
    none,
    x,
    y,
    z,
    normal_x,
    normal_y,
    normal_z,
    u,
    v,
    red,
    green,
    blue,
    alpha,
    texture,
    start,
    end,
    corners,
    corner_uvs,
    count
};

enum class Kind : uint8_t { other, vertices, faces, strips, edges };

Kind kind_of(const Element& element)
{
    static const std::map<std::string_view, Kind> kinds{
        {"vertex", Kind::vertices},       {"face", Kind::faces},
        {"tristrips", Kind::strips},      {"tristrip", Kind::strips},
        {"trianglestrips", Kind::strips}, {"edge", Kind::edges}};
    const auto found = kinds.find(element.name);
    return found == kinds.end() ? Kind::other : found->second;
}

Use use_of(Kind kind, const Property& property)
{
    static const std::map<std::string_view, Use> numbers{
        {"x", Use::x},
        {"y", Use::y},
        {"z", Use::z},
        {"nx", Use::normal_x},
        {"ny", Use::normal_y},
        {"nz", Use::normal_z},
        {"normal_x", Use::normal_x},
        {"normal_y", Use::normal_y},
        {"normal_z", Use::normal_z},
        {"s", Use::u},
        {"t", Use::v},
        {"u", Use::u},
        {"v", Use::v},
        {"texture_u", Use::u},
        {"texture_v", Use::v},
        {"texture_s", Use::u},
        {"texture_t", Use::v},
        {"tex_u", Use::u},
        {"tex_v", Use::v},
        {"red", Use::red},
        {"green", Use::green},
        {"blue", Use::blue},
        {"alpha", Use::alpha},
        {"r", Use::red},
        {"g", Use::green},
        {"b", Use::blue},
        {"a", Use::alpha},
        {"diffuse_red", Use::red},
        {"diffuse_green", Use::green},
        {"diffuse_blue", Use::blue},
        {"diffuse_alpha", Use::alpha},
        {"texnumber", Use::texture},
        {"vertex1", Use::start},
        {"vertex2", Use::end},
    };
    static const std::map<std::string_view, Use> lists{
        {"vertex_indices", Use::corners}, {"vertex_index", Use::corners}, {"texcoord", Use::corner_uvs}};
    if (kind == Kind::other)
        return Use::none;
    const auto& uses = property.length_type ? lists : numbers;
    const auto found = uses.find(property.name);
    return found == uses.end() ? Use::none : found->second;
}

/// Returns the largest value of a colour channel that is stored in this number type.
double full_color(Type type)
{
    switch (type) {
    case Type::int8:
        return 127.0;
    case Type::int16:
        return 32767.0;
    case Type::uint16:
        return 65535.0;
    case Type::float32:
    case Type::float64:
        return 1.0;
    default:
        return 255.0;
    }
}

/// Converts colours from sRGB to linear, because scanning programs write sRGB. Floats have the range 0 to 1,
/// or 0 to 255 if any float is above 1.
void make_linear(std::vector<glm::vec4>& colors)
{
    float most = 0.0F;
    for (const glm::vec4& color : colors)
        most = std::max({most, color.x, color.y, color.z});
    const float scale = most > 1.0F ? 1.0F / 255.0F : 1.0F;
    for (glm::vec4& color : colors) {
        for (int i = 0; i < 4; ++i)
            color[i] = std::isfinite(color[i]) ? std::clamp(scale * color[i], 0.0F, 1.0F) : 1.0F;
        for (int i = 0; i < 3; ++i)
            color[i] = linear_from_srgb(color[i]);
    }
}

class Parser {
public:
    Parser(Input& input, Header header) : input_(input), header_(std::move(header)) {}

    Data run()
    {
        data_.texture_files = std::move(header_.texture_files);
        check_header();
        if (header_.format == Format::ascii)
            read_elements(TextRows(input_));
        else
            read_elements(BinaryRows(input_, header_.format == Format::big_endian));
        finish();
        return std::move(data_);
    }

private:
    void check_header()
    {
        const auto vertices =
            std::find_if(header_.elements.begin(), header_.elements.end(),
                         [](const Element& element) { return kind_of(element) == Kind::vertices; });
        int axes = 0;
        if (vertices != header_.elements.end())
            for (const Property& property : vertices->properties)
                if (const Use use = use_of(Kind::vertices, property); use >= Use::x && use <= Use::z)
                    axes |= 1 << static_cast<int>(use);
        if (axes !=
            (1 << static_cast<int>(Use::x) | 1 << static_cast<int>(Use::y) | 1 << static_cast<int>(Use::z)))
            throw Error("has no vertices with x, y and z", input_.name(), "give a file with points or faces");
    }

    template <typename Rows>
    void read_elements(Rows&& rows)
    {
        for (size_t i = 0; i < header_.elements.size(); ++i)
            read_element(rows, i);
        if (!is_cut_ && rows.goes_on())
            data_.warnings.emplace_back(
                "goes on after the last element that its header counts: what is drawn "
                "may be shifted or incomplete");
    }

    template <typename Rows>
    void read_element(Rows& rows, size_t number)
    {
        const Element& element = header_.elements[number];
        const Kind kind = kind_of(element);
        data_.promises_faces |= (kind == Kind::faces || kind == Kind::strips) && element.count > 0;
        if (element.properties.empty())
            return;
        begin(kind, element);
        const bool is_last =
            std::all_of(header_.elements.begin() + static_cast<std::ptrdiff_t>(number + 1),
                        header_.elements.end(), [](const Element& later) { return later.count == 0; });
        uint64_t count = 0;
        while (count < element.count && !is_cut_ && rows.next()) {
            const bool is_whole = read_row(rows, element);
            // In a truncated text file, the last number may lack digits.
            const bool is_suspect = rows.may_be_cut() && (count + 1 < element.count || !is_last);
            if (is_whole && !is_suspect) {
                long_rows_ += rows.has_more_in_row() ? 1 : 0;
                take_row(kind);
            } else if (Rows::goes_on_after_short_row && !rows.may_be_cut()) {
                ++short_rows_;
                take_short_row(kind);
            } else {
                is_cut_ = true;
                break;
            }
            ++count;
        }
        if (count < element.count) {
            is_cut_ = true;
            data_.warnings.push_back(fmt::format("is cut off: says {} {}, has {}", element.count,
                                                 plural(kind, element.name), count));
        }
        if (kind == Kind::vertices)
            has_vertices_ = true;
    }

    static std::string plural(Kind kind, const std::string& name)
    {
        switch (kind) {
        case Kind::vertices:
            return "vertices";
        case Kind::faces:
            return "faces";
        case Kind::strips:
            return "strips";
        case Kind::edges:
            return "edges";
        default:
            return fmt::format("elements \"{}\"", name);
        }
    }

    /// Prepares for the rows of an element: determines the meaning of each property once for all rows.
    void begin(Kind kind, const Element& element)
    {
        uses_.clear();
        scales_.clear();
        std::array<bool, static_cast<size_t>(Use::count)> has{};
        for (const Property& property : element.properties) {
            Use use = use_of(kind, property);
            if (has[static_cast<size_t>(use)])
                use = Use::none; // if a property name occurs twice, only the first property is used
            has[static_cast<size_t>(use)] = use != Use::none;
            uses_.push_back(use);
            scales_.push_back(use >= Use::red && use <= Use::alpha ? 1.0 / full_color(property.type) : 1.0);
        }
        const auto has_use = [&has](Use use) { return has[static_cast<size_t>(use)]; };
        has_normals_ = has_use(Use::normal_x) && has_use(Use::normal_y) && has_use(Use::normal_z);
        has_uvs_ = has_use(Use::u) && has_use(Use::v);
        has_colors_ = has_use(Use::red) && has_use(Use::green) && has_use(Use::blue);
        has_corner_uvs_ = has_use(Use::corner_uvs);
        has_textures_ = has_use(Use::texture);
        values_.fill(0.0);
        values_[static_cast<size_t>(Use::alpha)] = 1.0;
    }

    template <typename Rows>
    bool read_row(Rows& rows, const Element& element)
    {
        corners_.clear();
        corner_uvs_.clear();
        for (size_t i = 0; i < element.properties.size(); ++i) {
            const Property& property = element.properties[i];
            if (property.length_type) {
                if (!read_list(rows, property, uses_[i]))
                    return false;
                continue;
            }
            double value = 0.0;
            if (!rows.read(property.type, value))
                return false;
            values_[static_cast<size_t>(uses_[i])] = value * scales_[i];
        }
        return true;
    }

    template <typename Rows>
    bool read_list(Rows& rows, const Property& property, Use use)
    {
        double length = 0.0;
        if (!rows.read(*property.length_type, length) || !(length >= 0.0) || !(length < 4294967295.0) ||
            !rows.has_room(static_cast<uint64_t>(length), property.type))
            return false;
        for (uint64_t i = 0; i < static_cast<uint64_t>(length); ++i) {
            double value = 0.0;
            if (!rows.read(property.type, value))
                return false;
            if (use == Use::corners)
                corners_.push_back(value);
            else if (use == Use::corner_uvs)
                corner_uvs_.push_back(static_cast<float>(value));
        }
        return true;
    }

    [[nodiscard]] double value(Use use) const { return values_[static_cast<size_t>(use)]; }

    [[nodiscard]] glm::vec4 color() const
    {
        return {value(Use::red), value(Use::green), value(Use::blue), value(Use::alpha)};
    }

    void take_row(Kind kind)
    {
        switch (kind) {
        case Kind::vertices:
            take_vertex();
            break;
        case Kind::faces:
            take_face(corners_, color());
            break;
        case Kind::strips:
            take_strip();
            break;
        case Kind::edges:
            take_edge();
            break;
        default:
            break;
        }
    }

    /// Handles a row with too few numbers. If the row is a vertex, an invalid vertex is added, so that later
    /// indices remain right.
    void take_short_row(Kind kind)
    {
        if (kind != Kind::vertices)
            return;
        values_[static_cast<size_t>(Use::x)] = std::numeric_limits<double>::quiet_NaN();
        take_vertex();
    }

    void take_vertex()
    {
        data_.positions.emplace_back(value(Use::x), value(Use::y), value(Use::z));
        if (has_normals_)
            data_.normals.emplace_back(value(Use::normal_x), value(Use::normal_y), value(Use::normal_z));
        if (has_uvs_)
            data_.uvs.emplace_back(value(Use::u), value(Use::v));
        if (has_colors_)
            data_.colors.push_back(color());
    }

    /// Converts a number in the file to a vertex index. Returns no_index if it is invalid.
    [[nodiscard]] uint32_t vertex_of(double index) const
    {
        // If vertices come after faces, the number of vertices is not known while faces are read.
        const double limit = has_vertices_ ? static_cast<double>(data_.positions.size()) : 4294967295.0;
        return index >= 0.0 && index < limit ? static_cast<uint32_t>(index) : no_index;
    }

    void take_face(std::span<const double> corners, const glm::vec4& face_color)
    {
        vertices_.clear();
        bool is_sound = true;
        for (const double corner : corners) {
            vertices_.push_back(vertex_of(corner));
            is_sound = is_sound && vertices_.back() != no_index;
        }
        if (!is_sound || corners.size() < 3) {
            ++(is_sound ? short_faces_ : bad_faces_);
            return;
        }
        if (corners.size() == 3) {
            add_triangle(0, 1, 2, face_color);
            return;
        }
        cut_.clear();
        polygon_.clear();
        if (has_vertices_) {
            for (const uint32_t vertex : vertices_)
                polygon_.push_back(data_.positions[vertex]);
            triangulation_.cut(polygon_, cut_);
        } else { // vertices come after faces, so the polygon's shape is unknown
            for (uint32_t i = 1; i + 1 < vertices_.size(); ++i)
                cut_.insert(cut_.end(), {0, i, i + 1});
        }
        for (size_t i = 0; i + 2 < cut_.size(); i += 3)
            add_triangle(cut_[i], cut_[i + 1], cut_[i + 2], face_color);
    }

    void add_triangle(uint32_t a, uint32_t b, uint32_t c, const glm::vec4& face_color)
    {
        // Triangles of earlier elements may lack the attributes of corners. The lists are therefore first
        // extended with default values for earlier triangles.
        const size_t before = data_.triangles.size() / 3;
        data_.triangles.insert(data_.triangles.end(), {vertices_[a], vertices_[b], vertices_[c]});
        if (has_corner_uvs_) {
            data_.corner_uvs.resize(3 * before, glm::vec2(0.0F));
            for (const uint32_t corner : {a, b, c})
                data_.corner_uvs.push_back(
                    2 * corner + 1 < corner_uvs_.size()
                        ? glm::vec2(corner_uvs_[2 * corner], corner_uvs_[2 * corner + 1])
                        : glm::vec2(0.0F));
        }
        if (has_colors_) {
            data_.face_colors.resize(before, glm::vec4(1.0F));
            data_.face_colors.push_back(face_color);
        }
        if (has_textures_) {
            data_.face_textures.resize(before, 0);
            const double texture = value(Use::texture);
            data_.face_textures.push_back(texture >= 0.0 &&
                                                  texture < static_cast<double>(data_.texture_files.size())
                                              ? static_cast<uint32_t>(texture)
                                              : 0);
        }
    }

    /// Reads triangle strips. The index -1 ends a strip; the next index starts another strip.
    void take_strip()
    {
        const std::vector<double> strip = corners_;
        has_corner_uvs_ = has_textures_ = has_colors_ = false;
        size_t start = 0;
        for (size_t i = 0; i < strip.size(); ++i) {
            if (strip[i] < 0.0) {
                start = i + 1;
                continue;
            }
            if (i < start + 2)
                continue;
            const bool is_odd = (i - start) % 2 == 1;
            const std::array<double, 3> corners{strip[i - 2], is_odd ? strip[i] : strip[i - 1],
                                                is_odd ? strip[i - 1] : strip[i]};
            // Where a strip changes its direction, it has degenerate triangles, which use a vertex twice.
            // These triangles are skipped.
            if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
                take_face(corners, glm::vec4(1.0F));
        }
    }

    void take_edge()
    {
        const uint32_t start = vertex_of(value(Use::start));
        const uint32_t end = vertex_of(value(Use::end));
        if (start == no_index || end == no_index)
            ++bad_faces_;
        else
            data_.lines.insert(data_.lines.end(), {start, end});
    }

    /// Drops elements that refer to missing vertices. Vertices may come after the elements, so the indices
    /// are checked last.
    void drop_missing()
    {
        const auto limit = static_cast<uint32_t>(data_.positions.size());
        const auto is_missing = [limit](uint32_t vertex) { return vertex >= limit; };
        if (std::none_of(data_.triangles.begin(), data_.triangles.end(), is_missing) &&
            std::none_of(data_.lines.begin(), data_.lines.end(), is_missing))
            return;
        size_t kept = 0;
        for (size_t t = 0; t < data_.triangles.size() / 3; ++t) {
            const auto first = data_.triangles.begin() + static_cast<std::ptrdiff_t>(3 * t);
            if (std::any_of(first, first + 3, is_missing)) {
                ++bad_faces_;
                continue;
            }
            std::copy_n(first, 3, data_.triangles.begin() + static_cast<std::ptrdiff_t>(3 * kept));
            for (size_t k = 0; k < 3 && !data_.corner_uvs.empty(); ++k)
                data_.corner_uvs[3 * kept + k] = data_.corner_uvs[3 * t + k];
            if (!data_.face_colors.empty())
                data_.face_colors[kept] = data_.face_colors[t];
            if (!data_.face_textures.empty())
                data_.face_textures[kept] = data_.face_textures[t];
            ++kept;
        }
        data_.triangles.resize(3 * kept);
        std::vector<uint32_t> lines;
        for (size_t i = 0; i + 1 < data_.lines.size(); i += 2)
            if (!is_missing(data_.lines[i]) && !is_missing(data_.lines[i + 1]))
                lines.insert(lines.end(), {data_.lines[i], data_.lines[i + 1]});
        data_.lines = std::move(lines);
    }

    void finish()
    {
        const size_t triangles = data_.triangles.size() / 3;
        // Faces and strips of one file may have different attributes. Missing values get a default.
        if (data_.corner_uvs.size() != 3 * triangles)
            data_.corner_uvs.resize(data_.corner_uvs.empty() ? 0 : 3 * triangles, glm::vec2(0.0F));
        if (data_.face_colors.size() != triangles)
            data_.face_colors.resize(data_.face_colors.empty() ? 0 : triangles, glm::vec4(1.0F));
        if (data_.face_textures.size() != triangles)
            data_.face_textures.resize(data_.face_textures.empty() ? 0 : triangles, 0);
        drop_missing();
        make_linear(data_.colors);
        make_linear(data_.face_colors);
        const auto warn = [this](uint64_t count, const char* text) {
            if (count > 0)
                data_.warnings.push_back(fmt::format("{} {}", count, text));
        };
        warn(bad_faces_, "faces left out: they name vertices that are not there");
        warn(short_faces_, "faces left out: they have fewer than three corners");
        warn(short_rows_, "lines have too few numbers: what they are of is left out");
        warn(long_rows_, "lines have too many numbers: the last ones are left out");
        warn(triangulation_.unclean(), "polygons cross themselves: their triangles may be wrong");
    }

    Input& input_;
    Header header_;
    Data data_;
    std::vector<Use> uses_;
    std::vector<double> scales_;
    std::array<double, static_cast<size_t>(Use::count)> values_{};
    std::vector<double> corners_;
    std::vector<float> corner_uvs_;
    std::vector<uint32_t> vertices_;
    std::vector<glm::dvec3> polygon_;
    std::vector<uint32_t> cut_;
    Triangulation triangulation_;
    bool has_normals_ = false;
    bool has_uvs_ = false;
    bool has_colors_ = false;
    bool has_corner_uvs_ = false;
    bool has_textures_ = false;
    bool has_vertices_ = false;
    bool is_cut_ = false;
    uint64_t bad_faces_ = 0;
    uint64_t short_faces_ = 0;
    uint64_t short_rows_ = 0;
    uint64_t long_rows_ = 0;
};

} // namespace

Data parse(Input& input)
{
    Header header = read_header(input);
    return Parser(input, std::move(header)).run();
}

} // namespace estampe::ply
