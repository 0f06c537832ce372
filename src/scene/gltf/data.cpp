// SPDX-License-Identifier: MIT
#include "scene/gltf/data.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/free_memory.hpp"
#include "core/read_scope.hpp"

namespace estampe::gltf {
namespace {

/// Parameters of EXT_meshopt_compression for a buffer view.
struct MeshoptLayout {
    uint64_t count = 0;
    uint64_t stride = 0;
    std::string mode;   ///< mode of the compression: ATTRIBUTES, TRIANGLES or INDICES
    std::string filter; ///< filter of the compression: NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

/// Throws Error for parameters that the decoders of meshoptimizer only check with assertions.
void check_layout(const MeshoptLayout& layout)
{
    bool good = false;
    if (layout.mode == "ATTRIBUTES") {
        good = layout.stride % 4 == 0 && layout.stride <= 256;
    } else {
        good = (layout.stride == 2 || layout.stride == 4) && layout.filter == "NONE" &&
               (layout.mode == "INDICES" || layout.count % 3 == 0);
    }
    if (layout.filter == "OCTAHEDRAL") {
        good = good && (layout.stride == 4 || layout.stride == 8);
    } else if (layout.filter == "QUATERNION") {
        good = good && layout.stride == 8;
    }
    if (!good) {
        throw Error(fmt::format("{} elements of {} bytes do not go with mode {} and filter {}", layout.count,
                                layout.stride, layout.mode, layout.filter));
    }
}

/// Decodes count * stride bytes with meshoptimizer. Throws Error without a place when the data is damaged or
/// does not match `layout`.
std::vector<std::byte> decode_meshopt(std::span<const std::byte> source, const MeshoptLayout& layout)
{
    check_layout(layout);
    std::vector<std::byte> decoded(layout.count * layout.stride);
    const auto* bytes = reinterpret_cast<const unsigned char*>(source.data());
    int failure = 0;
    if (layout.mode == "ATTRIBUTES") {
        failure =
            meshopt_decodeVertexBuffer(decoded.data(), layout.count, layout.stride, bytes, source.size());
    } else if (layout.mode == "TRIANGLES") {
        failure =
            meshopt_decodeIndexBuffer(decoded.data(), layout.count, layout.stride, bytes, source.size());
    } else {
        failure =
            meshopt_decodeIndexSequence(decoded.data(), layout.count, layout.stride, bytes, source.size());
    }
    if (failure != 0) {
        throw Error("the compressed data is damaged", {}, "fetch or export the file again");
    }
    if (layout.filter == "OCTAHEDRAL") {
        meshopt_decodeFilterOct(decoded.data(), layout.count, layout.stride);
    } else if (layout.filter == "QUATERNION") {
        meshopt_decodeFilterQuat(decoded.data(), layout.count, layout.stride);
    } else if (layout.filter == "EXPONENTIAL") {
        meshopt_decodeFilterExp(decoded.data(), layout.count, layout.stride);
    }
    return decoded;
}

constexpr uint64_t budget_base_bytes = uint64_t{64} << 20;
constexpr uint64_t budget_factor = 256;
constexpr auto meshopt_extension = "EXT_meshopt_compression";

const tinygltf::Value* compression_of(const tinygltf::BufferView& view)
{
    const auto found = view.extensions.find(meshopt_extension);
    return found == view.extensions.end() ? nullptr : &found->second;
}

/// Returns whether a buffer may have no bytes. A buffer without bytes is allowed if it is a fallback buffer,
/// to which only compressed views refer. Only programs without the compression extension read a fallback
/// buffer's bytes.
bool is_fallback(const tinygltf::Model& model, size_t buffer)
{
    for (const tinygltf::BufferView& view : model.bufferViews) {
        if (view.buffer == static_cast<int>(buffer) && compression_of(view) == nullptr) {
            return false;
        }
    }
    return !model.bufferViews.empty();
}

uint64_t unsigned_of(const tinygltf::Value& object, const std::string& key)
{
    return object.Has(key) ? static_cast<uint64_t>(object.Get(key).GetNumberAsDouble()) : 0;
}

} // namespace

Data::Data(Document document, const Container& container, std::string file,
           std::optional<std::filesystem::path> folder, ReadScope scope)
    : document_(std::move(document)), file_(std::move(file)), folder_(std::move(folder)),
      scope_(std::move(scope))
{
    load_buffers(container);
    views_.resize(model().bufferViews.size());
    for (size_t i = 0; i < views_.size(); ++i) {
        open_view(i);
    }
}

void Data::load_buffers(const Container& container)
{
    // For each file: index of its buffer with the largest declared length. Each file is read only once, up to
    // its largest declared length.
    std::map<std::string_view, size_t> longest;
    for (size_t i = 0; i < document_.buffers.size(); ++i) {
        const BufferSource& source = document_.buffers[i];
        if (!source.uri.empty()) {
            const auto entry = longest.try_emplace(source.uri, i).first;
            const bool is_longer = source.byte_length > document_.buffers[entry->second].byte_length;
            entry->second = is_longer ? i : entry->second;
        }
    }
    uint64_t input_bytes = container.json.size() + (container.binary ? container.binary->size() : 0);
    std::map<std::string_view, std::span<const std::byte>> bytes_of;
    for (const auto& [uri, index] : longest) {
        bytes_of[uri] = named_bytes(index);
        input_bytes += bytes_of[uri].size();
        warn_of_excess(index, bytes_of[uri].size());
    }
    buffers_.resize(document_.buffers.size());
    for (size_t i = 0; i < buffers_.size(); ++i) {
        const BufferSource& source = document_.buffers[i];
        const auto named = bytes_of.find(source.uri);
        const bool is_named = named != bytes_of.end();
        if (!is_named && !(i == 0 && container.binary)) {
            check_is_fallback(i, container);
            continue;
        }
        const auto bytes = is_named ? named->second : *container.binary;
        if (bytes.size() < source.byte_length) {
            fail(fmt::format("/buffers/{}/byteLength", i),
                 fmt::format("promises {} bytes, there are {}", source.byte_length, bytes.size()),
                 "the data is truncated: fetch or export it again");
        }
        buffers_[i] = bytes.first(source.byte_length);
    }
    budget_bytes_ = budget_base_bytes + budget_factor * input_bytes;
}

std::span<const std::byte> Data::named_bytes(size_t index)
{
    const BufferSource& source = document_.buffers[index];
    try {
        return owned_.emplace_back(is_data_uri(source.uri)
                                       ? resource(source.uri)
                                       : read_file_start(file_of(source.uri), source.byte_length, scope_));
    } catch (const Error& error) {
        fail(fmt::format("/buffers/{}/uri", index), error.what());
    }
}

void Data::warn_of_excess(size_t index, uint64_t read_bytes)
{
    const BufferSource& source = document_.buffers[index];
    std::error_code failed;
    const uint64_t there =
        is_data_uri(source.uri) ? read_bytes : std::filesystem::file_size(file_of(source.uri), failed);
    constexpr uint64_t most_padding = 3;
    if (!failed && there > source.byte_length + most_padding) {
        warn(fmt::format("/buffers/{}/byteLength", index),
             fmt::format("the buffer has {} bytes, and there are {}; if bytes were added by mistake, the "
                         "meshes are damaged",
                         source.byte_length, there));
    }
}

void Data::check_is_fallback(size_t index, const Container& container) const
{
    if (!is_fallback(model(), index)) {
        fail(fmt::format("/buffers/{}", index),
             container.is_binary ? "has no uri, and the glb has no binary chunk" : "has no uri",
             "fetch or export the file again");
    }
}

std::string Data::resource_name(const std::string& uri) const
{
    if (is_data_uri(uri)) {
        return "embedded data";
    }
    return decode_relative_uri(uri).value_or(uri.substr(0, 200));
}

std::vector<std::byte> Data::resource(const std::string& uri) const
{
    if (is_data_uri(uri)) {
        auto bytes = decode_data_uri(uri);
        if (!bytes) {
            throw Error("is not valid base64", resource_name(uri), "export the file again");
        }
        return std::move(*bytes);
    }
    constexpr uint64_t max_resource_bytes = uint64_t{1} << 31;
    return read_file(file_of(uri), max_resource_bytes, scope_);
}

std::filesystem::path Data::file_of(const std::string& uri) const
{
    const auto relative = decode_relative_uri(uri);
    if (scope_.is_limited() && (!relative || leads_upwards(*relative))) {
        fail_outside(resource_name(uri), scope_, resource_name(uri));
    }
    if (!relative) {
        throw Error("is not a relative path", resource_name(uri), "put the file beside the glTF");
    }
    if (!folder_) {
        throw Error("cannot be read: the glTF came from memory", resource_name(uri));
    }
    return *folder_ / *relative;
}

std::vector<std::filesystem::path> Data::named_files() const
{
    std::vector<std::string> uris = other_uris_;
    std::ranges::transform(document_.buffers, std::back_inserter(uris), &BufferSource::uri);
    std::ranges::transform(document_.images, std::back_inserter(uris), &ImageSource::uri);
    std::vector<std::filesystem::path> files;
    for (const std::string& uri : uris) {
        const auto relative = uri.empty() || is_data_uri(uri) ? std::nullopt : decode_relative_uri(uri);
        std::error_code problem;
        if (folder_ && relative && std::filesystem::is_regular_file(*folder_ / *relative, problem)) {
            files.push_back(*folder_ / *relative);
        }
    }
    std::ranges::sort(files);
    files.erase(std::unique(files.begin(), files.end()), files.end());
    return files;
}

void Data::warn(const std::string& pointer, const std::string& what)
{
    constexpr size_t max_warnings = 100;
    std::string line = Error(what, place(pointer)).what();
    if (std::ranges::find(warnings_, line) != warnings_.end()) {
        return;
    }
    if (++warning_count_ <= max_warnings) {
        warnings_.push_back(std::move(line));
    }
}

std::vector<std::string> Data::take_warnings()
{
    if (warning_count_ > warnings_.size()) {
        warnings_.push_back(fmt::format("{}: {} more warnings", file_, warning_count_ - warnings_.size()));
    }
    return std::move(warnings_);
}

void Data::spend(uint64_t bytes, const std::string& pointer)
{
    if (bytes > budget_bytes_) {
        fail(pointer, fmt::format("asks for {} bytes, far more than a file of this size can hold", bytes));
    }
    budget_bytes_ -= bytes;
    require_memory(bytes, "this", place(pointer));
}

std::span<const std::byte> Data::slice(int buffer, uint64_t offset, uint64_t length,
                                       const std::string& pointer) const
{
    const auto bytes = buffers_[static_cast<size_t>(buffer)];
    if (offset > bytes.size() || length > bytes.size() - offset) {
        fail(pointer, fmt::format("bytes {} to {} are past the end of buffer {}, which has {}", offset,
                                  offset + length, buffer, bytes.size()));
    }
    return bytes.subspan(offset, length);
}

void Data::open_view(size_t index)
{
    const tinygltf::BufferView& view = model().bufferViews[index];
    if (const tinygltf::Value* compression = compression_of(view)) {
        decompress_view(index, *compression);
        return;
    }
    views_[index] = slice(view.buffer, view.byteOffset, view.byteLength,
                          fmt::format("/bufferViews/{}/byteLength", index));
}

void Data::decompress_view(size_t index, const tinygltf::Value& compression)
{
    const std::string pointer = fmt::format("/bufferViews/{}/extensions/{}", index, meshopt_extension);
    const auto source =
        slice(compression.Get("buffer").GetNumberAsInt(), unsigned_of(compression, "byteOffset"),
              unsigned_of(compression, "byteLength"), pointer + "/byteLength");
    const MeshoptLayout layout{
        .count = unsigned_of(compression, "count"),
        .stride = unsigned_of(compression, "byteStride"),
        .mode = compression.Get("mode").Get<std::string>(),
        .filter = compression.Has("filter") ? compression.Get("filter").Get<std::string>() : "NONE",
    };
    const uint64_t length = model().bufferViews[index].byteLength;
    if (layout.count * layout.stride < length) {
        fail(pointer + "/count", fmt::format("{} elements of {} bytes do not fill the view's {}",
                                             layout.count, layout.stride, length));
    }
    spend(layout.count * layout.stride, pointer + "/count");
    try {
        owned_.push_back(decode_meshopt(source, layout));
    } catch (const Error& error) {
        fail(pointer, error.what());
    }
    views_[index] = std::span<const std::byte>(owned_.back()).first(length);
}

} // namespace estampe::gltf
