// SPDX-License-Identifier: MIT
#include "scene/gltf/gltf_import.hpp"

#include <algorithm>
#include <new>

#include "scene/gltf/convert.hpp"
#include "scene/gltf/extensions.hpp"
#include "scene/gltf/extras.hpp"
#include "scene/visibility.hpp"

namespace estampe {
namespace {

void check_drawable(const Scene& scene, const std::string& file)
{
    const std::vector<bool> visible = visible_nodes(scene);
    bool has_geometry = false;
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        const bool is_drawn = node.mesh != no_index && !scene.meshes[node.mesh].primitives.empty();
        if (is_drawn && visible[i]) {
            return;
        }
        has_geometry = has_geometry || is_drawn;
    }
    if (has_geometry) {
        throw Error("nothing to draw: all nodes with a mesh are hidden by KHR_node_visibility", file,
                    "export it with at least one visible mesh");
    }
    throw Error("nothing to draw: the scene has no geometry", file, "export it with at least one mesh");
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

/// Of pictures in a format that is not read, the textures that have no other are warned of one by one.
void warn_of_required(gltf::Data& data)
{
    const std::vector<std::string>& required = data.model().extensionsRequired;
    for (size_t i = 0; i < required.size(); ++i) {
        if (!gltf::knows_extension(required[i]) && !gltf::unread_picture_format(required[i])) {
            data.warn(fmt::format("/extensionsRequired/{}", i),
                      fmt::format("{} is required but not read; the scene is drawn without it", required[i]));
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
        scene.file_unit_m = 1.0;
        list_extensions(data.model(), scene);
        warn_of_required(data);
        const auto held_textures = gltf::import_materials(data, scene);
        scene.variants = data.variants();
        gltf::import_meshes(data, scene);
        gltf::import_nodes(data, scene);
        gltf::import_cloth(data, held_textures, scene);
        gltf::import_animations(data, scene);
        gltf::check_lightmap_extras(data);
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
    return import(gltf::read_gltf_bytes(path), path.string(), path.parent_path());
}

Scene load_gltf_bytes(std::span<const std::byte> bytes, const std::string& name)
{
    return import(bytes, name, std::nullopt);
}

} // namespace estampe
