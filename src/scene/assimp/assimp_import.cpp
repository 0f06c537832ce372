// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <system_error>

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "scene/assimp/convert.hpp"
#include "scene/assimp/dae_document.hpp"
#include "scene/assimp/fbx/document.hpp"
#include "scene/assimp/fbx/tree.hpp"
#include "scene/importers.hpp"
#include "scene/mending/mend.hpp"

namespace estampe {
namespace {

/// Returns the distance between two adjacent floats at the vertex farthest from the mesh's origin, as a share
/// of the mesh's size.
double step_in_sizes(const Mesh& mesh)
{
    Bounds bounds;
    for (const Primitive& primitive : mesh.primitives)
        for (const glm::vec3& position : primitive.positions)
            bounds.extend(position);
    const glm::dvec3 size = bounds.max - bounds.min;
    const double length = std::max({size.x, size.y, size.z});
    const glm::dvec3 reach = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
    const double farthest = std::max({reach.x, reach.y, reach.z});
    if (bounds.empty() || !(length > 0.0))
        return 0.0;
    return farthest * static_cast<double>(std::numeric_limits<float>::epsilon()) / length;
}

constexpr double visible_step = 1e-4;

/// Adds a warning when nodes are so far from the origin that floats cannot place them precisely relative to
/// each other. Assimp reads the transforms of nodes as floats.
void warn_of_far_nodes(Scene& scene)
{
    const Bounds bounds = scene_bounds(scene, pose_scene(scene, 0.0, no_index));
    double farthest = 0.0;
    size_t shown = 0;
    for (const Node& node : scene.nodes) {
        const glm::dvec3 place = node.matrix ? glm::dvec3((*node.matrix)[3]) : node.transform.translation;
        farthest = std::max(farthest, glm::length(place));
        shown += node.mesh != no_index ? 1 : 0;
    }
    const double step = farthest * static_cast<double>(std::numeric_limits<float>::epsilon());
    // Metres per unit of the file, which is the scale of the root node.
    const double unit_m =
        scene.roots.empty()
            ? 1.0
            : glm::length(glm::dvec3(scene.nodes[scene.roots.front()].matrix.value_or(glm::dmat4(1.0))[0]));
    if (shown > 1 && bounds.radius() > 0.0 && step * unit_m > visible_step * bounds.radius())
        scene.warnings.push_back(fmt::format("nodes lie so far from the origin that they are placed to "
                                             "{:.2g} m only; move the scene to the origin "
                                             "in the program that wrote the file",
                                             step * unit_m));
}

/// Adds a warning when meshes are so far from their own origin that rounding vertices to floats has visibly
/// changed their shape.
void warn_of_far_meshes(Scene& scene)
{
    size_t count = 0;
    double coarsest = 0.0;
    std::string name;
    for (const Mesh& mesh : scene.meshes) {
        const double step = step_in_sizes(mesh);
        if (!(step > visible_step))
            continue;
        ++count;
        if (step > coarsest) {
            coarsest = step;
            name = mesh.name;
        }
    }
    if (count > 0)
        scene.warnings.push_back(fmt::format(
            "{} mesh{} lie{} too far from the origin for their coordinates to be read exactly: \"{}\" by "
            "1/{:.0f} "
            "of its size; move the model to the origin in the program that wrote the file",
            count, count == 1 ? "" : "es", count == 1 ? "s" : "", name, std::max(1.0, 1.0 / coarsest)));
}

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

/// Adds a node for one skinned mesh. In Assimp each mesh has a skin, in Estampe each node, so each skinned
/// mesh needs its own node.
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

/// Lets Assimp open no file. Assimp gets the scene's file as bytes; pictures are read by load_pictures().
class NoFiles : public Assimp::DefaultIOSystem {
public:
    bool Exists(const char* /*file*/) const override { return false; }

    Assimp::IOStream* Open(const char* /*file*/, const char* /*mode*/) override { return nullptr; }
};

Conversion convert(const aiScene& source, const std::filesystem::path& path)
{
    Conversion conversion{.source = source, .result = {}, .node_of_name = {}, .node_of_source = {}};
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

UndecodedScene read_fbx(Assimp::Importer& importer, const std::filesystem::path& path, const ReadScope& scope,
                        unsigned steps)
{
    std::vector<std::byte> bytes = read_file(path, any_length, scope);
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
    return std::move(conversion.result);
}

UndecodedScene read_dae(Assimp::Importer& importer, const std::filesystem::path& path, const ReadScope& scope,
                        unsigned steps)
{
    const dae::Document document = dae::read_document(path, scope);
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
    return std::move(conversion.result);
}

/// Reads `path` with Assimp and converts the result to a scene. load_scene() calls this function in a child
/// process, because Assimp may crash or get stuck on a malicious file. The geometry is not repaired yet:
/// faces share no vertices, and normals exist only if the file has them. Throws Error or std::bad_alloc.
UndecodedScene read_with_assimp(const std::filesystem::path& path, const ReadScope& scope)
{
    constexpr unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType;
    Assimp::Importer importer;
    importer.SetIOHandler(new NoFiles); // the importer takes ownership of this object
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    return lower_extension(path) == ".fbx" ? read_fbx(importer, path, scope, steps)
                                           : read_dae(importer, path, scope, steps);
}

/// Calls read_with_assimp(). Messages of Assimp get the file as their place.
UndecodedScene read_naming_file(const std::filesystem::path& path, const ReadScope& scope)
{
    try {
        return read_with_assimp(path, scope);
    } catch (const Error& error) {
        if (!error.where().empty())
            throw;
        throw Error(error.what(), path.string(),
                    "check that the file opens in other programs, or convert it to glTF");
    }
}

void check_file(const std::filesystem::path& path)
{
    std::error_code failed;
    const auto status = std::filesystem::status(path, failed);
    if (!std::filesystem::exists(status))
        throw Error("no such file", path.string(), "check the path");
    if (!std::filesystem::is_regular_file(status))
        throw Error("is not a file", path.string(), "give the path of a scene file");
    const auto size = std::filesystem::file_size(path, failed);
    if (failed || size == 0)
        throw Error(failed ? "cannot be read" : "is empty", path.string(), "check the file");
}

/// Converts light intensities to physical units. In FBX and DAE, a light of intensity 1 makes a white surface
/// fully bright. In Estampe this needs an intensity of pi lux. For lamps, the conversion assumes a distance
/// equal to the scene's size.
void give_lights_units(Scene& scene)
{
    if (scene.lights.empty())
        return;
    const ScenePose pose = pose_scene(scene, 0.0);
    const Bounds bounds = scene_bounds(scene, pose);
    for (Index index = 0; index < scene.nodes.size(); ++index) {
        const Index light_index = scene.nodes[index].light;
        if (light_index == no_index)
            continue;
        Light& light = scene.lights[light_index];
        light.intensity *= std::numbers::pi_v<float>;
        if (light.type == LightType::directional)
            continue;
        const glm::dvec3 place(pose.world_from_node[index][3]);
        const double distance_m = std::max(glm::distance(place, bounds.center()), 0.5 * bounds.radius());
        light.intensity *= static_cast<float>(distance_m * distance_m);
    }
}

} // namespace

Scene load_with_assimp(const std::filesystem::path& path, const ReadScope& scope)
{
    check_file(path);
    if (lower_extension(path) == ".fbx")
        fbx::check_version(path, scope);
    UndecodedScene undecoded = read_naming_file(path, scope);
    Scene& scene = undecoded.scene;
    mend_meshes(scene, path.string());
    FileFinder finder({path.parent_path()}, scope);
    load_pictures(scene, undecoded.images, finder);
    check_structure(scene, path.string());
    give_lights_units(scene);
    return std::move(scene);
}

} // namespace estampe
