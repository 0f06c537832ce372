// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "scene/gltf/convert.hpp"
#include "scene/gltf/extras.hpp"
#include "scene/importers.hpp"
#include "scene/visibility.hpp"

namespace estampe::gltf {
namespace {

// Sources of the extension names: Khronos, "glTF 2.0 Extension Registry" (KHR, EXT and vendors), and the
// registries of VRM and of the Open Metaverse Interoperability group (OMI).

constexpr std::array<std::string_view, 19> understood = {
    "EXT_mesh_gpu_instancing",    "EXT_mesh_primitive_edge_visibility",
    "EXT_meshopt_compression",    "EXT_texture_webp",
    "KHR_animation_pointer",      "KHR_draco_mesh_compression",
    "KHR_lights_punctual",        "KHR_materials_emissive_strength",
    "KHR_materials_ior",          "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_transmission", "KHR_materials_unlit",
    "KHR_materials_variants",     "KHR_materials_volume",
    "KHR_mesh_quantization",      "KHR_node_visibility",
    "KHR_texture_transform",      "MOZ_lightmap",
    "VRMC_materials_mtoon",
};

constexpr std::array<std::pair<std::string_view, std::string_view>, 3> unread_pictures = {{
    {"EXT_texture_avif", "AVIF"},
    {"KHR_texture_basisu", "KTX2/Basis Universal"},
    {"MSFT_texture_dds", "DDS"},
}};

/// Words by which harmless extensions are recognised. Harmless extensions only change the appearance, or add
/// data that is not drawn. The word follows the vendor's prefix, as in "KHR_materials_sheen",
/// "ADOBE_materials_thin_transparency" and "OMI_physics_body".
constexpr std::array<std::string_view, 18> harmless_subjects = {
    "animation", "audio",    "environment", "feature", "image", "interactivity", "light",   "lights",  "link",
    "materials", "metadata", "packing",     "physics", "seat",  "spawn",         "texture", "vehicle", "xmp",
};

/// Full names of further harmless extensions, which harmless_subjects does not cover. MSFT_lod adds coarser
/// copies of meshes, which are ignored. The small ellipsoids of Gaussian splatting are drawn as points.
constexpr std::array<std::string_view, 23> harmless = {
    "AGI_articulations",
    "AGI_stk_metadata",
    "CESIUM_primitive_outline",
    "EXT_instance_features",
    "EXT_mesh_features",
    "EXT_mesh_manifold",
    "EXT_structural_metadata",
    "FB_geometry_metadata",
    "FB_ngon_encoding",
    "GRIFFEL_bim_data",
    "KHR_gaussian_splatting",
    "KHR_implicit_shapes",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_techniques_webgl",
    "MSFT_lod",
    "NEEDLE_components",
    "NV_materials_mdl",
    "OMI_personality",
    "VRM",
    "VRMC_node_constraint",
    "VRMC_springBone",
    "VRMC_vrm",
};

} // namespace

bool knows_extension(std::string_view name)
{
    return std::ranges::find(understood, name) != understood.end();
}

bool can_do_without(std::string_view name)
{
    if (std::ranges::find(harmless, name) != harmless.end()) {
        return true;
    }
    const size_t prefix = name.find('_');
    if (prefix == std::string_view::npos) {
        return false;
    }
    const std::string_view rest = name.substr(prefix + 1);
    const std::string_view subject = rest.substr(0, rest.find('_'));
    return std::ranges::find(harmless_subjects, subject) != harmless_subjects.end();
}

std::optional<std::string_view> unread_picture_format(std::string_view extension)
{
    const auto* const found =
        std::ranges::find(unread_pictures, extension, [](const auto& entry) { return entry.first; });
    return found == unread_pictures.end() ? std::nullopt : std::optional(found->second);
}

} // namespace estampe::gltf

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

/// Adds a warning for each required extension that is not supported. Picture formats are left out, because
/// each texture without another picture gets its own warning.
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
             const std::optional<std::filesystem::path>& folder, const ReadScope& scope)
{
    try {
        const gltf::Container container = gltf::open_container(bytes, file);
        gltf::Data data(gltf::read_document(container, file), container, file, folder, scope);
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
        scene.files = data.named_files();
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

Scene load_gltf(const std::filesystem::path& path, const ReadScope& scope)
{
    return import(gltf::read_gltf_bytes(path, scope), path.string(), path.parent_path(), scope);
}

Scene load_gltf_bytes(std::span<const std::byte> bytes, const std::string& name)
{
    return import(bytes, name, std::nullopt, {});
}

} // namespace estampe
