// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "scene/assimp/converter.hpp"

namespace estampe {
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

/// Keeps the eight strongest influences of a vertex.
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

} // namespace estampe
