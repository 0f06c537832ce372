// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "scene/gltf/convert.hpp"
#include "scene/gltf/extras.hpp"

namespace estampe::gltf {
namespace {

constexpr auto variants_extension = "KHR_materials_variants";

} // namespace

std::vector<Index> variant_materials(Data& data, const tinygltf::Primitive& source,
                                     const std::string& pointer)
{
    const auto found = source.extensions.find(variants_extension);
    if (found == source.extensions.end()) {
        return {};
    }
    const tinygltf::Value& mappings = found->second.Get("mappings");
    const size_t count = data.variants().size();
    data.spend(count * sizeof(Index), pointer);
    std::vector<Index> materials(count, no_index);
    for (size_t i = 0; i < mappings.ArrayLen(); ++i) {
        const tinygltf::Value& mapping = mappings.Get(static_cast<int>(i));
        const tinygltf::Value& variants = mapping.Get("variants");
        for (size_t v = 0; v < variants.ArrayLen(); ++v) {
            const auto variant = static_cast<size_t>(variants.Get(static_cast<int>(v)).GetNumberAsInt());
            if (materials[variant] != no_index) {
                data.warn(fmt::format("{}/extensions/{}/mappings/{}", pointer, variants_extension, i),
                          fmt::format("variant {} has a material already, which it keeps", variant));
                continue;
            }
            materials[variant] = static_cast<Index>(mapping.Get("material").GetNumberAsInt());
        }
    }
    const bool changes = std::ranges::any_of(materials, [](Index material) { return material != no_index; });
    return changes ? materials : std::vector<Index>();
}

namespace {

template <int Size>
glm::vec<Size, float> vector_of(const std::vector<double>& numbers, const glm::vec<Size, float>& otherwise)
{
    if (numbers.size() < Size) {
        return otherwise;
    }
    glm::vec<Size, float> vector;
    for (int i = 0; i < Size; ++i) {
        vector[i] = static_cast<float>(numbers[static_cast<size_t>(i)]);
    }
    return vector;
}

/// Reads the JSON of a glTF extension. The types of all values have already been checked.
class Extension {
public:
    explicit Extension(const tinygltf::Value& value) : value_(value) {}

    [[nodiscard]] float number(const char* key, float otherwise) const
    {
        return value_.Has(key) ? static_cast<float>(value_.Get(key).GetNumberAsDouble()) : otherwise;
    }

    [[nodiscard]] std::string text(const char* key) const
    {
        return value_.Has(key) ? value_.Get(key).Get<std::string>() : std::string();
    }

    template <int Size>
    [[nodiscard]] glm::vec<Size, float> vector(const char* key, const glm::vec<Size, float>& otherwise) const
    {
        if (!value_.Has(key)) {
            return otherwise;
        }
        std::vector<double> numbers;
        numbers.reserve(Size);
        for (int i = 0; i < Size; ++i) {
            numbers.push_back(value_.Get(key).Get(i).GetNumberAsDouble());
        }
        return vector_of<Size>(numbers, otherwise);
    }

    [[nodiscard]] tinygltf::TextureInfo texture(const char* key) const
    {
        tinygltf::TextureInfo info;
        if (value_.Has(key)) {
            const tinygltf::Value& value = value_.Get(key);
            info.index = value.Get("index").GetNumberAsInt();
            info.texCoord = value.Has("texCoord") ? value.Get("texCoord").GetNumberAsInt() : 0;
            if (value.Has("extensions")) {
                info.extensions = value.Get("extensions").Get<tinygltf::Value::Object>();
            }
        }
        return info;
    }

private:
    const tinygltf::Value& value_;
};

std::optional<Extension> extension(const tinygltf::ExtensionMap& extensions, const char* name)
{
    const auto found = extensions.find(name);
    return found == extensions.end() ? std::nullopt : std::optional(Extension(found->second));
}

/// Returns the matrix of uv' = translation * rotation * scale * uv. The direction of rotation is that of
/// KHR_texture_transform.
glm::mat3 uv_transform(const Extension& transform)
{
    const glm::vec2 offset = transform.vector<2>("offset", glm::vec2(0.0F));
    const glm::vec2 scale = transform.vector<2>("scale", glm::vec2(1.0F));
    const float angle = transform.number("rotation", 0.0F);
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    return glm::mat3(c * scale.x, -s * scale.x, 0.0F, s * scale.y, c * scale.y, 0.0F, offset.x, offset.y,
                     1.0F);
}

template <typename Info>
TextureRef texture_ref(Data& data, TextureTable& textures, const Info& info, const std::string& pointer)
{
    TextureRef ref;
    if (info.index < 0) {
        return ref;
    }
    ref.texture = textures.use(info.index);
    int uv_set = info.texCoord;
    if (const auto transform = extension(info.extensions, "KHR_texture_transform")) {
        ref.uv_transform = uv_transform(*transform);
        uv_set = static_cast<int>(transform->number("texCoord", static_cast<float>(uv_set)));
    }
    if (uv_set > 1) {
        data.warn(pointer + "/texCoord", fmt::format("UV set {} is not supported; set 0 is used", uv_set));
        uv_set = 0;
    }
    ref.uv_set = static_cast<uint32_t>(uv_set);
    return ref;
}

/// Returns a factor, after a check that it is between 0 and 1.
float fraction(Data& data, double value, const std::string& pointer)
{
    const double clamped = std::clamp(value, 0.0, 1.0);
    if (std::abs(clamped - value) > 1e-3) {
        data.warn(pointer, fmt::format("is {}, outside 0 to 1; {} is used", value, clamped));
    }
    return static_cast<float>(clamped);
}

ToonShade toon_shade(Data& data, TextureTable& textures, const Extension& mtoon, const std::string& pointer)
{
    ToonShade toon;
    toon.shade_color = mtoon.vector<3>("shadeColorFactor", glm::vec3(1.0F));
    toon.shade_texture =
        texture_ref(data, textures, mtoon.texture("shadeMultiplyTexture"), pointer + "/shadeMultiplyTexture");
    toon.shade_shift = mtoon.number("shadingShiftFactor", 0.0F);
    toon.shade_toony = fraction(data, static_cast<double>(mtoon.number("shadingToonyFactor", 0.9F)),
                                pointer + "/shadingToonyFactor");
    if (mtoon.texture("shadingShiftTexture").index >= 0) {
        data.warn(pointer + "/shadingShiftTexture", "is not looked up; the factor holds all over");
    }
    const std::string mode = mtoon.text("outlineWidthMode");
    if (mode == "worldCoordinates") {
        toon.outline_width_m = mtoon.number("outlineWidthFactor", 0.0F);
    } else if (mode == "screenCoordinates") {
        data.warn(pointer + "/outlineWidthMode",
                  "outlines by the screen's size are not supported; it has none of its own");
    }
    toon.outline_color = mtoon.vector<3>("outlineColorFactor", glm::vec3(0.0F));
    return toon;
}

/// Reads the index of refraction of a material with a volume.
float ior_of(Data& data, const tinygltf::Material& source, const std::string& pointer)
{
    constexpr float default_ior = 1.5F; // of KHR_materials_ior
    const auto refraction = extension(source.extensions, "KHR_materials_ior");
    const float ior = refraction ? refraction->number("ior", default_ior) : default_ior;
    if (ior < 1.0F) {
        data.warn(pointer + "/extensions/KHR_materials_ior/ior",
                  fmt::format("is {}, below 1; light passes straight", ior));
    }
    return std::max(ior, 1.0F);
}

/// Reads the transmission of a material. Returns nothing if the material is not transmissive.
std::optional<Transmission> transmission_of(Data& data, const tinygltf::Material& source,
                                            const std::string& pointer)
{
    const auto found = extension(source.extensions, "KHR_materials_transmission");
    if (!found) {
        return std::nullopt;
    }
    const std::string there = pointer + "/extensions/KHR_materials_transmission";
    const auto warn_of_texture = [&](const Extension& where, const char* key, const std::string& name) {
        if (where.texture(key).index >= 0) {
            data.warn(name + "/" + key, "is not looked up; the factor holds all over");
        }
    };
    Transmission seen;
    seen.share = fraction(data, static_cast<double>(found->number("transmissionFactor", 0.0F)),
                          there + "/transmissionFactor");
    warn_of_texture(*found, "transmissionTexture", there);
    if (const auto volume = extension(source.extensions, "KHR_materials_volume")) {
        seen.thickness_m = volume->number("thicknessFactor", 0.0F);
        seen.attenuation_m = volume->number("attenuationDistance", 0.0F);
        seen.attenuation_color =
            glm::clamp(volume->vector<3>("attenuationColor", glm::vec3(1.0F)), 0.0F, 1.0F);
        warn_of_texture(*volume, "thicknessTexture", pointer + "/extensions/KHR_materials_volume");
    }
    if (seen.thickness_m > 0.0F) {
        seen.ior = ior_of(data, source, pointer);
    }
    return seen.share > 0.0F ? std::optional(seen) : std::nullopt;
}

void apply_extensions(Data& data, TextureTable& textures, const tinygltf::Material& source,
                      const std::string& pointer, Material& material)
{
    // Files give toon materials KHR_materials_unlit as well, for programs that do not read
    // VRMC_materials_mtoon.
    material.unlit = source.extensions.contains("KHR_materials_unlit") &&
                     !source.extensions.contains("VRMC_materials_mtoon");
    if (const auto strength = extension(source.extensions, "KHR_materials_emissive_strength")) {
        material.emissive *= strength->number("emissiveStrength", 1.0F);
    }
    if (const auto gloss = extension(source.extensions, "KHR_materials_pbrSpecularGlossiness")) {
        material.base_color = gloss->vector<4>("diffuseFactor", glm::vec4(1.0F));
        material.base_color_texture =
            texture_ref(data, textures, gloss->texture("diffuseTexture"),
                        pointer + "/extensions/KHR_materials_pbrSpecularGlossiness/diffuseTexture");
        material.metallic = 0.0F;
        material.roughness = 1.0F - std::clamp(gloss->number("glossinessFactor", 1.0F), 0.0F, 1.0F);
    }
    material.transmission = transmission_of(data, source, pointer);
    if (const auto mtoon = extension(source.extensions, "VRMC_materials_mtoon")) {
        material.toon = toon_shade(data, textures, *mtoon, pointer + "/extensions/VRMC_materials_mtoon");
    }
}

Material import_material(Data& data, TextureTable& textures, const tinygltf::Material& source,
                         const std::string& pointer)
{
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    Material material;
    material.name = source.name;
    material.base_color = vector_of<4>(pbr.baseColorFactor, glm::vec4(1.0F));
    material.base_color_texture =
        texture_ref(data, textures, pbr.baseColorTexture, pointer + "/pbrMetallicRoughness/baseColorTexture");
    material.metallic = fraction(data, pbr.metallicFactor, pointer + "/pbrMetallicRoughness/metallicFactor");
    material.roughness =
        fraction(data, pbr.roughnessFactor, pointer + "/pbrMetallicRoughness/roughnessFactor");
    material.normal_texture = texture_ref(data, textures, source.normalTexture, pointer + "/normalTexture");
    material.normal_scale = static_cast<float>(source.normalTexture.scale);
    material.occlusion_texture =
        texture_ref(data, textures, source.occlusionTexture, pointer + "/occlusionTexture");
    material.occlusion_strength =
        fraction(data, source.occlusionTexture.strength, pointer + "/occlusionTexture/strength");
    material.emissive = vector_of<3>(source.emissiveFactor, glm::vec3(0.0F));
    material.emissive_texture =
        texture_ref(data, textures, source.emissiveTexture, pointer + "/emissiveTexture");
    material.alpha_mode = source.alphaMode == "MASK"    ? AlphaMode::mask
                          : source.alphaMode == "BLEND" ? AlphaMode::blend
                                                        : AlphaMode::opaque;
    material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
    material.double_sided = source.doubleSided;
    apply_extensions(data, textures, source, pointer, material);
    read_link_extras(data, source.extras, pointer, material.links);
    return material;
}

/// Removes the textures of a material whose picture could not be read. A picture that could not be read was
/// replaced by a white pixel. As a normal map, the white pixel would give wrong normals; as an emissive
/// texture, it would make the whole surface glow; as a shade texture, it would make the shade white.
void leave_out_lost(const TextureTable& textures, Material& material)
{
    if (textures.is_lost(material.normal_texture.texture)) {
        material.normal_texture = {};
    }
    if (material.toon && textures.is_lost(material.toon->shade_texture.texture)) {
        material.toon->shade_texture = {};
    }
    if (textures.is_lost(material.emissive_texture.texture)) {
        material.emissive_texture = {};
        material.emissive = glm::vec3(0.0F);
    }
}

bool needs_default_material(const tinygltf::Model& model)
{
    for (const tinygltf::Mesh& mesh : model.meshes) {
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            if (primitive.material < 0) {
                return true;
            }
        }
    }
    return model.materials.empty();
}

} // namespace

std::map<Index, Index> import_materials(Data& data, Scene& scene)
{
    TextureTable textures(data);
    const auto& sources = data.model().materials;
    for (size_t i = 0; i < sources.size(); ++i) {
        scene.materials.push_back(
            import_material(data, textures, sources[i], fmt::format("/materials/{}", i)));
    }
    if (needs_default_material(data.model())) {
        scene.materials.emplace_back().name = "default";
    }
    std::map<Index, Index> held_textures;
    const auto hold = [&](const tinygltf::Value& extras, const std::string& pointer) {
        if (const auto texture = held_texture(data, extras, pointer)) {
            held_textures[*texture] = textures.use(static_cast<int>(*texture));
        }
    };
    for (size_t i = 0; i < sources.size(); ++i) {
        hold(sources[i].extras, fmt::format("/materials/{}", i));
    }
    for (size_t i = 0; i < data.model().nodes.size(); ++i) {
        hold(data.model().nodes[i].extras, fmt::format("/nodes/{}", i));
    }
    scene.textures = textures.decode(scene.missing_files);
    for (Material& material : scene.materials) {
        leave_out_lost(textures, material);
    }
    for (auto& [of_file, of_scene] : held_textures) {
        of_scene = textures.is_lost(of_scene) ? no_index : of_scene;
    }
    return held_textures;
}

} // namespace estampe::gltf
