// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>

#include "core/file.hpp"
#include "scene/assimp/assimp_import.hpp"
#include "scene/drawn_size.hpp"
#include "scene/gltf/gltf_import.hpp"
#include "scene/turn_up.hpp"

namespace estampe {
namespace {

constexpr std::array<std::string_view, 3> gltf_extensions = {".gltf", ".glb", ".vrm"};
constexpr std::array<std::string_view, 5> assimp_extensions = {".obj", ".ply", ".stl", ".fbx", ".dae"};

bool is_among(std::string_view extension, std::span<const std::string_view> extensions)
{
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

Scene checked(Scene scene, const std::filesystem::path& path, const LoadOptions& options)
{
    if (!options.variant.empty()) {
        apply_variant(scene, options.variant);
    }
    if (options.up) {
        turn_up(scene, *options.up);
    }
    check_drawn_size(scene, path.string());
    return scene;
}

} // namespace

Scene load_scene(const std::filesystem::path& path, const LoadOptions& options)
{
    const std::string extension = lower_extension(path);
    if (is_among(extension, gltf_extensions)) {
        return checked(load_gltf(path), path, options);
    }
    if (is_among(extension, assimp_extensions)) {
        return checked(load_with_assimp(path), path, options);
    }
    throw Error(extension.empty() ? "has no file name extension"
                                  : fmt::format("files of type {} are not read", extension),
                path.string(),
                fmt::format("give one of: {} {}", fmt::join(gltf_extensions, " "),
                            fmt::join(assimp_extensions, " ")));
}

} // namespace estampe
