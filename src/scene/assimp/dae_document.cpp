// SPDX-License-Identifier: MIT
#include "scene/assimp/dae_document.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>

#include "core/file.hpp"
#include "core/text.hpp"

namespace estampe::dae {
namespace {

/// Width / height that is assumed for a camera with only a width, because the page is not known yet.
constexpr double usual_aspect = 16.0 / 9.0;

double unit_m(const pugi::xml_node& collada)
{
    const double metres = collada.child("asset").child("unit").attribute("meter").as_double(1.0);
    return metres > 0.0 && std::isfinite(metres) ? metres : 1.0;
}

std::optional<double> positive(const pugi::xml_node& optics, const char* name)
{
    const double number = optics.child(name).text().as_double(0.0);
    return number > 0.0 && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

/// Computes a height from the height, the width and the aspect ratio in the file, of which some may be
/// missing. Width and height must be proportional to lengths: tangents of angles, not angles.
std::optional<double> height_of(const std::optional<double>& width, const std::optional<double>& height,
                                const std::optional<double>& aspect)
{
    if (height)
        return height;
    if (width)
        return *width / aspect.value_or(usual_aspect);
    return std::nullopt;
}

std::optional<double> half_tangent(const std::optional<double>& degrees)
{
    return degrees && *degrees < 179.0 ? std::optional(std::tan(0.5 * glm::radians(*degrees))) : std::nullopt;
}

SceneCamera lens_of(const pugi::xml_node& common, double metres)
{
    constexpr double nearest_m = 1e-4;
    SceneCamera lens;
    const pugi::xml_node parallel = common.child("orthographic");
    const pugi::xml_node optics = parallel ? parallel : common.child("perspective");
    const std::optional<double> aspect = positive(optics, "aspect_ratio");
    if (parallel) {
        lens.orthographic = true;
        lens.half_height_m =
            metres * height_of(positive(optics, "xmag"), positive(optics, "ymag"), aspect).value_or(1.0);
    } else if (const std::optional<double> height = height_of(
                   half_tangent(positive(optics, "xfov")), half_tangent(positive(optics, "yfov")), aspect)) {
        const double fov_rad = 2.0 * std::atan(*height);
        if (fov_rad > 0.02 && fov_rad < 3.0)
            lens.vertical_fov_rad = fov_rad;
    }
    if (const std::optional<double> near_units = positive(optics, "znear"))
        lens.near_m = std::max(*near_units * metres, nearest_m);
    return lens;
}

void add_number(pugi::xml_node parent, const char* name, double value)
{
    parent.append_child(name).text().set(value);
}

/// Reads the lenses of all cameras, in metres and radians. Replaces each camera in the document by a
/// perspective camera. The far plane of this camera is set to the camera's index, see lens_index(). Cameras
/// are replaced because Assimp does not support parallel projections, and computes a wrong angle for a camera
/// with only a vertical field of view.
std::vector<SceneCamera> number_cameras(const pugi::xml_node& collada)
{
    const double metres = unit_m(collada);
    std::vector<SceneCamera> lenses;
    for (pugi::xml_node library : collada.children("library_cameras")) {
        for (pugi::xml_node camera : library.children("camera")) {
            pugi::xml_node optics = camera.child("optics");
            lenses.push_back(lens_of(optics.child("technique_common"), metres));
            const pugi::char_t* const name = camera.attribute("name").value();
            lenses.back().name = *name != '\0' ? name : camera.attribute("id").value();
            // Assimp identifies cameras by name, but COLLADA allows cameras without a name.
            if (*name == '\0') {
                camera.remove_attribute("name");
                camera.append_attribute("name").set_value(lenses.back().name.c_str());
            }
            camera.remove_child(optics);
            pugi::xml_node lens =
                camera.append_child("optics").append_child("technique_common").append_child("perspective");
            add_number(lens, "xfov", 45.0);
            add_number(lens, "aspect_ratio", 1.0);
            add_number(lens, "znear", 0.5);
            add_number(lens, "zfar", static_cast<double>(lenses.size()));
        }
    }
    return lenses;
}

} // namespace

size_t lens_index(double far_plane)
{
    return far_plane >= 1.0 && far_plane < 1e7 ? static_cast<size_t>(std::lround(far_plane)) - 1 : 0;
}

namespace {

/// A mesh is moved to the origin if its distance from the origin is at least this many times its size. At
/// that distance, floats store only five digits of the mesh's shape.
constexpr double far_in_sizes = 50.0;

std::string id_of_url(std::string_view url)
{
    return std::string(url.starts_with('#') ? url.substr(1) : url);
}

pugi::xml_node child_with_id(const pugi::xml_node& parent, const char* name, const std::string& id)
{
    return parent.find_child_by_attribute(name, "id", id.c_str());
}

/// Returns the array of vertex positions of a mesh. Null unless the array has exactly three numbers per
/// vertex.
pugi::xml_node place_array(const pugi::xml_node& mesh)
{
    const pugi::xml_node input =
        mesh.child("vertices").find_child_by_attribute("input", "semantic", "POSITION");
    const pugi::xml_node source = child_with_id(mesh, "source", id_of_url(input.attribute("source").value()));
    const pugi::xml_node accessor = source.child("technique_common").child("accessor");
    if (accessor.attribute("stride").as_int(0) != 3 || accessor.attribute("offset").as_int(0) != 0)
        return {};
    return source.child("float_array");
}

/// Parses a list of numbers. Returns an empty list if any word is not a number.
std::vector<double> numbers_of(std::string_view text)
{
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at < end) {
        if (*at == ' ') {
            ++at;
            continue;
        }
        double number = 0.0;
        const auto read = std::from_chars(at, end, number);
        if (read.ec != std::errc{} || !std::isfinite(number))
            return {};
        numbers.push_back(number);
        at = read.ptr;
    }
    return numbers;
}

Bounds bounds_of(const std::vector<double>& numbers)
{
    Bounds bounds;
    for (size_t i = 0; i + 2 < numbers.size(); i += 3)
        bounds.extend({numbers[i], numbers[i + 1], numbers[i + 2]});
    return bounds;
}

glm::dvec3 exact_in_floats(const glm::dvec3& point)
{
    return glm::dvec3(glm::vec3(point));
}

bool move_places(pugi::xml_node array, glm::dvec3& offset)
{
    std::vector<double> numbers = numbers_of(array.text().get());
    const Bounds bounds = bounds_of(numbers);
    if (numbers.size() < 9 || numbers.size() % 3 != 0 || bounds.empty())
        return false;
    offset = exact_in_floats(bounds.center());
    if (!(glm::length(offset) > far_in_sizes * 2.0 * bounds.radius()))
        return false;
    fmt::memory_buffer text;
    for (size_t i = 0; i < numbers.size(); ++i)
        fmt::format_to(std::back_inserter(text), "{}{}", i == 0 ? "" : " ",
                       numbers[i] - offset[static_cast<int>(i % 3)]);
    return array.text().set(fmt::to_string(text).c_str());
}

/// Returns the ids of all geometries that a skin or a morph target refers to.
std::set<std::string> bent_geometries(const pugi::xml_node& collada)
{
    std::set<std::string> bent;
    for (const pugi::xml_node library : collada.children("library_controllers"))
        for (const pugi::xml_node controller : library.children("controller")) {
            for (const pugi::xml_node kind : controller.children())
                bent.insert(id_of_url(kind.attribute("source").value()));
            const pugi::xml_node shapes = controller.child("morph");
            for (const pugi::xml_node source : shapes.children("source")) {
                const std::string names = source.child("IDREF_array").text().get();
                for (size_t at = 0; at < names.size();) {
                    const size_t end = std::min(names.find(' ', at), names.size());
                    bent.insert(names.substr(at, end - at));
                    at = end + 1;
                }
            }
        }
    return bent;
}

using Offsets = std::map<std::string, glm::dvec3>;

struct FindInstances : pugi::xml_tree_walker {
    const Offsets& offsets;
    std::vector<pugi::xml_node> found;

    explicit FindInstances(const Offsets& moved) : offsets(moved) {}

    bool for_each(pugi::xml_node& node) override
    {
        if (std::string_view(node.name()) == "instance_geometry" &&
            offsets.contains(id_of_url(node.attribute("url").value())))
            found.push_back(node);
        return true;
    }
};

/// Moves `instance` into a new child node with the same name and the translation `offset`. Contents of the
/// node other than `instance` are not displaced.
void displace(const pugi::xml_node& instance, const glm::dvec3& offset)
{
    pugi::xml_node parent = instance.parent();
    pugi::xml_node between = parent.append_child("node");
    for (const char* const attribute : {"id", "name"})
        if (const pugi::xml_attribute given = parent.attribute(attribute))
            between.append_copy(given);
    between.append_child("translate")
        .text()
        .set(fmt::format("{} {} {}", offset.x, offset.y, offset.z).c_str());
    between.append_move(instance);
}

/// Moves vertices that are far from their mesh's origin to the origin, and moves their nodes by the opposite
/// offset. The offset is exactly representable as a float. Skinned and morphed meshes are not moved. Returns
/// whether anything was moved.
bool move_to_origin(const pugi::xml_node& collada)
{
    const std::set<std::string> bent = bent_geometries(collada);
    Offsets offsets;
    for (const pugi::xml_node library : collada.children("library_geometries"))
        for (const pugi::xml_node geometry : library.children("geometry")) {
            const std::string id = geometry.attribute("id").value();
            glm::dvec3 offset{0.0};
            if (!id.empty() && !bent.contains(id) && !offsets.contains(id) &&
                move_places(place_array(geometry.child("mesh")), offset))
                offsets.emplace(id, offset);
        }
    if (offsets.empty())
        return false;
    FindInstances find(offsets);
    pugi::xml_node(collada).traverse(find);
    for (const pugi::xml_node& instance : find.found)
        displace(instance, offsets.at(id_of_url(instance.attribute("url").value())));
    return true;
}

bool is_blank(char letter)
{
    return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n';
}

/// Returns whether a word is NaN (not a number) as Windows programs print it, such as "-1.#IND".
bool is_windows_nan(std::string_view word)
{
    return word.find(".#") != std::string_view::npos;
}

/// Replaces each run of blanks between words by a single blank, and removes blanks before and after the text.
/// Assimp misreads extra blanks as numbers in some places.
std::string tidied(std::string_view text)
{
    std::string result;
    result.reserve(text.size());
    size_t at = 0;
    while (at < text.size()) {
        if (is_blank(text[at])) {
            ++at;
            continue;
        }
        const size_t first = at;
        while (at < text.size() && !is_blank(text[at]))
            ++at;
        const std::string_view word = text.substr(first, at - first);
        if (!result.empty())
            result += ' ';
        result += is_windows_nan(word) ? "0" : word;
    }
    return result;
}

/// Returns whether an element contains a file name, in which runs of blanks must not be changed.
bool holds_a_path(const pugi::xml_node& text)
{
    const std::string_view parent = text.parent().name();
    return parent == "init_from" || parent == "ref";
}

struct TidyTexts : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override
    {
        if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata)
            node.set_value(
                (holds_a_path(node) ? std::string(trimmed(node.value())) : tidied(node.value())).c_str());
        return true;
    }
};

struct StringWriter : pugi::xml_writer {
    std::string text;

    void write(const void* data, size_t size) override { text.append(static_cast<const char*>(data), size); }
};

std::optional<double> number_below(const pugi::xml_node& root, const char* name)
{
    const pugi::xml_node found =
        root.find_node([name](const pugi::xml_node& node) { return std::string_view(node.name()) == name; });
    const double number = found.text().as_double(-1.0);
    return number >= 0.0 && number <= 1e6 ? std::optional(number) : std::nullopt;
}

} // namespace

Document read_document(const std::filesystem::path& path, const ReadScope& scope)
{
    std::vector<std::byte> bytes = read_file(path, any_length, scope);
    pugi::xml_document xml;
    const pugi::xml_parse_result result = xml.load_buffer_inplace(bytes.data(), bytes.size());
    if (!result)
        throw Error(fmt::format("is not sound XML at byte {}: {}", result.offset, result.description()));
    const pugi::xml_node root = xml.child("COLLADA");
    if (!root)
        throw Error("is XML, but not COLLADA");
    TidyTexts tidy;
    xml.traverse(tidy);
    Document document;
    document.moved_vertices = move_to_origin(root);
    document.lenses = number_cameras(root);
    const pugi::xml_node scenes = root.child("library_visual_scenes");
    document.frames_per_s = number_below(scenes, "frame_rate");
    if (document.frames_per_s && !(*document.frames_per_s > 0.0 && *document.frames_per_s <= 1000.0))
        document.frames_per_s.reset();
    const double metres = root.child("asset").child("unit").attribute("meter").as_double(0.0);
    if (metres > 0.0 && std::isfinite(metres))
        document.unit_m = metres;
    document.start_s = number_below(scenes, "start_time").value_or(0.0);
    StringWriter writer;
    xml.save(writer, "", pugi::format_raw, pugi::encoding_utf8);
    document.text = std::move(writer.text);
    return document;
}

} // namespace estampe::dae
