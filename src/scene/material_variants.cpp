// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>

namespace estampe {
namespace {

size_t find_variant(const Scene& scene, const std::string& variant)
{
    const auto named = std::ranges::find(scene.variants, variant);
    if (named != scene.variants.end()) {
        return static_cast<size_t>(named - scene.variants.begin());
    }
    size_t number = 0;
    const char* const end = variant.data() + variant.size();
    const auto [stop, problem] = std::from_chars(variant.data(), end, number);
    if (problem == std::errc{} && stop == end && number < scene.variants.size()) {
        return number;
    }
    if (scene.variants.empty()) {
        throw Error(fmt::format("no variant \"{}\": the scene has no material variants", variant), scene.name,
                    "leave the variant out");
    }
    std::string list;
    for (size_t i = 0; i < scene.variants.size(); ++i) {
        list += fmt::format("{}{} \"{}\"", i == 0 ? "" : ", ", i, scene.variants[i]);
    }
    throw Error(fmt::format("no variant \"{}\"", variant), scene.name, "variants of the scene: " + list);
}

} // namespace

void apply_variant(Scene& scene, const std::string& variant)
{
    const bool is_default = variant.empty();
    const size_t number = is_default ? 0 : find_variant(scene, variant);
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            if (primitive.default_material == no_index) {
                primitive.default_material = primitive.material;
            }
            const bool is_mapped = !is_default && number < primitive.variant_materials.size() &&
                                   primitive.variant_materials[number] < scene.materials.size();
            primitive.material = is_mapped ? primitive.variant_materials[number] : primitive.default_material;
        }
    }
}

} // namespace estampe
