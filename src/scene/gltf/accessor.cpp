// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>
#include <type_traits>

#include "scene/gltf/data.hpp"

namespace estampe::gltf {
namespace {

size_t component_bytes(int component_type)
{
    return static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(component_type)));
}

/// Elements in a buffer view. There are `count` elements, and each begins `stride` bytes after the one
/// before.
struct Elements {
    std::span<const std::byte> bytes;
    uint64_t count = 0;
    uint64_t stride = 0;
    int component_type = 0;
    int components = 0;
    bool normalized = false;
};

Elements checked(const Data& data, const Elements& wanted, int view, uint64_t offset,
                 const std::string& pointer)
{
    Elements elements = wanted;
    const uint64_t element_bytes =
        component_bytes(elements.component_type) * static_cast<uint64_t>(elements.components);
    elements.stride = elements.stride == 0 ? element_bytes : elements.stride;
    const auto bytes = data.view(view);
    if (elements.stride < element_bytes) {
        data.fail(fmt::format("/bufferViews/{}/byteStride", view),
                  fmt::format("{} bytes are less than an element's {}", elements.stride, element_bytes));
    }
    const uint64_t needed = offset + (elements.count - 1) * elements.stride + element_bytes;
    if (needed > bytes.size()) {
        data.fail(pointer, fmt::format("{} elements need {} bytes, buffer view {} has {}", elements.count,
                                       needed, view, bytes.size()));
    }
    elements.bytes = bytes.subspan(offset);
    return elements;
}

uint64_t stride_of(const Data& data, int view)
{
    const tinygltf::BufferView& source = data.model().bufferViews[static_cast<size_t>(view)];
    const auto compression = source.extensions.find("EXT_meshopt_compression");
    if (compression != source.extensions.end()) {
        return static_cast<uint64_t>(compression->second.Get("byteStride").GetNumberAsInt());
    }
    return source.byteStride;
}

Elements elements_of(const Data& data, int index)
{
    const tinygltf::Accessor& accessor = accessor_of(data, index);
    return checked(data,
                   {.bytes = {},
                    .count = accessor.count,
                    .stride = stride_of(data, accessor.bufferView),
                    .component_type = accessor.componentType,
                    .components = component_count(accessor),
                    .normalized = accessor.normalized},
                   accessor.bufferView, accessor.byteOffset, accessor_pointer(index) + "/count");
}

struct SparseElements {
    Elements indices;
    Elements values;
};

SparseElements sparse_of(const Data& data, int index)
{
    const tinygltf::Accessor& accessor = accessor_of(data, index);
    const auto& sparse = accessor.sparse;
    const std::string pointer = accessor_pointer(index) + "/sparse";
    const auto count = static_cast<uint64_t>(sparse.count);
    if (count > accessor.count) {
        data.fail(pointer + "/count",
                  fmt::format("{} is more than the accessor's {}", count, accessor.count));
    }
    return {
        .indices = checked(
            data,
            {.bytes = {}, .count = count, .component_type = sparse.indices.componentType, .components = 1},
            sparse.indices.bufferView, static_cast<uint64_t>(sparse.indices.byteOffset),
            pointer + "/indices"),
        .values = checked(data,
                          {.bytes = {},
                           .count = count,
                           .component_type = accessor.componentType,
                           .components = component_count(accessor),
                           .normalized = accessor.normalized},
                          sparse.values.bufferView, static_cast<uint64_t>(sparse.values.byteOffset),
                          pointer + "/values")};
}

template <typename Source, typename Target>
Target convert(Source value, bool normalized)
{
    if constexpr (std::is_floating_point_v<Target> && !std::is_floating_point_v<Source>) {
        if (normalized) {
            const auto scaled =
                static_cast<Target>(value) / static_cast<Target>(std::numeric_limits<Source>::max());
            return std::max(scaled, Target{-1});
        }
    }
    return static_cast<Target>(value);
}

/// Copies row `from` of `source` to `target`, and converts the type of each component.
template <typename Source, typename Target>
void copy_row(const Elements& source, uint64_t from, Target* target, int components)
{
    for (int c = 0; c < components; ++c) {
        Source value{};
        std::memcpy(&value,
                    source.bytes.data() + from * source.stride + sizeof(Source) * static_cast<size_t>(c),
                    sizeof value);
        target[c] = convert<Source, Target>(value, source.normalized);
    }
}

template <typename Target>
using CopyRow = void (*)(const Elements&, uint64_t, Target*, int);

template <typename Target>
CopyRow<Target> row_copier(int component_type)
{
    switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return copy_row<int8_t, Target>;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return copy_row<uint8_t, Target>;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return copy_row<int16_t, Target>;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return copy_row<uint16_t, Target>;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return copy_row<uint32_t, Target>;
    default:
        if constexpr (std::is_floating_point_v<Target>) {
            return copy_row<float, Target>;
        }
        return nullptr;
    }
}

template <typename Target>
std::vector<Target> read_rows(Data& data, int index, int components, Target fill)
{
    const tinygltf::Accessor& accessor = accessor_of(data, index);
    const std::string pointer = accessor_pointer(index);
    const auto row = static_cast<uint64_t>(components);
    data.spend(accessor.count * row * sizeof(Target), pointer + "/count");
    const int copied = std::min(components, component_count(accessor));
    const CopyRow<Target> copy = row_copier<Target>(accessor.componentType);
    if (copy == nullptr) {
        data.fail(pointer + "/componentType", "should be an integer type");
    }
    const Target initial = accessor.bufferView < 0 ? Target{0} : fill;
    std::vector<Target> rows(accessor.count * row, initial);
    if (accessor.bufferView >= 0) {
        const Elements source = elements_of(data, index);
        for (uint64_t i = 0; i < source.count; ++i) {
            copy(source, i, rows.data() + i * row, copied);
        }
    }
    if (accessor.sparse.isSparse) {
        const SparseElements sparse = sparse_of(data, index);
        const CopyRow<uint32_t> copy_index = row_copier<uint32_t>(sparse.indices.component_type);
        for (uint64_t i = 0; i < sparse.indices.count; ++i) {
            uint32_t at = 0;
            copy_index(sparse.indices, i, &at, 1);
            if (at >= accessor.count) {
                data.fail(pointer + "/sparse/indices",
                          fmt::format("index {} is past the accessor's {} elements", at, accessor.count));
            }
            copy(sparse.values, i, rows.data() + at * row, copied);
        }
    }
    return rows;
}

} // namespace

std::string accessor_pointer(int accessor)
{
    return fmt::format("/accessors/{}", accessor);
}

const tinygltf::Accessor& accessor_of(const Data& data, int accessor)
{
    return data.model().accessors[static_cast<size_t>(accessor)];
}

int component_count(const tinygltf::Accessor& accessor)
{
    return tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
}

void check_accessors(const Data& data)
{
    for (int i = 0; i < static_cast<int>(data.model().accessors.size()); ++i) {
        const tinygltf::Accessor& accessor = accessor_of(data, i);
        if (accessor.bufferView >= 0) {
            [[maybe_unused]] const Elements elements = elements_of(data, i);
        }
        if (accessor.sparse.isSparse) {
            [[maybe_unused]] const SparseElements sparse = sparse_of(data, i);
        }
    }
}

std::vector<float> read_floats(Data& data, int accessor, int components, float fill)
{
    return read_rows<float>(data, accessor, components, fill);
}

std::vector<uint32_t> read_integers(Data& data, int accessor, int components)
{
    return read_rows<uint32_t>(data, accessor, components, 0);
}

template <typename Vector>
std::vector<Vector> read_vectors(Data& data, int accessor, float fill)
{
    constexpr int components = sizeof(Vector) / sizeof(float);
    const std::vector<float> floats = read_floats(data, accessor, components, fill);
    std::vector<Vector> vectors(floats.size() / components);
    std::memcpy(static_cast<void*>(vectors.data()), floats.data(), floats.size() * sizeof(float));
    return vectors;
}

template std::vector<glm::vec2> read_vectors<glm::vec2>(Data&, int, float);
template std::vector<glm::vec3> read_vectors<glm::vec3>(Data&, int, float);
template std::vector<glm::vec4> read_vectors<glm::vec4>(Data&, int, float);
template std::vector<glm::mat4> read_vectors<glm::mat4>(Data&, int, float);

} // namespace estampe::gltf
