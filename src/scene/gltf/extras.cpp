// SPDX-License-Identifier: MIT
#include "scene/gltf/extras.hpp"

#include <algorithm>
#include <span>

#include <fmt/ranges.h>

namespace estampe::gltf {
namespace {

constexpr int group_count = 16;

/// One object of ours, read key by key.
class Reader {
public:
    Reader(const Data& data, const tinygltf::Value& extras, const std::string& pointer)
        : data_(data), value_(extras.Get(our_key)), pointer_(pointer + "/extras/" + our_key)
    {
        check_object();
    }

    /// Of an object within it.
    Reader(const Reader& whole, const std::string& key)
        : data_(whole.data_), value_(whole.value_.Get(key)), pointer_(whole.at(key))
    {
        check_object();
    }

    /// Fails at the first key that is not among `known`.
    void expect_only(std::span<const std::string_view> known) const
    {
        for (const std::string& key : value_.Keys()) {
            if (std::find(known.begin(), known.end(), key) == known.end()) {
                data_.fail(at(key), "is not known", fmt::format("allowed: {}", fmt::join(known, ", ")));
            }
        }
    }

    [[nodiscard]] bool has(const std::string& key) const { return value_.Has(key); }

    [[nodiscard]] bool is_boolean(const std::string& key) const { return value_.Get(key).IsBool(); }

    [[nodiscard]] bool boolean(const std::string& key) const
    {
        if (!is_boolean(key)) {
            data_.fail(at(key), "should be true or false");
        }
        return value_.Get(key).Get<bool>();
    }

    [[nodiscard]] float positive_number(const std::string& key) const
    {
        const tinygltf::Value& value = value_.Get(key);
        const double number = value.IsNumber() ? value.GetNumberAsDouble() : -1.0;
        if (!(number >= 0.0 && number <= 1e6)) {
            data_.fail(at(key), "should be a number, 0 or more");
        }
        return static_cast<float>(number);
    }

    /// Of a list of so many things.
    [[nodiscard]] Index index(const std::string& key, size_t count, std::string_view what) const
    {
        const tinygltf::Value& value = value_.Get(key);
        const int number = value.IsInt() ? value.GetNumberAsInt() : -1;
        if (number < 0 || static_cast<size_t>(number) >= count) {
            data_.fail(at(key), fmt::format("should be the number of a {}", what));
        }
        return static_cast<Index>(number);
    }

    /// The place of the word among `words`.
    [[nodiscard]] size_t choice(const std::string& key, std::span<const std::string_view> words) const
    {
        const tinygltf::Value& value = value_.Get(key);
        const std::string word = value.IsString() ? value.Get<std::string>() : std::string();
        const auto found = std::find(words.begin(), words.end(), word);
        if (found == words.end()) {
            data_.fail(at(key), fmt::format("should be one of: {}", fmt::join(words, ", ")));
        }
        return static_cast<size_t>(found - words.begin());
    }

    [[nodiscard]] Groups groups(const std::string& key) const
    {
        const tinygltf::Value& value = value_.Get(key);
        if (!value.IsArray()) {
            data_.fail(at(key), "should be an array of groups", "write for instance [1, 2]");
        }
        uint32_t bits = 0;
        for (size_t i = 0; i < value.ArrayLen(); ++i) {
            const tinygltf::Value& entry = value.Get(static_cast<int>(i));
            const int group = entry.IsInt() ? entry.GetNumberAsInt() : 0;
            if (group < 1 || group > group_count) {
                data_.fail(fmt::format("{}/{}", at(key), i),
                           fmt::format("should be a group from 1 to {}", group_count));
            }
            bits |= 1U << static_cast<uint32_t>(group - 1);
        }
        return static_cast<Groups>(bits);
    }

private:
    void check_object() const
    {
        if (!value_.IsObject()) {
            data_.fail(pointer_, "should be an object");
        }
    }

    [[nodiscard]] std::string at(const std::string& key) const { return pointer_ + "/" + key; }

    const Data& data_;
    const tinygltf::Value& value_;
    std::string pointer_;
};

} // namespace

bool has_extras(const tinygltf::Value& extras)
{
    return extras.IsObject() && extras.Has(our_key);
}

void read_light_extras(const Data& data, const tinygltf::Value& extras, const std::string& pointer,
                       Light& light)
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
    if (reader.has("falloff")) {
        light.falloff = static_cast<LightFalloff>(reader.choice("falloff", falloffs));
    }
    if (reader.has("shape")) {
        light.shape = static_cast<SpotShape>(reader.choice("shape", shapes));
    }
    if (reader.has("type")) {
        static_cast<void>(reader.choice("type", types));
        light.type = LightType::ambient;
    }
    if (reader.has("groups")) {
        light.groups = reader.groups("groups");
    }
    if (reader.has("casters")) {
        light.casters = reader.groups("casters");
    }
    if (reader.has("radius")) {
        light.radius_m = reader.positive_number("radius");
    }
    if (reader.has("shadows") && !reader.boolean("shadows")) {
        light.casters = 0;
    }
}

void read_link_extras(const Data& data, const tinygltf::Value& extras, const std::string& pointer,
                      LightLinks& links)
{
    if (!has_extras(extras)) {
        return;
    }
    static constexpr std::string_view keys[] = {"casts",  "cloth",    "collider",
                                                "groups", "lightmap", "receives"};
    const Reader reader(data, extras, pointer);
    reader.expect_only(keys);
    if (reader.has("groups")) {
        links.lit_by = reader.groups("groups");
    }
    if (reader.has("casts")) {
        links.casts_for = !reader.is_boolean("casts") ? reader.groups("casts")
                          : reader.boolean("casts")   ? all_groups
                                                      : Groups{0};
    }
    if (reader.has("receives")) {
        links.receives_shadows = reader.boolean("receives");
    }
}

void read_cloth_extras(const Data& data, const tinygltf::Value& extras, const std::string& pointer,
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
        cloth = reader.boolean("cloth") ? std::optional(cloth.value_or(Cloth{})) : std::nullopt;
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
        number = own.has(key) ? own.positive_number(key) : number;
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
    if (own.has("back")) {
        read.back_material = own.index("back", data.model().materials.size(), "material");
    }
    if (own.has("solver")) {
        read.solver = static_cast<ClothSolver>(own.choice("solver", solvers));
    }
}

std::optional<Index> held_texture(const Data& data, const tinygltf::Value& extras, const std::string& pointer)
{
    if (!has_extras(extras)) {
        return std::nullopt;
    }
    const Reader reader(data, extras, pointer);
    if (!reader.has("cloth") || reader.is_boolean("cloth")) {
        return std::nullopt;
    }
    const Reader own(reader, "cloth");
    return own.has("held") ? std::optional(own.index("held", data.model().textures.size(), "texture"))
                           : std::nullopt;
}

void read_collider_extras(const Data& data, const tinygltf::Value& extras, const std::string& pointer,
                          ClothCollider& collider)
{
    if (!has_extras(extras)) {
        return;
    }
    static constexpr std::string_view shapes[] = {"none", "box", "ellipsoid", "cylinder", "capsule", "mesh"};
    const Reader reader(data, extras, pointer);
    if (reader.has("collider")) {
        collider = static_cast<ClothCollider>(reader.choice("collider", shapes));
    }
}

} // namespace estampe::gltf
