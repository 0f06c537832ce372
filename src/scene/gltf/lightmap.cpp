// SPDX-License-Identifier: MIT
#include <estampe/lightmap.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include <fmt/ranges.h>

#include "core/child/child.hpp"
#include "core/color.hpp"
#include "core/exr.hpp"
#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "scene/gltf/extras.hpp"

namespace estampe {
namespace gltf {
namespace {

constexpr const char* map_key = "lightmap";
constexpr const char* extension_key = "MOZ_lightmap";

/// A lightmap that `extras` or MOZ_lightmap names, before its picture is read.
struct Entry {
    std::optional<std::string> uri;
    int texture = -1;  ///< index of the lightmap's texture in the file, used if there is no URI
    std::string place; ///< JSON pointer of the URI or texture, for messages
    uint32_t uv_set = 1;
    float intensity = 1.0F;
};

/// Reads the description of a lightmap. Unknown settings are ignored with a warning. Returns nothing if no
/// picture is named.
class EntryReader {
public:
    EntryReader(Data& data, const tinygltf::Value& value, const std::string& pointer,
                std::span<const std::string_view> keys)
        : data_(data), value_(value), pointer_(pointer), keys_(keys)
    {
    }

    [[nodiscard]] std::optional<Entry> read()
    {
        if (!value_.IsObject()) {
            return leave_out(pointer_, "should be an object");
        }
        for (const std::string& key : value_.Keys()) {
            if (std::find(keys_.begin(), keys_.end(), key) == keys_.end()) {
                leave_out(at(key), fmt::format("is not known (allowed: {})", fmt::join(keys_, ", ")));
            }
        }
        const bool has_uri = value_.Has("uri");
        const std::string index_key = value_.Has("index") ? "index" : "texture";
        if (has_uri == value_.Has(index_key)) {
            return leave_out(pointer_, fmt::format("{} (write for instance {})",
                                                   has_uri ? "names a picture twice" : "names no picture",
                                                   R"({"uri": "room.png"} or {"texture": 0})"));
        }
        Entry entry;
        entry.place = at(has_uri ? "uri" : index_key);
        if (has_uri && !value_.Get("uri").IsString()) {
            return leave_out(entry.place, "should be text");
        }
        if (has_uri) {
            entry.uri = value_.Get("uri").Get<std::string>();
            data_.add_named(*entry.uri);
        } else {
            const auto count = static_cast<double>(data_.model().textures.size());
            const double texture = number_of(value_.Get(index_key)).value_or(-1.0);
            if (!(texture >= 0.0 && texture < count && std::floor(texture) == texture)) {
                return leave_out(entry.place, fmt::format("should be one of the file's {} textures", count));
            }
            entry.texture = static_cast<int>(texture);
        }
        read_numbers(entry);
        return entry;
    }

private:
    void read_numbers(Entry& entry)
    {
        if (value_.Has("texCoord")) {
            const double set = number_of(value_.Get("texCoord")).value_or(-1.0);
            if (set == 0.0 || set == 1.0) {
                entry.uv_set = static_cast<uint32_t>(set);
            } else {
                leave_out(at("texCoord"), "should be 0 or 1: a mesh has two sets of UVs");
            }
        }
        if (value_.Has("intensity")) {
            const double factor = number_of(value_.Get("intensity")).value_or(-1.0);
            if (factor >= 0.0 && factor <= 1e6) {
                entry.intensity = static_cast<float>(factor);
            } else {
                leave_out(at("intensity"), "should be a number, 0 or more");
            }
        }
    }

    std::nullopt_t leave_out(const std::string& place, const std::string& why)
    {
        data_.warn(place, fmt::format("{}; {} is drawn without it", why, owner_at(data_, pointer_)));
        return std::nullopt;
    }

    [[nodiscard]] std::string at(const std::string& key) const { return pointer_ + "/" + key; }

    Data& data_;
    const tinygltf::Value& value_;
    const std::string& pointer_;
    std::span<const std::string_view> keys_;
};

std::optional<Entry> entry_of_extras(Data& data, const tinygltf::Value& extras, const std::string& pointer)
{
    if (!extras.IsObject() || !extras.Has(our_key) || !extras.Get(our_key).Has(map_key)) {
        return std::nullopt;
    }
    static constexpr std::string_view keys[] = {"intensity", "texCoord", "texture", "uri"};
    return EntryReader(data, extras.Get(our_key).Get(map_key),
                       fmt::format("{}/extras/{}/{}", pointer, our_key, map_key), keys)
        .read();
}

std::optional<Entry> entry_of_material(Data& data, const tinygltf::Material& material,
                                       const std::string& pointer)
{
    if (auto own = entry_of_extras(data, material.extras, pointer)) {
        return own;
    }
    const auto found = material.extensions.find(extension_key);
    if (found == material.extensions.end()) {
        return std::nullopt;
    }
    static constexpr std::string_view keys[] = {"extensions", "extras", "index", "intensity", "texCoord"};
    return EntryReader(data, found->second, pointer + "/extensions/" + extension_key, keys).read();
}

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

/// Collects the lightmaps that a file names, and reads each picture once.
class NamedMaps {
public:
    explicit NamedMaps(Data& data) : data_(data) {}

    /// Returns the lightmap of the file; nothing if the file names none.
    [[nodiscard]] std::optional<Lightmap> take()
    {
        const tinygltf::Model& model = data_.model();
        for (size_t i = 0; i < model.materials.size(); ++i) {
            map_.of_material.push_back(
                worn(entry_of_material(data_, model.materials[i], fmt::format("/materials/{}", i))));
        }
        map_.of_node.resize(model.nodes.size());
        if (!model.scenes.empty()) {
            const auto shown = static_cast<size_t>(std::max(model.defaultScene, 0));
            const tinygltf::Scene& scene = model.scenes[std::min(shown, model.scenes.size() - 1)];
            scene_pointer_ = fmt::format("/scenes/{}", &scene - model.scenes.data());
            map_.of_scene = worn(entry_of_extras(data_, scene.extras, scene_pointer_));
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
    /// Assigns lightmaps to nodes. The lightmap of a node also applies to its children, unless the children
    /// have their own lightmaps.
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
            if (const auto own =
                    worn(entry_of_extras(data_, source.extras, fmt::format("/nodes/{}", node)))) {
                map_.of_node[node] = own;
            }
            for (const int child : source.children) {
                map_.of_node[static_cast<size_t>(child)] = map_.of_node[node];
                open.push_back(static_cast<size_t>(child));
            }
        }
    }

    [[nodiscard]] std::optional<WornPicture> worn(const std::optional<Entry>& entry)
    {
        const auto picture = !entry       ? std::nullopt
                             : entry->uri ? by_uri(*entry->uri, entry->place)
                                          : by_texture(entry->texture, entry->place);
        if (!picture) {
            return std::nullopt;
        }
        return WornPicture{.picture = *picture, .uv_set = entry->uv_set, .intensity = entry->intensity};
    }

    /// Reads the picture of a URI. Returns nothing if the file is a baked lightmap, which only the scene may
    /// name.
    [[nodiscard]] std::optional<uint32_t> by_uri(const std::string& uri, const std::string& pointer)
    {
        return read(uri, pointer, [&] { return data_.resource(uri); });
    }

    [[nodiscard]] std::optional<uint32_t> by_texture(int index, const std::string& pointer)
    {
        const auto& textures = data_.model().textures;
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
            numbers_.erase(entry); // a baked lightmap has no index in the list of pictures
            return std::nullopt;
        } catch (const Error& error) {
            data_.fail(pointer, fmt::format("names a lightmap that cannot be read: {}", error.what()),
                       "put the picture there, or take the lightmap out of the file");
        }
    }

    Data& data_;
    Lightmap map_;
    std::optional<Lightmap> baked_;
    std::string scene_pointer_;
    std::map<std::string, uint32_t> numbers_;
};

} // namespace

void check_lightmap_extras(Data& data)
{
    const tinygltf::Model& model = data.model();
    for (size_t i = 0; i < model.materials.size(); ++i) {
        static_cast<void>(entry_of_material(data, model.materials[i], fmt::format("/materials/{}", i)));
    }
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        static_cast<void>(entry_of_extras(data, model.nodes[i].extras, fmt::format("/nodes/{}", i)));
    }
    for (size_t i = 0; i < model.scenes.size(); ++i) {
        static_cast<void>(entry_of_extras(data, model.scenes[i].extras, fmt::format("/scenes/{}", i)));
    }
}

} // namespace gltf

std::optional<Lightmap> named_lightmap(const std::filesystem::path& scene_file, const ReadScope& scope)
{
    const std::string extension = lower_extension(scene_file);
    if (extension != ".gltf" && extension != ".glb" && extension != ".vrm") {
        return std::nullopt;
    }
    const std::string file = scene_file.string();
    const std::vector<std::byte> bytes = gltf::read_gltf_bytes(scene_file, scope);
    const gltf::Container container = gltf::open_container(bytes, file);
    if (container.json.find(gltf::map_key) == std::string_view::npos) {
        return std::nullopt;
    }
    const auto read = [&] {
        gltf::Data data(gltf::read_document(container, file), container, file, scene_file.parent_path(),
                        scope);
        return gltf::NamedMaps(data).take();
    };
    std::optional<Lightmap> map = run_in_child(read, limits_for_file(scene_file, scope), file);
    if (map && !is_well_formed(*map)) {
        throw Error("what was read from it came back damaged", file);
    }
    return map;
}

} // namespace estampe
