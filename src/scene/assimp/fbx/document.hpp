// SPDX-License-Identifier: MIT
#pragma once

// What an FBX file says about its nodes, cameras, lights and settings, by name of property, and the
// transforms of nodes and lenses of cameras computed from it.

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

/// Properties of an object. A property that the object does not set has the value of its template, which the
/// file also lists.
struct Properties {
    PropertyMap own;
    std::shared_ptr<const PropertyMap> defaults;

    [[nodiscard]] bool sets(std::string_view name) const { return own.contains(name); }

    [[nodiscard]] std::optional<double> number(std::string_view name) const;
    [[nodiscard]] std::optional<glm::dvec3> vector(std::string_view name) const;
    [[nodiscard]] std::string text(std::string_view name) const;
};

/// A node. Texts and numbers keep the file's units: centimetres times the file's unit, degrees.
struct Model {
    std::string name;
    Properties properties;
    std::vector<int64_t> children;      ///< child models, in the order of the connections
    std::vector<int64_t> attributes;    ///< cameras and lights
    std::optional<int64_t> look_at;     ///< the model that this one always looks at
    std::optional<int64_t> up_position; ///< the model that gives this one's upward direction
};

/// A camera, light or other attribute of a node; `kind` is Camera, Light, Null and so on.
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
    std::map<std::string, TimeRange> ranges; ///< time ranges of the animations, by name
};

/// Collects the objects of `tree`, and leaves out those of an unknown form.
[[nodiscard]] Document read_document(const Tree& tree);

/// Renames, in the file that `tree` was read from, all properties that give nodes a pivot or displace their
/// geometry. Assimp applies some of these properties in the wrong order and passes others on to children;
/// without them it finds nodes that are only translated, rotated and scaled. Names keep their length, so that
/// offsets in the file stay valid.
void hide_pivots(const Tree& tree, std::span<char> file);

/// The factors of a node's transform, in the order of multiplication: translation, before_rotation, rotation,
/// before_scale, scale, after_scale. Animations change translation, rotation and scale; the other factors
/// hold pivots and fixed rotations.
struct Parts {
    glm::dvec3 translation{0.0};
    glm::dmat4 before_rotation{1.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dmat4 before_scale{1.0};
    glm::dvec3 scale{1.0};
    glm::dmat4 after_scale{1.0};
    glm::dmat4 geometry{1.0}; ///< transforms the node's own geometry, but not its children

    [[nodiscard]] glm::dmat4 matrix() const;

    /// Whether the transform consists of translation, rotation and scale only.
    [[nodiscard]] bool is_plain() const;
};

[[nodiscard]] Parts parts_of(const Properties& model);

/// Matrix from the axes and the unit of the file to right-handed metres with y up.
[[nodiscard]] glm::dmat4 world_from_file(const Properties& settings);

/// Upward direction in the file's own axes.
[[nodiscard]] glm::dvec3 up_of_file(const Properties& settings);

/// Metres per unit of the file.
[[nodiscard]] double unit_m(const Properties& settings);

/// The lens of a camera of the file, in metres: the field of view that follows from its aperture mode and
/// gate fit, or the height of a parallel projection, and the near plane. `name` is not set.
[[nodiscard]] SceneCamera lens_of(const Properties& camera, const Document& document);

} // namespace estampe::fbx
