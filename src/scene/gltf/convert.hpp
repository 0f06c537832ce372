// SPDX-License-Identifier: MIT
#pragma once

// The parts of the importer: which extensions are read, textures, and readers of single extensions; then, in
// the order they run, what fills a part of the scene each and throws Error with a pointer.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <estampe/scene.hpp>

#include "scene/gltf/data.hpp"

namespace estampe::gltf {

/// The extensions that the importer understands.
[[nodiscard]] bool knows_extension(std::string_view name);

/// Whether a scene can be drawn without an extension that is not understood, even if the file requires it:
/// it changes materials, pictures or lights, or adds what is not drawn (sound, physics, facts). Every other
/// extension may change the geometry, and drawing without it would be wrong.
[[nodiscard]] bool can_do_without(std::string_view name);

/// The picture format that an extension of textures brings and that is not read, such as "AVIF"; nothing for
/// all other extensions.
[[nodiscard]] std::optional<std::string_view> unread_picture_format(std::string_view extension);

/// Gathers the textures that materials use, then decodes each of their pictures once.
class TextureTable {
public:
    explicit TextureTable(Data& data);

    /// The scene's index of the file's texture `index`. Two textures of the same picture and wrap modes are
    /// one.
    [[nodiscard]] Index use(int index);

    /// All textures in use. A picture that is missing, damaged or of a format that is not read becomes one
    /// white pixel, with a warning; files that could not be opened are added to `missing_files`.
    [[nodiscard]] std::vector<Texture> decode(std::vector<std::string>& missing_files);

    /// Whether a texture of the scene was replaced by a white pixel. Known after decode().
    [[nodiscard]] bool is_lost(Index texture) const;

private:
    struct Use {
        int texture = -1;
        int image = -1; ///< negative: none that can be read
        std::string_view unread_format;
        Wrap wrap_u = Wrap::repeat;
        Wrap wrap_v = Wrap::repeat;
    };

    struct Decoded {
        Image image;
        std::string failure; ///< empty: it was read
        bool is_missing = false;
        size_t uses_left = 0;
    };

    [[nodiscard]] Decoded decode_one(int image) const;
    [[nodiscard]] std::map<int, Decoded> decode_all();
    void warn_of_unread(const Use& use);

    Data& data_;
    std::vector<int> first_of_same_; ///< per image of the file, the first with the same file or bytes
    std::map<std::tuple<int, int, Wrap, Wrap>, Index> index_of_;
    std::vector<Use> uses_;
    std::vector<bool> lost_;
};

/// The material of a primitive in each variant of the file (KHR_materials_variants), `no_index` where it
/// keeps its own; empty where no variant changes it. Warns of a variant that is mapped twice: the first
/// mapping holds.
[[nodiscard]] std::vector<Index> variant_materials(Data& data, const tinygltf::Primitive& source,
                                                   const std::string& pointer);

/// What a Draco stream holds: attributes as floats, converted as their accessors say, and triangles.
struct DracoMesh {
    std::map<std::string, std::vector<float>> attributes;
    std::vector<uint32_t> indices; ///< a triangle list

    [[nodiscard]] const std::vector<float>* attribute(const std::string& name) const
    {
        const auto found = attributes.find(name);
        return found == attributes.end() ? nullptr : &found->second;
    }
};

/// Decodes KHR_draco_mesh_compression; nothing for a primitive without it. Throws Error with a pointer when
/// the stream is damaged or does not match the accessors.
[[nodiscard]] std::optional<DracoMesh> decode_draco(Data& data, const tinygltf::Primitive& source,
                                                    const std::string& pointer);

/// Reads EXT_mesh_primitive_edge_visibility into `primitive.edge_marks`; nothing for a primitive without it.
///
/// `primitive` has its final triangles, but still the vertices of the file; `indices` are the file's own, in
/// the order of its topology. Values 2 and 3 (hard, hard repeated) and the edges of `lineStrings` are marked;
/// 0 and 1 (hidden, silhouette) are not: outlines are found anyway. An edge is marked on every triangle of
/// the primitive that has its two vertices. Throws Error with a pointer when accessors do not fit; what runs
/// along no triangle is counted in a warning. Cost: n log n in marked edges.
void read_edge_marks(Data& data, const tinygltf::Primitive& source, std::span<const uint32_t> indices,
                     Primitive& primitive, const std::string& pointer);

/// Materials, and the textures they use, decoded on up to four threads. The last one is the default, when a
/// mesh needs it. Returns the scene's textures that say how cloth is held, by the file's;
/// `no_index` for one that is missing.
std::map<Index, Index> import_materials(Data& data, Scene& scene);

/// Meshes, decompressed, as plain lists, with normals and tangents.
void import_meshes(Data& data, Scene& scene);

/// Nodes, lights, cameras, skins, and which of them belong to the file's scene.
void import_nodes(Data& data, Scene& scene);

/// What is cloth: by the names of nodes and materials, or their extras. The red of its vertices' colours says
/// how much they are held, and colours nothing.
void import_cloth(Data& data, const std::map<Index, Index>& held_textures, Scene& scene);

void import_animations(Data& data, Scene& scene);

} // namespace estampe::gltf
