// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "scene/gltf/data.hpp"

namespace estampe::gltf {
namespace {

/// Expected type of a property in the JSON of a glTF file.
enum class Kind : uint8_t { index, integer, number, text, boolean, choice, object, index_map, list };

constexpr double max_number = 3.0e38;      ///< largest value that fits in a float
constexpr double max_count = 2147483647.0; ///< largest index in a glTF file
constexpr double max_offset = 1099511627776.0;

struct Rule {
    std::string_view key;
    Kind kind = Kind::object;
    /// Depends on the type: name of the array that an index refers to, name of an object's schema, or list of
    /// valid words.
    std::string target;
    bool required = false;
    double min = -max_number;
    double max = max_number;
    Kind entry = Kind::object; ///< type of the entries of a list
    int length = -1;           ///< number of entries of a list; negative: any number
};

Rule required(Rule rule)
{
    rule.required = true;
    return rule;
}

Rule index(std::string_view key, std::string array)
{
    return {.key = key, .kind = Kind::index, .target = std::move(array)};
}

Rule integer(std::string_view key, double min, double max)
{
    return {.key = key, .kind = Kind::integer, .target = {}, .min = min, .max = max};
}

Rule number(std::string_view key, double min = -max_number, double max = max_number)
{
    return {.key = key, .kind = Kind::number, .target = {}, .min = min, .max = max};
}

Rule text(std::string_view key)
{
    return {.key = key, .kind = Kind::text, .target = {}};
}

Rule boolean(std::string_view key)
{
    return {.key = key, .kind = Kind::boolean, .target = {}};
}

Rule choice(std::string_view key, std::string words)
{
    return {.key = key, .kind = Kind::choice, .target = std::move(words)};
}

Rule object(std::string_view key, std::string schema)
{
    return {.key = key, .kind = Kind::object, .target = std::move(schema)};
}

Rule index_map(std::string_view key, std::string array)
{
    return {.key = key, .kind = Kind::index_map, .target = std::move(array)};
}

Rule objects(std::string_view key, std::string schema)
{
    return {.key = key, .kind = Kind::list, .target = std::move(schema), .entry = Kind::object};
}

Rule index_maps(std::string_view key, std::string array)
{
    return {.key = key, .kind = Kind::list, .target = std::move(array), .entry = Kind::index_map};
}

Rule indices(std::string_view key, std::string array)
{
    return {.key = key, .kind = Kind::list, .target = std::move(array), .entry = Kind::index};
}

Rule numbers(std::string_view key, int length, double min = -max_number, double max = max_number)
{
    return {.key = key,
            .kind = Kind::list,
            .target = {},
            .min = min,
            .max = max,
            .entry = Kind::number,
            .length = length};
}

Rule texts(std::string_view key)
{
    return {.key = key, .kind = Kind::list, .target = {}, .entry = Kind::text};
}

constexpr const char* component_types = "5120 5121 5122 5123 5125 5126";
constexpr const char* wraps = "33071 33648 10497";

// Rules for the properties that the importer reads, from the JSON schemas of glTF 2.0 and of its extensions.

using Schemas = std::map<std::string_view, std::vector<Rule>>;

Schemas data_schemas()
{
    return {
        {"root",
         {required(object("asset", "asset")), texts("extensionsUsed"), texts("extensionsRequired"),
          index("scene", "scenes"), objects("buffers", "buffer"), objects("bufferViews", "view"),
          objects("accessors", "accessor"), objects("images", "image"), objects("samplers", "sampler"),
          objects("textures", "texture"), objects("materials", "material"), objects("meshes", "mesh"),
          objects("nodes", "node"), objects("scenes", "scene"), objects("skins", "skin"),
          objects("cameras", "camera"), objects("animations", "animation"),
          object("extensions", "root extensions")}},
        {"root extensions",
         {object("KHR_lights_punctual", "lights"), object("KHR_materials_variants", "variants")}},
        {"asset", {required(text("version")), text("minVersion"), text("generator"), text("copyright")}},
        {"buffer", {text("name"), text("uri"), required(integer("byteLength", 1, max_offset))}},
        {"view",
         {text("name"), required(index("buffer", "buffers")), integer("byteOffset", 0, max_offset),
          required(integer("byteLength", 1, max_offset)), integer("byteStride", 0, 252),
          integer("target", 0, max_count), object("extensions", "view extensions")}},
        {"view extensions", {object("EXT_meshopt_compression", "meshopt")}},
        {"meshopt",
         {required(index("buffer", "buffers")), integer("byteOffset", 0, max_count),
          required(integer("byteLength", 1, max_count)), required(integer("byteStride", 1, 256)),
          required(integer("count", 1, max_count)), required(choice("mode", "ATTRIBUTES TRIANGLES INDICES")),
          choice("filter", "NONE OCTAHEDRAL QUATERNION EXPONENTIAL")}},
        {"accessor",
         {text("name"), index("bufferView", "bufferViews"), integer("byteOffset", 0, max_offset),
          required(choice("componentType", component_types)), boolean("normalized"),
          required(integer("count", 1, 4294967295.0)),
          required(choice("type", "SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4")), object("sparse", "sparse")}},
        {"sparse",
         {required(integer("count", 1, max_count)), required(object("indices", "sparse indices")),
          required(object("values", "sparse values"))}},
        {"sparse indices",
         {required(index("bufferView", "bufferViews")), integer("byteOffset", 0, max_count),
          required(choice("componentType", "5121 5123 5125"))}},
        {"sparse values",
         {required(index("bufferView", "bufferViews")), integer("byteOffset", 0, max_count)}},
        {"animation",
         {text("name"), required(objects("channels", "channel")),
          required(objects("samplers", "animation sampler"))}},
        {"channel",
         {required(integer("sampler", 0, max_count)), required(object("target", "channel target"))}},
        {"channel target",
         {index("node", "nodes"), required(text("path")), object("extensions", "channel extensions")}},
        {"channel extensions", {object("KHR_animation_pointer", "animation pointer")}},
        {"animation pointer", {required(text("pointer"))}},
        {"animation sampler",
         {required(index("input", "accessors")), required(index("output", "accessors")),
          choice("interpolation", "LINEAR STEP CUBICSPLINE")}},
    };
}

Schemas scene_schemas()
{
    return {
        {"mesh", {text("name"), required(objects("primitives", "primitive")), numbers("weights", -1)}},
        {"primitive",
         {required(index_map("attributes", "accessors")), index("indices", "accessors"),
          index("material", "materials"), integer("mode", 0, 6), index_maps("targets", "accessors"),
          object("extensions", "primitive extensions")}},
        {"primitive extensions",
         {object("KHR_draco_mesh_compression", "draco"),
          object("EXT_mesh_primitive_edge_visibility", "edge visibility"),
          object("KHR_materials_variants", "variant mappings")}},
        {"edge visibility",
         {index("visibility", "accessors"), index("material", "materials"),
          objects("lineStrings", "line string")}},
        {"line string", {required(index("indices", "accessors")), index("material", "materials")}},
        {"draco",
         {required(index("bufferView", "bufferViews")), required(object("attributes", "draco attributes"))}},
        {"draco attributes", {}},
        {"node",
         {text("name"), indices("children", "nodes"), numbers("matrix", 16), numbers("translation", 3),
          numbers("scale", 3), numbers("rotation", 4), index("mesh", "meshes"), index("skin", "skins"),
          index("camera", "cameras"), numbers("weights", -1), object("extensions", "node extensions")}},
        {"node extensions",
         {object("KHR_lights_punctual", "node light"), object("EXT_mesh_gpu_instancing", "instancing"),
          object("KHR_node_visibility", "visibility")}},
        {"visibility", {boolean("visible")}},
        {"node light", {required(index("light", "extensions/KHR_lights_punctual/lights"))}},
        {"instancing", {required(index_map("attributes", "accessors"))}},
        {"scene", {text("name"), indices("nodes", "nodes")}},
        {"skin",
         {text("name"), index("inverseBindMatrices", "accessors"), index("skeleton", "nodes"),
          required(indices("joints", "nodes"))}},
        {"camera",
         {text("name"), required(choice("type", "perspective orthographic")),
          object("perspective", "perspective"), object("orthographic", "orthographic")}},
        {"perspective", {required(number("yfov", 1e-6, std::numbers::pi)), required(number("znear", 0.0))}},
        {"orthographic",
         {required(number("xmag")), required(number("ymag")), required(number("zfar", 0.0)),
          required(number("znear", 0.0))}},
        {"lights", {required(objects("lights", "light"))}},
        {"light",
         {text("name"), required(choice("type", "directional point spot")), numbers("color", 3, 0.0),
          number("intensity", 0.0), number("range", 0.0), object("spot", "spot")}},
        {"spot",
         {number("innerConeAngle", 0.0, std::numbers::pi / 2.0),
          number("outerConeAngle", 0.0, std::numbers::pi / 2.0 + 1e-6)}},
    };
}

Schemas material_schemas()
{
    return {
        {"image", {text("name"), text("uri"), text("mimeType"), index("bufferView", "bufferViews")}},
        {"sampler", {text("name"), choice("wrapS", wraps), choice("wrapT", wraps)}},
        {"texture",
         {text("name"), index("sampler", "samplers"), index("source", "images"),
          object("extensions", "texture extensions")}},
        {"texture extensions",
         {object("EXT_texture_webp", "other picture"), object("KHR_texture_basisu", "other picture"),
          object("EXT_texture_avif", "other picture"), object("MSFT_texture_dds", "other picture")}},
        {"other picture", {required(index("source", "images"))}},
        {"texture info",
         {required(index("index", "textures")), integer("texCoord", 0, 1000), number("scale"),
          number("strength"), object("extensions", "texture info extensions")}},
        {"texture info extensions", {object("KHR_texture_transform", "texture transform")}},
        {"texture transform",
         {numbers("offset", 2), number("rotation"), numbers("scale", 2), integer("texCoord", 0, 1000)}},
        {"material",
         {text("name"), object("pbrMetallicRoughness", "metallic roughness"),
          object("normalTexture", "texture info"), object("occlusionTexture", "texture info"),
          object("emissiveTexture", "texture info"), numbers("emissiveFactor", 3, 0.0),
          choice("alphaMode", "OPAQUE MASK BLEND"), number("alphaCutoff", 0.0), boolean("doubleSided"),
          object("extensions", "material extensions")}},
        {"metallic roughness",
         {numbers("baseColorFactor", 4, 0.0, 1e6), object("baseColorTexture", "texture info"),
          number("metallicFactor"), number("roughnessFactor"),
          object("metallicRoughnessTexture", "texture info")}},
        {"material extensions",
         {object("KHR_materials_unlit", "unlit"),
          object("KHR_materials_emissive_strength", "emissive strength"),
          object("KHR_materials_pbrSpecularGlossiness", "specular glossiness"),
          object("KHR_materials_transmission", "transmission"), object("KHR_materials_volume", "volume"),
          object("KHR_materials_ior", "refraction"), object("VRMC_materials_mtoon", "mtoon")}},
        {"unlit", {}},
        {"emissive strength", {number("emissiveStrength", 0.0)}},
        {"variants", {required(objects("variants", "variant"))}},
        {"variant", {text("name")}},
        {"variant mappings", {required(objects("mappings", "variant mapping"))}},
        {"variant mapping",
         {required(index("material", "materials")),
          required(indices("variants", "extensions/KHR_materials_variants/variants"))}},
        {"specular glossiness",
         {numbers("diffuseFactor", 4, 0.0, 1e6), object("diffuseTexture", "texture info"),
          number("glossinessFactor")}},
        {"transmission", {number("transmissionFactor"), object("transmissionTexture", "texture info")}},
        {"refraction", {number("ior", 0.0)}},
        {"volume",
         {number("thicknessFactor", 0.0), object("thicknessTexture", "texture info"),
          number("attenuationDistance", 0.0), numbers("attenuationColor", 3, 0.0, 1e6)}},
        {"mtoon",
         {numbers("shadeColorFactor", 3, 0.0, 1e6), object("shadeMultiplyTexture", "texture info"),
          number("shadingShiftFactor"), object("shadingShiftTexture", "texture info"),
          number("shadingToonyFactor"), choice("outlineWidthMode", "none worldCoordinates screenCoordinates"),
          number("outlineWidthFactor", 0.0), numbers("outlineColorFactor", 3, 0.0, 1e6)}},
    };
}

Schemas all_schemas()
{
    Schemas all = data_schemas();
    all.merge(scene_schemas());
    all.merge(material_schemas());
    return all;
}

/// Returns the rules for one type of glTF object, such as "root", "accessor" or "node".
std::span<const Rule> rules_of(std::string_view schema)
{
    static const Schemas schemas = all_schemas();
    const auto found = schemas.find(schema);
    assert(found != schemas.end());
    return found->second;
}

using nlohmann::json;

class Checker {
public:
    Checker(const json& root, const std::string& file) : root_(root), place_(file + "#") {}

    void object(json& value, std::string_view schema)
    {
        expect(value.is_object(), "should be an object");
        for (const Rule& rule : rules_of(schema)) {
            const auto member = value.find(rule.key);
            if (member == value.end()) {
                expect(!rule.required, fmt::format("lacks \"{}\"", rule.key));
                continue;
            }
            const Step step(place_, rule.key);
            property(*member, rule);
        }
    }

private:
    /// Appends a step to the JSON pointer of the current position; its destructor removes the step.
    class Step {
    public:
        template <typename Key>
        Step(std::string& place, const Key& key) : place_(place), length_(place.size())
        {
            place_ += '/';
            for (const char character : fmt::format("{}", key)) {
                place_ += character == '~'   ? "~0"
                          : character == '/' ? "~1"
                                             : std::string(1, printable(character));
            }
        }

        ~Step() { place_.resize(length_); }

        Step(const Step&) = delete;
        Step& operator=(const Step&) = delete;

    private:
        static char printable(char character)
        {
            return static_cast<unsigned char>(character) < 0x20 ? '?' : character;
        }

        std::string& place_;
        size_t length_;
    };

    void expect(bool good, const std::string& what) const
    {
        if (!good) {
            throw Error(what, place_);
        }
    }

    void property(json& value, const Rule& rule)
    {
        switch (rule.kind) {
        case Kind::index:
            index(value, rule.target);
            break;
        case Kind::integer:
            integer(value, rule.min, rule.max);
            break;
        case Kind::number:
            number(value, rule.min, rule.max);
            break;
        case Kind::text:
            expect(value.is_string(), "should be a string");
            break;
        case Kind::boolean:
            expect(value.is_boolean(), "should be true or false");
            break;
        case Kind::choice:
            choice(value, rule.target);
            break;
        case Kind::object:
            object(value, rule.target);
            break;
        case Kind::index_map:
            index_map(value, rule.target);
            break;
        case Kind::list:
            list(value, rule);
            break;
        }
    }

    void list(json& value, const Rule& rule)
    {
        expect(value.is_array(), "should be an array");
        if (rule.length >= 0) {
            expect(value.size() == static_cast<size_t>(rule.length),
                   fmt::format("should have {} entries, not {}", rule.length, value.size()));
        }
        Rule entry = rule;
        entry.kind = rule.entry;
        for (size_t i = 0; i < value.size(); ++i) {
            const Step step(place_, i);
            property(value[i], entry);
        }
    }

    void number(const json& value, double min, double max) const
    {
        expect(value.is_number(), "should be a number");
        const auto number = value.get<double>();
        expect(number >= min && number <= max, fmt::format("is {}, outside {} to {}", number, min, max));
    }

    void integer(json& value, double min, double max) const
    {
        expect(value.is_number(), "should be an integer");
        const auto number = value.get<double>();
        expect(std::floor(number) == number, fmt::format("is {}, not an integer", number));
        expect(number >= min && number <= max, fmt::format("is {}, outside {} to {}", number, min, max));
        if (value.is_number_float()) {
            value = static_cast<int64_t>(number);
        }
    }

    /// Checks an index. `target` is the path from the root to the array, such as
    /// "extensions/KHR_lights_punctual/lights".
    void index(json& value, const std::string& target) const
    {
        integer(value, -max_count, max_count);
        const json::json_pointer pointer("/" + target);
        const size_t count = root_.contains(pointer) ? root_.at(pointer).size() : 0;
        const auto at = value.get<int64_t>();
        expect(at >= 0 && static_cast<uint64_t>(at) < count,
               fmt::format("index {} is outside \"{}\", which has {}", at, target, count));
    }

    void choice(const json& value, const std::string& allowed) const
    {
        const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
        const bool known = !text.empty() && text.find(' ') == std::string::npos &&
                           (" " + allowed + " ").find(" " + text + " ") != std::string::npos;
        expect(known, fmt::format("is {}, not one of: {}", value.dump(-1, ' ', true).substr(0, 80), allowed));
    }

    void index_map(json& value, const std::string& target)
    {
        expect(value.is_object(), "should be an object");
        for (auto& [key, entry] : value.items()) {
            const Step step(place_, key);
            index(entry, target);
        }
    }

    const json& root_;
    std::string place_;
};

/// Checks that a camera has the object (perspective or orthographic) that the camera's type names.
void check_cameras(const json& document, const std::string& file)
{
    const json cameras = document.value("cameras", json::array());
    for (size_t i = 0; i < cameras.size(); ++i) {
        const auto type = cameras[i]["type"].get<std::string>();
        if (!cameras[i].contains(type)) {
            throw Error(fmt::format("lacks \"{}\"", type), fmt::format("{}#/cameras/{}", file, i));
        }
    }
}

void check_strides(const json& document, const std::string& file)
{
    const json views = document.value("bufferViews", json::array());
    for (size_t i = 0; i < views.size(); ++i) {
        const int stride = views[i].value("byteStride", 0);
        if (stride % 4 != 0) {
            throw Error(fmt::format("is {}, not a multiple of 4", stride),
                        fmt::format("{}#/bufferViews/{}/byteStride", file, i));
        }
    }
}

} // namespace

void check_document(json& document, const std::string& file)
{
    Checker(document, file).object(document, "root");
    check_cameras(document, file);
    check_strides(document, file);
}

} // namespace estampe::gltf
