// SPDX-License-Identifier: MIT
#include "techniques/occlusion/occlusion.hpp"

#include <cmath>

#include "shaders/backs_comp.hpp"
#include "shaders/horizon_backs_comp.hpp"
#include "shaders/horizon_comp.hpp"
#include "shaders/horizon_page_comp.hpp"
#include "shaders/horizon_smooth_comp.hpp"
#include "style/parameter.hpp"
#include "techniques/occlusion/alternatives/discs.hpp"
#include "techniques/occlusion/alternatives/unsharp.hpp"
#include "techniques/occlusion/horizon/horizon.glsl.h"

namespace estampe::occlusion {

const style::Table<OcclusionStyle>& occlusion_table()
{
    static const auto table =
        style::Table<OcclusionStyle>("occlusion", "Ambient occlusion: corners and narrow gaps are darker")
            .toggle("enabled", &OcclusionStyle::enabled,
                    "Turns ambient occlusion on: corners, folds and places where things touch are darker")
            .choice("method", &OcclusionStyle::method,
                    {{"horizon", Method::horizon},
                     {"discs", Method::discs},
                     {"splats", Method::splats},
                     {"uv", Method::uv},
                     {"unsharp", Method::unsharp}},
                    "How the darkness of corners (ambient occlusion) is computed. horizon: from visible "
                    "surfaces; discs, splats, uv: also from hidden surfaces, per point of the model, per "
                    "pixel, or in a texture; unsharp: darkens the background at edges.")
            .choice("feeds", &OcclusionStyle::feeds,
                    {{"ambient", Feeds::ambient}, {"tone", Feeds::tone}, {"layer", Feeds::layer}},
                    "Which light is darkened in corners (ambient occlusion). ambient: light from all "
                    "directions and fill light; tone: all light; layer: no light in the picture, only the "
                    "separate layer \"occlusion\" shows the dark corners.")
            .number(
                "radius_m", &OcclusionStyle::radius_m, {0.0F, 1e6F}, "m",
                "Largest distance between two surfaces at which one still darkens the other (ambient "
                "occlusion). More gives wider dark areas in corners. 0 uses a fifth of the scene's radius.")
            .number("reach_mm", &OcclusionStyle::reach_mm, {0.1F, 200.0F}, "mm",
                    "Largest distance on the page over which corners darken their surroundings (ambient "
                    "occlusion). Near the camera, occlusion.radius_m is limited to this length: less keeps "
                    "dark areas narrow in close-ups.")
            .number("thickness", &OcclusionStyle::thickness, {0.01F, 4.0F}, "",
                    "Thickness that all objects are assumed to have, as a share of the radius of dark "
                    "corners. Less keeps the surroundings of thin objects light, more darkens them. Only "
                    "used when occlusion.method is horizon.")
            .choice("thickness_from", &OcclusionStyle::thickness_from,
                    {{"guess", ThicknessFrom::guess}, {"back_faces", ThicknessFrom::back_faces}},
                    "How thick the objects that darken corners are. guess: as thick as "
                    "occlusion.thickness says; back_faces: from front to back of each object, which is "
                    "slower. Only used when occlusion.method is horizon.")
            .number("strength", &OcclusionStyle::strength, {0.0F, 8.0F}, "",
                    "Strength of ambient occlusion (darker corners). 0 has no effect, 1 is physically right, "
                    "more is darker.")
            .number("bleeding", &OcclusionStyle::bleeding, {0.0F, 4.0F}, "",
                    "How much coloured light surfaces reflect into the corners beside them. 0 is none, 1 is "
                    "as much as an evenly lit surface reflects, more is more colourful. Only used when "
                    "occlusion.method is discs, splats or uv.")
            .integer("texels", &OcclusionStyle::texels, {64, 4096}, "texels",
                     "Width and height of the texture (image) that stores how dark corners are. More shows "
                     "finer detail and is slower. Meshes with overlapping UVs (texture coordinates) get new "
                     "UVs. Only used when occlusion.method is uv.");
    return table;
}

namespace {

shared::HorizonConstants constants_of(const OcclusionInputs& in, const OcclusionStyle& style)
{
    const HalfPage half = half_page(in);
    return {.radius_m = in.radius_m,
            .reach_px = style.reach_mm * in.pixels_per_mm,
            .thickness = style.thickness,
            .strength = style.strength,
            .from_half = half.from_half,
            .half_px = half.half_px};
}

} // namespace

float radius_of(const OcclusionStyle& style, float scene_radius_m)
{
    return style.radius_m > 0.0F ? style.radius_m : 0.2F * scene_radius_m;
}

uint32_t reach_px(const OcclusionStyle& style, float pixels_per_mm)
{
    // Additional reach of smoothing, which reads up to four pixels of the half page (every second pixel)
    // beyond the radius.
    constexpr uint32_t smoothed_px = 8;
    return style.enabled ? static_cast<uint32_t>(std::ceil(style.reach_mm * pixels_per_mm)) + smoothed_px
                         : 0U;
}

std::optional<uint32_t> map_texels(const OcclusionStyle& style)
{
    return style.enabled && style.method == Method::uv ? std::optional(style.texels) : std::nullopt;
}

bool needs_behind(const OcclusionStyle& style)
{
    return style.enabled && style.method == Method::horizon &&
           style.thickness_from == ThicknessFrom::back_faces;
}

struct Memory::Kept {
    DiscBuffers discs;
    DiscMapBuffers disc_map;
};

Memory::Memory() : kept_(std::make_unique<Kept>()) {}

Memory::~Memory() = default;

bool Memory::lacks_surfaces(const OcclusionStyle& style) const
{
    return style.enabled && has_discs(style.method) && kept_->discs.empty();
}

void Memory::set_surfaces(gpu::Device& device, const OccluderMesh& surfaces)
{
    DiscList list = list_discs(surfaces.places, surfaces.unit_m, surfaces.triangles);
    color_discs(list, surfaces.color_of_vertex);
    kept_->discs = upload_discs(device, list, static_cast<uint32_t>(surfaces.places.size()));
}

void Memory::ensure(gpu::Device& device, const OcclusionStyle& style)
{
    const std::optional<uint32_t> size = map_texels(style);
    if (size && kept_->disc_map.size != *size) {
        kept_->disc_map = make_disc_map(device, *size);
    }
}

void Memory::forget_surfaces()
{
    *kept_ = {};
}

void Memory::forget_pose()
{
    kept_->discs.is_found = false;
    kept_->disc_map.is_found = false;
}

std::optional<AmbientOcclusion> add_occlusion(gpu::Graph& graph, Memory& memory, const OcclusionInputs& in,
                                              const OcclusionStyle& style)
{
    if (has_discs(style.method)) {
        return add_disc_occlusion(graph, memory.kept_->discs, memory.kept_->disc_map, in, style);
    }
    return style.method == Method::unsharp ? add_unsharp(graph, in, style) : add_horizon(graph, in, style);
}

namespace {

/// Adds a pass that writes the depth at which the view ray leaves the visible body, or 0 for open sheets.
gpu::ImageId add_backs(gpu::Graph& graph, const OcclusionInputs& in)
{
    auto pass = graph.compute("occlusion/backs", shaders::backs_comp);
    pass.uniform(in.frame).sample(in.surfaces->visibility, gpu::Format::rg32ui);
    pass.sample(*in.surfaces->behind, gpu::Format::rg32ui);
    pass.sample(in.surfaces->triangles).sample(in.surfaces->posed_vertices);
    const gpu::ImageId backs = pass.write(graph.image(
        "occlusion/backs", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r32f}));
    pass.dispatch_over_page(in.size_px.x, in.size_px.y);
    return backs;
}

} // namespace

AmbientOcclusion add_horizon(gpu::Graph& graph, const OcclusionInputs& in, const OcclusionStyle& style)
{
    const shared::HorizonConstants constants = constants_of(in, style);
    const auto half_image = [&](const char* name) {
        return graph.image(
            name,
            {.width = constants.half_px.x, .height = constants.half_px.y, .format = gpu::Format::rg32ui});
    };
    const bool has_backs = in.surfaces && in.surfaces->behind;
    const std::optional<gpu::ImageId> backs = has_backs ? std::optional(add_backs(graph, in)) : std::nullopt;
    auto looking = graph.compute("occlusion", backs ? shaders::horizon_backs_comp : shaders::horizon_comp);
    looking.uniform(in.frame).sample(in.depth).sample(in.normal);
    if (backs) {
        looking.sample(*backs);
    }
    gpu::ImageId open = looking.write(half_image("occlusion/half"));
    looking.push(constants).dispatch_over(constants.half_px.x, constants.half_px.y);
    for (const uint32_t is_upright : {0U, 1U}) {
        auto smoothing = graph.compute(is_upright != 0 ? "occlusion/columns" : "occlusion/rows",
                                       shaders::horizon_smooth_comp);
        smoothing.uniform(in.frame).sample(in.normal).sample(open);
        open = smoothing.write(half_image("occlusion/smooth"));
        smoothing.variant(is_upright).push(constants).dispatch_over(constants.half_px.x, constants.half_px.y);
    }
    auto pass = graph.compute("occlusion/page", shaders::horizon_page_comp);
    pass.uniform(in.frame).sample(in.depth).sample(in.normal).sample(open);
    const gpu::ImageId page = pass.write(graph.image(
        "occlusion/open", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r16f}));
    pass.push(constants).dispatch_over_page(in.size_px.x, in.size_px.y);
    return {.visibility = page, .bounced = std::nullopt};
}

} // namespace estampe::occlusion
