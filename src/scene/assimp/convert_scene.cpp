// SPDX-License-Identifier: MIT
// Lights, cameras and animations.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/assimp/converter.hpp"
#include "scene/assimp/dae/dae_text.hpp"

namespace estampe {
namespace {

glm::dvec3 exact(const aiVector3D& v)
{
    return {v.x, v.y, v.z};
}

/// A child of the node of that name, at `place`, looking along `direction`: lights and cameras have a place
/// of their own within their node. no_index when there is no such node.
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

/// Places the values of `count` keys, `get(key)` giving time and value.
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

    // An animated node has to be in parts, as its keys are.
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
        if (!(light.intensity > 0.0F))
            continue;
        light.color = glm::vec3(color.r, color.g, color.b) / light.intensity;
        light.inner_cone_rad = 0.5F * source.mAngleInnerCone;
        light.outer_cone_rad = 0.5F * source.mAngleOuterCone;
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
