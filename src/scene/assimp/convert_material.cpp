// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>

#include <assimp/material.h>
#include <fmt/format.h>

#include "scene/assimp/converter.hpp"

namespace estampe {
namespace {

Wrap wrap_of(aiTextureMapMode mode)
{
    if (mode == aiTextureMapMode_Mirror)
        return Wrap::mirror;
    return mode == aiTextureMapMode_Wrap ? Wrap::repeat : Wrap::clamp;
}

/// Pictures inside the file are either those of a file, kept as they are, or plain texels.
void take_embedded(const aiTexture& source, Texture& texture, ImageSource& image)
{
    if (source.mHeight == 0) {
        const auto* bytes = reinterpret_cast<const std::byte*>(source.pcData);
        image.bytes.assign(bytes, bytes + source.mWidth);
        return;
    }
    texture.image.width = source.mWidth;
    texture.image.height = source.mHeight;
    const size_t count = static_cast<size_t>(source.mWidth) * source.mHeight;
    for (size_t i = 0; i < count; ++i) {
        const aiTexel& texel = source.pcData[i];
        texture.image.rgba.insert(texture.image.rgba.end(), {texel.r, texel.g, texel.b, texel.a});
    }
}

Index texture_of(Conversion& conversion, const aiMaterial& material, aiTextureType type)
{
    aiString file;
    aiTextureMapMode modes[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    if (material.GetTextureCount(type) == 0 ||
        material.GetTexture(type, 0, &file, nullptr, nullptr, nullptr, nullptr, modes) != aiReturn_SUCCESS)
        return no_index;
    Texture texture;
    texture.name = name_of(file);
    texture.wrap_u = wrap_of(modes[0]);
    texture.wrap_v = wrap_of(modes[1]);
    std::vector<Texture>& textures = conversion.scene().textures;
    const auto same = std::find_if(textures.begin(), textures.end(), [&texture](const Texture& other) {
        return other.name == texture.name && other.wrap_u == texture.wrap_u && other.wrap_v == texture.wrap_v;
    });
    if (same != textures.end())
        return static_cast<Index>(same - textures.begin());
    ImageSource image{.file = texture.name, .bytes = {}};
    if (const aiTexture* const embedded = conversion.source.GetEmbeddedTexture(file.C_Str()))
        take_embedded(*embedded, texture, image);
    textures.push_back(std::move(texture));
    conversion.transfer.images.push_back(std::move(image));
    return static_cast<Index>(textures.size() - 1);
}

glm::vec3 color_of(const aiColor4D& color)
{
    return glm::max(glm::vec3(color.r, color.g, color.b), glm::vec3(0.0F));
}

Material convert_material(Conversion& conversion, const aiMaterial& source)
{
    Material material;
    aiString name;
    if (source.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS)
        material.name = name_of(name);
    material.double_sided = true;
    material.metallic = 0.0F;
    aiColor4D color;
    if (source.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS ||
        source.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS)
        material.base_color = glm::vec4(color_of(color), 1.0F);
    if (source.Get(AI_MATKEY_COLOR_EMISSIVE, color) == aiReturn_SUCCESS)
        material.emissive = color_of(color);

    Index texture = texture_of(conversion, source, aiTextureType_BASE_COLOR);
    if (texture == no_index)
        texture = texture_of(conversion, source, aiTextureType_DIFFUSE);
    material.base_color_texture.texture = texture;
    // Exporters leave the colour black where the texture says it all.
    if (texture != no_index && glm::vec3(material.base_color) == glm::vec3(0.0F))
        material.base_color = glm::vec4(1.0F);

    float opacity = 1.0F;
    (void)source.Get(AI_MATKEY_OPACITY, opacity);
    if (!(opacity > 0.0F)) {
        conversion.scene().warnings.push_back(
            fmt::format("material \"{}\": opacity {} would hide it; drawn opaque", material.name, opacity));
        opacity = 1.0F;
    }
    if (opacity < 0.999F) {
        material.base_color.w = opacity;
        material.alpha_mode = AlphaMode::blend;
    }
    return material;
}

} // namespace

void convert_materials(Conversion& conversion)
{
    for (unsigned i = 0; i < conversion.source.mNumMaterials; ++i)
        conversion.scene().materials.push_back(
            convert_material(conversion, *conversion.source.mMaterials[i]));
}

} // namespace estampe
