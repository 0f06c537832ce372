// SPDX-License-Identifier: MIT
#include "scene/gltf/extensions.hpp"

#include <algorithm>
#include <array>
#include <utility>

// Names from Khronos, "glTF 2.0 Extension Registry" (KHR, EXT and vendors), and from the registries of VRM
// and of the Open Metaverse Interoperability group (OMI).

namespace estampe::gltf {
namespace {

constexpr std::array<std::string_view, 18> understood = {
    "EXT_mesh_gpu_instancing",
    "EXT_mesh_primitive_edge_visibility",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_animation_pointer",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
    "MOZ_lightmap",
    "VRMC_materials_mtoon",
};

constexpr std::array<std::pair<std::string_view, std::string_view>, 3> unread_pictures = {{
    {"EXT_texture_avif", "AVIF"},
    {"KHR_texture_basisu", "KTX2/Basis Universal"},
    {"MSFT_texture_dds", "DDS"},
}};

/// What follows the vendor's prefix where an extension changes looks or adds what is not drawn:
/// "KHR_materials_sheen", "ADOBE_materials_thin_transparency", "OMI_physics_body".
constexpr std::array<std::string_view, 18> harmless_subjects = {
    "animation", "audio",    "environment", "feature", "image", "interactivity", "light",   "lights",  "link",
    "materials", "metadata", "packing",     "physics", "seat",  "spawn",         "texture", "vehicle", "xmp",
};

/// Whole names that the subjects do not cover. MSFT_lod adds coarser copies, Gaussian splats are drawn as
/// points.
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
