// SPDX-License-Identifier: MIT
#pragma once

// A glTF file before it is a scene: its container, its document, and its bytes with every access checked.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>

namespace estampe::gltf {

/// The two parts of a glTF file: the JSON text, and for .glb the binary chunk.
struct Container {
    std::string_view json;
    std::optional<std::span<const std::byte>> binary;
    bool is_binary = false;
    size_t json_offset = 0; ///< where the JSON text begins in the file
};

/// The bytes of a glTF file, and none of what lies behind: its first bytes are looked at before the rest is
/// read, so that a large file of something else is refused at once. Throws Error as open_container() does.
[[nodiscard]] std::vector<std::byte> read_gltf_bytes(const std::filesystem::path& path);

/// Takes a file apart without copying; the result points into `bytes`. Throws Error with a byte offset when
/// it is empty, truncated, of another version, or no glTF at all, and when the JSON is nested deeper than 256
/// levels.
[[nodiscard]] Container open_container(std::span<const std::byte> bytes, const std::string& file);

[[nodiscard]] bool is_data_uri(std::string_view uri);

/// The bytes of "data:...;base64,..."; nothing when it is not base64 or damaged.
[[nodiscard]] std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri);

/// The file name in a relative URI, percent-decoded; nothing for an absolute path, another scheme, or a zero
/// byte.
[[nodiscard]] std::optional<std::string> decode_relative_uri(std::string_view uri);

/// Where a buffer's bytes are. Kept out of tinygltf's model, which would read them unasked.
struct BufferSource {
    std::string uri; ///< empty: the binary chunk, or a fallback that nobody reads
    uint64_t byte_length = 0;
};

/// Where an image is: a data URI, a relative path, or a buffer view.
struct ImageSource {
    std::string name;
    std::string uri;
    int view = -1;
};

struct Document {
    tinygltf::Model model; ///< without buffers, images, and the indices of primitives
    std::vector<BufferSource> buffers;
    std::vector<ImageSource> images;

    /// The index accessor of each primitive of each mesh, or -1. tinygltf refuses one without a buffer view,
    /// which glTF allows.
    std::vector<std::vector<int>> indices;

    /// Names of the material variants (KHR_materials_variants). tinygltf drops those without a name.
    std::vector<std::string> variants;
};

/// Parses and checks the JSON. Afterwards every index in the model is inside its array and every number is in
/// range. Throws Error with a JSON pointer, a line and column, or a byte.
[[nodiscard]] Document read_document(const Container& container, const std::string& file);

/// Checks the parsed JSON of a glTF file against what the importer relies on: every property it reads has its
/// type and range, what is required is there, and every index points into its array. Numbers with a zero
/// fraction where an integer belongs become integers.
///
/// Throws Error with `file#/json/pointer`. After it, reading a property can neither fail nor overflow.
void check_document(nlohmann::json& document, const std::string& file);

/// Under which the extras of an object have what only this library reads.
inline constexpr const char* our_key = "estampe";

/// One file on its way to a Scene: the parsed document and its bytes, with every access checked.
///
/// Reading adds to a budget of a few hundred times the files' size, so that a small file cannot ask for a
/// large scene. All members throw Error with `file#/json/pointer`.
class Data {
public:
    /// Reads every buffer. Without a `folder`, files beside the document cannot be read.
    Data(Document document, const Container& container, std::string file,
         std::optional<std::filesystem::path> folder);

    [[nodiscard]] const tinygltf::Model& model() const { return document_.model; }

    [[nodiscard]] const std::vector<ImageSource>& images() const { return document_.images; }

    [[nodiscard]] const std::vector<std::vector<int>>& indices() const { return document_.indices; }

    [[nodiscard]] const std::vector<std::string>& variants() const { return document_.variants; }

    [[nodiscard]] const std::string& file() const { return file_; }

    /// The bytes of a buffer view, decompressed.
    [[nodiscard]] std::span<const std::byte> view(int index) const
    {
        return views_[static_cast<size_t>(index)];
    }

    /// The bytes of a data URI or of a file beside the document. The Error it throws has the resource's name
    /// for a place.
    [[nodiscard]] std::vector<std::byte> resource(const std::string& uri) const;
    [[nodiscard]] std::string resource_name(const std::string& uri) const;

    /// Takes `bytes` from the budget.
    void spend(uint64_t bytes, const std::string& pointer);

    /// Notes a repair, in one line; the same line only once.
    void warn(const std::string& pointer, const std::string& what);

    [[nodiscard]] std::string place(const std::string& pointer) const { return file_ + "#" + pointer; }

    [[noreturn]] void fail(const std::string& pointer, const std::string& what,
                           const std::string& remedy = {}) const
    {
        throw Error(what, place(pointer), remedy);
    }

    /// What was repaired, at most a hundred lines and one that counts the rest.
    [[nodiscard]] std::vector<std::string> take_warnings();

private:
    void load_buffers(const Container& container);
    [[nodiscard]] std::span<const std::byte> named_bytes(size_t index);
    void check_is_fallback(size_t index, const Container& container) const;
    [[nodiscard]] std::filesystem::path file_of(const std::string& uri) const;
    void open_view(size_t index);
    void decompress_view(size_t index, const tinygltf::Value& compression);
    [[nodiscard]] std::span<const std::byte> slice(int buffer, uint64_t offset, uint64_t length,
                                                   const std::string& pointer) const;

    Document document_;
    std::string file_;
    std::optional<std::filesystem::path> folder_;
    std::vector<std::vector<std::byte>> owned_;
    std::vector<std::span<const std::byte>> buffers_;
    std::vector<std::span<const std::byte>> views_;
    uint64_t budget_bytes_ = 0;
    std::vector<std::string> warnings_;
    size_t warning_count_ = 0;
};

/// The vertices that an accessor holds, as floats: normalised integers become -1..1 or 0..1, others keep
/// their value, sparse entries are put in. `components` floats an element; what the file lacks stays as it is
/// in `fill`.
[[nodiscard]] std::vector<float> read_floats(Data& data, int accessor, int components, float fill = 0.0F);

/// The same for integers: indices and joints.
[[nodiscard]] std::vector<uint32_t> read_integers(Data& data, int accessor, int components);

/// The same into GLM vectors or matrices of floats.
template <typename Vector>
[[nodiscard]] std::vector<Vector> read_vectors(Data& data, int accessor, float fill = 0.0F);

/// "/accessors/3"
[[nodiscard]] std::string accessor_pointer(int accessor);

[[nodiscard]] const tinygltf::Accessor& accessor_of(const Data& data, int accessor);

/// Components an element: 1 for SCALAR, 16 for MAT4.
[[nodiscard]] int component_count(const tinygltf::Accessor& accessor);

/// Checks every accessor of the file against its view, whether something uses it or not.
void check_accessors(const Data& data);

} // namespace estampe::gltf
