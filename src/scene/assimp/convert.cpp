// SPDX-License-Identifier: MIT
#include "scene/assimp/convert.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <system_error>

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <estampe/error.hpp>

#include "core/file.hpp"
#include "scene/assimp/convert_fbx.hpp"
#include "scene/assimp/converter.hpp"
#include "scene/assimp/dae/dae_text.hpp"
#include "scene/assimp/far_meshes.hpp"
#include "scene/assimp/fbx/document.hpp"

namespace estampe {
namespace {

bool has_bones(const Conversion& conversion, unsigned mesh)
{
    return conversion.source.mMeshes[mesh]->HasBones();
}

Index add_node(Conversion& conversion, const aiNode& source, Index parent)
{
    Scene& scene = conversion.scene();
    const auto index = static_cast<Index>(scene.nodes.size());
    Node& node = scene.nodes.emplace_back();
    node.name = name_of(source.mName);
    node.parent = parent;
    node.matrix = matrix_of(source.mTransformation);
    if (parent == no_index)
        scene.roots.push_back(index);
    else
        scene.nodes[parent].children.push_back(index);
    conversion.node_of_name.emplace(node.name, index);
    conversion.node_of_source.emplace(&source, index);
    return index;
}

void add_nodes(Conversion& conversion, std::vector<std::pair<const aiNode*, Index>>& drawn)
{
    std::vector<std::pair<const aiNode*, Index>> pending{{conversion.source.mRootNode, no_index}};
    while (!pending.empty()) {
        const auto [source, parent] = pending.back();
        pending.pop_back();
        const Index index = add_node(conversion, *source, parent);
        if (source->mNumMeshes > 0)
            drawn.emplace_back(source, index);
        for (unsigned child = source->mNumChildren; child > 0; --child)
            pending.emplace_back(source->mChildren[child - 1], index);
    }
}

Index add_mesh(Conversion& conversion, const std::string& name, std::vector<Primitive> primitives)
{
    Mesh& mesh = conversion.scene().meshes.emplace_back();
    mesh.name = name;
    mesh.primitives = std::move(primitives);
    return static_cast<Index>(conversion.scene().meshes.size() - 1);
}

/// A node has one skin and here every mesh may have its own, so each skinned mesh gets a node for itself.
void add_skinned(Conversion& conversion, unsigned source, Index parent)
{
    const aiMesh& mesh = *conversion.source.mMeshes[source];
    Primitive primitive = convert_primitive(mesh);
    const Index skin = convert_skin(conversion, mesh, primitive);
    std::vector<Primitive> primitives;
    primitives.push_back(std::move(primitive));
    Node node;
    node.name = name_of(mesh.mName);
    node.parent = parent;
    node.mesh = add_mesh(conversion, node.name, std::move(primitives));
    node.skin = skin;
    Scene& scene = conversion.scene();
    scene.nodes[parent].children.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back(std::move(node));
}

void add_meshes(Conversion& conversion, const std::vector<std::pair<const aiNode*, Index>>& drawn)
{
    std::map<std::vector<unsigned>, Index> known;
    for (const auto& [source, index] : drawn) {
        std::vector<unsigned> plain;
        for (unsigned i = 0; i < source->mNumMeshes; ++i) {
            if (has_bones(conversion, source->mMeshes[i]))
                add_skinned(conversion, source->mMeshes[i], index);
            else
                plain.push_back(source->mMeshes[i]);
        }
        if (plain.empty())
            continue;
        const auto [found, is_new] = known.emplace(plain, no_index);
        if (is_new) {
            std::vector<Primitive> primitives;
            primitives.reserve(plain.size());
            for (const unsigned mesh : plain)
                primitives.push_back(convert_primitive(*conversion.source.mMeshes[mesh]));
            found->second = add_mesh(conversion, name_of(source->mName), std::move(primitives));
        }
        conversion.scene().nodes[index].mesh = found->second;
    }
}

} // namespace

Index Conversion::find_node(const aiString& name) const
{
    const auto found = node_of_name.find(name_of(name));
    return found == node_of_name.end() ? no_index : found->second;
}

glm::dmat4 matrix_of(const aiMatrix4x4& m)
{
    return {{m.a1, m.b1, m.c1, m.d1},
            {m.a2, m.b2, m.c2, m.d2},
            {m.a3, m.b3, m.c3, m.d3},
            {m.a4, m.b4, m.c4, m.d4}};
}

std::string name_of(const aiString& name)
{
    return {name.data, std::min<size_t>(name.length, sizeof(name.data) - 1)};
}

namespace {

/// What a file names beside itself is opened only if it is a file: a pipe or a device could be waited for
/// without end.
class RegularFiles : public Assimp::DefaultIOSystem {
public:
    bool Exists(const char* file) const override
    {
        std::error_code failed;
        return std::filesystem::is_regular_file(file, failed) &&
               std::filesystem::file_size(file, failed) > 0; // files of /proc have no size
    }

    Assimp::IOStream* Open(const char* file, const char* mode) override
    {
        return Exists(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
    }
};

} // namespace

namespace {

Conversion convert(const aiScene& source, const std::filesystem::path& path)
{
    Conversion conversion{.source = source, .transfer = {}, .node_of_name = {}, .node_of_source = {}};
    conversion.scene().name = path.stem().string();
    std::vector<std::pair<const aiNode*, Index>> drawn;
    add_nodes(conversion, drawn);
    convert_materials(conversion);
    add_meshes(conversion, drawn);
    convert_lights(conversion);
    convert_animations(conversion);
    return conversion;
}

const aiScene& checked(const aiScene* scene, const Assimp::Importer& importer)
{
    if (scene == nullptr || scene->mRootNode == nullptr)
        throw Error(importer.GetErrorString());
    return *scene;
}

TransferScene read_fbx(Assimp::Importer& importer, const std::filesystem::path& path, unsigned steps)
{
    std::vector<std::byte> bytes = read_file(path);
    const std::span file(reinterpret_cast<char*>(bytes.data()), bytes.size());
    fbx::Document document;
    {
        const fbx::Tree tree = fbx::read_tree(file);
        document = fbx::read_document(tree);
        fbx::hide_pivots(tree, file);
    }
    const aiScene* const scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), steps, "fbx");
    Conversion conversion = convert(checked(scene, importer), path);
    apply_fbx(conversion, document);
    warn_of_far_meshes(conversion.scene());
    return std::move(conversion.transfer);
}

TransferScene read_dae(Assimp::Importer& importer, const std::filesystem::path& path, unsigned steps)
{
    const dae::Document document = dae::read_document(path);
    const aiScene* const scene =
        importer.ReadFileFromMemory(document.text.data(), document.text.size(), steps, "dae");
    Conversion conversion = convert(checked(scene, importer), path);
    convert_cameras(conversion, document.lenses);
    conversion.scene().frames_per_s = document.frames_per_s;
    conversion.scene().file_unit_m = document.unit_m;
    for (Animation& animation : conversion.scene().animations)
        if (document.start_s < animation.duration_s)
            animation.start_s = static_cast<float>(document.start_s);
    warn_of_far_meshes(conversion.scene());
    if (!document.moved_vertices)
        warn_of_far_nodes(conversion.scene());
    return std::move(conversion.transfer);
}

} // namespace

TransferScene read_with_assimp(const std::filesystem::path& path)
{
    constexpr unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType;
    Assimp::Importer importer;
    importer.SetIOHandler(new RegularFiles); // it is the importer's from now on
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    const std::string extension = lower_extension(path);
    if (extension == ".fbx")
        return read_fbx(importer, path, steps);
    if (extension == ".dae")
        return read_dae(importer, path, steps);
    return convert(checked(importer.ReadFile(path.string(), steps), importer), path).transfer;
}

} // namespace estampe
