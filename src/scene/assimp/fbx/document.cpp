// SPDX-License-Identifier: MIT
#include "scene/assimp/fbx/document.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

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

/// Extracts the object's name from "Model::Box", or from "Box\0\1Model" in binary files.
std::string object_name(const std::string& text)
{
    if (const size_t split = text.find(std::string_view("\0\1", 2)); split != std::string::npos)
        return text.substr(0, split);
    const size_t split = text.find("::");
    return split == std::string::npos ? text : text.substr(split + 2);
}

PropertyMap properties_of(const std::vector<Element>& children)
{
    // Position of the first value in an FBX property; name, type, label and flags come before.
    constexpr size_t values_at = 4;
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

/// Converts a time from FBX's own unit to seconds.
double seconds_of(double fbx_time)
{
    constexpr double units_per_s = 46186158000.0;
    return fbx_time / units_per_s;
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

namespace {

constexpr int order_xyz = 0;

/// Returns a rotation from Euler angles in degrees. `order` is the number that FBX gives to the rotation
/// order; in the order XYZ, the rotation about x comes first.
glm::dquat turn(const glm::dvec3& degrees, int order)
{
    constexpr std::array<std::array<int, 3>, 6> orders{
        {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}}};
    glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
    for (const int axis : orders[order >= 0 && order < 6 ? static_cast<size_t>(order) : 0]) {
        glm::dvec3 about{0.0};
        about[axis] = 1.0;
        rotation = glm::angleAxis(glm::radians(degrees[axis]), about) * rotation;
    }
    return rotation;
}

glm::dmat4 moved(const glm::dvec3& by)
{
    return glm::translate(glm::dmat4(1.0), by);
}

/// Returns the unit vector of an axis in the file's settings, which store the axis as a number 0 to 2 and a
/// sign.
glm::dvec3 axis_of(const Properties& settings, const std::string& name, double fallback)
{
    const double axis = settings.number(name).value_or(fallback);
    glm::dvec3 direction{0.0};
    if (axis == 0.0 || axis == 1.0 || axis == 2.0)
        direction[static_cast<int>(axis)] = settings.number(name + "Sign").value_or(1.0) < 0.0 ? -1.0 : 1.0;
    return direction;
}

/// Returns a matrix whose rows are the file's right, up and front axes.
glm::dmat3 axes_of(const Properties& settings)
{
    const glm::dmat3 axes(axis_of(settings, "CoordAxis", 0.0), axis_of(settings, "UpAxis", 1.0),
                          axis_of(settings, "FrontAxis", 2.0));
    return std::abs(glm::determinant(axes)) == 1.0 ? glm::transpose(axes) : glm::dmat3(1.0);
}

} // namespace

glm::dmat4 Parts::matrix() const
{
    return moved(translation) * before_rotation * glm::mat4_cast(rotation) * before_scale *
           glm::scale(glm::dmat4(1.0), scale) * after_scale;
}

bool Parts::is_plain() const
{
    const glm::dmat4 none(1.0);
    return before_rotation == none && before_scale == none && after_scale == none;
}

Parts parts_of(const Properties& model)
{
    const glm::dvec3 zero{0.0};
    const auto vector = [&](const char* name) { return model.vector(name).value_or(zero); };
    const bool turns_freely = model.number("RotationActive").value_or(1.0) != 0.0 &&
                              model.number("RotationSpaceForLimitOnly").value_or(0.0) == 0.0;
    const int order =
        turns_freely ? static_cast<int>(model.number("RotationOrder").value_or(order_xyz)) : order_xyz;
    const glm::dvec3 rotation_pivot = vector("RotationPivot");
    const glm::dvec3 scaling_pivot = vector("ScalingPivot");
    Parts parts;
    parts.translation = vector("Lcl Translation");
    parts.rotation = turn(vector("Lcl Rotation"), order);
    parts.scale = model.vector("Lcl Scaling").value_or(glm::dvec3(1.0));
    parts.before_rotation = moved(vector("RotationOffset") + rotation_pivot);
    parts.before_scale = moved(vector("ScalingOffset") + scaling_pivot - rotation_pivot);
    if (turns_freely) {
        parts.before_rotation *= glm::mat4_cast(turn(vector("PreRotation"), order_xyz));
        parts.before_scale =
            glm::mat4_cast(glm::conjugate(turn(vector("PostRotation"), order_xyz))) * parts.before_scale;
    }
    parts.after_scale = moved(-scaling_pivot);
    parts.geometry = glm::scale(moved(vector("GeometricTranslation")) *
                                    glm::mat4_cast(turn(vector("GeometricRotation"), order_xyz)),
                                model.vector("GeometricScaling").value_or(glm::dvec3(1.0)));
    return parts;
}

glm::dmat4 world_from_file(const Properties& settings)
{
    return glm::scale(glm::dmat4(1.0), glm::dvec3(unit_m(settings))) * glm::dmat4(axes_of(settings));
}

glm::dvec3 up_of_file(const Properties& settings)
{
    return glm::transpose(axes_of(settings)) * glm::dvec3(0.0, 1.0, 0.0);
}

double unit_m(const Properties& settings)
{
    const double centimetres = settings.number("UnitScaleFactor").value_or(1.0);
    return 0.01 * (centimetres > 0.0 ? centimetres : 1.0);
}

namespace {

constexpr double inch_mm = 25.4;

// The enumerations have the values of the numbers in FBX files.
enum class ApertureMode { both, horizontal, vertical, focal_length };
enum class GateFit { none, vertical, horizontal, fill, overscan, stretch };
enum class AspectMode { window, fixed_ratio, fixed_resolution, fixed_width, fixed_height };

template <typename Enum>
Enum enum_of(const Properties& camera, const char* name, Enum fallback, Enum last)
{
    const double value = camera.number(name).value_or(static_cast<double>(fallback));
    return value >= 0.0 && value <= static_cast<double>(last) ? static_cast<Enum>(static_cast<int>(value))
                                                              : fallback;
}

double positive(const Properties& camera, const char* name, double fallback)
{
    const double value = camera.number(name).value_or(fallback);
    return value > 0.0 ? value : fallback;
}

/// Returns the aspect ratio (width / height) of a camera's picture. The FBX default is 320 by 200.
double picture_aspect(const Properties& camera)
{
    const double width = positive(camera, "AspectWidth", positive(camera, "AspectW", 320.0));
    const double height = positive(camera, "AspectHeight", positive(camera, "AspectH", 200.0));
    const double pixel = positive(camera, "PixelAspectRatio", 1.0);
    switch (enum_of(camera, "AspectRatioMode", AspectMode::window, AspectMode::fixed_height)) {
    case AspectMode::fixed_width:
        return pixel / height;
    case AspectMode::fixed_height:
        return pixel * width;
    default:
        return pixel * width / height;
    }
}

/// Returns how the film gate (the exposed area of the film) of a camera is fitted to a picture with another
/// aspect ratio.
GateFit fit_of(const Properties& camera, double aspect, double film_aspect)
{
    const GateFit fit = enum_of(camera, "GateFit", GateFit::none, GateFit::stretch);
    if (fit == GateFit::fill)
        return aspect > film_aspect ? GateFit::horizontal : GateFit::vertical;
    if (fit == GateFit::overscan)
        return aspect < film_aspect ? GateFit::horizontal : GateFit::vertical;
    return fit;
}

double vertical_of(double horizontal_deg, double aspect)
{
    return 2.0 * std::atan(std::tan(0.5 * glm::radians(horizontal_deg)) / aspect);
}

/// Returns the vertical field of view in radians. The result is not checked for implausible values in the
/// file.
double vertical_fov(const Properties& camera, double aspect)
{
    // The FBX default is 0.816 by 0.612 inches, the film size of 35 mm television.
    const double film_width = positive(camera, "FilmWidth", 0.816);
    const double film_height =
        positive(camera, "FilmHeight", 0.612) * positive(camera, "FilmSqueezeRatio", 1.0);
    const double focal_mm = camera.number("FocalLength").value_or(0.0);
    const double fov_deg = camera.number("FieldOfView").value_or(0.0);
    ApertureMode mode = enum_of(camera, "ApertureMode", ApertureMode::vertical, ApertureMode::focal_length);
    const bool has_focal = focal_mm > 0.0 && (camera.sets("FocalLength") || !(fov_deg > 0.0));
    if (mode == ApertureMode::focal_length && !has_focal)
        mode = ApertureMode::horizontal;
    else if (mode != ApertureMode::focal_length && !(fov_deg > 0.0) && !camera.number("FieldOfViewY"))
        mode = ApertureMode::focal_length;
    switch (mode) {
    case ApertureMode::both:
        if (const double fov_y_deg = camera.number("FieldOfViewY").value_or(0.0); fov_y_deg > 0.0)
            return glm::radians(fov_y_deg);
        return vertical_of(fov_deg, aspect);
    case ApertureMode::horizontal:
        return vertical_of(fov_deg, aspect);
    case ApertureMode::vertical:
        return glm::radians(fov_deg);
    case ApertureMode::focal_length:
        break;
    }
    const bool by_width = fit_of(camera, aspect, film_width / film_height) == GateFit::horizontal;
    const double height_mm = inch_mm * (by_width ? film_width / aspect : film_height);
    return 2.0 * std::atan2(0.5 * height_mm, focal_mm);
}

/// Returns half the height of a parallel projection, in metres. An FBX orthographic zoom of 1 shows 30 units
/// of the file. The exporter of Blender writes metres.
double orthographic_half_height_m(const Properties& camera, const Document& document, double aspect)
{
    constexpr double units_at_zoom_1 = 30.0;
    const bool blender = document.creator.starts_with("Blender");
    const double span_m =
        positive(camera, "OrthoZoom", 1.0) * (blender ? 1.0 : units_at_zoom_1 * unit_m(document.settings));
    const double film_aspect = positive(camera, "FilmWidth", 0.816) / positive(camera, "FilmHeight", 0.612);
    const bool by_width = fit_of(camera, aspect, film_aspect) == GateFit::horizontal;
    return 0.5 * (by_width ? span_m / aspect : span_m);
}

} // namespace

SceneCamera lens_of(const Properties& camera, const Document& document)
{
    constexpr double nearest_m = 1e-4;
    SceneCamera lens;
    const double aspect = std::clamp(picture_aspect(camera), 0.01, 100.0);
    const double fov_rad = vertical_fov(camera, aspect);
    if (fov_rad > 0.02 && fov_rad < 3.0)
        lens.vertical_fov_rad = fov_rad;
    lens.orthographic = camera.number("CameraProjectionType").value_or(0.0) == 1.0;
    if (lens.orthographic)
        lens.half_height_m = orthographic_half_height_m(camera, document, aspect);
    if (const std::optional<double> near_units = camera.number("NearPlane"))
        lens.near_m = std::max(*near_units * unit_m(document.settings), nearest_m);
    return lens;
}

} // namespace estampe::fbx
