// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/long_jobs.hpp"
#include "scene/gltf/convert.hpp"
#include "scene/mending/mend.hpp"

namespace estampe::gltf {
namespace {

/// Reads the vertex and index arrays of one primitive, from accessors or from a Draco stream.
class PrimitiveReader {
public:
    PrimitiveReader(Data& data, const tinygltf::Primitive& source, int index_accessor,
                    const std::string& pointer)
        : data_(data), source_(source), index_accessor_(index_accessor), pointer_(pointer)
    {
    }

    Primitive read()
    {
        draco_ = decode_draco(data_, source_, pointer_);
        primitive_.positions = attribute<glm::vec3>("POSITION");
        check_positions();
        primitive_.normals = attribute<glm::vec3>("NORMAL");
        primitive_.tangents = attribute<glm::vec4>("TANGENT");
        primitive_.uvs = {attribute<glm::vec2>("TEXCOORD_0"), attribute<glm::vec2>("TEXCOORD_1")};
        primitive_.colors = attribute<glm::vec4>("COLOR_0", 1.0F);
        make_finite(primitive_.uvs[0], "TEXCOORD_0", 0.0F);
        make_finite(primitive_.uvs[1], "TEXCOORD_1", 0.0F);
        make_finite(primitive_.colors, "COLOR_0", 1.0F);
        read_skinning();
        read_morph_targets();
        read_indices();
        return std::move(primitive_);
    }

private:
    [[nodiscard]] bool has(const char* name) const { return source_.attributes.contains(name); }

    [[nodiscard]] std::string pointer_of(const char* name) const { return pointer_ + "/attributes/" + name; }

    void check_type(int accessor, size_t components, const std::string& pointer) const
    {
        const auto found = static_cast<size_t>(component_count(accessor_of(data_, accessor)));
        const bool color_without_alpha = components == 4 && found == 3 && pointer.ends_with("COLOR_0");
        if (found != components && !color_without_alpha) {
            data_.fail(pointer,
                       fmt::format("accessor {} has {} components, not {}", accessor, found, components));
        }
    }

    void check_count(size_t count, const std::string& pointer) const
    {
        if (count != primitive_.positions.size()) {
            data_.fail(pointer, fmt::format("has {} elements, but there are {} positions", count,
                                            primitive_.positions.size()));
        }
    }

    template <typename Vector>
    std::vector<Vector> attribute(const char* name, float fill = 0.0F)
    {
        if (!has(name)) {
            return {};
        }
        const int accessor = source_.attributes.at(name);
        check_type(accessor, sizeof(Vector) / sizeof(float), pointer_of(name));
        std::vector<Vector> values;
        const std::vector<float>* decoded = draco_ ? draco_->attribute(name) : nullptr;
        if (decoded != nullptr) {
            values = vectors_of<Vector>(*decoded, component_count(accessor_of(data_, accessor)), fill);
        } else {
            values = read_vectors<Vector>(data_, accessor, fill);
        }
        if (!primitive_.positions.empty()) {
            check_count(values.size(), pointer_of(name));
        }
        return values;
    }

    template <typename Vector>
    static std::vector<Vector> vectors_of(const std::vector<float>& floats, int components, float fill)
    {
        const auto row = static_cast<size_t>(components);
        std::vector<Vector> vectors(floats.size() / row, Vector(fill));
        for (size_t i = 0; i < vectors.size(); ++i) {
            for (int c = 0; c < std::min(components, static_cast<int>(Vector::length())); ++c) {
                vectors[i][c] = floats[i * row + static_cast<size_t>(c)];
            }
        }
        return vectors;
    }

    template <typename Vector>
    void make_finite(std::vector<Vector>& values, const char* name, float otherwise)
    {
        size_t bad = 0;
        for (Vector& value : values) {
            if (!std::isfinite(glm::dot(value, Vector(1.0F)))) {
                value = Vector(otherwise);
                ++bad;
            }
        }
        if (bad > 0) {
            data_.warn(pointer_of(name), fmt::format("{} values are not finite; {} is used", bad, otherwise));
        }
    }

    void check_positions() const
    {
        for (size_t i = 0; i < primitive_.positions.size(); ++i) {
            const glm::vec3& p = primitive_.positions[i];
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
                data_.fail(pointer_of("POSITION"),
                           fmt::format("vertex {} has a position that is not finite", i),
                           "export the mesh again");
            }
        }
    }

    std::vector<glm::u16vec4> joints(const char* name)
    {
        std::vector<uint32_t> values;
        const std::vector<float>* decoded = draco_ ? draco_->attribute(name) : nullptr;
        const int accessor = source_.attributes.at(name);
        check_type(accessor, 4, pointer_of(name));
        if (decoded != nullptr) {
            for (const float value : *decoded) {
                values.push_back(value >= 0.0F && value < 65536.0F ? static_cast<uint32_t>(value) : 65535U);
            }
        } else {
            values = read_integers(data_, accessor, 4);
        }
        check_count(values.size() / 4, pointer_of(name));
        std::vector<glm::u16vec4> joints(values.size() / 4);
        for (size_t i = 0; i < values.size(); ++i) {
            joints[i / 4][static_cast<int>(i % 4)] = static_cast<uint16_t>(std::min(values[i], 65535U));
        }
        return joints;
    }

    void read_skinning()
    {
        if (!has("JOINTS_0") || !has("WEIGHTS_0")) {
            return;
        }
        primitive_.joints_0 = joints("JOINTS_0");
        primitive_.weights_0 = attribute<glm::vec4>("WEIGHTS_0");
        if (has("JOINTS_1") && has("WEIGHTS_1")) {
            primitive_.joints_1 = joints("JOINTS_1");
            primitive_.weights_1 = attribute<glm::vec4>("WEIGHTS_1");
        }
        if (const size_t bad = normalise_weights(primitive_); bad > 0) {
            data_.warn(pointer_of("WEIGHTS_0"),
                       fmt::format("{} vertices have no usable skin weight; each follows its "
                                   "first joint",
                                   bad));
        }
    }

    std::vector<glm::vec3> offsets(const std::map<std::string, int>& target, const char* name,
                                   const std::string& pointer)
    {
        const auto found = target.find(name);
        if (found == target.end()) {
            return {};
        }
        check_type(found->second, 3, pointer);
        std::vector<glm::vec3> values = read_vectors<glm::vec3>(data_, found->second);
        check_count(values.size(), pointer);
        for (size_t i = 0; i < values.size(); ++i) {
            if (!std::isfinite(glm::dot(values[i], glm::vec3(1.0F)))) {
                data_.fail(pointer, fmt::format("vertex {} has an offset that is not finite", i),
                           "export the mesh again");
            }
        }
        return values;
    }

    void read_morph_targets()
    {
        for (size_t i = 0; i < source_.targets.size(); ++i) {
            const std::string pointer = fmt::format("{}/targets/{}", pointer_, i);
            primitive_.morph_targets.push_back(
                {.position_offsets = offsets(source_.targets[i], "POSITION", pointer + "/POSITION"),
                 .normal_offsets = offsets(source_.targets[i], "NORMAL", pointer + "/NORMAL")});
        }
    }

    void read_indices()
    {
        const size_t vertex_count = primitive_.positions.size();
        if (draco_) {
            primitive_.indices = std::move(draco_->indices);
        } else if (index_accessor_ >= 0) {
            check_type(index_accessor_, 1, pointer_ + "/indices");
            primitive_.indices = read_integers(data_, index_accessor_, 1);
        } else {
            data_.spend(vertex_count * sizeof(uint32_t), pointer_);
            primitive_.indices.resize(vertex_count);
            for (size_t i = 0; i < vertex_count; ++i) {
                primitive_.indices[i] = static_cast<uint32_t>(i);
            }
        }
        for (size_t i = 0; i < primitive_.indices.size(); ++i) {
            if (primitive_.indices[i] >= vertex_count) {
                data_.fail(pointer_ + "/indices", fmt::format("index {} is {}, past the {} vertices", i,
                                                              primitive_.indices[i], vertex_count));
            }
        }
    }

    Data& data_;
    const tinygltf::Primitive& source_;
    int index_accessor_;
    const std::string& pointer_;
    std::optional<DracoMesh> draco_;
    Primitive primitive_;
};

/// Finds a normal map of the primitive that needs tangents. Searches the default material first, then the
/// materials of variants.
const TextureRef* normal_map_of(const Scene& scene, const Primitive& primitive)
{
    std::vector<Index> materials = primitive.variant_materials;
    materials.insert(materials.begin(), primitive.material);
    for (const Index material : materials) {
        const TextureRef* map =
            material < scene.materials.size() ? &scene.materials[material].normal_texture : nullptr;
        if (map != nullptr && map->texture != no_index && !primitive.uvs[map->uv_set].empty()) {
            return map;
        }
    }
    return nullptr;
}

void finish_triangles(Data& data, const Scene& scene, Primitive& primitive, const std::string& pointer)
{
    if (primitive.normals.empty()) {
        data.spend(primitive.indices.size() * sizeof(glm::vec3) * 4, pointer);
        // The winding of one-sided triangles is not changed, because it defines from which side they are
        // visible.
        if (primitive.material < scene.materials.size() && scene.materials[primitive.material].double_sided) {
            if (const size_t turned = agree_winding(primitive); turned > 0) {
                data.warn(pointer, fmt::format("{} triangles ran against their neighbours, turned", turned));
            }
        }
        make_flat_normals(primitive);
    } else if (const size_t bad = repair_normals(primitive); bad > 0) {
        data.warn(pointer + "/attributes/NORMAL",
                  fmt::format("{} normals are zero or not finite; they were computed from the faces", bad));
    }
    const TextureRef* normal_map = normal_map_of(scene, primitive);
    const bool good =
        std::all_of(primitive.tangents.begin(), primitive.tangents.end(), [](const glm::vec4& tangent) {
            return std::isfinite(glm::dot(tangent, tangent)) && glm::length(glm::vec3(tangent)) > 1e-6F;
        });
    if (!good) {
        data.warn(pointer + "/attributes/TANGENT",
                  "some tangents are zero or not finite; all were computed anew");
        primitive.tangents.clear();
    }
    if (normal_map != nullptr && primitive.tangents.empty()) {
        make_tangents(primitive, normal_map->uv_set);
    }
}

/// Imports a primitive. Returns nothing if the primitive has nothing to draw.
std::optional<Primitive> import_primitive(Data& data, const Scene& scene, const tinygltf::Primitive& source,
                                          int index_accessor, const std::string& pointer)
{
    if (!source.attributes.contains("POSITION")) {
        data.warn(pointer, "has no positions; it is left out");
        return std::nullopt;
    }
    Primitive primitive = PrimitiveReader(data, source, index_accessor, pointer).read();
    const int mode = source.mode < 0 ? TINYGLTF_MODE_TRIANGLES : source.mode;
    primitive.topology = mode == TINYGLTF_MODE_POINTS     ? Topology::points
                         : mode < TINYGLTF_MODE_TRIANGLES ? Topology::lines
                                                          : Topology::triangles;
    primitive.material = source.material >= 0 ? static_cast<Index>(source.material)
                                              : static_cast<Index>(scene.materials.size() - 1);
    primitive.variant_materials = variant_materials(data, source, pointer);
    const std::vector<uint32_t> in_file = std::move(primitive.indices);
    primitive.indices = list_indices(mode, in_file);
    if (primitive.indices.empty()) {
        data.warn(pointer, "has nothing to draw; it is left out");
        return std::nullopt;
    }
    read_edge_marks(data, source, in_file, primitive, pointer);
    drop_unused_vertices(primitive);
    if (primitive.topology == Topology::triangles) {
        finish_triangles(data, scene, primitive, pointer);
    }
    return primitive;
}

} // namespace

void import_meshes(Data& data, Scene& scene)
{
    const auto& sources = data.model().meshes;
    for (size_t i = 0; i < sources.size(); ++i) {
        constexpr double meshes_from = 0.75; // share of the file's load time before meshes are imported
        report_progress(
            std::lerp(meshes_from, 1.0, static_cast<double>(i) / static_cast<double>(sources.size())));
        const std::string pointer = fmt::format("/meshes/{}", i);
        Mesh& mesh = scene.meshes.emplace_back();
        mesh.name = sources[i].name;
        size_t targets = 0;
        for (size_t p = 0; p < sources[i].primitives.size(); ++p) {
            auto primitive = import_primitive(data, scene, sources[i].primitives[p], data.indices()[i][p],
                                              fmt::format("{}/primitives/{}", pointer, p));
            if (primitive) {
                targets = std::max(targets, primitive->morph_targets.size());
                mesh.primitives.push_back(std::move(*primitive));
            }
        }
        for (const double weight : sources[i].weights) {
            mesh.morph_weights.push_back(static_cast<float>(weight));
        }
        if (!mesh.morph_weights.empty() && mesh.morph_weights.size() != targets) {
            data.warn(pointer + "/weights",
                      fmt::format("{} weights for {} morph targets", mesh.morph_weights.size(), targets));
        }
        mesh.morph_weights.resize(targets, 0.0F);
    }
}

} // namespace estampe::gltf
