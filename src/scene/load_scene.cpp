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
#include "core/progress_watch.hpp"
#include "scene/assimp/assimp_import.hpp"
#include "scene/drawn_size.hpp"
#include "scene/gltf/gltf_import.hpp"
#include "scene/mending/repair.hpp"
#include "scene/mending/turn_outside.hpp"
#include "scene/obj/obj_import.hpp"
#include "scene/ply/ply_import.hpp"
#include "scene/stl/stl_import.hpp"
#include "scene/turn_up.hpp"

namespace estampe {
namespace {

constexpr std::array<std::string_view, 3> gltf_extensions = {".gltf", ".glb", ".vrm"};
constexpr std::array<std::string_view, 5> other_extensions = {".obj", ".ply", ".stl", ".fbx", ".dae"};

bool is_among(std::string_view extension, std::span<const std::string_view> extensions)
{
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

Scene read(const std::filesystem::path& path)
{
    const std::string extension = lower_extension(path);
    if (is_among(extension, gltf_extensions)) {
        return load_gltf(path);
    }
    if (extension == ".obj") {
        return load_obj(path);
    }
    if (extension == ".ply") {
        return load_ply(path);
    }
    if (extension == ".stl") {
        return load_stl(path);
    }
    if (is_among(extension, other_extensions)) {
        return load_with_assimp(path);
    }
    throw Error(
        extension.empty() ? "has no file name extension"
                          : fmt::format("files of type {} are not read", extension),
        path.string(),
        fmt::format("give one of: {} {}", fmt::join(gltf_extensions, " "), fmt::join(other_extensions, " ")));
}

} // namespace

Scene load_scene(const std::filesystem::path& path, const LoadOptions& options)
{
    Scene scene = read(path);
    if (!options.variant.empty()) {
        apply_variant(scene, options.variant);
    }
    report_progress(0.9);
    turn_by_normals(scene);
    turn_outside(scene);
    leave_out_outline_hulls(scene);
    find_cut_out_materials(scene);
    report_progress(1.0);
    if (options.up) {
        turn_up(scene, *options.up);
    }
    check_drawn_size(scene, path.string());
    return scene;
}

} // namespace estampe
