// SPDX-License-Identifier: MIT
#include "scene/gltf/convert.hpp"

#include <algorithm>
#include <memory>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop

namespace estampe::gltf {
namespace {

constexpr auto draco_extension = "KHR_draco_mesh_compression";

float largest(draco::DataType type)
{
    switch (type) {
    case draco::DT_INT8:
        return 127.0F;
    case draco::DT_UINT8:
        return 255.0F;
    case draco::DT_INT16:
        return 32767.0F;
    case draco::DT_UINT16:
        return 65535.0F;
    default:
        return 1.0F;
    }
}

std::vector<float> floats_of(const draco::PointAttribute& attribute, uint32_t points, int components,
                             bool normalized)
{
    std::vector<float> values(size_t{points} * static_cast<size_t>(components));
    const bool scaled = normalized && !attribute.normalized();
    const float divisor = scaled ? largest(attribute.data_type()) : 1.0F;
    for (uint32_t point = 0; point < points; ++point) {
        float* row = values.data() + size_t{point} * static_cast<size_t>(components);
        const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(point));
        if (index.value() >= attribute.size() ||
            !attribute.ConvertValue<float>(index, static_cast<int8_t>(components), row)) {
            return {};
        }
        for (int c = 0; scaled && c < components; ++c) {
            row[c] = std::max(row[c] / divisor, -1.0F);
        }
    }
    return values;
}

std::unique_ptr<draco::Mesh> decode_stream(Data& data, std::span<const std::byte> bytes,
                                           const std::string& pointer)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        data.fail(pointer, fmt::format("the Draco data is damaged: {}", decoded.status().error_msg_string()),
                  "fetch or export the file again");
    }
    return std::move(decoded).value();
}

} // namespace

std::optional<DracoMesh> decode_draco(Data& data, const tinygltf::Primitive& source,
                                      const std::string& pointer)
{
    const auto found = source.extensions.find(draco_extension);
    if (found == source.extensions.end()) {
        return std::nullopt;
    }
    const std::string here = pointer + "/extensions/" + draco_extension;
    if (source.mode >= 0 && source.mode != TINYGLTF_MODE_TRIANGLES &&
        source.mode != TINYGLTF_MODE_TRIANGLE_STRIP) {
        data.fail(pointer + "/mode", "Draco holds triangles only");
    }
    const auto bytes = data.view(found->second.Get("bufferView").GetNumberAsInt());
    const std::unique_ptr<draco::Mesh> mesh = decode_stream(data, bytes, here);
    DracoMesh result;
    const tinygltf::Value& attributes = found->second.Get("attributes");
    for (const std::string& name : attributes.Keys()) {
        std::string at = here;
        at.append("/attributes/").append(name);
        const auto accessor_index = source.attributes.find(name);
        if (accessor_index == source.attributes.end()) {
            data.fail(at, "is not among the primitive's attributes");
        }
        const tinygltf::Accessor& accessor = accessor_of(data, accessor_index->second);
        const tinygltf::Value& id = attributes.Get(name);
        const draco::PointAttribute* attribute =
            id.IsInt() && id.GetNumberAsInt() >= 0
                ? mesh->GetAttributeByUniqueId(static_cast<uint32_t>(id.GetNumberAsInt()))
                : nullptr;
        if (attribute == nullptr) {
            data.fail(at, "names no attribute of the Draco data");
        }
        if (mesh->num_points() != accessor.count) {
            data.fail(at, fmt::format("the Draco data has {} points, the accessor {}", mesh->num_points(),
                                      accessor.count));
        }
        data.spend(accessor.count * static_cast<uint64_t>(component_count(accessor)) * sizeof(float), at);
        auto& values = result.attributes[name];
        values = floats_of(*attribute, mesh->num_points(), component_count(accessor), accessor.normalized);
        if (values.empty()) {
            data.fail(at, "the Draco data is damaged", "fetch or export the file again");
        }
    }
    data.spend(uint64_t{mesh->num_faces()} * 3 * sizeof(uint32_t), here);
    result.indices.reserve(size_t{mesh->num_faces()} * 3);
    for (uint32_t face = 0; face < mesh->num_faces(); ++face) {
        for (const draco::PointIndex& point : mesh->face(draco::FaceIndex(face))) {
            result.indices.push_back(point.value());
        }
    }
    return result;
}

} // namespace estampe::gltf
