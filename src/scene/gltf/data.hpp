// SPDX-License-Identifier: MIT
#pragma once

// A glTF file before its conversion to a scene: the container, the JSON document, and bounds-checked access
// to the binary data.

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
#include <estampe/read_scope.hpp>
#include <estampe/scene.hpp>

namespace estampe::gltf {

/// The two parts of a glTF file: the JSON text, and the binary chunk, which only .glb files have.
struct Container {
    std::string_view json;
    std::optional<std::span<const std::byte>> binary;
    bool is_binary = false;
    size_t json_offset = 0; ///< byte offset of the JSON text in the file
};

/// Reads a glTF file, up to the length that its header declares. Checks the first bytes before it reads the
/// rest, so that a large file of another type is rejected at once. Throws Error as open_container() does.
[[nodiscard]] std::vector<std::byte> read_gltf_bytes(const std::filesystem::path& path,
                                                     const ReadScope& scope = {});

/// Finds the JSON text and the binary chunk of a glTF file. The result points into `bytes`; nothing is
/// copied. Throws Error with a byte offset when the file is empty, truncated, of another version or not glTF.
/// JSON that is nested deeper than 256 levels is also an error.
[[nodiscard]] Container open_container(std::span<const std::byte> bytes, const std::string& file);

[[nodiscard]] bool is_data_uri(std::string_view uri);

/// Decodes a URI of the form "data:...;base64,...". Returns nothing when the URI is not base64 or is damaged.
[[nodiscard]] std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri);

/// Percent-decodes the file name in a relative URI. Returns nothing for an absolute path, another scheme, or
/// a name with a zero byte.
[[nodiscard]] std::optional<std::string> decode_relative_uri(std::string_view uri);

/// Location of a buffer's bytes. The location is stored outside of tinygltf's model, because tinygltf would
/// read the buffers itself.
struct BufferSource {
    std::string uri; ///< URI of the buffer; empty for the binary chunk, or for an unused fallback buffer
    uint64_t byte_length = 0;
};

/// Location of an image: a data URI, a relative path, or a buffer view.
struct ImageSource {
    std::string name;
    std::string uri;
    int view = -1;
};

struct Document {
    /// The file as tinygltf parsed it, without buffers, images, and the indices of primitives.
    tinygltf::Model model;
    std::vector<BufferSource> buffers;
    std::vector<ImageSource> images;

    /// The index accessor of each primitive of each mesh; -1 for a primitive without indices. The accessors
    /// are stored here because tinygltf rejects index accessors without a buffer view, which glTF allows.
    std::vector<std::vector<int>> indices;

    /// Names of the material variants (KHR_materials_variants). The names are stored here because tinygltf
    /// leaves out variants without a name.
    std::vector<std::string> variants;
};

/// Parses and checks the JSON of a glTF file. In the result every index is inside its array and every number
/// is in range. Throws Error with a JSON pointer, a line and column, or a byte offset.
[[nodiscard]] Document read_document(const Container& container, const std::string& file);

/// Checks the parsed JSON of a glTF file: every property that the importer reads has the right type and
/// range, required properties exist, and every index is inside its array. Converts numbers with a zero
/// fraction to integers where an integer is expected.
///
/// Throws Error with `file#/json/pointer`. After this check, reading a property can neither fail nor
/// overflow.
void check_document(nlohmann::json& document, const std::string& file);

/// Key in the `extras` of a glTF object. The value of the key holds the settings that only Estampe reads.
inline constexpr const char* our_key = "estampe";

/// A glTF file during its import: the parsed document and bounds-checked access to its bytes.
///
/// Every read uses up a part of a memory budget, which is a few hundred times the size of the files. A small
/// file can therefore not create a huge scene. All members throw Error with `file#/json/pointer`.
class Data {
public:
    /// Reads every buffer of the file. Without a `folder`, external files cannot be read. External files
    /// outside of `scope` are refused.
    Data(Document document, const Container& container, std::string file,
         std::optional<std::filesystem::path> folder, ReadScope scope = {});

    [[nodiscard]] const tinygltf::Model& model() const { return document_.model; }

    [[nodiscard]] const std::vector<ImageSource>& images() const { return document_.images; }

    [[nodiscard]] const std::vector<std::vector<int>>& indices() const { return document_.indices; }

    [[nodiscard]] const std::vector<std::string>& variants() const { return document_.variants; }

    [[nodiscard]] const std::string& file() const { return file_; }

    /// Returns the bytes of a buffer view, decompressed.
    [[nodiscard]] std::span<const std::byte> view(int index) const
    {
        return views_[static_cast<size_t>(index)];
    }

    /// Returns the bytes of a data URI, or of an external file whose path is relative to the document. Throws
    /// Error with the name of the resource as its place, OutsideScope for a file outside of the scope.
    [[nodiscard]] std::vector<std::byte> resource(const std::string& uri) const;
    [[nodiscard]] std::string resource_name(const std::string& uri) const;

    /// Adds a URI outside of `buffers` and `images` to the named files.
    void add_named(const std::string& uri) { other_uris_.push_back(uri); }

    /// Returns the files that the glTF names and that exist, each once.
    [[nodiscard]] std::vector<std::filesystem::path> named_files() const;

    /// Subtracts `bytes` from the memory budget of this import. Throws Error when the budget is used up.
    void spend(uint64_t bytes, const std::string& pointer);

    /// Adds a line about a repair to the warnings. Equal lines are stored only once.
    void warn(const std::string& pointer, const std::string& what);

    [[nodiscard]] std::string place(const std::string& pointer) const { return file_ + "#" + pointer; }

    [[noreturn]] void fail(const std::string& pointer, const std::string& what,
                           const std::string& remedy = {}) const
    {
        throw Error(what, place(pointer), remedy);
    }

    /// Returns the warnings: at most a hundred lines, and one more line that counts the rest.
    [[nodiscard]] std::vector<std::string> take_warnings();

private:
    void load_buffers(const Container& container);
    [[nodiscard]] std::span<const std::byte> named_bytes(size_t index);
    /// Warns if a buffer's file or data uri is longer than the buffer. `read_bytes` is what was read of it.
    void warn_of_excess(size_t index, uint64_t read_bytes);
    void check_is_fallback(size_t index, const Container& container) const;
    [[nodiscard]] std::filesystem::path file_of(const std::string& uri) const;
    void open_view(size_t index);
    void decompress_view(size_t index, const tinygltf::Value& compression);
    [[nodiscard]] std::span<const std::byte> slice(int buffer, uint64_t offset, uint64_t length,
                                                   const std::string& pointer) const;

    Document document_;
    std::string file_;
    std::optional<std::filesystem::path> folder_;
    ReadScope scope_;
    std::vector<std::vector<std::byte>> owned_;
    std::vector<std::span<const std::byte>> buffers_;
    std::vector<std::span<const std::byte>> views_;
    uint64_t budget_bytes_ = 0;
    std::vector<std::string> other_uris_; ///< URIs of files outside of the document's buffers and images
    std::vector<std::string> warnings_;
    size_t warning_count_ = 0;
};

/// Reads the elements of an accessor as floats, `components` per element. Normalised integers become -1..1 or
/// 0..1. Other integers keep their value. Sparse entries are applied. Components that the file does not have
/// get the value `fill`.
[[nodiscard]] std::vector<float> read_floats(Data& data, int accessor, int components, float fill = 0.0F);

/// Reads the elements of an accessor as integers, such as vertex indices and joints.
[[nodiscard]] std::vector<uint32_t> read_integers(Data& data, int accessor, int components);

/// Reads the elements of an accessor as GLM vectors or matrices of floats; see read_floats().
template <typename Vector>
[[nodiscard]] std::vector<Vector> read_vectors(Data& data, int accessor, float fill = 0.0F);

/// Returns the JSON pointer of an accessor, such as "/accessors/3".
[[nodiscard]] std::string accessor_pointer(int accessor);

[[nodiscard]] const tinygltf::Accessor& accessor_of(const Data& data, int accessor);

/// Returns the number of components per element of an accessor: 1 for SCALAR, 16 for MAT4.
[[nodiscard]] int component_count(const tinygltf::Accessor& accessor);

/// Checks that every accessor of the file, used or unused, fits into its buffer view.
void check_accessors(const Data& data);

} // namespace estampe::gltf
