// SPDX-License-Identifier: MIT
#pragma once

// Properties of lights and objects that glTF lacks are read from `extras`, from an object named "estampe":
//
//     light           "falloff": "inverse_square" or "unit_volume"   "shape": "cone" or "pyramid"
//                     "type": "ambient"                              "shadows": true or false
//                     "groups": [1, 2]    lights objects of these    "casters": [1]    is blocked by those
//                     "radius": 0.1       metres, of what glows
//     node            "collider": "box", "ellipsoid", "cylinder", "capsule" or "mesh", which cloth runs into
//     node, material  "cloth": true, or {"density": 0.15, ...}: its members' names without units, see
//                     estampe/cloth.hpp, and "solver": "automatic", "small_steps", "verlet" or
//                     "block_descent", "held": a texture whose red says how much, "back": the material of
//                     the other side, "self": metres
//     node, material  "groups": [1]       lit by lights of these     "casts": [1], true or false
//                     "receives": true or false               "lightmap": see estampe/lightmap.hpp
//
// Groups of lights have numbers from 1 to 16. An object without groups belongs to all groups. The settings of
// a node apply to its children unless the children override them.
//
// Older versions of Blender have no boolean custom properties, and artists type numbers as text. So 0, 1,
// "0", "true" and the like are accepted as booleans, "0.5" as a number, and one group as a list.

#include "scene/gltf/data.hpp"

namespace estampe::gltf {

/// Reads the settings of a light from `extras`. All functions in this file ignore unknown settings. A warning
/// names the key of the setting, its place in the file and its owner.
void read_light_extras(Data& data, const tinygltf::Value& extras, const std::string& pointer, Light& light);
void read_link_extras(Data& data, const tinygltf::Value& extras, const std::string& pointer,
                      LightLinks& links);

void read_cloth_extras(Data& data, const tinygltf::Value& extras, const std::string& pointer,
                       std::optional<Cloth>& cloth);
/// Returns the texture of the file whose red channel defines how strongly the vertices of cloth are held.
/// Returns nothing if the extras name no texture.
[[nodiscard]] std::optional<Index> held_texture(Data& data, const tinygltf::Value& extras,
                                                const std::string& pointer);
void read_collider_extras(Data& data, const tinygltf::Value& extras, const std::string& pointer,
                          ClothCollider& collider);

/// Warns of unknown settings in the lightmaps of materials, nodes and scenes. The lightmaps themselves are
/// read by named_lightmap().
void check_lightmap_extras(Data& data);

/// Returns type and name of the object that owns the extras at or below `pointer`, for messages; for example:
/// node "Flag".
[[nodiscard]] std::string owner_at(const Data& data, const std::string& pointer);

/// Reads a JSON number, or a text that contains only a number.
[[nodiscard]] std::optional<double> number_of(const tinygltf::Value& value);

/// Returns whether `extras` has an object named "estampe".
[[nodiscard]] bool has_extras(const tinygltf::Value& extras);

} // namespace estampe::gltf
