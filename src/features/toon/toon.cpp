// SPDX-License-Identifier: MIT
#include "features/toon/toon.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include <estampe/image.hpp>

#include "gpu/resources.hpp"

namespace estampe::features {
namespace {

bool is_picture(const wash::WashStyle& style)
{
    return style.shade_texture != wash::shade_of_material && style.shade_texture != wash::no_shade &&
           !style.shade_texture.empty();
}

const wash::WashStyle& wash_of(const StyleVariants& variants, size_t draw)
{
    return (variants.has_several() ? variants.styles[variants.variant_of_draw[draw]]
                                   : variants.styles.front())
        .wash;
}

bool are_equal(const std::vector<shared::ShadeRecord>& a, const std::vector<shared::ShadeRecord>& b)
{
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(shared::ShadeRecord)) == 0);
}

} // namespace

void Toon::invalidate(Event event)
{
    if (event == Event::scene_replaced || event == Event::layout_replaced) {
        records_before_.clear();
    }
}

void Toon::ensure_pictures(gpu::Device& device, const StyleVariants& variants)
{
    const auto is_loaded = [&](const StyleTables& style) {
        return !is_picture(style.wash) ||
               std::ranges::find(pictures_, style.wash.shade_texture, &Picture::path) != pictures_.end();
    };
    const auto is_wanted = [&](const Picture& picture) {
        return std::ranges::any_of(variants.styles, [&](const StyleTables& style) {
            return style.wash.shade_texture == picture.path;
        });
    };
    if (std::ranges::all_of(variants.styles, is_loaded) && std::ranges::all_of(pictures_, is_wanted)) {
        return;
    }
    pictures_.clear();
    picture_layers_ = {};
    std::vector<Picture> pictures;
    std::vector<Image> images;
    for (const StyleTables& style : variants.styles) {
        const std::string& path = style.wash.shade_texture;
        if (is_picture(style.wash) && std::ranges::find(pictures, path, &Picture::path) == pictures.end()) {
            images.push_back(load_image(path, style.wash.scope));
            pictures.push_back({.path = path, .mean_color = surface::mean_color(images.back())});
        }
    }
    if (!images.empty()) {
        picture_layers_ = surface::upload_pictures(device, std::move(images));
    }
    pictures_ = std::move(pictures);
}

shared::ShadeRecord Toon::record_of(const ToonInputs& in, size_t draw) const
{
    const Index material = in.layout.draws[draw].material;
    const wash::WashStyle& style = wash_of(in.variants, draw);
    const bool is_ground = draw >= in.layout.sources.size();
    shared::ShadeRecord record{};
    if (is_ground || style.shade_texture == wash::no_shade) {
        return record;
    }
    if (!in.materials.shades.empty()) {
        record = in.materials.shades.at(material);
    }
    if (is_picture(style)) {
        if ((in.layout.draws[draw].flags & shared::draw_has_uv) == 0) {
            return shared::ShadeRecord{};
        }
        const auto picture = std::ranges::find(pictures_, style.shade_texture, &Picture::path);
        const auto layer = static_cast<uint32_t>(picture - pictures_.begin());
        // The picture is placed like the base colour's texture: with its UV set, transform and wrap modes.
        constexpr uint32_t place_mask = 0xff000000U;
        record.texture = in.materials.records.at(material).base_texture;
        const uint32_t place =
            record.texture.location == shared::no_texture ? 0U : record.texture.location & place_mask;
        record.texture.location = shared::shade_picture_class | layer << 4U | place;
        record.color = glm::vec3(1.0F);
        record.mean_color = picture->mean_color;
        record.flags |= shared::shade_is_there;
    }
    record.detail = style.detail;
    if (style.shade_step == wash::ShadeStep::wash) {
        record.flags &= ~shared::shade_has_step;
    }
    return record;
}

ToonPlan Toon::ensure(gpu::Device& device, const ToonInputs& in, std::vector<std::string>& notes)
{
    const bool is_painted = std::ranges::any_of(
        in.variants.styles, [](const StyleTables& style) { return style.wash.strength > 0.0F; });
    if (!is_painted) {
        return {};
    }
    ensure_pictures(device, in.variants);
    if (in.materials.shades.empty() && pictures_.empty()) {
        return {};
    }
    ToonPlan plan;
    size_t without_uvs = 0;
    records_.clear();
    for (size_t draw = 0; draw < in.layout.draws.size(); ++draw) {
        const shared::ShadeRecord& record = records_.emplace_back(record_of(in, draw));
        plan.is_drawn |= (record.flags & shared::shade_is_there) != 0;
        plan.has_steps |= in.has_sun && (record.flags & shared::shade_has_step) != 0;
        without_uvs += draw < in.layout.sources.size() && is_picture(wash_of(in.variants, draw)) &&
                               (in.layout.draws[draw].flags & shared::draw_has_uv) == 0
                           ? 1
                           : 0;
    }
    if (without_uvs > 0) {
        notes.push_back(fmt::format("wash.shade_texture does not show on {} of the scene's {} meshes, which "
                                    "have no UVs",
                                    without_uvs, in.layout.sources.size()));
    }
    if (plan.is_drawn && !are_equal(records_, records_before_)) {
        record_buffer_ = gpu::upload_buffer(device, "shade records", records_);
        std::swap(records_, records_before_);
    }
    return plan;
}

} // namespace estampe::features
