// SPDX-License-Identifier: MIT
#include "scene/assimp/transfer.hpp"

#include <cstring>
#include <type_traits>

#include <estampe/error.hpp>

namespace estampe {
namespace {

/// Writes or reads values in sequence. The functions `exchange` below define the same order for both
/// directions.
class Packer {
public:
    static constexpr bool reading = false;

    void raw(const void* data, size_t size)
    {
        const auto* first = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), first, first + size);
    }

    size_t count(size_t size, size_t)
    {
        const uint64_t value = size;
        raw(&value, sizeof(value));
        return size;
    }

    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

private:
    std::vector<std::byte> bytes_;
};

class Unpacker {
public:
    static constexpr bool reading = true;

    Unpacker(std::span<const std::byte> bytes, const std::string& where) : bytes_(bytes), where_(where) {}

    void raw(void* data, size_t size)
    {
        if (size > bytes_.size())
            damaged();
        if (size > 0)
            std::memcpy(data, bytes_.data(), size);
        bytes_ = bytes_.subspan(size);
    }

    size_t count(size_t, size_t least_bytes_each)
    {
        uint64_t value = 0;
        raw(&value, sizeof(value));
        if (value > bytes_.size() / least_bytes_each)
            damaged();
        return value;
    }

    [[noreturn]] void damaged() const { throw Error("what was read from it came back damaged", where_); }

private:
    std::span<const std::byte> bytes_;
    const std::string& where_;
};

template <typename Archive, typename Value>

requires(std::is_trivially_copyable_v<Value> && !std::is_enum_v<Value> &&
         !std::is_same_v<Value, bool>) void exchange(Archive& archive, Value& value)
{
    archive.raw(&value, sizeof(value));
}

template <typename Archive>
void exchange(Archive& archive, bool& value)
{
    auto byte = static_cast<uint8_t>(value ? 1 : 0);
    archive.raw(&byte, 1);
    value = byte != 0;
}

template <typename Archive, typename Enum>
requires std::is_enum_v<Enum>

void exchange_enum(Archive& archive, Enum& value, Enum last)
{
    auto number = static_cast<uint8_t>(value);
    archive.raw(&number, 1);
    if constexpr (Archive::reading)
        if (number > static_cast<uint8_t>(last))
            archive.damaged();
    value = static_cast<Enum>(number);
}

template <typename Archive>
void exchange(Archive& archive, std::string& text)
{
    text.resize(archive.count(text.size(), 1));
    archive.raw(text.data(), text.size());
}

template <typename Archive, typename Item>
void exchange(Archive& archive, std::vector<Item>& items)
{
    if constexpr (std::is_trivially_copyable_v<Item>) {
        items.resize(archive.count(items.size(), sizeof(Item)));
        archive.raw(items.data(), items.size() * sizeof(Item));
    } else {
        items.resize(archive.count(items.size(), 1));
        for (Item& item : items)
            exchange(archive, item);
    }
}

template <typename Archive>
void exchange(Archive& archive, ImageSource& source)
{
    exchange(archive, source.file);
    exchange(archive, source.bytes);
}

template <typename Archive>
void exchange(Archive& archive, Texture& texture)
{
    exchange(archive, texture.name);
    exchange(archive, texture.image.width);
    exchange(archive, texture.image.height);
    exchange(archive, texture.image.rgba);
    exchange_enum(archive, texture.wrap_u, Wrap::mirror);
    exchange_enum(archive, texture.wrap_v, Wrap::mirror);
}

template <typename Archive>
void exchange(Archive& archive, Material& material)
{
    exchange(archive, material.name);
    exchange(archive, material.base_color);
    exchange(archive, material.base_color_texture);
    exchange(archive, material.emissive);
    exchange(archive, material.metallic);
    exchange(archive, material.roughness);
    exchange_enum(archive, material.alpha_mode, AlphaMode::blend);
    exchange(archive, material.double_sided);
}

template <typename Archive>
void exchange(Archive& archive, MorphTarget& target)
{
    exchange(archive, target.position_offsets);
    exchange(archive, target.normal_offsets);
}

template <typename Archive>
void exchange(Archive& archive, Primitive& primitive)
{
    exchange_enum(archive, primitive.topology, Topology::triangles);
    exchange(archive, primitive.material);
    exchange(archive, primitive.positions);
    exchange(archive, primitive.normals);
    exchange(archive, primitive.uvs[0]);
    exchange(archive, primitive.uvs[1]);
    exchange(archive, primitive.colors);
    exchange(archive, primitive.joints_0);
    exchange(archive, primitive.joints_1);
    exchange(archive, primitive.weights_0);
    exchange(archive, primitive.weights_1);
    exchange(archive, primitive.indices);
    exchange(archive, primitive.morph_targets);
}

template <typename Archive>
void exchange(Archive& archive, Mesh& mesh)
{
    exchange(archive, mesh.name);
    exchange(archive, mesh.primitives);
    exchange(archive, mesh.morph_weights);
}

template <typename Archive>
void exchange(Archive& archive, Node& node)
{
    exchange(archive, node.name);
    exchange(archive, node.parent);
    exchange(archive, node.children);
    exchange(archive, node.transform.translation);
    exchange(archive, node.transform.rotation);
    exchange(archive, node.transform.scale);
    bool has_matrix = node.matrix.has_value();
    exchange(archive, has_matrix);
    if (has_matrix) {
        if (!node.matrix)
            node.matrix.emplace(1.0);
        exchange(archive, *node.matrix);
    }
    exchange(archive, node.mesh);
    exchange(archive, node.skin);
    exchange(archive, node.camera);
    exchange(archive, node.light);
    exchange(archive, node.visible);
}

template <typename Archive>
void exchange(Archive& archive, Skin& skin)
{
    exchange(archive, skin.name);
    exchange(archive, skin.joints);
    exchange(archive, skin.joint_from_bind);
}

template <typename Archive>
void exchange(Archive& archive, Light& light)
{
    exchange(archive, light.name);
    exchange_enum(archive, light.type, LightType::spot);
    exchange(archive, light.color);
    exchange(archive, light.intensity);
    exchange(archive, light.inner_cone_rad);
    exchange(archive, light.outer_cone_rad);
}

template <typename Archive>
void exchange(Archive& archive, SceneCamera& camera)
{
    exchange(archive, camera.name);
    exchange(archive, camera.orthographic);
    exchange(archive, camera.vertical_fov_rad);
    exchange(archive, camera.half_height_m);
    exchange(archive, camera.near_m);
}

template <typename Archive>
void exchange(Archive& archive, AnimationChannel& channel)
{
    exchange(archive, channel.node);
    exchange_enum(archive, channel.path, AnimatedPath::weights);
    exchange_enum(archive, channel.interpolation, Interpolation::cubic_spline);
    exchange(archive, channel.times_s);
    exchange(archive, channel.values);
}

template <typename Archive>
void exchange(Archive& archive, Animation& animation)
{
    exchange(archive, animation.name);
    exchange(archive, animation.channels);
    exchange(archive, animation.duration_s);
    exchange(archive, animation.start_s);
}

template <typename Archive>
void exchange(Archive& archive, std::optional<double>& value)
{
    bool has_value = value.has_value();
    exchange(archive, has_value);
    if (!has_value) {
        value.reset();
        return;
    }
    double number = value.value_or(0.0);
    exchange(archive, number);
    value = number;
}

template <typename Archive>
void exchange(Archive& archive, TransferScene& transfer)
{
    Scene& scene = transfer.scene;
    exchange(archive, scene.name);
    exchange(archive, scene.textures);
    exchange(archive, transfer.images);
    exchange(archive, scene.materials);
    exchange(archive, scene.meshes);
    exchange(archive, scene.nodes);
    exchange(archive, scene.roots);
    exchange(archive, scene.skins);
    exchange(archive, scene.lights);
    exchange(archive, scene.cameras);
    exchange(archive, scene.animations);
    exchange(archive, scene.frames_per_s);
    exchange(archive, scene.file_unit_m);
    exchange(archive, scene.warnings);
}

} // namespace

std::vector<std::byte> pack(const TransferScene& transfer)
{
    Packer packer;
    // The const_cast is safe, because `exchange` only reads the scene when its first argument is a Packer.
    // With an Unpacker, `exchange` writes the scene.
    exchange(packer, const_cast<TransferScene&>(transfer));
    return packer.take();
}

TransferScene unpack(std::span<const std::byte> bytes, const std::string& where)
{
    Unpacker unpacker(bytes, where);
    TransferScene transfer;
    exchange(unpacker, transfer);
    if (transfer.images.size() != transfer.scene.textures.size())
        unpacker.damaged();
    return transfer;
}

} // namespace estampe
