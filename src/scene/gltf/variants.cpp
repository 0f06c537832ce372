// SPDX-License-Identifier: MIT
#include "scene/gltf/variants.hpp"

#include <algorithm>

namespace estampe::gltf {
namespace {

constexpr auto extension_name = "KHR_materials_variants";

} // namespace

std::vector<Index> variant_materials(Data& data, const tinygltf::Primitive& source,
                                     const std::string& pointer)
{
    const auto found = source.extensions.find(extension_name);
    if (found == source.extensions.end()) {
        return {};
    }
    const tinygltf::Value& mappings = found->second.Get("mappings");
    const size_t count = data.variants().size();
    data.spend(count * sizeof(Index), pointer);
    std::vector<Index> materials(count, no_index);
    for (size_t i = 0; i < mappings.ArrayLen(); ++i) {
        const tinygltf::Value& mapping = mappings.Get(static_cast<int>(i));
        const tinygltf::Value& variants = mapping.Get("variants");
        for (size_t v = 0; v < variants.ArrayLen(); ++v) {
            const auto variant = static_cast<size_t>(variants.Get(static_cast<int>(v)).GetNumberAsInt());
            if (materials[variant] != no_index) {
                data.warn(fmt::format("{}/extensions/{}/mappings/{}", pointer, extension_name, i),
                          fmt::format("variant {} has a material already, which it keeps", variant));
                continue;
            }
            materials[variant] = static_cast<Index>(mapping.Get("material").GetNumberAsInt());
        }
    }
    const bool changes = std::ranges::any_of(materials, [](Index material) { return material != no_index; });
    return changes ? materials : std::vector<Index>();
}

} // namespace estampe::gltf
