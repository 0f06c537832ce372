// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/assimp/convert.hpp"
#include "scene/assimp/fbx/document.hpp"

namespace estampe {
namespace {

/// Defines the upward direction of an object that looks at a target. If `node` is set, up is the direction to
/// this node; otherwise up is `direction` in world space.
struct Upward {
    glm::dvec3 direction{0.0, 1.0, 0.0};
    Index node = no_index;
    double roll_rad = 0.0; ///< rotation about the line of sight
};

/// World-space axes of an object at `eye` that looks at `target`. The columns of the matrix are right, up and
/// back.
std::optional<glm::dmat3> looking_axes(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up,
                                       double roll_rad)
{
    const double distance = glm::distance(eye, target);
    if (!(distance > 0.0) || !std::isfinite(distance))
        return std::nullopt;
    const glm::dvec3 back = (eye - target) / distance;
    glm::dvec3 right = glm::cross(up, back);
    if (!(glm::length(right) > 1e-6 * glm::length(up)))
        right = glm::cross(std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1), back);
    right = glm::normalize(right);
    const glm::dvec3 upright = glm::cross(back, right);
    const double c = std::cos(roll_rad);
    const double s = std::sin(roll_rad);
    return glm::dmat3(c * right - s * upright, c * upright + s * right, back);
}

/// Rotation of a child node relative to its parent, for which the child has the world-space axes `axes`.
/// Scale and mirroring of the parent are ignored, because they do not change where -z and y of the child
/// point.
std::optional<glm::dquat> turn_within(const glm::dmat4& world_from_parent, glm::dmat3 axes)
{
    glm::dmat3 parent(world_from_parent);
    for (int axis = 0; axis < 3; ++axis) {
        const double length = glm::length(parent[axis]);
        if (!(length > 0.0))
            return std::nullopt;
        parent[axis] /= length;
    }
    const double determinant = glm::determinant(parent);
    if (!(std::abs(determinant) > 1e-6))
        return std::nullopt;
    if (determinant < 0.0)
        axes[0] = -axes[0];
    return glm::normalize(glm::quat_cast(glm::inverse(parent) * axes));
}

std::optional<glm::dquat> turn_at(const Scene& scene, const ScenePose& pose, Index looking, Index target,
                                  const Upward& upward)
{
    const glm::dvec3 eye(pose.world_from_node[looking][3]);
    const glm::dvec3 up =
        upward.node == no_index ? upward.direction : glm::dvec3(pose.world_from_node[upward.node][3]) - eye;
    const std::optional<glm::dmat3> axes =
        looking_axes(eye, glm::dvec3(pose.world_from_node[target][3]), up, upward.roll_rad);
    if (!axes)
        return std::nullopt;
    return turn_within(pose.world_from_node[scene.nodes[looking].parent], *axes);
}

std::vector<bool> nodes_above(const Scene& scene, std::initializer_list<Index> nodes)
{
    std::vector<bool> above(scene.nodes.size(), false);
    for (Index node : nodes)
        for (; node != no_index && !above[node]; node = scene.nodes[node].parent)
            above[node] = true;
    return above;
}

/// Number of samples of an animated direction: one per frame, or fewer if the animation is very long.
size_t sample_count(const Scene& scene, float duration_s)
{
    constexpr double most_node_samples = 2e7;
    const double wanted =
        1.0 + std::ceil(static_cast<double>(duration_s) * scene.frames_per_s.value_or(30.0));
    const double most = most_node_samples / static_cast<double>(scene.nodes.size());
    return static_cast<size_t>(std::clamp(std::min(wanted, most), 2.0, 4000.0));
}

AnimationChannel aimed_channel(const Scene& scene, Index animation, Index looking, Index target,
                               const Upward& upward)
{
    AnimationChannel channel{.node = looking, .path = AnimatedPath::rotation};
    const float duration_s = scene.animations[animation].duration_s;
    const size_t count = sample_count(scene, duration_s);
    for (size_t i = 0; i < count; ++i) {
        const float time_s = duration_s * static_cast<float>(i) / static_cast<float>(count - 1);
        // At its exact end an animation wraps to its beginning, so it is evaluated just before its end.
        const double just_before_s = std::min<double>(time_s, 0.999999 * duration_s);
        const std::optional<glm::dquat> turn =
            turn_at(scene, pose_scene(scene, just_before_s, animation), looking, target, upward);
        if (!turn)
            continue;
        channel.times_s.push_back(time_s);
        for (const double value : {turn->x, turn->y, turn->z, turn->w})
            channel.values.push_back(static_cast<float>(value));
    }
    return channel;
}

/// Rotates the node `looking` so that its -z points at the origin of the node `target`, in the rest pose and
/// in every animation that moves one of the two nodes. A node at the position of its target is not changed.
void aim_node(Scene& scene, Index looking, Index target, const Upward& upward)
{
    const std::optional<glm::dquat> turn =
        turn_at(scene, pose_scene(scene, 0.0, no_index), looking, target, upward);
    if (!turn)
        return;
    Node& node = scene.nodes[looking];
    if (node.matrix)
        node.transform.translation = glm::dvec3((*node.matrix)[3]);
    node.matrix.reset();
    node.transform.rotation = *turn;
    const std::vector<bool> moving = upward.node == no_index
                                         ? nodes_above(scene, {looking, target})
                                         : nodes_above(scene, {looking, target, upward.node});
    for (Index index = 0; index < scene.animations.size(); ++index) {
        Animation& animation = scene.animations[index];
        const bool moves = std::any_of(animation.channels.begin(), animation.channels.end(),
                                       [&](const AnimationChannel& channel) { return moving[channel.node]; });
        if (!moves || !(animation.duration_s > 0.0F))
            continue;
        AnimationChannel channel = aimed_channel(scene, index, looking, target, upward);
        if (!channel.times_s.empty())
            animation.channels.push_back(std::move(channel));
    }
}

/// Maps the id of an FBX model to the index of its node in the scene.
using NodeOfModel = std::map<int64_t, Index>;

void match_children(const aiNode& parent, const std::vector<int64_t>& models, const fbx::Document& document,
                    const Conversion& conversion, std::vector<std::pair<const aiNode*, int64_t>>& found)
{
    // Assimp keeps the order of the children, but drops children that it cannot read. If any are missing,
    // names decide which model belongs to which child.
    const bool same_count = parent.mNumChildren == models.size();
    size_t next = 0;
    for (unsigned i = 0; i < parent.mNumChildren; ++i) {
        const aiNode& child = *parent.mChildren[i];
        const std::string name = name_of(child.mName);
        while (!same_count && next < models.size() && document.models.at(models[next]).name != name)
            ++next;
        if (next >= models.size())
            return;
        if (conversion.node_of_source.contains(&child))
            found.emplace_back(&child, models[next]);
        ++next;
    }
}

NodeOfModel match_nodes(const Conversion& conversion, const fbx::Document& document)
{
    NodeOfModel matched;
    std::vector<std::pair<const aiNode*, int64_t>> pending;
    match_children(*conversion.source.mRootNode, document.roots, document, conversion, pending);
    while (!pending.empty()) {
        const auto [source, id] = pending.back();
        pending.pop_back();
        matched.emplace(id, conversion.node_of_source.at(source));
        match_children(*source, document.models.at(id).children, document, conversion, pending);
    }
    return matched;
}

/// `name` is passed by value, because it may belong to a node that moves in memory when the child is added.
Index add_child(Scene& scene, Index parent, std::string name, const glm::dmat4& matrix)
{
    const auto index = static_cast<Index>(scene.nodes.size());
    Node& node = scene.nodes.emplace_back();
    node.name = std::move(name);
    node.parent = parent;
    node.matrix = matrix;
    scene.nodes[parent].children.push_back(index);
    return index;
}

/// Applies the transform `geometry` to the mesh of a node, but not to the node's children.
void place_geometry(Scene& scene, Index index, const glm::dmat4& geometry)
{
    if (geometry == glm::dmat4(1.0))
        return;
    for (const Index child : scene.nodes[index].children)
        if (scene.nodes[child].skin != no_index)
            for (glm::mat4& joint_from_bind : scene.skins[scene.nodes[child].skin].joint_from_bind)
                joint_from_bind = glm::mat4(glm::dmat4(joint_from_bind) * geometry);
    if (scene.nodes[index].mesh == no_index)
        return;
    const Index shown = add_child(scene, index, scene.nodes[index].name, geometry);
    scene.nodes[shown].mesh = std::exchange(scene.nodes[index].mesh, no_index);
}

/// Returns all animation channels that animate `node`.
std::vector<AnimationChannel*> channels_of(Scene& scene, Index node)
{
    std::vector<AnimationChannel*> channels;
    for (Animation& animation : scene.animations)
        for (AnimationChannel& channel : animation.channels)
            if (channel.node == node)
                channels.push_back(&channel);
    return channels;
}

/// Splits an animated node with pivots into a chain of nodes. Each animated part of the node's transform
/// (translation, rotation, scale) gets a new parent node of its own.
void split_node(Scene& scene, Index index, const fbx::Parts& parts)
{
    const Index parent = scene.nodes[index].parent;
    const std::string name = scene.nodes[index].name;
    std::erase(scene.nodes[parent].children, index);
    const Index translated = add_child(scene, parent, name, glm::dmat4(1.0));
    const Index before_rotation = add_child(scene, translated, name, parts.before_rotation);
    const Index rotated = add_child(scene, before_rotation, name, glm::dmat4(1.0));
    const Index before_scale = add_child(scene, rotated, name, parts.before_scale);
    const Index scaled = add_child(scene, before_scale, name, glm::dmat4(1.0));
    for (const Index animated : {translated, rotated, scaled})
        scene.nodes[animated].matrix.reset();
    scene.nodes[translated].transform.translation = parts.translation;
    scene.nodes[rotated].transform.rotation = parts.rotation;
    scene.nodes[scaled].transform.scale = parts.scale;
    scene.nodes[scaled].children.push_back(index);
    scene.nodes[index].parent = scaled;
    scene.nodes[index].matrix = parts.after_scale;
    for (AnimationChannel* const channel : channels_of(scene, index))
        channel->node = channel->path == AnimatedPath::translation ? translated
                        : channel->path == AnimatedPath::rotation  ? rotated
                                                                   : scaled;
}

void place_node(Scene& scene, Index index, const fbx::Parts& parts, bool is_animated)
{
    place_geometry(scene, index, parts.geometry);
    Node& node = scene.nodes[index];
    if (!is_animated) {
        node.matrix = parts.matrix();
    } else if (parts.is_plain()) {
        node.matrix.reset();
        node.transform = {.translation = parts.translation, .rotation = parts.rotation, .scale = parts.scale};
    } else {
        split_node(scene, index, parts);
    }
}

void place_nodes(Scene& scene, const fbx::Document& document, const NodeOfModel& nodes)
{
    std::vector<bool> is_animated(scene.nodes.size(), false);
    for (const Animation& animation : scene.animations)
        for (const AnimationChannel& channel : animation.channels)
            is_animated[channel.node] = true;
    for (const auto& [id, index] : nodes)
        place_node(scene, index, fbx::parts_of(document.models.at(id).properties), is_animated[index]);
}

/// Returns the upward direction of a camera or light that looks at a target.
Upward upward_of(const fbx::Model& model, const fbx::Properties& attribute, const fbx::Document& document,
                 const NodeOfModel& nodes)
{
    Upward upward;
    upward.roll_rad = glm::radians(attribute.number("Roll").value_or(0.0));
    // Exporters write the y axis if the up vector is unset, regardless of the up axis of the file.
    const glm::dvec3 unset(0.0, 1.0, 0.0);
    const glm::dvec3 chosen = attribute.vector("UpVector").value_or(unset);
    const glm::dvec3 up = chosen == unset ? fbx::up_of_file(document.settings) : chosen;
    upward.direction = glm::dmat3(fbx::world_from_file(document.settings)) * up;
    if (model.up_position)
        if (const auto found = nodes.find(*model.up_position); found != nodes.end())
            upward.node = found->second;
    return upward;
}

/// Adds a camera to the node `parent`. An FBX camera looks along the x axis of its node, with y up.
Index add_camera(Scene& scene, Index parent, SceneCamera lens, const std::string& name)
{
    const glm::dmat4 matrix(glm::dvec4(0.0, 0.0, 1.0, 0.0), glm::dvec4(0.0, 1.0, 0.0, 0.0),
                            glm::dvec4(-1.0, 0.0, 0.0, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0));
    const Index index = add_child(scene, parent, name, matrix);
    lens.name = name;
    scene.nodes[index].camera = static_cast<Index>(scene.cameras.size());
    scene.cameras.push_back(std::move(lens));
    return index;
}

Index light_below(const Scene& scene, Index parent)
{
    for (const Index child : scene.nodes[parent].children)
        if (scene.nodes[child].light != no_index)
            return child;
    return no_index;
}

/// Returns whether a model is a viewport camera of the exporting program. Viewport cameras are not part of
/// the scene.
bool is_view_of_program(const fbx::Model& model)
{
    constexpr std::array<std::string_view, 7> views{"Perspective", "Front", "Back",  "Right",
                                                    "Left",        "Top",   "Bottom"};
    constexpr std::string_view prefix = "Producer ";
    return model.name.starts_with(prefix) &&
           std::find(views.begin(), views.end(), std::string_view(model.name).substr(prefix.size())) !=
               views.end();
}

/// Adds the cameras and lights of the file. Cameras are added in the order of their nodes.
void add_attributes(Scene& scene, const fbx::Document& document, const NodeOfModel& nodes)
{
    std::vector<std::pair<Index, int64_t>> in_order;
    for (const auto& [id, index] : nodes)
        in_order.emplace_back(index, id);
    std::sort(in_order.begin(), in_order.end());
    for (const auto& [index, id] : in_order) {
        const fbx::Model& model = document.models.at(id);
        if (is_view_of_program(model))
            continue;
        for (const int64_t attribute_id : model.attributes) {
            const fbx::Attribute& attribute = document.attributes.at(attribute_id);
            Index looking = no_index;
            if (attribute.kind == "Camera")
                looking = add_camera(scene, index, fbx::lens_of(attribute.properties, document), model.name);
            else if (attribute.kind == "Light")
                looking = light_below(scene, index);
            if (looking == no_index || !model.look_at)
                continue;
            if (const auto target = nodes.find(*model.look_at); target != nodes.end())
                aim_node(scene, looking, target->second,
                         upward_of(model, attribute.properties, document, nodes));
        }
    }
}

std::optional<double> frames_per_s(const fbx::Properties& settings)
{
    // Frames per second for each FBX time mode. The value 0 means that the mode has no fixed rate. Mode 14 is
    // a custom rate.
    constexpr std::array<double, 19> rates{0.0,  120.0, 100.0,  60.0,   50.0, 48.0, 30.0, 30.0,  29.97, 29.97,
                                           25.0, 24.0,  1000.0, 23.976, 0.0,  96.0, 72.0, 59.94, 119.88};
    constexpr double custom = 14.0;
    const double mode = settings.number("TimeMode").value_or(0.0);
    double rate = 0.0;
    if (mode == custom)
        rate = settings.number("CustomFrameRate").value_or(0.0);
    else if (mode > 0.0 && mode < static_cast<double>(rates.size()))
        rate = rates[static_cast<size_t>(mode)];
    return rate > 0.0 && rate <= 1000.0 ? std::optional(rate) : std::nullopt;
}

/// Sets the durations of animations from the file, because an animation may hold its last pose beyond its
/// last key. Assimp has already shifted the start of each animation to 0.
void set_durations(Scene& scene, const fbx::Document& document)
{
    for (Animation& animation : scene.animations) {
        const auto range = document.ranges.find(animation.name);
        if (range == document.ranges.end())
            continue;
        const auto length_s = static_cast<float>(range->second.stop_s - range->second.start_s);
        if (length_s > animation.duration_s && length_s < 1e6F)
            animation.duration_s = length_s;
    }
}

bool is_set_to_zero(const fbx::Properties& properties, std::string_view name)
{
    return properties.sets(name) && properties.number(name).value_or(1.0) == 0.0;
}

/// Hides the mesh and light of a model, but not the models below it. Assimp may have moved the content of a
/// hidden node to extra child nodes, which are hidden too.
void hide_own(Scene& scene, Index index, const std::vector<bool>& is_model)
{
    for (const Index child : scene.nodes[index].children)
        // Larger indices belong to nodes that were added by this function.
        if (child >= is_model.size() || !is_model[child])
            scene.nodes[child].visible = false;
    if (scene.nodes[index].mesh == no_index && scene.nodes[index].light == no_index)
        return;
    const Index shown = add_child(scene, index, scene.nodes[index].name, glm::dmat4(1.0));
    scene.nodes[shown].visible = false;
    scene.nodes[shown].mesh = std::exchange(scene.nodes[index].mesh, no_index);
    scene.nodes[shown].skin = std::exchange(scene.nodes[index].skin, no_index);
    scene.nodes[shown].light = std::exchange(scene.nodes[index].light, no_index);
}

/// Hides the models that the FBX properties `Show` or `Visibility` hide. `Show` hides only the model itself.
/// `Visibility` also hides models below it that inherit visibility, which is the default.
void hide_models(Scene& scene, const fbx::Document& document, const NodeOfModel& nodes)
{
    std::vector<bool> is_model(scene.nodes.size(), false);
    for (const auto& [id, index] : nodes)
        is_model[index] = true;
    std::set<int64_t> seen;
    std::vector<std::pair<int64_t, bool>> pending; // models to visit, and whether their parent is invisible
    for (const int64_t root : document.roots)
        pending.emplace_back(root, false);
    while (!pending.empty()) {
        const auto [id, hidden_above] = pending.back();
        pending.pop_back();
        // The models of a damaged file may form a cycle.
        if (!seen.insert(id).second)
            continue;
        const fbx::Model& model = document.models.at(id);
        const bool inherits = !is_set_to_zero(model.properties, "VisibilityInheritance");
        const bool hidden = is_set_to_zero(model.properties, "Visibility") || (hidden_above && inherits);
        const auto found = nodes.find(id);
        if (found != nodes.end() && (hidden || is_set_to_zero(model.properties, "Show")))
            hide_own(scene, found->second, is_model);
        for (const int64_t child : model.children)
            pending.emplace_back(child, hidden);
    }
}

} // namespace

void apply_fbx(Conversion& conversion, const fbx::Document& document)
{
    Scene& scene = conversion.scene();
    scene.frames_per_s = frames_per_s(document.settings);
    scene.file_unit_m = fbx::unit_m(document.settings);
    set_durations(scene, document);
    const NodeOfModel nodes = match_nodes(conversion, document);
    hide_models(scene, document, nodes);
    place_nodes(scene, document, nodes);
    scene.nodes[scene.roots.front()].matrix = fbx::world_from_file(document.settings);
    add_attributes(scene, document, nodes);
}

} // namespace estampe
