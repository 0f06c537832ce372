// SPDX-License-Identifier: MIT
#include <estampe/lightmap.hpp>

#include <algorithm>
#include <array>
#include <map>

#include <fmt/ranges.h>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "core/lightmap_file.hpp"
#include "core/srgb.hpp"
#include "scene/gltf/data.hpp"

namespace estampe {
namespace gltf {
namespace {

constexpr const char* map_key = "lightmap";
constexpr const char* extension_key = "MOZ_lightmap";

LightImage linear(const Image& image)
{
    const std::array<float, 256> table = linear_of_srgb_bytes<float>();
    LightImage light{.width = image.width, .height = image.height};
    light.texels.reserve(image.rgba.size() / 4);
    for (size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
        light.texels.emplace_back(table[image.rgba[i]], table[image.rgba[i + 1]], table[image.rgba[i + 2]]);
    }
    return light;
}

/// Gathers the maps that one file names, each of its pictures once.
class NamedMaps {
public:
    explicit NamedMaps(const Data& data) : data_(data) {}

    /// No map where the file names none.
    [[nodiscard]] std::optional<Lightmap> take()
    {
        const tinygltf::Model& model = data_.model();
        for (size_t i = 0; i < model.materials.size(); ++i) {
            map_.of_material.push_back(of_material(model.materials[i], fmt::format("/materials/{}", i)));
        }
        map_.of_node.resize(model.nodes.size());
        if (!model.scenes.empty()) {
            const auto shown = static_cast<size_t>(std::max(model.defaultScene, 0));
            const tinygltf::Scene& scene = model.scenes[std::min(shown, model.scenes.size() - 1)];
            scene_pointer_ = fmt::format("/scenes/{}", &scene - model.scenes.data());
            map_.of_scene = of_extras(scene.extras, scene_pointer_);
            lay_on_nodes(scene.nodes);
        }
        if (baked_ && !map_.pictures.empty()) {
            data_.fail(scene_pointer_, "names a baked lightmap, which is for the whole scene, beside others");
        }
        return baked_                  ? std::move(baked_)
               : map_.pictures.empty() ? std::nullopt
                                       : std::optional(std::move(map_));
    }

private:
    /// What a node says holds for those below it, unless they say otherwise.
    void lay_on_nodes(const std::vector<int>& roots)
    {
        std::vector<bool> seen(map_.of_node.size(), false);
        std::vector<size_t> open(roots.begin(), roots.end());
        while (!open.empty()) {
            const size_t node = open.back();
            open.pop_back();
            if (seen[node]) {
                continue;
            }
            seen[node] = true;
            const tinygltf::Node& source = data_.model().nodes[node];
            if (const auto own = of_extras(source.extras, fmt::format("/nodes/{}", node))) {
                map_.of_node[node] = own;
            }
            for (const int child : source.children) {
                map_.of_node[static_cast<size_t>(child)] = map_.of_node[node];
                open.push_back(static_cast<size_t>(child));
            }
        }
    }

    [[nodiscard]] std::optional<WornPicture> of_material(const tinygltf::Material& material,
                                                         const std::string& pointer)
    {
        if (const auto own = of_extras(material.extras, pointer)) {
            return own;
        }
        const auto found = material.extensions.find(extension_key);
        if (found == material.extensions.end()) {
            return std::nullopt;
        }
        static constexpr std::string_view keys[] = {"extensions", "extras", "index", "intensity", "texCoord"};
        return worn(found->second, pointer + "/extensions/" + extension_key, keys);
    }

    [[nodiscard]] std::optional<WornPicture> of_extras(const tinygltf::Value& extras,
                                                       const std::string& pointer)
    {
        if (!extras.IsObject() || !extras.Has(our_key) || !extras.Get(our_key).Has(map_key)) {
            return std::nullopt;
        }
        static constexpr std::string_view keys[] = {"intensity", "texCoord", "texture", "uri"};
        return worn(extras.Get(our_key).Get(map_key),
                    fmt::format("{}/extras/{}/{}", pointer, our_key, map_key), keys);
    }

    [[nodiscard]] std::optional<WornPicture> worn(const tinygltf::Value& value, const std::string& pointer,
                                                  std::span<const std::string_view> keys)
    {
        if (!value.IsObject()) {
            data_.fail(pointer, "should be an object");
        }
        for (const std::string& key : value.Keys()) {
            if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
                data_.fail(fmt::format("{}/{}", pointer, key), "is not known",
                           fmt::format("allowed: {}", fmt::join(keys, ", ")));
            }
        }
        WornPicture result;
        if (value.Has("texCoord")) {
            const tinygltf::Value& set = value.Get("texCoord");
            if (!set.IsInt() || set.GetNumberAsInt() < 0 || set.GetNumberAsInt() > 1) {
                data_.fail(pointer + "/texCoord", "should be 0 or 1: a mesh has two sets of UVs");
            }
            result.uv_set = static_cast<uint32_t>(set.GetNumberAsInt());
        }
        if (value.Has("intensity")) {
            const tinygltf::Value& factor = value.Get("intensity");
            const double number = factor.IsNumber() ? factor.GetNumberAsDouble() : -1.0;
            if (!(number >= 0.0 && number <= 1e6)) {
                data_.fail(pointer + "/intensity", "should be a number, 0 or more");
            }
            result.intensity = static_cast<float>(number);
        }
        const bool has_uri = value.Has("uri");
        const char* index_key = value.Has("index") ? "index" : "texture";
        if (has_uri == value.Has(index_key)) {
            data_.fail(pointer, has_uri ? "names a picture twice" : "names no picture",
                       R"(write for instance {"uri": "room.png"} or {"texture": 0})");
        }
        const auto picture = has_uri ? by_uri(value.Get("uri"), pointer)
                                     : by_texture(value.Get(index_key), pointer + "/" + index_key);
        result.picture = picture.value_or(0);
        return picture ? std::optional(result) : std::nullopt;
    }

    /// None when it is a baked map, which the scene alone may name.
    [[nodiscard]] std::optional<uint32_t> by_uri(const tinygltf::Value& uri, const std::string& pointer)
    {
        if (!uri.IsString()) {
            data_.fail(pointer + "/uri", "should be text");
        }
        const auto& text = uri.Get<std::string>();
        return read(text, pointer + "/uri", [&] { return data_.resource(text); });
    }

    [[nodiscard]] std::optional<uint32_t> by_texture(const tinygltf::Value& texture,
                                                     const std::string& pointer)
    {
        const auto& textures = data_.model().textures;
        const int index = texture.IsInt() ? texture.GetNumberAsInt() : -1;
        if (index < 0 || index >= static_cast<int>(textures.size())) {
            data_.fail(pointer, fmt::format("should be one of the file's {} textures", textures.size()));
        }
        const tinygltf::Texture& source = textures[static_cast<size_t>(index)];
        const auto webp = source.extensions.find("EXT_texture_webp");
        const int image =
            webp != source.extensions.end() ? webp->second.Get("source").GetNumberAsInt() : source.source;
        if (image < 0 || image >= static_cast<int>(data_.images().size())) {
            data_.fail(pointer, "has no image that can be read");
        }
        const ImageSource& from = data_.images()[static_cast<size_t>(image)];
        return read(fmt::format("image {}", image), pointer, [&] {
            if (from.view < 0) {
                return data_.resource(from.uri);
            }
            const auto bytes = data_.view(from.view);
            return std::vector<std::byte>(bytes.begin(), bytes.end());
        });
    }

    template <class Bytes>
    [[nodiscard]] std::optional<uint32_t> read(const std::string& name, const std::string& pointer,
                                               const Bytes& bytes_of)
    {
        const auto [entry, is_new] = numbers_.try_emplace(name, static_cast<uint32_t>(map_.pictures.size()));
        if (!is_new) {
            return entry->second;
        }
        try {
            const std::vector<std::byte> bytes = bytes_of();
            if (!is_exr(bytes)) {
                map_.pictures.push_back(linear(decode_image(bytes, "")));
                return entry->second;
            }
            ExrFile file = decode_exr(bytes, "");
            if (!is_baked(file) || pointer.find(scene_pointer_ + "/") != 0 || scene_pointer_.empty()) {
                map_.pictures.push_back(std::move(file.image));
                return entry->second;
            }
            baked_ = baked_lightmap(std::move(file), "");
            numbers_.erase(entry); // it is no picture
            return std::nullopt;
        } catch (const Error& error) {
            data_.fail(pointer, fmt::format("names a lightmap that cannot be read: {}", error.what()),
                       "put the picture there, or take the lightmap out of the file");
        }
    }

    const Data& data_;
    Lightmap map_;
    std::optional<Lightmap> baked_;
    std::string scene_pointer_;
    std::map<std::string, uint32_t> numbers_;
};

} // namespace
} // namespace gltf

std::optional<Lightmap> named_lightmap(const std::filesystem::path& scene_file)
{
    const std::string extension = lower_extension(scene_file);
    if (extension != ".gltf" && extension != ".glb" && extension != ".vrm") {
        return std::nullopt;
    }
    const std::string file = scene_file.string();
    const std::vector<std::byte> bytes = gltf::read_gltf_bytes(scene_file);
    const gltf::Container container = gltf::open_container(bytes, file);
    if (container.json.find(gltf::map_key) == std::string_view::npos) {
        return std::nullopt;
    }
    const gltf::Data data(gltf::read_document(container, file), container, file, scene_file.parent_path());
    return gltf::NamedMaps(data).take();
}

} // namespace estampe
