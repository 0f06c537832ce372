// SPDX-License-Identifier: MIT
#include "scene/gltf/extras.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/ranges.h>

#include "core/text.hpp"
#include "scene/gltf/convert.hpp"

namespace estampe::gltf {

std::string owner_at(const Data& data, const std::string& pointer)
{
    const tinygltf::Model& model = data.model();
    const auto named = [&](std::string_view prefix, std::string_view word, const auto& list) {
        if (!pointer.starts_with(prefix)) {
            return std::string();
        }
        size_t number = 0;
        std::from_chars(pointer.data() + prefix.size(), pointer.data() + pointer.size(), number);
        const std::string name = number < list.size() ? list[number].name : std::string();
        return name.empty() ? fmt::format("{} {}", word, number) : fmt::format("{} \"{}\"", word, name);
    };
    for (const std::string& owner :
         {named("/nodes/", "node", model.nodes), named("/materials/", "material", model.materials),
          named("/extensions/KHR_lights_punctual/lights/", "light", model.lights)}) {
        if (!owner.empty()) {
            return owner;
        }
    }
    return "the scene";
}

std::optional<double> number_of(const tinygltf::Value& value)
{
    if (value.IsNumber()) {
        return value.GetNumberAsDouble();
    }
    if (!value.IsString()) {
        return std::nullopt;
    }
    return number_from<double>(value.Get<std::string>());
}

namespace {

constexpr int group_count = 16;

/// Parses true and false. Also accepts 1, 0, "true", "0" and the like, because Blender writes custom
/// properties in these forms.
std::optional<bool> boolean_of(const tinygltf::Value& value)
{
    if (value.IsBool()) {
        return value.Get<bool>();
    }
    const std::string word = value.IsString() ? lower_case(value.Get<std::string>()) : std::string();
    const std::optional<double> number = number_of(value);
    if (word == "true" || number == 1.0) {
        return true;
    }
    return word == "false" || number == 0.0 ? std::optional(false) : std::nullopt;
}

/// Reads an object named "estampe" key by key. Unknown or invalid settings are ignored, with a warning that
/// names the key and its owner, so that the file can be drawn in spite of a mistake in a custom property.
class Reader {
public:
    Reader(Data& data, const tinygltf::Value& extras, const std::string& pointer)
        : data_(data), value_(extras.Get(our_key)), pointer_(pointer + "/extras/" + our_key),
          owner_(owner_at(data, pointer))
    {
        check_object();
    }

    /// Reads the object that is the value of `key` in the object of `whole`.
    Reader(const Reader& whole, const std::string& key)
        : data_(whole.data_), value_(whole.value_.Get(key)), pointer_(whole.at(key)), owner_(whole.owner_)
    {
        check_object();
    }

    /// Adds a warning for each key that is not in `known`.
    void expect_only(std::span<const std::string_view> known) const
    {
        if (!value_.IsObject()) {
            return;
        }
        for (const std::string& key : value_.Keys()) {
            if (std::find(known.begin(), known.end(), key) == known.end()) {
                leave_out(at(key), fmt::format("is not known (allowed: {})", fmt::join(known, ", ")));
            }
        }
    }

    [[nodiscard]] bool has(const std::string& key) const { return value_.IsObject() && value_.Has(key); }

    [[nodiscard]] bool is_boolean(const std::string& key) const
    {
        return has(key) && boolean_of(value_.Get(key)).has_value();
    }

    [[nodiscard]] bool is_object(const std::string& key) const
    {
        return has(key) && value_.Get(key).IsObject();
    }

    /// The functions below return the value of a key. Each function returns nothing if the key is missing. If
    /// the value is invalid, each function returns nothing and adds a warning.
    [[nodiscard]] std::optional<bool> boolean(const std::string& key) const
    {
        return take(key, "should be true or false", boolean_of);
    }

    [[nodiscard]] std::optional<float> positive_number(const std::string& key) const
    {
        return take(key, "should be a number, 0 or more", [](const tinygltf::Value& value) {
            const double number = number_of(value).value_or(-1.0);
            return number >= 0.0 && number <= 1e6 ? std::optional(static_cast<float>(number)) : std::nullopt;
        });
    }

    /// Reads an index into a list of `count` entries.
    [[nodiscard]] std::optional<Index> index(const std::string& key, size_t count,
                                             std::string_view what) const
    {
        return take(key, fmt::format("should be the number of a {}", what),
                    [&](const tinygltf::Value& value) {
                        const double number = number_of(value).value_or(-1.0);
                        const bool is_one = number >= 0.0 && number < static_cast<double>(count) &&
                                            std::floor(number) == number;
                        return is_one ? std::optional(static_cast<Index>(number)) : std::nullopt;
                    });
    }

    /// Reads a word, and returns its index in `words`.
    [[nodiscard]] std::optional<size_t> choice(const std::string& key,
                                               std::span<const std::string_view> words) const
    {
        const std::string wanted = fmt::format("should be one of: {}", fmt::join(words, ", "));
        return take(key, wanted, [&](const tinygltf::Value& value) -> std::optional<size_t> {
            const std::string word = value.IsString() ? lower_case(value.Get<std::string>()) : std::string();
            const auto found = std::find(words.begin(), words.end(), word);
            return found == words.end() ? std::nullopt
                                        : std::optional(static_cast<size_t>(found - words.begin()));
        });
    }

    /// Reads a list of group numbers, or a single group number.
    [[nodiscard]] std::optional<Groups> groups(const std::string& key) const
    {
        const std::string wanted =
            fmt::format("should be an array of groups from 1 to {}, for instance [1, 2]", group_count);
        return take(key, wanted, [](const tinygltf::Value& value) -> std::optional<Groups> {
            const size_t count = value.IsArray() ? value.ArrayLen() : 1;
            uint32_t bits = 0;
            for (size_t i = 0; i < count; ++i) {
                const double group =
                    number_of(value.IsArray() ? value.Get(static_cast<int>(i)) : value).value_or(0.0);
                if (!(group >= 1.0 && group <= group_count && std::floor(group) == group)) {
                    return std::nullopt;
                }
                bits |= 1U << (static_cast<uint32_t>(group) - 1U);
            }
            return static_cast<Groups>(bits);
        });
    }

    void leave_out(const std::string& place, const std::string& why) const
    {
        data_.warn(place, fmt::format("{}; {} is drawn without it", why, owner_));
    }

    [[nodiscard]] std::string at(const std::string& key) const { return pointer_ + "/" + key; }

private:
    void check_object() const
    {
        if (!value_.IsObject()) {
            leave_out(pointer_, "should be an object");
        }
    }

    template <typename Read>
    [[nodiscard]] auto take(const std::string& key, const std::string& wanted, const Read& read) const
        -> decltype(read(std::declval<const tinygltf::Value&>()))
    {
        if (!has(key)) {
            return std::nullopt;
        }
        const auto result = read(value_.Get(key));
        if (!result) {
            leave_out(at(key), wanted);
        }
        return result;
    }

    Data& data_;
    const tinygltf::Value& value_;
    std::string pointer_;
    std::string owner_;
};

} // namespace

bool has_extras(const tinygltf::Value& extras)
{
    return extras.IsObject() && extras.Has(our_key);
}

void read_light_extras(Data& data, const tinygltf::Value& extras, const std::string& pointer, Light& light)
{
    if (!has_extras(extras)) {
        return;
    }
    static constexpr std::string_view keys[] = {"casters", "falloff", "groups", "radius",
                                                "shadows", "shape",   "type"};
    static constexpr std::string_view falloffs[] = {"inverse_square", "unit_volume"};
    static constexpr std::string_view shapes[] = {"cone", "pyramid"};
    static constexpr std::string_view types[] = {"ambient"};
    const Reader reader(data, extras, pointer);
    reader.expect_only(keys);
    if (const auto falloff = reader.choice("falloff", falloffs)) {
        light.falloff = static_cast<LightFalloff>(*falloff);
    }
    if (const auto shape = reader.choice("shape", shapes)) {
        light.shape = static_cast<SpotShape>(*shape);
    }
    if (reader.choice("type", types)) {
        light.type = LightType::ambient;
    }
    light.groups = reader.groups("groups").value_or(light.groups);
    light.casters = reader.groups("casters").value_or(light.casters);
    if (const auto radius = reader.positive_number("radius")) {
        light.radius_m = radius;
    }
    if (!reader.boolean("shadows").value_or(true)) {
        light.casters = 0;
    }
}

void read_link_extras(Data& data, const tinygltf::Value& extras, const std::string& pointer,
                      LightLinks& links)
{
    if (!has_extras(extras)) {
        return;
    }
    static constexpr std::string_view keys[] = {"casts",  "cloth",    "collider",
                                                "groups", "lightmap", "receives"};
    const Reader reader(data, extras, pointer);
    reader.expect_only(keys);
    links.lit_by = reader.groups("groups").value_or(links.lit_by);
    if (reader.is_boolean("casts")) {
        links.casts_for = *reader.boolean("casts") ? all_groups : Groups{0};
    } else {
        links.casts_for = reader.groups("casts").value_or(links.casts_for);
    }
    links.receives_shadows = reader.boolean("receives").value_or(links.receives_shadows);
}

void read_cloth_extras(Data& data, const tinygltf::Value& extras, const std::string& pointer,
                       std::optional<Cloth>& cloth)
{
    if (!has_extras(extras)) {
        return;
    }
    const Reader reader(data, extras, pointer);
    if (!reader.has("cloth")) {
        return;
    }
    if (reader.is_boolean("cloth")) {
        cloth = *reader.boolean("cloth") ? std::optional(cloth.value_or(Cloth{})) : std::nullopt;
        return;
    }
    if (!reader.is_object("cloth")) {
        reader.leave_out(reader.at("cloth"), "should be true, false or an object");
        return;
    }
    static constexpr std::string_view keys[] = {"back",   "bending",  "damping", "density",  "drag",
                                                "fold",   "friction", "held",    "lift",     "self",
                                                "solver", "stretch",  "tear",    "thickness"};
    static constexpr std::string_view solvers[] = {"automatic", "small_steps", "verlet", "block_descent"};
    const Reader own(reader, "cloth");
    own.expect_only(keys);
    Cloth& read = cloth.emplace();
    const auto take = [&](const char* key, float& number) {
        number = own.positive_number(key).value_or(number);
    };
    take("bending", read.bending_n_m);
    take("damping", read.damping_per_s);
    take("density", read.density_kg_m2);
    take("drag", read.drag);
    take("fold", read.fold);
    take("friction", read.friction);
    take("lift", read.lift);
    take("self", read.self_m);
    take("stretch", read.stretch_n_m);
    take("tear", read.tear);
    take("thickness", read.thickness_m);
    read.back_material =
        own.index("back", data.model().materials.size(), "material").value_or(read.back_material);
    if (const auto solver = own.choice("solver", solvers)) {
        read.solver = static_cast<ClothSolver>(*solver);
    }
}

std::optional<Index> held_texture(Data& data, const tinygltf::Value& extras, const std::string& pointer)
{
    if (!has_extras(extras)) {
        return std::nullopt;
    }
    const Reader reader(data, extras, pointer);
    if (!reader.is_object("cloth")) {
        return std::nullopt;
    }
    return Reader(reader, "cloth").index("held", data.model().textures.size(), "texture");
}

void read_collider_extras(Data& data, const tinygltf::Value& extras, const std::string& pointer,
                          ClothCollider& collider)
{
    if (!has_extras(extras)) {
        return;
    }
    static constexpr std::string_view shapes[] = {"none", "box", "ellipsoid", "cylinder", "capsule", "mesh"};
    const Reader reader(data, extras, pointer);
    if (const auto shape = reader.choice("collider", shapes)) {
        collider = static_cast<ClothCollider>(*shape);
    }
}

namespace {

/// Returns whether a name is "cloth", or "cloth" followed by a character that is not a letter, such as
/// "cloth_flag" or "Cloth.001". The case of letters is ignored.
bool names_cloth(const std::string& name)
{
    constexpr std::string_view word = "cloth";
    for (size_t i = 0; i < word.size(); ++i) {
        if (i >= name.size() || (name[i] | 0x20) != word[i]) {
            return false;
        }
    }
    return name.size() == word.size() || std::isalpha(static_cast<unsigned char>(name[word.size()])) == 0;
}

/// Returns the red channel of a texture at `uv`, with bilinear interpolation.
float red_at(const Texture& texture, glm::vec2 uv)
{
    const auto wrapped = [](int at, int size, Wrap wrap) {
        if (wrap == Wrap::clamp) {
            return std::clamp(at, 0, size - 1);
        }
        const int period = wrap == Wrap::mirror ? 2 * size : size;
        const int within = (at % period + period) % period;
        return within < size ? within : period - 1 - within;
    };
    const glm::ivec2 size(texture.image.width, texture.image.height);
    const glm::vec2 place = glm::clamp(uv, -1e4F, 1e4F) * glm::vec2(size) - 0.5F;
    const glm::ivec2 corner(glm::floor(place));
    const glm::vec2 share = place - glm::vec2(corner);
    const auto red = [&](int x, int y) {
        const auto column = static_cast<size_t>(wrapped(corner.x + x, size.x, texture.wrap_u));
        const auto row = static_cast<size_t>(wrapped(corner.y + y, size.y, texture.wrap_v));
        return static_cast<float>(texture.image.rgba.at(4 * (row * static_cast<size_t>(size.x) + column)));
    };
    return glm::mix(glm::mix(red(0, 0), red(1, 0), share.x), glm::mix(red(0, 1), red(1, 1), share.x),
                    share.y) /
           255.0F;
}

/// Sets how strongly the vertices of cloth are held in place. The values come from a texture, if a texture is
/// given and the primitive has UVs. Otherwise the values come from the red channel of the vertex colours.
void hold(Primitive& primitive, const Scene& scene, Index texture)
{
    if (texture != no_index && !primitive.uvs[0].empty()) {
        primitive.held.clear();
        for (const glm::vec2& uv : primitive.uvs[0]) {
            primitive.held.push_back(red_at(scene.textures[texture], uv));
        }
        return;
    }
    if (!primitive.colors.empty()) {
        for (const glm::vec4& color : primitive.colors) {
            primitive.held.push_back(glm::clamp(color.x, 0.0F, 1.0F));
        }
        primitive.colors.clear();
    }
}

/// Whether extras of a node or material say whether it is cloth.
bool speaks_of_cloth(Data& data, const tinygltf::Value& extras, const std::string& pointer)
{
    return has_extras(extras) && Reader(data, extras, pointer).has("cloth");
}

/// Warns of a node that is cloth by its name or the name of its material alone, if nothing holds it.
void warn_if_it_falls(Data& data, const std::string& pointer, const Primitive& primitive)
{
    if (std::ranges::none_of(primitive.held, [](float held) { return held > 0.0F; })) {
        data.warn(
            pointer,
            fmt::format("{} is simulated as cloth because of the name \"cloth\", and falls down, because "
                        "nothing holds it; to draw it as it is, set \"cloth\": false in its extras, or "
                        "rename it",
                        owner_at(data, pointer)));
    }
}

} // namespace

void import_cloth(Data& data, const std::map<Index, Index>& held_textures, Scene& scene)
{
    const auto& sources = data.model();
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        Material& material = scene.materials[i];
        if (names_cloth(material.name)) {
            material.cloth = Cloth{};
        }
        if (i < sources.materials.size()) {
            read_cloth_extras(data, sources.materials[i].extras, fmt::format("/materials/{}", i),
                              material.cloth);
        }
    }
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        Node& node = scene.nodes[i];
        const std::string pointer = fmt::format("/nodes/{}", i);
        read_collider_extras(data, sources.nodes[i].extras, pointer, node.collider);
        if (names_cloth(node.name) && node.mesh != no_index) {
            node.cloth = Cloth{};
        }
        read_cloth_extras(data, sources.nodes[i].extras, pointer, node.cloth);
        if (node.mesh == no_index) {
            continue;
        }
        const auto of_node = held_texture(data, sources.nodes[i].extras, pointer);
        for (Primitive& primitive : scene.meshes[node.mesh].primitives) {
            if (cloth_of(scene, node, primitive) == nullptr) {
                continue;
            }
            static const tinygltf::Value no_extras;
            const bool has_material = primitive.material < sources.materials.size();
            const tinygltf::Value& of_material =
                has_material ? sources.materials[primitive.material].extras : no_extras;
            const std::string material_pointer = fmt::format("/materials/{}", primitive.material);
            const auto texture = of_node ? of_node : held_texture(data, of_material, material_pointer);
            hold(primitive, scene, texture ? held_textures.at(*texture) : no_index);
            if (!speaks_of_cloth(data, sources.nodes[i].extras, pointer) &&
                !speaks_of_cloth(data, of_material, material_pointer)) {
                warn_if_it_falls(data, pointer, primitive);
            }
        }
    }
}

} // namespace estampe::gltf
