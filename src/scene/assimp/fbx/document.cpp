// SPDX-License-Identifier: MIT
#include "scene/assimp/fbx/document.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace estampe::fbx {
namespace {

using Templates = std::map<std::string, std::shared_ptr<const PropertyMap>, std::less<>>;

const Element* find(const std::vector<Element>& elements, std::string_view name)
{
    const auto found = std::find_if(elements.begin(), elements.end(),
                                    [name](const Element& element) { return element.name == name; });
    return found == elements.end() ? nullptr : &*found;
}

const std::vector<Element>& children_of(const std::vector<Element>& elements, std::string_view name)
{
    static const std::vector<Element> none;
    const Element* const element = find(elements, name);
    return element == nullptr ? none : element->children;
}

std::optional<int64_t> whole_at(const Element& element, size_t index)
{
    if (index >= element.values.size())
        return std::nullopt;
    const auto* const whole = std::get_if<int64_t>(&element.values[index]);
    return whole == nullptr ? std::nullopt : std::optional(*whole);
}

std::string text_at(const Element& element, size_t index)
{
    if (index >= element.values.size())
        return {};
    const auto* const text = std::get_if<std::string>(&element.values[index]);
    return text == nullptr ? std::string() : *text;
}

/// Of "Model::Box" and, in binary files, "Box\0\1Model".
std::string object_name(const std::string& text)
{
    if (const size_t split = text.find(std::string_view("\0\1", 2)); split != std::string::npos)
        return text.substr(0, split);
    const size_t split = text.find("::");
    return split == std::string::npos ? text : text.substr(split + 2);
}

PropertyMap properties_of(const std::vector<Element>& children)
{
    constexpr size_t values_at = 4; // after name, type, label and flags
    PropertyMap map;
    for (const Element& property : children_of(children, "Properties70")) {
        const std::string name = text_at(property, 0);
        if (property.name == "P" && !name.empty() && property.values.size() >= values_at)
            map.insert_or_assign(
                name, std::vector<Value>(property.values.begin() + values_at, property.values.end()));
    }
    return map;
}

Templates templates_of(const Tree& tree)
{
    Templates templates;
    for (const Element& type : children_of(tree.elements, "Definitions"))
        for (const Element& element : type.children)
            if (element.name == "PropertyTemplate")
                templates.insert_or_assign(text_at(element, 0), std::make_shared<const PropertyMap>(
                                                                    properties_of(element.children)));
    return templates;
}

Properties with_template(const Element& object, const Templates& templates, std::string_view name)
{
    const auto found = templates.find(name);
    return {.own = properties_of(object.children),
            .defaults = found == templates.end() ? nullptr : found->second};
}

void add_object(Document& document, const Element& object, const Templates& templates)
{
    const std::optional<int64_t> id = whole_at(object, 0);
    if (!id)
        return;
    const std::string kind = text_at(object, 2);
    if (object.name == "Model") {
        document.models[*id] = {.name = object_name(text_at(object, 1)),
                                .properties = with_template(object, templates, "FbxNode")};
    } else if (object.name == "NodeAttribute") {
        document.attributes[*id] = {.kind = kind,
                                    .properties = with_template(object, templates, "Fbx" + kind)};
    } else if (object.name == "AnimationStack") {
        const Properties properties = with_template(object, templates, "FbxAnimStack");
        document.ranges[object_name(text_at(object, 1))] = {
            .start_s = seconds_of(properties.number("LocalStart").value_or(0.0)),
            .stop_s = seconds_of(properties.number("LocalStop").value_or(0.0))};
    }
}

void connect(Document& document, const Element& connection)
{
    const std::optional<int64_t> source = whole_at(connection, 1);
    const std::optional<int64_t> target = whole_at(connection, 2);
    if (!source || !target)
        return;
    const auto model = document.models.find(*target);
    const bool is_model = document.models.contains(*source);
    const std::string property = text_at(connection, 3);
    if (text_at(connection, 0) == "OO") {
        if (is_model && *target == 0)
            document.roots.push_back(*source);
        else if (is_model && model != document.models.end())
            model->second.children.push_back(*source);
        else if (model != document.models.end() && document.attributes.contains(*source))
            model->second.attributes.push_back(*source);
    } else if (model != document.models.end() && is_model) {
        if (property == "LookAtProperty")
            model->second.look_at = *source;
        else if (property == "UpVectorProperty")
            model->second.up_position = *source;
    }
}

std::string creator_of(const Tree& tree)
{
    const Element* const creator = find(children_of(tree.elements, "FBXHeaderExtension"), "Creator");
    return creator == nullptr ? std::string() : text_at(*creator, 0);
}

const std::vector<Value>* values_of(const Properties& properties, std::string_view name)
{
    if (const auto found = properties.own.find(name); found != properties.own.end())
        return &found->second;
    if (properties.defaults == nullptr)
        return nullptr;
    const auto found = properties.defaults->find(name);
    return found == properties.defaults->end() ? nullptr : &found->second;
}

std::optional<double> finite_number(const Value& value)
{
    if (const auto* const whole = std::get_if<int64_t>(&value))
        return static_cast<double>(*whole);
    const auto* const number = std::get_if<double>(&value);
    return number != nullptr && std::isfinite(*number) ? std::optional(*number) : std::nullopt;
}

void hide_pivots_of(const std::vector<Element>& children, std::span<char> file)
{
    constexpr std::array<std::string_view, 9> hidden{
        "PreRotation",   "PostRotation",         "RotationPivot",     "RotationOffset",  "ScalingPivot",
        "ScalingOffset", "GeometricTranslation", "GeometricRotation", "GeometricScaling"};
    for (const Element& property : children_of(children, "Properties70"))
        if (std::find(hidden.begin(), hidden.end(), text_at(property, 0)) != hidden.end() &&
            property.first_text_at < file.size())
            file[property.first_text_at] = '_';
}

} // namespace

std::optional<double> Properties::number(std::string_view name) const
{
    const std::vector<Value>* const values = values_of(*this, name);
    return values == nullptr || values->empty() ? std::nullopt : finite_number(values->front());
}

std::optional<glm::dvec3> Properties::vector(std::string_view name) const
{
    const std::vector<Value>* const values = values_of(*this, name);
    if (values == nullptr || values->size() < 3)
        return std::nullopt;
    glm::dvec3 vector{0.0};
    for (int axis = 0; axis < 3; ++axis) {
        const std::optional<double> number = finite_number((*values)[static_cast<size_t>(axis)]);
        if (!number)
            return std::nullopt;
        vector[axis] = *number;
    }
    return vector;
}

std::string Properties::text(std::string_view name) const
{
    const std::vector<Value>* const values = values_of(*this, name);
    const auto* const text =
        values == nullptr || values->empty() ? nullptr : std::get_if<std::string>(&values->front());
    return text == nullptr ? std::string() : *text;
}

double seconds_of(double fbx_time)
{
    constexpr double units_per_s = 46186158000.0;
    return fbx_time / units_per_s;
}

Document read_document(const Tree& tree)
{
    Document document;
    document.version = tree.version;
    document.creator = creator_of(tree);
    if (const Element* const settings = find(tree.elements, "GlobalSettings"))
        document.settings.own = properties_of(settings->children);
    const Templates templates = templates_of(tree);
    for (const Element& object : children_of(tree.elements, "Objects"))
        add_object(document, object, templates);
    for (const Element& connection : children_of(tree.elements, "Connections"))
        connect(document, connection);
    return document;
}

void hide_pivots(const Tree& tree, std::span<char> file)
{
    for (const Element& type : children_of(tree.elements, "Definitions"))
        for (const Element& element : type.children)
            if (element.name == "PropertyTemplate")
                hide_pivots_of(element.children, file);
    for (const Element& object : children_of(tree.elements, "Objects"))
        if (object.name == "Model")
            hide_pivots_of(object.children, file);
}

} // namespace estampe::fbx
