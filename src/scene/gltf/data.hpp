// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>

#include "scene/gltf/document.hpp"

namespace estampe::gltf {

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
