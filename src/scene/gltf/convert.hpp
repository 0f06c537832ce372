// SPDX-License-Identifier: MIT
#pragma once

// The functions of the glTF importer: known extensions, textures, readers of single extensions, and the
// import functions in the order in which the importer calls them. Each import function fills one part of the
// scene and throws Error with a JSON pointer.

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

/// Returns whether the importer supports this extension.
[[nodiscard]] bool knows_extension(std::string_view name);

/// Returns whether a file can be drawn correctly enough although the importer does not support this
/// extension. Returns true for extensions that change only materials, pictures or lights, or that add data
/// which is not drawn (sound, physics, metadata). Returns false for all other extensions, because they may
/// change the geometry.
[[nodiscard]] bool can_do_without(std::string_view name);

/// Returns the name of the picture format, such as "AVIF", if a texture extension adds a format that the
/// importer cannot decode. Returns nothing for other extensions.
[[nodiscard]] std::optional<std::string_view> unread_picture_format(std::string_view extension);

/// Collects the textures that materials use, then decodes each picture once.
class TextureTable {
public:
    explicit TextureTable(Data& data);

    /// Returns the scene's texture index for texture `index` of the file. Textures with equal picture and
    /// wrap modes share one index.
    [[nodiscard]] Index use(int index);

    /// Decodes all textures in use. A picture that is missing, damaged or in an unsupported format becomes
    /// one white pixel, with a warning. Appends names of files that could not be opened to `missing_files`.
    [[nodiscard]] std::vector<Texture> decode(std::vector<std::string>& missing_files);

    /// Returns whether decode() replaced the picture of a texture by a white pixel. Only valid after
    /// decode().
    [[nodiscard]] bool is_lost(Index texture) const;

private:
    struct Use {
        int texture = -1;
        int image = -1; ///< index of the image; negative if the texture has no picture that can be decoded
        std::string_view unread_format;
        Wrap wrap_u = Wrap::repeat;
        Wrap wrap_v = Wrap::repeat;
    };

    struct Decoded {
        Image image;
        std::string failure; ///< reason why the picture could not be read; empty if it was read
        std::string refusal; ///< message about a picture that lies outside of the scope of reading
        bool is_missing = false;
        size_t uses_left = 0;
    };

    [[nodiscard]] Decoded decode_one(int image) const;
    [[nodiscard]] std::map<int, Decoded> decode_all();
    void warn_of_unread(const Use& use);

    Data& data_;
    /// For each image of the file: the first image with the same file or bytes.
    std::vector<int> first_of_same_;
    std::map<std::tuple<int, int, Wrap, Wrap>, Index> index_of_;
    std::vector<Use> uses_;
    std::vector<bool> lost_;
};

/// Returns the material of a primitive for each variant of the file (KHR_materials_variants), or `no_index`
/// if the variant does not change the material. The list is empty if no variant changes it. If a variant is
/// mapped twice, warns and uses the first mapping.
[[nodiscard]] std::vector<Index> variant_materials(Data& data, const tinygltf::Primitive& source,
                                                   const std::string& pointer);

/// A decoded Draco stream: a list of triangles, and vertex attributes, which are converted to floats as their
/// accessors specify.
struct DracoMesh {
    std::map<std::string, std::vector<float>> attributes;
    std::vector<uint32_t> indices; ///< vertex indices, three per triangle

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

/// Reads EXT_mesh_primitive_edge_visibility into `primitive.edge_marks`. Does nothing for a primitive without
/// this extension.
///
/// `primitive` has its final triangles, but still the vertices of the file. `indices` are the indices in the
/// file, in the order of its topology. Edges with the values 2 and 3 (hard, hard repeated) and the edges of
/// `lineStrings` are marked. Values 0 and 1 (hidden, silhouette) are ignored, because the renderer finds
/// outlines itself. If an edge is marked, it is marked in every triangle of the primitive that uses both its
/// vertices. A warning counts the marked edges that belong to no triangle. Throws Error with a pointer when
/// accessors do not fit. Cost: n log n in marked edges.
void read_edge_marks(Data& data, const tinygltf::Primitive& source, std::span<const uint32_t> indices,
                     Primitive& primitive, const std::string& pointer);

/// Imports materials and their textures. Decodes pictures on up to four threads. If a mesh has no material, a
/// default material is added at the end. Returns a map from texture indices in the file to texture indices in
/// the scene, for the textures that define how strongly cloth is held. A missing texture has `no_index`.
std::map<Index, Index> import_materials(Data& data, Scene& scene);

/// Imports meshes as decompressed triangle, line and point lists, with normals and tangents.
void import_meshes(Data& data, Scene& scene);

/// Imports nodes, lights, cameras and skins. Finds which nodes belong to the scene that the file selects.
void import_nodes(Data& data, Scene& scene);

/// Finds cloth by the names or extras of nodes and materials. The red channel of the vertex colours of cloth
/// defines how strongly a vertex is held in place. Vertex colours that hold cloth are not drawn.
void import_cloth(Data& data, const std::map<Index, Index>& held_textures, Scene& scene);

void import_animations(Data& data, Scene& scene);

} // namespace estampe::gltf
