// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <estampe/scene.hpp>
#include <nlohmann/json.hpp>

namespace estampe::app {

/// The details of a scene that `estampe info` prints apart from counts: axis, unit, cameras, animations,
/// variants, lights, missing files.
struct SceneDetails {
    /// Label and text of each detail, in display order.
    std::vector<std::pair<std::string, std::string>> rows;
    nlohmann::ordered_json json; ///< The details as numbers and lists, in JSON
};

/// Collects the details of a scene. `path` is the file from which the scene was read; the format of this file
/// determines whether axis and unit are known. Cost: linear in vertices and triangles.
[[nodiscard]] SceneDetails scene_details(const Scene& scene, const std::string& path);

/// Checks the name of a layer. Throws Error, with the nearest valid name, unless `layer` can be a layer or
/// mask of a picture of the scene: an object's name, or a name that render_layers() uses.
void check_layer_name(const Scene& scene, const std::string& layer);

/// Returns a note if a scene from a file without an up axis of its own (.obj, .ply, .stl) has a shape that
/// looks z-up; empty for all others.
[[nodiscard]] std::vector<std::string> up_axis_notes(const Scene& scene, const std::string& path);

/// Returns the frame rate that matches all keys of an animation: 24, 25, 30, 60 or another common rate. 0
/// when no rate matches, or when there are too few keys to tell.
[[nodiscard]] double key_rate(const Animation& animation);

} // namespace estampe::app
