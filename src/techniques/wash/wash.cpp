// SPDX-License-Identifier: MIT
#include "techniques/wash/wash.hpp"

#include "shaders/wash_comp.hpp"
#include "style/parameter.hpp"
#include "techniques/wash/wash.glsl.h"

namespace estampe::wash {

namespace {

/// Adds a pass that paints the surfaces of one style variant over the wash of the previous variants.
gpu::ImageId add_variant(gpu::Graph& graph, const WashInputs& in, const WashVariant& variant, uint32_t number,
                         std::optional<gpu::ImageId> before)
{
    const WashStyle& style = variant.style;
    auto pass = graph.compute("wash", shaders::wash_comp);
    pass.uniform(in.frame).sample(in.draw).sample(in.depth).sample(in.color).sample(in.light);
    pass.sample(in.draws).sample(in.materials).sample(in.background).sample(in.screen);
    const gpu::ImageId wash =
        before
            ? pass.modify(*before)
            : pass.write(graph.image(
                  "wash", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba16f}));
    pass.sample(in.variant_of_draw.value_or(in.draws), gpu::Format::r32ui);
    pass.sample(in.shade.value_or(in.color));
    pass.variant((style.air > 0.0F ? shared::wash_has_air : 0U) |
                 (in.has_screen ? shared::wash_has_screen : 0U) |
                 (in.has_background ? shared::wash_has_background : 0U) |
                 (before ? shared::wash_is_of_one_variant : 0U) |
                 (in.keeps_cover ? shared::wash_keeps_cover : 0U) | (in.shade ? shared::wash_has_shade : 0U));
    pass.push(shared::WashConstants{.tone = variant.tone,
                                    .shadow_tint = style.shadow_tint,
                                    .shadow_from = style.shadow_from,
                                    .softness = style.softness,
                                    .ground_shadow = style.ground_shadow,
                                    .detail = style.detail,
                                    .least = style.least,
                                    .strength = style.strength,
                                    .neutral = style.neutral,
                                    .saturation = style.saturation,
                                    .light_tint = style.light_tint,
                                    .air = style.air,
                                    .air_color = style.air_color,
                                    .air_distance_m = style.air_distance_m,
                                    .spot_color = style.spot_color,
                                    .spot = style.spot,
                                    .style_variant = number})
        .dispatch_over_page(in.size_px.x, in.size_px.y);
    return wash;
}

} // namespace

gpu::ImageId add_wash(gpu::Graph& graph, const WashInputs& in, const std::vector<WashVariant>& variants)
{
    std::optional<gpu::ImageId> wash;
    for (uint32_t variant = 0; variant < variants.size(); ++variant) {
        wash = add_variant(graph, in, variants[variant], variant, wash);
    }
    return wash.value();
}

const style::Table<WashStyle>& wash_table()
{
    static const auto table =
        style::Table<WashStyle>("wash", "Wash: flat colour by material, cooler in shadow")
            .number("strength", &WashStyle::strength, {0.0F, 1.0F}, "",
                    "Strength of the colour that is painted below the ink: 0 leaves the paper bare, 1 is "
                    "full colour")
            .number("neutral", &WashStyle::neutral, {0.0F, 1.0F}, "",
                    "How strongly grey things are painted, as a share of wash.strength. 0 leaves grey things "
                    "white, 1 paints greys as strongly as colours.")
            .number("saturation", &WashStyle::saturation, {0.0F, 1.0F}, "",
                    "Saturation of the painted colours: 0 paints greys, 1 paints the full colours of the "
                    "materials")
            .number("detail", &WashStyle::detail, {0.0F, 1.0F}, "",
                    "How much texture the painted colour shows: 0 is one flat colour per material, 1 its "
                    "whole texture")
            .number("least", &WashStyle::least, {0.0F, 1.0F}, "",
                    "Smallest brightness of painted colours, as a share of white. More paints dark things "
                    "paler, so that strokes alone show how dark these things are.")
            .color(
                "shadow_tint", &WashStyle::shadow_tint,
                "Colour that painted colours are multiplied by in shadow: a bluish grey makes shadows cooler")
            .number("shadow_from", &WashStyle::shadow_from, {0.0F, 1.0F}, "",
                    "Darkness above which painted colours take on wash.shadow_tint. Less gives larger shadow "
                    "areas, more gives smaller ones.")
            .number(
                "softness", &WashStyle::softness, {0.001F, 0.5F}, "",
                "Softness of the edge of shadows in painted colours: less is a crisp step, more is gradual")
            .number("ground_shadow", &WashStyle::ground_shadow, {0.0F, 1.0F}, "",
                    "Strength of shadows on the blank ground below the scene. 0 leaves the ground white, 1 "
                    "paints the shadow in the full colour of wash.shadow_tint.")
            .number("light_tint", &WashStyle::light_tint, {0.0F, 1.0F}, "",
                    "How much the colour of light changes the painted colours. 0 treats all light as white, "
                    "1 takes on the full colour of the light.")
            .number("spot", &WashStyle::spot, {0.0F, 1.0F}, "",
                    "How far all colours are printed in one ink, wash.spot_color: more ink where a colour is "
                    "darker. 0 keeps the colours, 1 prints the ink alone.")
            .color("spot_color", &WashStyle::spot_color,
                   "Colour of the ink in which colours are printed. Only used when wash.spot is above 0.")
            .file_or_name(
                "shade_texture", &WashStyle::shade_texture, {shade_of_material, no_shade},
                "Picture of the colours that surfaces have in the shade, in place of wash.shadow_tint. "
                "material: as in the scene's file (MToon); none: no picture; or a picture file, "
                "placed on the surface like its base colour.")
            .choice(
                "shade_step", &WashStyle::shade_step,
                {{"material", ShadeStep::material}, {"wash", ShadeStep::wash}},
                "What decides where a surface with wash.shade_texture is in the shade. material: the step "
                "of an MToon material under the sun; wash, or without such a step: wash.shadow_from and "
                "wash.softness.")
            .by_surface_but({});
    return table;
}

} // namespace estampe::wash
