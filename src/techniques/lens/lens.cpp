// SPDX-License-Identifier: MIT
#include "techniques/lens/lens.hpp"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "shaders/lens_apply_comp.hpp"
#include "shaders/lens_gather_comp.hpp"
#include "shaders/lens_ink_across_comp.hpp"
#include "shaders/lens_ink_comp.hpp"
#include "shaders/lens_level_comp.hpp"
#include "shaders/lens_pack_comp.hpp"
#include "shaders/lens_reach_comp.hpp"
#include "shaders/lens_strokes_comp.hpp"
#include "shaders/lens_tiles_comp.hpp"
#include "style/parameter.hpp"
#include "techniques/lens/alternatives/blurs.hpp"

namespace estampe::lens {

const style::Table<LensStyle>& lens_table()
{
    static const auto table =
        style::Table<LensStyle>("lens", "Depth of field: a lens that is sharp at one distance")
            .toggle("enabled", &LensStyle::enabled,
                    "Turns depth of field on: things nearer or farther than the focus are blurred")
            .choice("mode", &LensStyle::mode,
                    {{"gather", Mode::gather},
                     {"separable", Mode::separable},
                     {"mips", Mode::mips},
                     {"sums", Mode::sums},
                     {"circles", Mode::circles}},
                    "How the blur of things out of focus is computed. gather: best, with clean edges; "
                    "separable: Gaussian (soft) blur; mips, sums: quicker, but blur runs over edges; "
                    "circles: shows the blur's size, red in front of the focus, blue behind.")
            .choice("acts_on", &LensStyle::acts_on,
                    {{"picture", ActsOn::picture}, {"wash", ActsOn::wash}, {"strokes", ActsOn::strokes}},
                    "What the lens blurs. picture: colour, strokes and lines together; wash: colour alone; "
                    "strokes: colour is blurred, while strokes and lines become fewer, wider and paler.")
            .number("focal_mm", &LensStyle::focal_mm, {1.0F, 2000.0F}, "mm",
                    "Focal length of the lens: more blurs more. The field of view of the camera stays the "
                    "same, because the sensor changes its size.")
            .number("f_number", &LensStyle::f_number, {0.1F, 128.0F}, "",
                    "Aperture of the lens as an f-number: a low value blurs strongly, a high value keeps "
                    "more in focus")
            .number(
                "focus_m", &LensStyle::focus_m, {0.0F, 1e6F}, "m",
                "Distance from the camera at which things are sharp. 0 focuses on the middle of the scene.")
            .text("focus_on", &LensStyle::focus_on,
                  "Object on which the lens focuses, instead of at lens.focus_m. A * in the name stands for "
                  "any letters.")
            .number("largest_mm", &LensStyle::largest_mm, {0.1F, 60.0F}, "mm",
                    "Largest width on the page to which a point is blurred: stronger blur is limited to this "
                    "width")
            .integer("blades", &LensStyle::blades, {0, 12}, "",
                     "Number of blades of the lens aperture. With 3 or more, blurred points of light become "
                     "polygons with as many sides. With 0 to 2, they become round discs.")
            .number("blade_turn_deg", &LensStyle::blade_turn_deg, {0.0F, 360.0F}, "deg",
                    "Rotation of the lens aperture, which rotates the polygons of blurred points of light. "
                    "Only used when lens.blades is 3 or more.")
            .number("widen", &LensStyle::widen, {0.0F, 4.0F}, "",
                    "How much wider and farther apart hatching strokes become for each millimetre of blur. 0 "
                    "changes nothing, more gives few broad strokes. Only used when lens.acts_on is strokes.")
            .number("pale", &LensStyle::pale, {0.0F, 4.0F}, "",
                    "How much paler strokes and lines become for each millimetre of blur. 0 changes nothing, "
                    "more is paler. Only used when lens.acts_on is strokes.");
    return table;
}

// Sources of the thin lens, and of near and far fields: Potmesil and Chakravarty, "A Lens and Aperture Camera
// Model for Synthetic Image Generation", SIGGRAPH 1981; Jimenez, "Next Generation Post Processing in Call of
// Duty", SIGGRAPH 2014.

namespace {

constexpr float most_wider_px = 10.0F; // largest growth of an unfocused line on each side

float most_radius_px(const LensStyle& style, float pixels_per_mm)
{
    return 0.5F * style.largest_mm * pixels_per_mm;
}

/// Adds the passes that apply one lens (depth of field) to one page.
class Passes {
public:
    Passes(gpu::Graph& graph, const LensInputs& in, const LensStyle& style, shared::LensConstants lens)
        : graph_(graph), in_(in), lens_(lens),
          variant_((in.has_sky ? shared::lens_has_sky : 0U) |
                   (style.acts_on != ActsOn::picture ? shared::lens_wash_only : 0U) |
                   (style.blades > 2 ? shared::lens_has_blades : 0U)),
          padded_px_(glm::uvec2((in.size_px + lens.pad_px + shared::lens_block_px - 1U) /
                                shared::lens_block_px * shared::lens_block_px))
    {
    }

    gpu::ImageId add_pack()
    {
        auto pass = graph_.compute("lens/pack", shaders::lens_pack_comp);
        pass.sample(in_.depth).sample(in_.wash).sample(in_.hatch).sample(in_.lines).sample(in_.sky_ink);
        const gpu::ImageId page = pass.write(graph_.image("lens/page", texels(in_.size_px)));
        pass.variant(variant_).push(lens_).dispatch_over_page(in_.size_px.x, in_.size_px.y);
        return page;
    }

    gpu::ImageId add_levels(gpu::ImageId page, bool is_plain)
    {
        gpu::ImageId levels =
            graph_.image("lens/levels", texels({padded_px_.x / 2, padded_px_.y / 2 + padded_px_.y / 4}));
        for (uint32_t level = 1; level <= shared::lens_levels; ++level) {
            auto pass = graph_.compute("lens/level", shaders::lens_level_comp);
            pass.sample(page);
            levels = level == 1 ? pass.write(levels) : pass.modify(levels);
            shared::LensConstants lens = lens_;
            lens.level = level;
            pass.variant((level == 1 ? shared::lens_of_page : 0U) | (is_plain ? shared::lens_plain : 0U))
                .push(lens)
                .dispatch_over(padded_px_.x >> level, padded_px_.y >> level);
        }
        return levels;
    }

    gpu::ImageId add_reach(gpu::ImageId levels)
    {
        const glm::uvec2 tiles = padded_px_ / shared::lens_tile_px;
        const gpu::ImageDesc desc{.width = tiles.x, .height = tiles.y, .format = gpu::Format::rg16f};
        auto find = graph_.compute("lens/tiles", shaders::lens_tiles_comp);
        find.sample(levels);
        const gpu::ImageId found = find.write(graph_.image("lens/tiles", desc));
        find.push(lens_).dispatch_over(tiles.x, tiles.y);
        auto spread = graph_.compute("lens/reach", shaders::lens_reach_comp);
        spread.sample(found);
        const gpu::ImageId reach = spread.write(graph_.image("lens/reach", desc));
        spread.push(lens_).dispatch_over(tiles.x, tiles.y);
        return reach;
    }

    LensLayers add_gathered(gpu::ImageId page)
    {
        const gpu::ImageId levels = add_levels(page, false);
        const gpu::ImageId reach = add_reach(levels);
        auto pass = graph_.compute("lens/gather", shaders::lens_gather_comp);
        pass.sample(levels).sample(reach);
        const glm::uvec2 size_px = padded_px_ / 2U;
        const gpu::ImageId near = pass.write(graph_.image("lens/near", texels(size_px)));
        const gpu::ImageId far = pass.write(graph_.image("lens/far", texels(size_px)));
        pass.variant(variant_ & shared::lens_has_blades).push(lens_).dispatch_over(size_px.x, size_px.y);
        return add_apply(page, {.near = near, .far = far, .reach = reach}, shared::lens_is_gathered);
    }

    /// Converts a blurred packed page back to layers.
    LensLayers add_blurred(gpu::ImageId page, gpu::ImageId blurred)
    {
        return add_apply(page, {.near = blurred, .far = blurred, .reach = in_.depth}, 0U);
    }

    LensLayers add_circles(gpu::ImageId page)
    {
        return add_apply(page, {.near = page, .far = page, .reach = in_.depth}, shared::lens_shows_circles);
    }

    LensLayers add_ink(gpu::ImageId page, gpu::ImageId wash)
    {
        auto across = graph_.compute("lens/ink across", shaders::lens_ink_across_comp);
        across.sample(in_.lines).sample(page);
        const gpu::ImageId found = across.write(graph_.image("lens/ink across", image(gpu::Format::rg32ui)));
        across.push(lens_).dispatch_over(in_.size_px.x, in_.size_px.y);
        auto pass = graph_.compute("lens/ink", shaders::lens_ink_comp);
        pass.sample(in_.wash)
            .sample(in_.hatch)
            .sample(in_.lines)
            .sample(in_.sky_ink)
            .sample(page)
            .sample(found);
        const LensLayers drawn{.wash = wash,
                               .hatch = pass.write(graph_.image("lens/hatch", image(gpu::Format::r16f))),
                               .lines = pass.write(graph_.image("lens/lines", image(gpu::Format::rgba8)))};
        pass.variant(variant_ & shared::lens_has_sky).push(lens_).dispatch_over(in_.size_px.x, in_.size_px.y);
        return drawn;
    }

private:
    struct Blurred {
        gpu::ImageId near;
        gpu::ImageId far;
        gpu::ImageId reach;
    };

    [[nodiscard]] gpu::ImageDesc image(gpu::Format format) const
    {
        return {.width = in_.size_px.x, .height = in_.size_px.y, .format = format};
    }

    static gpu::ImageDesc texels(glm::uvec2 size_px)
    {
        return {.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba32ui};
    }

    LensLayers add_apply(gpu::ImageId page, const Blurred& blurred, uint32_t how)
    {
        const bool keeps_ink = (variant_ & shared::lens_wash_only) != 0 && how != shared::lens_shows_circles;
        const glm::uvec2 ink_px = keeps_ink ? glm::uvec2(1) : in_.size_px;
        auto pass = graph_.compute("lens/apply", shaders::lens_apply_comp);
        pass.sample(in_.wash).sample(in_.hatch).sample(in_.lines).sample(in_.sky_ink).sample(page);
        pass.sample(blurred.near).sample(blurred.far).sample(blurred.reach);
        const gpu::ImageId wash = pass.write(graph_.image("lens/wash", image(gpu::Format::rgba16f)));
        const gpu::ImageId hatch = pass.write(
            graph_.image("lens/hatch", {.width = ink_px.x, .height = ink_px.y, .format = gpu::Format::r16f}));
        const gpu::ImageId lines = pass.write(graph_.image(
            "lens/lines", {.width = ink_px.x, .height = ink_px.y, .format = gpu::Format::rgba8}));
        pass.variant(variant_ | how).push(lens_).dispatch_over_page(in_.size_px.x, in_.size_px.y);
        return {.wash = wash,
                .hatch = keeps_ink ? in_.hatch : hatch,
                .lines = keeps_ink ? in_.lines : lines,
                .holds_sky = !keeps_ink};
    }

    gpu::Graph& graph_;
    const LensInputs& in_;
    shared::LensConstants lens_;
    uint32_t variant_;
    glm::uvec2 padded_px_;
};

} // namespace

double circle_mm(double focal_mm, double f_number, double focus_m, double distance_m)
{
    const double focus_mm = 1e3 * focus_m;
    const double away = std::isinf(distance_m) ? 1.0 : std::abs(distance_m - focus_m) / distance_m;
    return focal_mm * focal_mm / (f_number * (focus_mm - focal_mm)) * away;
}

std::optional<shared::LensConstants> lens_on(const LensStyle& style, const LensPage& page)
{
    if (!style.enabled) {
        return std::nullopt;
    }
    // The blur circle of an infinitely distant point, measured on the plane in focus, is as wide as the
    // aperture. By similar triangles, a circle of that width corresponds to the circle on the sensor that
    // circle_mm() returns.
    const double aperture_m =
        1e-3 * static_cast<double>(style.focal_mm) / static_cast<double>(style.f_number);
    const double radius_px = 0.5 * aperture_m / (page.focus_m * page.pixel_at_one_m);
    const int blades = std::max(style.blades, 3);
    const float blade_rad = glm::two_pi<float>() / static_cast<float>(blades);
    const float wide_px = 0.5F * style.widen * most_radius_px(style, page.pixels_per_mm);
    return shared::LensConstants{
        .radius_px = static_cast<float>(radius_px),
        .radius_per_depth = static_cast<float>(radius_px * page.focus_m / page.near_m),
        .most_px = most_radius_px(style, page.pixels_per_mm),
        .blade_rad = blade_rad,
        .blade_turn_rad = glm::radians(style.blade_turn_deg),
        .blade_scale = std::sqrt(static_cast<float>(blades) * std::tan(0.5F * blade_rad) / glm::pi<float>()),
        .line_reach_px = std::ceil(std::max(page.line_half_px, 0.0F)) + 1.0F,
        .widening = style.widen,
        .widening_per_px = 2.0F * style.widen / page.pixels_per_mm,
        .paling_per_px = 2.0F * style.pale / page.pixels_per_mm,
        .most_wider_px = std::min(std::ceil(wide_px), most_wider_px)};
}

uint32_t reach_px(const LensStyle& style, float pixels_per_mm)
{
    if (!style.enabled) {
        return 0;
    }
    // A tile of the page depends on the blur circles of the neighbouring tiles. The circles are stored in
    // texels that are aligned to blocks of the page, so the reach includes two blocks.
    return static_cast<uint32_t>(std::ceil(2.0F * most_radius_px(style, pixels_per_mm))) +
           2 * shared::lens_block_px;
}

LensLayers add_lens(gpu::Graph& graph, const LensInputs& in, const LensStyle& style,
                    shared::LensConstants lens)
{
    lens.size_px = in.size_px;
    lens.pad_px = in.from_px % shared::lens_block_px;
    Passes passes(graph, in, style, lens);
    const gpu::ImageId page = passes.add_pack();
    if (style.mode == Mode::circles) {
        return passes.add_circles(page);
    }
    const auto blur = [&] {
        switch (style.mode) {
        case Mode::separable:
            return passes.add_blurred(page, add_separable(graph, page, lens));
        case Mode::mips:
        case Mode::sums:
            return passes.add_blurred(page, add_looked_up(graph, page, passes.add_levels(page, true),
                                                          style.mode == Mode::sums, lens));
        default:
            return passes.add_gathered(page);
        }
    };
    const LensLayers blurred = blur();
    return style.acts_on == ActsOn::strokes ? passes.add_ink(page, blurred.wash) : blurred;
}

gpu::ImageId add_wider_strokes(gpu::Graph& graph, gpu::ImageId depth, gpu::ImageId footprint,
                               glm::uvec2 size_px, const shared::LensConstants& lens)
{
    shared::LensConstants constants = lens;
    constants.size_px = size_px;
    auto pass = graph.compute("lens/strokes", shaders::lens_strokes_comp);
    pass.sample(depth).sample(footprint);
    const gpu::ImageId wider = pass.write(graph.image(
        "lens/strokes", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba32ui}));
    pass.push(constants).dispatch_over(size_px.x, size_px.y);
    return wider;
}

} // namespace estampe::lens
