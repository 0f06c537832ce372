// SPDX-License-Identifier: MIT
#include "scene/assimp/dae/origin.hpp"

#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <estampe/scene.hpp>

namespace estampe::dae {
namespace {

/// From this many times its own size away on, a mesh is moved: floats keep five digits of it then.
constexpr double far_in_sizes = 50.0;

std::string id_of_url(std::string_view url)
{
    return std::string(url.starts_with('#') ? url.substr(1) : url);
}

pugi::xml_node child_with_id(const pugi::xml_node& parent, const char* name, const std::string& id)
{
    return parent.find_child_by_attribute(name, "id", id.c_str());
}

/// The array of the vertices' places; null where it is not simply three numbers for each.
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

/// Nothing where a word is no number.
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

/// Geometries that a skin or a morph refers to.
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

/// Puts a node of the same name between, so that the other contents of the node stay where they are.
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

} // namespace

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

} // namespace estampe::dae
