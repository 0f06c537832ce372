// SPDX-License-Identifier: MIT
#include "scene/assimp/assimp_import.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "scene/assimp/child.hpp"
#include "scene/assimp/convert.hpp"
#include "scene/assimp/fbx/version.hpp"
#include "scene/mending/mend.hpp"
#include "scene/mending/mend_scene.hpp"

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
    if (lower_extension(path) == ".fbx")
        fbx::check_version(path);
    ChildLimits limits;
    limits.cpu_s = static_cast<uint32_t>(std::min<uint64_t>(10 + (size >> 20), 60));
    limits.memory_bytes = std::min<uint64_t>((uint64_t{512} << 20) + 64 * size, uint64_t{16} << 30);
    const std::vector<std::byte> bytes =
        run_in_child([&path] { return pack(read_with_assimp(path)); }, limits, path.string());
    TransferScene transfer = unpack(bytes, path.string());
    Scene& scene = transfer.scene;
    mend_meshes(scene, path.string());
    check_structure(scene, path.string());
    FileFinder finder({path.parent_path()});
    load_pictures(scene, transfer.images, finder);
    give_lights_units(scene);
    return std::move(scene);
}

} // namespace estampe
