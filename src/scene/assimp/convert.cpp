// SPDX-License-Identifier: MIT
// Converts materials, geometry, lights, cameras and animations from Assimp to Estampe.
#include "scene/assimp/convert.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <assimp/material.h>
#include <fmt/format.h>

#include "scene/assimp/dae_document.hpp"

namespace estampe {
namespace {

Wrap wrap_of(aiTextureMapMode mode)
{
    if (mode == aiTextureMapMode_Mirror)
        return Wrap::mirror;
    return mode == aiTextureMapMode_Wrap ? Wrap::repeat : Wrap::clamp;
}

/// Converts an embedded picture. The embedded texture is either an encoded file, which is copied byte by
/// byte, or a list of raw texels.
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
    conversion.result.images.push_back(std::move(image));
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
    // Exporters often write black as the colour of a material whose texture defines the colour.
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

namespace {

glm::vec3 vector_of(const aiVector3D& v)
{
    return {v.x, v.y, v.z};
}

std::vector<glm::vec3> vectors_of(const aiVector3D* first, unsigned count)
{
    std::vector<glm::vec3> vectors;
    if (first == nullptr)
        return vectors;
    vectors.reserve(count);
    for (unsigned i = 0; i < count; ++i)
        vectors.push_back(vector_of(first[i]));
    return vectors;
}

void convert_morph_targets(const aiMesh& mesh, Primitive& primitive)
{
    for (unsigned i = 0; i < mesh.mNumAnimMeshes; ++i) {
        const aiAnimMesh& shape = *mesh.mAnimMeshes[i];
        MorphTarget& target = primitive.morph_targets.emplace_back();
        if (shape.mNumVertices != mesh.mNumVertices)
            continue;
        target.position_offsets = vectors_of(shape.mVertices, shape.mNumVertices);
        for (size_t v = 0; v < target.position_offsets.size(); ++v)
            target.position_offsets[v] -= primitive.positions[v];
        if (primitive.normals.empty())
            continue;
        target.normal_offsets = vectors_of(shape.mNormals, shape.mNumVertices);
        for (size_t v = 0; v < target.normal_offsets.size(); ++v)
            target.normal_offsets[v] -= primitive.normals[v];
    }
}

/// Collects the joint weights of a vertex and keeps the eight largest.
struct Influences {
    std::array<float, 8> weights{};
    std::array<uint16_t, 8> joints{};

    void add(uint16_t joint, float weight)
    {
        const auto weakest = std::min_element(weights.begin(), weights.end());
        if (!(weight > *weakest))
            return;
        joints[static_cast<size_t>(weakest - weights.begin())] = joint;
        *weakest = weight;
    }
};

} // namespace

Primitive convert_primitive(const aiMesh& mesh)
{
    Primitive primitive;
    const unsigned corners = (mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) != 0 ? 3
                             : (mesh.mPrimitiveTypes & aiPrimitiveType_LINE) != 0   ? 2
                                                                                    : 1;
    primitive.topology = corners == 3   ? Topology::triangles
                         : corners == 2 ? Topology::lines
                                        : Topology::points;
    primitive.material = mesh.mMaterialIndex;
    primitive.positions = vectors_of(mesh.mVertices, mesh.mNumVertices);
    primitive.normals = vectors_of(mesh.mNormals, mesh.mNumVertices);
    for (unsigned set = 0; set < 2; ++set)
        for (unsigned i = 0; mesh.HasTextureCoords(set) && i < mesh.mNumVertices; ++i)
            primitive.uvs[set].emplace_back(mesh.mTextureCoords[set][i].x,
                                            1.0F - mesh.mTextureCoords[set][i].y);
    for (unsigned i = 0; mesh.HasVertexColors(0) && i < mesh.mNumVertices; ++i) {
        const aiColor4D& color = mesh.mColors[0][i];
        primitive.colors.emplace_back(color.r, color.g, color.b, color.a);
    }
    primitive.indices.reserve(static_cast<size_t>(mesh.mNumFaces) * corners);
    for (unsigned i = 0; i < mesh.mNumFaces; ++i)
        if (mesh.mFaces[i].mNumIndices == corners)
            primitive.indices.insert(primitive.indices.end(), mesh.mFaces[i].mIndices,
                                     mesh.mFaces[i].mIndices + corners);
    convert_morph_targets(mesh, primitive);
    return primitive;
}

Index convert_skin(Conversion& conversion, const aiMesh& mesh, Primitive& primitive)
{
    Skin skin;
    skin.name = name_of(mesh.mName);
    std::vector<Influences> influences(primitive.positions.size());
    for (unsigned i = 0; i < std::min(mesh.mNumBones, 65535U); ++i) {
        const aiBone& bone = *mesh.mBones[i];
        const Index node = conversion.find_node(bone.mName);
        if (node == no_index)
            continue;
        const auto joint = static_cast<uint16_t>(skin.joints.size());
        skin.joints.push_back(node);
        skin.joint_from_bind.emplace_back(matrix_of(bone.mOffsetMatrix));
        for (unsigned k = 0; k < bone.mNumWeights; ++k)
            if (bone.mWeights[k].mVertexId < influences.size())
                influences[bone.mWeights[k].mVertexId].add(joint, bone.mWeights[k].mWeight);
    }
    if (skin.joints.empty())
        return no_index;
    for (const Influences& each : influences) {
        const auto& j = each.joints;
        const auto& w = each.weights;
        primitive.joints_0.emplace_back(j[0], j[1], j[2], j[3]);
        primitive.joints_1.emplace_back(j[4], j[5], j[6], j[7]);
        primitive.weights_0.emplace_back(w[0], w[1], w[2], w[3]);
        primitive.weights_1.emplace_back(w[4], w[5], w[6], w[7]);
    }
    conversion.scene().skins.push_back(std::move(skin));
    return static_cast<Index>(conversion.scene().skins.size() - 1);
}

namespace {

glm::dvec3 exact(const aiVector3D& v)
{
    return {v.x, v.y, v.z};
}

/// Adds a child node at `place` that looks along `direction` to the node named `name`. The child node is
/// needed because Assimp's lights and cameras have a position and a direction within their node. Returns
/// no_index if no node has this name.
Index add_looking_node(Conversion& conversion, const aiString& name, const glm::dvec3& place,
                       const glm::dvec3& direction, const glm::dvec3& up)
{
    const Index parent = conversion.find_node(name);
    if (parent == no_index)
        return no_index;
    const double length = glm::length(direction);
    const glm::dvec3 back = length > 0.0 ? -direction / length : glm::dvec3(0.0, 0.0, 1.0);
    glm::dvec3 right = glm::cross(up, back);
    if (!(glm::length(right) > 1e-9))
        right = glm::cross(std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1), back);
    right = glm::normalize(right);
    Scene& scene = conversion.scene();
    Node node;
    node.name = name_of(name);
    node.parent = parent;
    node.matrix = glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(back, right), 0.0),
                             glm::dvec4(back, 0.0), glm::dvec4(place, 1.0));
    scene.nodes[parent].children.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back(std::move(node));
    return static_cast<Index>(scene.nodes.size() - 1);
}

/// Fills an animation channel with `count` keys. `get(key)` returns the time and the value of a key.
template <typename Key, typename Put>
AnimationChannel channel_of(Index node, AnimatedPath path, const Key* keys, unsigned count,
                            double ticks_per_s, Put put)
{
    AnimationChannel channel;
    channel.node = node;
    channel.path = path;
    for (unsigned i = 0; i < count; ++i) {
        const auto time_s = static_cast<float>(keys[i].mTime / ticks_per_s);
        if (!channel.times_s.empty() && !(time_s > channel.times_s.back()))
            continue;
        channel.times_s.push_back(time_s);
        put(channel.values, keys[i]);
    }
    return channel;
}

void add_channels(Conversion& conversion, const aiNodeAnim& source, double ticks_per_s, Animation& animation)
{
    const Index index = conversion.find_node(source.mNodeName);
    if (index == no_index)
        return;
    const auto put_vector = [](std::vector<float>& values, const aiVectorKey& key) {
        values.insert(values.end(), {key.mValue.x, key.mValue.y, key.mValue.z});
    };
    const auto put_rotation = [](std::vector<float>& values, const aiQuatKey& key) {
        values.insert(values.end(), {key.mValue.x, key.mValue.y, key.mValue.z, key.mValue.w});
    };
    const auto add = [&animation](AnimationChannel channel) {
        if (!channel.times_s.empty())
            animation.channels.push_back(std::move(channel));
    };
    add(channel_of(index, AnimatedPath::translation, source.mPositionKeys, source.mNumPositionKeys,
                   ticks_per_s, put_vector));
    add(channel_of(index, AnimatedPath::rotation, source.mRotationKeys, source.mNumRotationKeys, ticks_per_s,
                   put_rotation));
    add(channel_of(index, AnimatedPath::scale, source.mScalingKeys, source.mNumScalingKeys, ticks_per_s,
                   put_vector));

    // The keys animate translation, rotation and scale. An animated node must therefore store translation,
    // rotation and scale, not a matrix.
    Node& node = conversion.scene().nodes[index];
    if (!node.matrix)
        return;
    const glm::dmat4 m = *node.matrix;
    node.matrix.reset();
    glm::dmat3 axes(m);
    glm::dvec3 scale{glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])};
    if (glm::determinant(axes) < 0.0)
        scale.x = -scale.x;
    for (int axis = 0; axis < 3; ++axis)
        if (scale[axis] != 0.0)
            axes[axis] /= scale[axis];
    node.transform = {
        .translation = glm::dvec3(m[3]), .rotation = glm::normalize(glm::quat_cast(axes)), .scale = scale};
}

} // namespace

void convert_lights(Conversion& conversion)
{
    Scene& scene = conversion.scene();
    for (unsigned i = 0; i < conversion.source.mNumLights; ++i) {
        const aiLight& source = *conversion.source.mLights[i];
        Light light;
        light.name = name_of(source.mName);
        if (source.mType == aiLightSource_DIRECTIONAL) {
            light.type = LightType::directional;
        } else if (source.mType == aiLightSource_SPOT) {
            light.type = LightType::spot;
        } else if (source.mType != aiLightSource_POINT) {
            scene.warnings.push_back(
                fmt::format("light \"{}\" is of a kind that is not drawn; left out", light.name));
            continue;
        }
        const aiColor3D& color = source.mColorDiffuse;
        light.intensity = std::max({color.r, color.g, color.b});
        if (!(light.intensity > 0.0F && std::isfinite(light.intensity)))
            continue;
        light.color = glm::max(glm::vec3(color.r, color.g, color.b) / light.intensity, 0.0F);
        light.outer_cone_rad = std::clamp(0.5F * source.mAngleOuterCone, 0.01F, 1.57F);
        light.inner_cone_rad = std::clamp(0.5F * source.mAngleInnerCone, 0.0F, light.outer_cone_rad);
        const Index node = add_looking_node(conversion, source.mName, exact(source.mPosition),
                                            exact(source.mDirection), exact(source.mUp));
        if (node == no_index)
            continue;
        scene.nodes[node].light = static_cast<Index>(scene.lights.size());
        scene.lights.push_back(std::move(light));
    }
}

void convert_cameras(Conversion& conversion, const std::vector<SceneCamera>& lenses)
{
    Scene& scene = conversion.scene();
    for (unsigned i = 0; i < conversion.source.mNumCameras; ++i) {
        const aiCamera& source = *conversion.source.mCameras[i];
        const size_t lens = dae::lens_index(static_cast<double>(source.mClipPlaneFar));
        if (lens >= lenses.size())
            continue;
        const Index node = add_looking_node(conversion, source.mName, exact(source.mPosition),
                                            exact(source.mLookAt), exact(source.mUp));
        if (node == no_index)
            continue;
        scene.nodes[node].camera = static_cast<Index>(scene.cameras.size());
        scene.cameras.push_back(lenses[lens]);
    }
}

void convert_animations(Conversion& conversion)
{
    for (unsigned i = 0; i < conversion.source.mNumAnimations; ++i) {
        const aiAnimation& source = *conversion.source.mAnimations[i];
        const double ticks_per_s = source.mTicksPerSecond != 0.0 ? source.mTicksPerSecond : 25.0;
        Animation animation;
        animation.name = name_of(source.mName);
        for (unsigned k = 0; k < source.mNumChannels; ++k)
            add_channels(conversion, *source.mChannels[k], ticks_per_s, animation);
        for (const AnimationChannel& channel : animation.channels)
            animation.duration_s = std::max(animation.duration_s, channel.times_s.back());
        if (!animation.channels.empty())
            conversion.scene().animations.push_back(std::move(animation));
    }
}

} // namespace estampe
