// SPDX-License-Identifier: MIT
#pragma once

// The parts of the glTF importer: known extensions, textures, readers of single extensions, and the import
// functions in the order in which they run. Each import function fills one part of the scene and throws Error
// with a JSON pointer.

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

/// Whether the importer understands this extension.
[[nodiscard]] bool knows_extension(std::string_view name);

/// Whether a scene can be drawn although this extension, even if required by the file, is not understood.
/// That is so if the extension changes materials, pictures or lights, or adds what is not drawn (sound,
/// physics, facts). Every other extension may change the geometry, and the drawing would be wrong without it.
[[nodiscard]] bool can_do_without(std::string_view name);

/// The picture format that a texture extension adds and the importer cannot read, such as "AVIF"; nothing for
/// other extensions.
[[nodiscard]] std::optional<std::string_view> unread_picture_format(std::string_view extension);

/// Collects the textures that materials use, then decodes each picture once.
class TextureTable {
public:
    explicit TextureTable(Data& data);

    /// The scene's index of the file's texture `index`. Textures with the same picture and wrap modes share
    /// one index.
    [[nodiscard]] Index use(int index);

    /// Decodes all textures in use. A picture that is missing, damaged or of an unreadable format becomes one
    /// white pixel, with a warning; names of files that could not be opened are added to `missing_files`.
    [[nodiscard]] std::vector<Texture> decode(std::vector<std::string>& missing_files);

    /// Whether a texture of the scene was replaced by a white pixel. Only valid after decode().
    [[nodiscard]] bool is_lost(Index texture) const;

private:
    struct Use {
        int texture = -1;
        int image = -1; ///< negative if the texture has no picture that can be read
        std::string_view unread_format;
        Wrap wrap_u = Wrap::repeat;
        Wrap wrap_v = Wrap::repeat;
    };

    struct Decoded {
        Image image;
        std::string failure; ///< empty if the picture was read
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

/// The material of a primitive in each variant of the file (KHR_materials_variants), `no_index` in variants
/// that keep the primitive's own; empty if no variant changes it. If a variant is mapped twice, warns and
/// uses the first mapping.
[[nodiscard]] std::vector<Index> variant_materials(Data& data, const tinygltf::Primitive& source,
                                                   const std::string& pointer);

/// A decoded Draco stream: attributes as floats, converted as their accessors say, and triangles.
struct DracoMesh {
    std::map<std::string, std::vector<float>> attributes;
    std::vector<uint32_t> indices; ///< a triangle list

    [[nodiscard]] const std::vector<float>* attribute(const std::string& name) const
    {
        const auto found = attributes.find(name);
        return found == attributes.end() ? nullptr : &found->second;
    }
};

/// Decodes KHR_draco_mesh_compression; returns nothing for a primitive without it. Throws Error with a
/// pointer when the stream is damaged or does not match the accessors.
[[nodiscard]] std::optional<DracoMesh> decode_draco(Data& data, const tinygltf::Primitive& source,
                                                    const std::string& pointer);

/// Reads EXT_mesh_primitive_edge_visibility into `primitive.edge_marks`; does nothing for a primitive without
/// it.
///
/// `primitive` has its final triangles, but still the vertices of the file; `indices` are the file's own, in
/// the order of its topology. Edges with the values 2 and 3 (hard, hard repeated) and the edges of
/// `lineStrings` are marked. Values 0 and 1 (hidden, silhouette) are ignored, because outlines are found
/// anyway. An edge is marked on every triangle of the primitive that has its two vertices. Edges that belong
/// to no triangle are counted in a warning. Throws Error with a pointer when accessors do not fit. Cost: n
/// log n in marked edges.
void read_edge_marks(Data& data, const tinygltf::Primitive& source, std::span<const uint32_t> indices,
                     Primitive& primitive, const std::string& pointer);

/// Imports materials and the textures they use; decodes on up to four threads. The last material is the
/// default one, if a mesh needs it. Returns a map from the file's textures that say how strongly cloth is
/// held to the scene's textures, with `no_index` for one that is missing.
std::map<Index, Index> import_materials(Data& data, Scene& scene);

/// Imports meshes as decompressed triangle, line and point lists, with normals and tangents.
void import_meshes(Data& data, Scene& scene);

/// Imports nodes, lights, cameras and skins, and finds which of them belong to the file's scene.
void import_nodes(Data& data, Scene& scene);

/// Finds cloth by the names or extras of nodes and materials. The red of cloth's vertex colours says how
/// strongly a vertex is held, and these colours are not drawn.
void import_cloth(Data& data, const std::map<Index, Index>& held_textures, Scene& scene);

void import_animations(Data& data, Scene& scene);

} // namespace estampe::gltf
