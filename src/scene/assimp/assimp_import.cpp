// SPDX-License-Identifier: MIT
#include "scene/assimp/assimp_import.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "scene/assimp/child.hpp"
#include "scene/assimp/convert.hpp"
#include "scene/assimp/fbx/version.hpp"
#include "scene/assimp/mend.hpp"
#include "scene/assimp/ply_header.hpp"
#include "scene/assimp/turn_outside.hpp"

namespace estampe {
namespace {

uint64_t size_of_file(const std::filesystem::path& path)
{
    std::error_code failed;
    const auto status = std::filesystem::status(path, failed);
    if (!std::filesystem::exists(status))
        throw Error("no such file", path.string(), "check the path");
    if (!std::filesystem::is_regular_file(status))
        throw Error("is not a file", path.string(), "give the path of a scene file");
    const auto size = std::filesystem::file_size(path, failed);
    if (failed || size == 0)
        throw Error(failed ? "cannot be read" : "is empty", path.string(), "check the file");
    return size;
}

/// The file as the scene names it, or a file of that name beside the scene: paths of other machines are
/// common.
std::optional<std::filesystem::path> find_picture(std::string name, const std::filesystem::path& folder)
{
    std::replace(name.begin(), name.end(), '\\', '/');
    const std::filesystem::path given(name);
    for (const std::filesystem::path& candidate : {folder / given, folder / given.filename()}) {
        std::error_code failed;
        if (std::filesystem::is_regular_file(candidate, failed))
            return candidate;
    }
    return std::nullopt;
}

Image load_picture(const ImageSource& source, const std::filesystem::path& folder)
{
    if (!source.bytes.empty())
        return decode_image(source.bytes, source.file);
    const std::optional<std::filesystem::path> file = find_picture(source.file, folder);
    if (!file)
        throw Error("no such file", (folder / source.file).string());
    return load_image(*file);
}

void load_pictures(Scene& scene, const std::vector<ImageSource>& sources, const std::filesystem::path& folder)
{
    for (size_t i = 0; i < sources.size(); ++i) {
        Image& image = scene.textures[i].image;
        if (image.rgba.size() == size_t{4} * image.width * image.height && !image.empty())
            continue;
        try {
            image = load_picture(sources[i], folder);
        } catch (const Error& error) {
            scene.warnings.push_back(fmt::format("texture left white: {}", error.what()));
            image = {.width = 1, .height = 1, .rgba = {255, 255, 255, 255}};
        }
    }
}

void mend_meshes(Scene& scene, const std::filesystem::path& path)
{
    if (scene.materials.empty()) {
        scene.materials.emplace_back();
        scene.materials.front().double_sided = true;
    }
    size_t elements = 0;
    for (Mesh& mesh : scene.meshes) {
        size_t targets = 0;
        for (Primitive& primitive : mesh.primitives) {
            if (primitive.material >= scene.materials.size())
                primitive.material = 0;
            mend_primitive(primitive, mesh.name, scene.warnings);
            targets = std::max(targets, primitive.morph_targets.size());
        }
        std::erase_if(mesh.primitives, [](const Primitive& primitive) { return primitive.indices.empty(); });
        mesh.morph_weights.assign(targets, 0.0F);
        elements += mesh.primitives.size();
    }
    if (elements == 0)
        throw Error(scene.warnings.empty() ? std::string("has no triangles, lines or points")
                                           : fmt::format("has nothing to draw ({})", scene.warnings.back()),
                    path.string(), "give a file with meshes");
}

/// These formats' lights have no unit: 1 lights a surface fully. That is pi lux, here and, for lamps, at the
/// distance of the scene.
void give_lights_units(Scene& scene)
{
    if (scene.lights.empty())
        return;
    const ScenePose pose = pose_scene(scene, 0.0);
    const Bounds bounds = scene_bounds(scene, pose);
    for (Index index = 0; index < scene.nodes.size(); ++index) {
        const Index light_index = scene.nodes[index].light;
        if (light_index == no_index)
            continue;
        Light& light = scene.lights[light_index];
        light.intensity *= std::numbers::pi_v<float>;
        if (light.type == LightType::directional)
            continue;
        const glm::dvec3 place(pose.world_from_node[index][3]);
        const double distance_m = std::max(glm::distance(place, bounds.center()), 0.5 * bounds.radius());
        light.intensity *= static_cast<float>(distance_m * distance_m);
        light.outer_cone_rad = std::clamp(light.outer_cone_rad, 0.01F, 1.57F);
        light.inner_cone_rad = std::clamp(light.inner_cone_rad, 0.0F, light.outer_cone_rad);
    }
}

} // namespace

Scene load_with_assimp(const std::filesystem::path& path)
{
    const uint64_t size = size_of_file(path);
    if (lower_extension(path) == ".ply")
        check_ply_header(path, size);
    if (lower_extension(path) == ".fbx")
        fbx::check_version(path);
    ChildLimits limits;
    limits.cpu_s = static_cast<uint32_t>(std::min<uint64_t>(10 + (size >> 20), 60));
    limits.memory_bytes = std::min<uint64_t>((uint64_t{512} << 20) + 64 * size, uint64_t{16} << 30);
    const std::vector<std::byte> bytes =
        run_in_child([&path] { return pack(read_with_assimp(path)); }, limits, path.string());
    TransferScene transfer = unpack(bytes, path.string());
    Scene& scene = transfer.scene;
    mend_meshes(scene, path);
    make_sound(scene, path.string());
    load_pictures(scene, transfer.images, path.parent_path());
    give_lights_units(scene);
    return std::move(scene);
}

} // namespace estampe
