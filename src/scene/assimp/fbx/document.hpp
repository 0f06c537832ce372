// SPDX-License-Identifier: MIT
#pragma once

// Nodes, cameras, lights and settings of an FBX file, with their named properties. Also computes the
// transforms of nodes and the lenses of cameras from the properties of the FBX objects.

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

/// Properties of an FBX object. `own` contains the properties that the object sets. Properties that the
/// object does not store have the values in `defaults`, the object's template in the file.
struct Properties {
    PropertyMap own;
    std::shared_ptr<const PropertyMap> defaults;

    [[nodiscard]] bool sets(std::string_view name) const { return own.contains(name); }

    [[nodiscard]] std::optional<double> number(std::string_view name) const;
    [[nodiscard]] std::optional<glm::dvec3> vector(std::string_view name) const;
    [[nodiscard]] std::string text(std::string_view name) const;
};

/// A node of an FBX file. Properties keep the units of the file: lengths in centimetres times the unit factor
/// of the file, angles in degrees.
struct Model {
    std::string name;
    Properties properties;
    std::vector<int64_t> children;      ///< models below this one, in the order of the connections
    std::vector<int64_t> attributes;    ///< cameras and lights of this model
    std::optional<int64_t> look_at;     ///< the model that this model always faces
    std::optional<int64_t> up_position; ///< the model that defines the upward direction of this model
};

/// A camera, light or other attribute of a node. `kind` is the FBX type name: Camera, Light, Null and so on.
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
    std::map<std::string, TimeRange> ranges; ///< time ranges of the animations, by animation name
};

/// Collects the objects of an FBX file from `tree`. Skips objects of an unknown form.
[[nodiscard]] Document read_document(const Tree& tree);

/// Overwrites the names of some properties in the bytes of an FBX file, so that Assimp ignores the renamed
/// properties. The properties give a node a pivot or displace its geometry. Assimp applies some of the
/// properties in the wrong order, and applies some to children too. Without the renamed properties, Assimp
/// reads only translation, rotation and scale. A new name is as long as the old name, so that offsets in the
/// file stay valid.
void hide_pivots(const Tree& tree, std::span<char> file);

/// The factors of a node's transform, in the order of multiplication: translation, before_rotation, rotation,
/// before_scale, scale, after_scale. Animations change translation, rotation and scale. Factors other than
/// translation, rotation and scale contain pivots and fixed rotations.
struct Parts {
    glm::dvec3 translation{0.0};
    glm::dmat4 before_rotation{1.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dmat4 before_scale{1.0};
    glm::dvec3 scale{1.0};
    glm::dmat4 after_scale{1.0};
    glm::dmat4 geometry{1.0}; ///< transforms the node's own geometry, but not its children

    [[nodiscard]] glm::dmat4 matrix() const;

    /// Returns whether the transform consists of translation, rotation and scale only.
    [[nodiscard]] bool is_plain() const;
};

[[nodiscard]] Parts parts_of(const Properties& model);

/// Returns the matrix that converts positions from the axes and the unit of the file to right-handed metres
/// with y up.
[[nodiscard]] glm::dmat4 world_from_file(const Properties& settings);

/// Returns the upward direction, as a vector along the file's own axes.
[[nodiscard]] glm::dvec3 up_of_file(const Properties& settings);

/// Returns the number of metres per unit of the file.
[[nodiscard]] double unit_m(const Properties& settings);

/// Computes the lens of a camera of an FBX file, in metres and radians. The lens has a near plane, and either
/// a field of view or the height of a parallel projection. The field of view depends on aperture mode and
/// gate fit. `name` is not set.
[[nodiscard]] SceneCamera lens_of(const Properties& camera, const Document& document);

} // namespace estampe::fbx
