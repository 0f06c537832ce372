// SPDX-License-Identifier: MIT
#pragma once

// The objects on the square, each on y = 0 at the origin, and the square itself.

#include <filesystem>
#include <string>

#include <estampe/scene.hpp>

#include "kit.hpp"

namespace square {

/// A building with arches along x. Its front faces +z at z = 0.
struct Arcade {
    uint32_t arches = 9;
    float opening = 3.8F;
    float pier = 1.4F;
    float springing = 3.4F;
    float height = 8.6F;
    float thickness = 1.0F;
    float depth = 5.5F;  ///< depth of the walk behind the arches; 0: a free-standing wall
    bool windows = true; ///< the storey above the arches has windows
};

[[nodiscard]] float length_of(const Arcade& arcade);
[[nodiscard]] Kit build_arcade(const Arcade& arcade);

/// A square tower with a ring of columns and flags on top.
[[nodiscard]] Kit build_tower();

/// A fluted column on its block, with a capital, 7.6 m high.
[[nodiscard]] Kit build_column();

/// A piece of a broken column that lies along x.
[[nodiscard]] Kit build_drum();

/// A plinth with a lying figure, along x.
[[nodiscard]] Kit build_statue();

/// A person, 1.75 m.
[[nodiscard]] Kit build_person(bool cloak);

/// A steam engine with its tender, along x, chimney towards -x, with steam.
[[nodiscard]] Kit build_train();

/// The whole scene: objects, sun and the camera "square".
[[nodiscard]] estampe::Scene build_square();

/// One object of the scene, without light or camera: "statue", "engine", "tower". Throws estampe::Error for
/// an unknown name.
[[nodiscard]] estampe::Scene build_thing(const std::string& name);

/// Writes the meshes, materials, nodes, lights and cameras of `scene` as binary glTF. Equal scenes give equal
/// bytes. Throws estampe::Error when the file cannot be written.
void write_glb(const estampe::Scene& scene, const std::filesystem::path& path);

} // namespace square
