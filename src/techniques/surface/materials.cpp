// SPDX-License-Identifier: MIT
#include "techniques/surface/materials.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/color.hpp"
#include "gpu/resources.hpp"
#include "techniques/surface/mips.hpp"

namespace estampe::surface {
namespace {

size_t class_of(const Image& image)
{
    const uint32_t side = std::max(image.width, image.height);
    size_t size_class = 0;
    while (size_class + 1 < texture_class_px.size() && texture_class_px[size_class] < side) {
        ++size_class;
    }
    return size_class;
}

/// Finds a class of texture sizes with a free layer: `wanted` if possible, else the next smaller class, else
/// a larger class. Returns the number of classes if no class has a free layer.
size_t class_with_room(const TexturePlan& plan, size_t wanted, uint32_t most_layers)
{
    const auto has_room = [&](size_t size_class) { return plan.layers[size_class].size() < most_layers; };
    for (size_t size_class = wanted + 1; size_class > 0; --size_class) {
        if (has_room(size_class - 1)) {
            return size_class - 1;
        }
    }
    while (wanted < texture_class_px.size() && !has_room(wanted)) {
        ++wanted;
    }
    return wanted;
}

shared::TextureSlot slot(const Scene& scene, const TexturePlan& plan, const TextureRef& reference,
                         float strength = 1.0F)
{
    shared::TextureSlot result{
        .location = shared::no_texture, .column_u = {1, 0}, .column_v = {0, 1}, .strength = strength};
    if (reference.texture == no_index || plan.location[reference.texture] == shared::no_texture) {
        return result;
    }
    const Texture& texture = scene.textures[reference.texture];
    result.location = plan.location[reference.texture] | std::min(reference.uv_set, 1U) << 24U |
                      static_cast<uint32_t>(texture.wrap_u) << 25U |
                      static_cast<uint32_t>(texture.wrap_v) << 27U;
    result.column_u = glm::vec2(reference.uv_transform[0]);
    result.column_v = glm::vec2(reference.uv_transform[1]);
    result.offset = glm::vec2(reference.uv_transform[2]);
    return result;
}

float linear(uint8_t encoded)
{
    return linear_from_srgb(static_cast<float>(encoded) / 255.0F);
}

/// The occlusion texture of a material; empty if the material is unlit or the texture's strength is zero.
TextureRef occlusion_of(const Material& material)
{
    return material.unlit || material.occlusion_strength <= 0.0F ? TextureRef{} : material.occlusion_texture;
}

uint32_t flags_of(const Material& material)
{
    return (material.unlit ? shared::material_unlit : 0U) |
           (material.emissive != glm::vec3(0.0F) ? shared::material_emissive : 0U);
}

/// The second texture of a toon material, for the shade; empty if the material has none.
TextureRef shade_of(const Material& material)
{
    return material.toon ? material.toon->shade_texture : TextureRef{};
}

} // namespace

glm::vec3 mean_color(const Image& image)
{
    const size_t texels = static_cast<size_t>(image.width) * image.height;
    // An odd stride avoids reading only one column of the texture.
    const size_t stride = std::max<size_t>(1, texels / 4096) | 1U;
    glm::vec4 sum(0.0F);
    for (size_t i = 0; i < texels; i += stride) {
        const uint8_t* texel = &image.rgba[4 * i];
        const float alpha = static_cast<float>(texel[3]) / 255.0F;
        sum += glm::vec4(alpha * glm::vec3(linear(texel[0]), linear(texel[1]), linear(texel[2])), alpha);
    }
    return sum.w > 0.0F ? glm::vec3(sum) / sum.w : glm::vec3(1.0F);
}

TexturePlan plan_textures(const Scene& scene, uint32_t most_layers)
{
    TexturePlan plan;
    plan.location.assign(scene.textures.size(), shared::no_texture);
    std::set<Index> left_out;
    const auto use = [&](const TextureRef& reference) {
        if (reference.texture == no_index || plan.location[reference.texture] != shared::no_texture) {
            return;
        }
        const Image& image = scene.textures[reference.texture].image;
        const size_t size_class = class_with_room(plan, class_of(image), most_layers);
        if (size_class == texture_class_px.size()) {
            left_out.insert(reference.texture);
            return;
        }
        plan.reduced += texture_class_px[size_class] < std::max(image.width, image.height) ? 1 : 0;
        auto& layers = plan.layers[size_class];
        plan.location[reference.texture] =
            static_cast<uint32_t>(size_class) | static_cast<uint32_t>(layers.size()) << 4U;
        layers.push_back(reference.texture);
    };
    for (const Material& material : scene.materials) {
        use(material.base_color_texture);
        use(material.normal_texture);
        use(occlusion_of(material));
        use(shade_of(material));
    }
    plan.left_out = static_cast<uint32_t>(left_out.size());
    return plan;
}

std::vector<std::string> notes_of(const TexturePlan& plan)
{
    std::vector<std::string> notes;
    if (plan.reduced > 0) {
        notes.push_back(fmt::format("{} of the scene's textures are drawn smaller than they are: the device "
                                    "takes up to {} px, and so many of a size",
                                    plan.reduced, texture_class_px.back()));
    }
    if (plan.left_out > 0) {
        notes.push_back(fmt::format(
            "{} of the scene's textures are left out: the device has no room for so many", plan.left_out));
    }
    return notes;
}

SceneNeeds scene_needs(const Scene& scene, const TexturePlan& plan)
{
    SceneNeeds needs;
    for (size_t size_class = 0; size_class < plan.layers.size(); ++size_class) {
        needs.texture_classes |= plan.layers[size_class].empty() ? 0U : 1U << size_class;
    }
    for (const Material& material : scene.materials) {
        needs.normal_maps |= material.normal_texture.texture != no_index;
        const TextureRef occlusion = occlusion_of(material);
        needs.occlusion |= occlusion.texture != no_index;
        needs.second_uvs |= material.normal_texture.uv_set != 0 || material.base_color_texture.uv_set != 0 ||
                            occlusion.uv_set != 0;
        needs.own_outlines |= material.toon && material.toon->outline_width_m > 0.0F;
        needs.emissive |= material.emissive != glm::vec3(0.0F);
    }
    needs.moves = !scene.animations.empty() || !scene.skins.empty();
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            needs.moves |= !primitive.morph_targets.empty();
            needs.vertex_colors |= !primitive.colors.empty();
        }
    }
    return needs;
}

std::vector<shared::MaterialRecord> material_records(const Scene& scene, const TexturePlan& plan)
{
    std::vector<shared::MaterialRecord> records;
    for (const Material& material : scene.materials) {
        const TextureRef& base = material.base_color_texture;
        const glm::vec3 mean =
            base.texture != no_index ? mean_color(scene.textures[base.texture].image) : glm::vec3(1.0F);
        records.push_back(
            {.base_color = material.base_color,
             .mean_color = glm::vec3(material.base_color) * mean,
             .flags = flags_of(material),
             .shade_color = material.toon ? material.toon->shade_color : glm::vec3(1.0F),
             .alpha_cutoff =
                 material.alpha_mode == AlphaMode::blend ? shared::least_cover : material.alpha_cutoff,
             .outline_color = material.toon ? material.toon->outline_color : glm::vec3(0.0F),
             .outline_width_m = material.toon ? material.toon->outline_width_m : 0.0F,
             .emissive = material.emissive,
             .base_texture = slot(scene, plan, base),
             .normal_texture = slot(scene, plan, material.normal_texture, material.normal_scale),
             .occlusion_texture = slot(scene, plan, occlusion_of(material), material.occlusion_strength)});
    }
    const shared::TextureSlot none{.location = shared::no_texture};
    records.push_back({.base_color = glm::vec4(1.0F),
                       .mean_color = glm::vec3(1.0F),
                       .flags = shared::material_paper,
                       .shade_color = glm::vec3(1.0F),
                       .base_texture = none,
                       .normal_texture = none,
                       .occlusion_texture = none});
    return records;
}

std::vector<shared::ShadeRecord> shade_records(const Scene& scene, const TexturePlan& plan)
{
    const auto is_drawn = [&](const Material& material) {
        const Index texture = shade_of(material).texture;
        return texture != no_index && plan.location[texture] != shared::no_texture;
    };
    std::vector<shared::ShadeRecord> records;
    if (std::ranges::none_of(scene.materials, is_drawn)) {
        return records;
    }
    for (const Material& material : scene.materials) {
        shared::ShadeRecord& record = records.emplace_back(shared::ShadeRecord{});
        if (is_drawn(material)) {
            const ToonShade& toon = *material.toon;
            record.texture = slot(scene, plan, toon.shade_texture);
            record.color = toon.shade_color;
            record.flags = shared::shade_is_there | shared::shade_has_step;
            record.mean_color =
                toon.shade_color * mean_color(scene.textures[toon.shade_texture.texture].image);
            record.step_from = toon.shade_toony - 1.0F - toon.shade_shift;
            record.step_to = 1.0F - toon.shade_toony - toon.shade_shift;
        }
    }
    return records;
}

gpu::Image upload_pictures(gpu::Device& device, std::vector<Image> pictures)
{
    if (pictures.size() > device.limits().maxImageArrayLayers) {
        throw Error(fmt::format("the style names {} pictures of shaded surfaces", pictures.size()), {},
                    fmt::format("the device holds up to {}", device.limits().maxImageArrayLayers));
    }
    Scene scene;
    std::vector<Index> layers;
    size_t size_class = 0;
    for (Image& picture : pictures) {
        size_class = std::max(size_class, class_of(picture));
        layers.push_back(static_cast<Index>(layers.size()));
        scene.textures.push_back({.image = std::move(picture)});
    }
    const uint32_t side = texture_class_px[size_class];
    gpu::Image image(device, "pictures",
                     {.width = side,
                      .height = side,
                      .format = gpu::Format::rgba8,
                      .layers = static_cast<uint32_t>(layers.size()),
                      .mips = static_cast<uint32_t>(std::bit_width(side))},
                     true);
    MipQueue queue(scene, layers, side);
    gpu::upload_layers(device, image, [&](uint32_t layer) { return queue.take(layer); });
    return image;
}

MaterialBuffers upload_materials(gpu::Device& device, const Scene& scene, const TexturePlan& plan)
{
    MaterialBuffers buffers;
    buffers.records = material_records(scene, plan);
    buffers.shades = shade_records(scene, plan);
    buffers.materials = gpu::upload_buffer(device, "materials", buffers.records);
    for (size_t size_class = 0; size_class < texture_class_px.size(); ++size_class) {
        const std::vector<Index>& layers = plan.layers[size_class];
        const uint32_t side = layers.empty() ? 1 : texture_class_px[size_class];
        const gpu::ImageDesc desc{.width = side,
                                  .height = side,
                                  .format = gpu::Format::rgba8,
                                  .layers = std::max<uint32_t>(1, static_cast<uint32_t>(layers.size())),
                                  .mips = static_cast<uint32_t>(std::bit_width(side))};
        gpu::Image& image = buffers.textures[size_class];
        image = gpu::Image(device, "textures", desc, true);
        MipQueue queue(scene, layers, side);
        gpu::upload_layers(device, image, [&](uint32_t layer) { return queue.take(layer); });
    }
    return buffers;
}

void recolor(gpu::Device& device, MaterialBuffers& buffers, Index material, const glm::vec3& color)
{
    shared::MaterialRecord& record = buffers.records.at(material);
    record.base_color = glm::vec4(color, record.base_color.w);
    record.mean_color = color;
    buffers.materials = gpu::upload_buffer(device, "materials", buffers.records);
}

std::array<gpu::ImageId, 5> import_textures(gpu::Graph& graph, MaterialBuffers& materials)
{
    const auto import = [&](size_t i) {
        return gpu::import_uploaded(graph, "textures", materials.textures[i]);
    };
    return {import(0), import(1), import(2), import(3), import(4)};
}

} // namespace estampe::surface
