// SPDX-License-Identifier: MIT
#pragma once

// What an FBX file says of its nodes, cameras, lights and settings, by name of property; the places of nodes
// and the lenses of cameras that follow.

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <estampe/scene.hpp>

#include "scene/assimp/fbx/tree.hpp"

namespace estampe::fbx {

using PropertyMap = std::map<std::string, std::vector<Value>, std::less<>>;

/// Properties of an object; those that it does not set are its template's, which the file lists as well.
struct Properties {
    PropertyMap own;
    std::shared_ptr<const PropertyMap> defaults;

    [[nodiscard]] bool sets(std::string_view name) const { return own.contains(name); }

    [[nodiscard]] std::optional<double> number(std::string_view name) const;
    [[nodiscard]] std::optional<glm::dvec3> vector(std::string_view name) const;
    [[nodiscard]] std::string text(std::string_view name) const;
};

/// A node. Texts and numbers are as they are in the file: centimetres times the unit, degrees.
struct Model {
    std::string name;
    Properties properties;
    std::vector<int64_t> children;      ///< models, in the order of the connections
    std::vector<int64_t> attributes;    ///< cameras and lights
    std::optional<int64_t> look_at;     ///< model that it always looks at
    std::optional<int64_t> up_position; ///< model that gives its upward direction
};

/// What a node carries: `kind` is Camera, Light, Null and so on.
struct Attribute {
    std::string kind;
    Properties properties;
};

struct TimeRange {
    double start_s = 0.0;
    double stop_s = 0.0;
};

struct Document {
    uint32_t version = 0;
    std::string creator;
    Properties settings;
    std::map<int64_t, Model> models;
    std::map<int64_t, Attribute> attributes;
    std::vector<int64_t> roots;
    std::map<std::string, TimeRange> ranges; ///< of animations, by name
};

/// Objects of a form that is not known are left out.
[[nodiscard]] Document read_document(const Tree& tree);

/// Renames, in the file that `tree` was read from, all properties by which nodes turn about pivots or
/// displace their geometry. Assimp then finds nodes that are translated, rotated and scaled, and nothing
/// more: it applies some of these properties the wrong way round, and hands others on to children. Names keep
/// their length.
void hide_pivots(const Tree& tree, std::span<char> file);

/// The parts of a node's place, in the order in which they are multiplied:
/// translation, before_rotation, rotation, before_scale, scale, after_scale. Animations move the translation,
/// rotation and scale; the others hold pivots and fixed turns.
struct Parts {
    glm::dvec3 translation{0.0};
    glm::dmat4 before_rotation{1.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dmat4 before_scale{1.0};
    glm::dvec3 scale{1.0};
    glm::dmat4 after_scale{1.0};
    glm::dmat4 geometry{1.0}; ///< places what the node shows, but not its children

    [[nodiscard]] glm::dmat4 matrix() const;

    /// Whether translation, rotation and scale say it all.
    [[nodiscard]] bool is_plain() const;
};

[[nodiscard]] Parts parts_of(const Properties& model);

/// From the axes and the unit of the file to right-handed metres with y up.
[[nodiscard]] glm::dmat4 world_from_file(const Properties& settings);

/// Upward direction in the file's own axes.
[[nodiscard]] glm::dvec3 up_of_file(const Properties& settings);

/// How many metres a unit of the file is.
[[nodiscard]] double unit_m(const Properties& settings);

/// The lens of a camera of the file: field of view as its aperture mode and gate fit make it, or the height
/// of a parallel projection, and the near plane, in metres. `name` is not set.
[[nodiscard]] SceneCamera lens_of(const Properties& camera, const Document& document);

} // namespace estampe::fbx
