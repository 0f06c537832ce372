// SPDX-License-Identifier: MIT
#include "scene/gltf/gltf_import.hpp"

#include <algorithm>
#include <new>

#include "core/file.hpp"
#include "scene/gltf/convert.hpp"

namespace estampe {
namespace {

void check_drawable(const Scene& scene, const std::string& file)
{
    const bool drawable = std::any_of(scene.nodes.begin(), scene.nodes.end(), [&](const Node& node) {
        return node.mesh != no_index && !scene.meshes[node.mesh].primitives.empty();
    });
    if (!drawable) {
        throw Error("nothing to draw: the scene has no geometry", file, "export it with at least one mesh");
    }
}

void list_extensions(const tinygltf::Model& model, Scene& scene)
{
    scene.extensions_used = model.extensionsUsed;
    for (const std::string& name : model.extensionsUsed) {
        if (!gltf::knows_extension(name)) {
            scene.extensions_ignored.push_back(name);
        }
    }
}

Scene import(std::span<const std::byte> bytes, const std::string& file,
             const std::optional<std::filesystem::path>& folder)
{
    try {
        const gltf::Container container = gltf::open_container(bytes, file);
        gltf::Data data(gltf::read_document(container, file), container, file, folder);
        gltf::check_accessors(data);
        Scene scene;
        list_extensions(data.model(), scene);
        const auto held_textures = gltf::import_materials(data, scene);
        gltf::import_meshes(data, scene);
        gltf::import_nodes(data, scene);
        gltf::import_cloth(data, held_textures, scene);
        gltf::import_animations(data, scene);
        check_drawable(scene, file);
        scene.warnings = data.take_warnings();
        return scene;
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error("does not fit into memory", file);
    } catch (const std::exception& error) {
        throw Error(error.what(), file);
    }
}

} // namespace

Scene load_gltf(const std::filesystem::path& path)
{
    constexpr uint64_t max_file_bytes = uint64_t{1} << 34;
    return import(read_file(path, max_file_bytes), path.string(), path.parent_path());
}

Scene load_gltf_bytes(std::span<const std::byte> bytes, const std::string& name)
{
    return import(bytes, name, std::nullopt);
}

} // namespace estampe
