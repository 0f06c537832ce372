// SPDX-License-Identifier: MIT
#include "scene/gltf/data.hpp"

#include <utility>

#include "core/file.hpp"
#include "core/free_memory.hpp"
#include "scene/gltf/meshopt.hpp"
#include "scene/gltf/uri.hpp"

namespace estampe::gltf {
namespace {

constexpr uint64_t budget_base_bytes = uint64_t{64} << 20;
constexpr uint64_t budget_factor = 256;
constexpr auto meshopt_extension = "EXT_meshopt_compression";

const tinygltf::Value* compression_of(const tinygltf::BufferView& view)
{
    const auto found = view.extensions.find(meshopt_extension);
    return found == view.extensions.end() ? nullptr : &found->second;
}

/// A buffer that only compressed views name may have no bytes: it is the fallback for readers without the
/// extension.
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
           std::optional<std::filesystem::path> folder)
    : document_(std::move(document)), file_(std::move(file)), folder_(std::move(folder))
{
    uint64_t input_bytes = container.json.size() + (container.binary ? container.binary->size() : 0);
    buffers_.resize(document_.buffers.size());
    for (size_t i = 0; i < buffers_.size(); ++i) {
        load_buffer(i, container);
        input_bytes += document_.buffers[i].uri.empty() ? 0 : buffers_[i].size();
    }
    budget_bytes_ = budget_base_bytes + budget_factor * input_bytes;
    views_.resize(model().bufferViews.size());
    for (size_t i = 0; i < views_.size(); ++i) {
        open_view(i);
    }
}

void Data::load_buffer(size_t index, const Container& container)
{
    const BufferSource& source = document_.buffers[index];
    const std::string pointer = fmt::format("/buffers/{}", index);
    std::span<const std::byte> bytes;
    if (!source.uri.empty()) {
        try {
            bytes = owned_.emplace_back(resource(source.uri));
        } catch (const Error& error) {
            fail(pointer + "/uri", error.what());
        }
    } else if (index == 0 && container.binary) {
        bytes = *container.binary;
    } else if (is_fallback(model(), index)) {
        return;
    } else {
        fail(pointer, container.is_binary ? "has no uri, and the glb has no binary chunk" : "has no uri",
             "fetch or export the file again");
    }
    if (bytes.size() < source.byte_length) {
        fail(pointer + "/byteLength",
             fmt::format("promises {} bytes, there are {}", source.byte_length, bytes.size()),
             "the data is truncated: fetch or export it again");
    }
    buffers_[index] = bytes.first(source.byte_length);
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
    const std::string name = resource_name(uri);
    if (is_data_uri(uri)) {
        auto bytes = decode_data_uri(uri);
        if (!bytes) {
            throw Error("is not valid base64", name, "export the file again");
        }
        return std::move(*bytes);
    }
    const auto relative = decode_relative_uri(uri);
    if (!relative) {
        throw Error("is not a relative path", name, "put the file beside the glTF");
    }
    if (!folder_) {
        throw Error("cannot be read: the glTF came from memory", name);
    }
    constexpr uint64_t max_resource_bytes = uint64_t{1} << 33;
    return read_file(*folder_ / *relative, max_resource_bytes);
}

void Data::warn(const std::string& pointer, const std::string& what)
{
    constexpr size_t max_warnings = 100;
    if (++warning_count_ > max_warnings) {
        return;
    }
    warnings_.emplace_back(Error(what, place(pointer)).what());
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
