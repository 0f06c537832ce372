// SPDX-License-Identifier: MIT
// What the renderer does for pictures in floats, and in layers, alone.
#include "frame/renderer_impl.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include "frame/layers.hpp"
#include "gpu/read_back.hpp"

namespace estampe {
namespace {

constexpr uint32_t draw_number_mask = (1U << 26U) - 1U; // DRAW_NUMBER_MASK of shaders/draw_word.glsl

/// Things of a scene as numbers: a node is its index + 2, the ground 1.
std::vector<uint32_t> thing_of_draw(const pose::MeshData& layout)
{
    std::vector<uint32_t> things(layout.draws.size(), 1);
    std::ranges::transform(layout.sources, things.begin(),
                           [](const pose::DrawSource& source) { return source.node + 2; });
    return things;
}

std::string name_of_thing(const Scene& scene, uint32_t thing)
{
    if (thing == 1) {
        return "ground";
    }
    const std::string& name = scene.nodes.at(thing - 2).name;
    return name.empty() ? fmt::format("object {}", thing - 2) : name;
}

/// No two alike: the second "leaf" is "leaf 2".
class Names {
public:
    std::string make(const std::string& wanted)
    {
        std::string name = wanted;
        for (int number = 2; !taken_.insert(name).second; ++number) {
            name = fmt::format("{} {}", wanted, number);
        }
        return name;
    }

private:
    std::set<std::string> taken_{"paper", "wash",   "ink",       "hatch", "lines",
                                 "smoke", "shadow", "occlusion", "clouds"};
};

/// The part of the page that its margin leaves: from the first pixel to before the last.
struct PixelWindow {
    glm::uvec2 first{0};
    glm::uvec2 last{0};
};

PixelWindow window_px(const paper::PaperStyle& style, const RenderSettings& settings)
{
    const float px_per_mm = static_cast<float>(settings.height) / style.height_mm;
    const paper::Window window = paper::window_of(style, static_cast<float>(settings.width) / px_per_mm);
    const glm::vec2 size_px(settings.width, settings.height);
    return {glm::uvec2(glm::floor(window.min_mm * px_per_mm)),
            glm::uvec2(glm::min(glm::ceil(window.max_mm * px_per_mm), size_px))};
}

/// What the samples of a picture have seen within its window.
class Seen {
public:
    Seen(const pose::MeshData& layout, const RenderSettings& settings, const PixelWindow& window)
        : things_(thing_of_draw(layout)), width_(settings.width), window_(window),
          pixel_things_(size_t{settings.width} * settings.height), shares_(pixel_things_.size()),
          shadow_(pixel_things_.size()), closed_(pixel_things_.size()), clouds_(pixel_things_.size())
    {
    }

    void add(const frame::LinearPage& page)
    {
        const auto words = gpu::items_of<uint32_t>(page.draws);
        const auto sun = gpu::items_of<float>(page.sun);
        const auto open =
            page.open.empty() ? std::span<const uint16_t>() : gpu::items_of<uint16_t>(page.open);
        const auto clouds =
            page.has_clouds ? gpu::items_of<uint16_t>(page.cloud_cover) : std::span<const uint16_t>();
        for (uint32_t y = window_.first.y; y < window_.last.y; ++y) {
            for (uint32_t x = window_.first.x; x < window_.last.x; ++x) {
                const size_t i = size_t{y} * width_ + x;
                const uint32_t number = words[i] & draw_number_mask;
                pixel_things_[i] = number > 0 ? things_.at(number - 1) : 0;
                // Negative: turned away from the sun, or never lit by it.
                shadow_[i] += sun[i] >= 0.0F ? 1.0F - std::min(sun[i], 1.0F) : 0.0F;
                clouds_[i] += number == 0 && !clouds.empty() ? glm::unpackHalf1x16(clouds[i]) : 0.0F;
                closed_[i] += number > 0 && !open.empty() ? 1.0F - glm::unpackHalf1x16(open[i]) : 0.0F;
            }
        }
        shares_.add(pixel_things_);
    }

    [[nodiscard]] std::vector<PictureMask> masks(const Scene& scene, const RenderSettings& settings,
                                                 uint32_t layer_count) const
    {
        constexpr uint32_t above_wash = 2;
        std::vector<PictureMask> masks;
        const auto add_shares = [&](const char* name, const std::vector<float>& sums) {
            if (std::ranges::none_of(sums, [](float sum) { return sum > 0.0F; })) {
                return;
            }
            masks.push_back({.name = name,
                             .is_object = false,
                             .above = above_wash,
                             .width = settings.width,
                             .height = settings.height,
                             .cover = sums});
            for (float& share : masks.back().cover) {
                share /= static_cast<float>(settings.samples);
            }
        };
        add_shares("shadow", shadow_);
        add_shares("occlusion", closed_);
        add_shares("clouds", clouds_);
        Names names;
        for (const auto& [thing, places] : shares_.places()) {
            masks.push_back(frame::cropped_mask(names.make(name_of_thing(scene, thing)), settings.width,
                                                places, settings.samples));
            masks.back().above = layer_count;
        }
        return masks;
    }

private:
    std::vector<uint32_t> things_;
    uint32_t width_;
    PixelWindow window_;
    std::vector<uint32_t> pixel_things_; ///< of the sample in hand
    frame::Shares shares_;
    std::vector<float> shadow_; ///< sum over the samples
    std::vector<float> closed_; ///< the same, of light that occlusion takes
    std::vector<float> clouds_; ///< the same, of sky that clouds cover
};

} // namespace

LinearImage Renderer::render_linear(const Camera& camera, const Style& style, const RenderSettings& settings)
{
    frame::check_size(impl_->device, settings);
    const std::optional<glm::vec3> paper = paper::transparent_color(style.tables().paper);
    frame::LinearPage page = frame::make_linear_page(
        impl_->device, settings,
        {.has_layers = false, .has_smoke = style.tables().smoke.drawn, .is_transparent = paper.has_value()});
    std::ignore = impl_->draw_picture(camera, style, settings, &page);
    LinearImage image{.width = settings.width, .height = settings.height, .pixels = {}, .paper = paper};
    const auto pixels = gpu::items_of<glm::vec4>(page.stages.front().pixels);
    image.pixels.assign(pixels.begin(), pixels.end());
    if (!paper) {
        std::ranges::for_each(image.pixels, [](glm::vec4& pixel) { pixel.w = 1.0F; });
    }
    return image;
}

LayeredImage Renderer::render_layers(const Camera& camera, const Style& style, const RenderSettings& settings)
{
    Impl& impl = *impl_;
    frame::check_size(impl.device, settings);
    const bool has_smoke = style.tables().smoke.drawn;
    const std::optional<glm::vec3> paper = paper::transparent_color(style.tables().paper);
    frame::LinearPage page = frame::make_linear_page(impl.device, settings,
                                                     {.has_layers = true,
                                                      .has_ink = style.tables().ink.drawn,
                                                      .has_smoke = has_smoke,
                                                      .has_occlusion = style.tables().occlusion.drawn});
    std::optional<Seen> seen;
    LayeredImage result;
    result.picture = impl.draw_picture(camera, style, settings, &page, [&] {
        if (!seen) {
            seen.emplace(impl.loaded->layout, settings, window_px(style.tables().paper, settings));
        }
        seen->add(page);
    });
    const auto stage = [&](paper::Stage wanted) {
        const auto found = std::ranges::find(page.stages, wanted, &frame::LinearPage::Stage::stage);
        return found != page.stages.end() ? gpu::items_of<glm::vec4>(found->pixels)
                                          : std::span<const glm::vec4>();
    };
    result.layers = frame::layers_between({.paper = stage(paper::Stage::paper),
                                           .wash = stage(paper::Stage::wash),
                                           .ink = stage(paper::Stage::ink),
                                           .hatch = stage(paper::Stage::hatch),
                                           .lines = stage(paper::Stage::lines),
                                           .smoke = stage(paper::Stage::smoke),
                                           .is_transparent = paper.has_value(),
                                           .paper_color = paper.value_or(glm::vec3(1.0F))},
                                          settings.width, settings.height);
    result.paper = paper;
    result.masks = seen->masks(impl.loaded->scene, settings, static_cast<uint32_t>(result.layers.size()));
    return result;
}

} // namespace estampe
