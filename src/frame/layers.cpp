// SPDX-License-Identifier: MIT
// Pictures in floats and in layers: how the renderer derives a picture's layers from its stages.
#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include <estampe/layers.hpp>

#include "frame/renderer_impl.hpp"
#include "gpu/transfers.hpp"

namespace estampe::frame {
namespace {

/// Counts how many samples of each pixel show each object. Most pixels show a single object. The count of the
/// first object is stored in an array; only the counts of further objects are in a map.
class Shares {
public:
    explicit Shares(size_t pixel_count) : first_(pixel_count), first_count_(pixel_count) {}

    /// Adds a sample of the picture: the object number of each pixel, 0 for none.
    void add(std::span<const uint32_t> things);

    /// The pixels where an object is visible, each with the number of samples that show the object, in the
    /// order of pixels.
    using Places = std::vector<std::pair<uint32_t, uint32_t>>;
    [[nodiscard]] std::map<uint32_t, Places> places() const;

private:
    std::vector<uint32_t> first_; ///< the first object seen at each pixel
    std::vector<uint32_t> first_count_;
    /// Number of samples that show an object other than the first, by pixel and object.
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> rest_;
};

/// The picture after each drawing stage, per pixel. Colours are opaque; alpha is the coverage of the topmost
/// layer.
struct StageColors {
    std::span<const glm::vec4> paper;
    std::span<const glm::vec4> wash;
    std::span<const glm::vec4> ink; ///< picture after flowing ink; empty without flowing ink
    std::span<const glm::vec4> hatch;
    std::span<const glm::vec4> lines;
    std::span<const glm::vec4> smoke; ///< picture after smoke; empty without smoke
    /// The picture has alpha: the wash's alpha is its coverage over paper of `paper_color`.
    bool is_transparent = false;
    glm::vec3 paper_color{1.0F};
};

/// The factor by which a multiply layer changes the value `below` into `wanted`.
float factor(float below, float wanted)
{
    return below > 0.0F ? wanted / below : 1.0F;
}

/// Returns the premultiplied colour that changes `below` into `wanted` when composited over `below`. A mean
/// over samples may need more alpha than the mean coverage, so alpha is raised until no colour is negative.
glm::vec4 laid_over(const glm::vec3& below, const glm::vec4& wanted)
{
    float alpha = std::clamp(wanted.w, 0.0F, 1.0F);
    if (alpha == 0.0F) {
        return glm::vec4(0.0F);
    }
    for (int channel = 0; channel < 3; ++channel) {
        if (below[channel] > 0.0F) {
            alpha = std::max(alpha, 1.0F - wanted[channel] / below[channel]);
        }
    }
    alpha = std::min(alpha, 1.0F);
    return {glm::max(glm::vec3(wanted) - below * (1.0F - alpha), 0.0F), alpha};
}

void Shares::add(std::span<const uint32_t> things)
{
    for (uint32_t pixel = 0; pixel < things.size(); ++pixel) {
        const uint32_t thing = things[pixel];
        if (thing == 0) {
            continue;
        }
        if (first_count_[pixel] == 0) {
            first_[pixel] = thing;
        }
        if (first_[pixel] == thing) {
            ++first_count_[pixel];
        } else {
            ++rest_[{pixel, thing}];
        }
    }
}

std::map<uint32_t, Shares::Places> Shares::places() const
{
    std::map<uint32_t, Places> places;
    for (uint32_t pixel = 0; pixel < first_.size(); ++pixel) {
        if (first_count_[pixel] > 0) {
            places[first_[pixel]].emplace_back(pixel, first_count_[pixel]);
        }
    }
    for (const auto& [place, count] : rest_) {
        places[place.second].emplace_back(place.first, count);
    }
    for (auto& [thing, of_thing] : places) {
        std::ranges::sort(of_thing);
    }
    return places;
}

/// Crops a mask to the pixels that it covers.
PictureMask cropped_mask(std::string name, uint32_t page_width, const Shares::Places& places,
                         uint32_t sample_count)
{
    PictureMask mask{.name = std::move(name)};
    if (places.empty()) {
        return mask;
    }
    uint32_t right = 0;
    mask.x = page_width;
    for (const auto& [pixel, count] : places) {
        mask.x = std::min(mask.x, pixel % page_width);
        right = std::max(right, pixel % page_width + 1);
    }
    mask.y = places.front().first / page_width;
    mask.width = right - mask.x;
    mask.height = places.back().first / page_width + 1 - mask.y;
    mask.cover.resize(size_t{mask.width} * mask.height);
    for (const auto& [pixel, count] : places) {
        const size_t place = size_t{pixel / page_width - mask.y} * mask.width + (pixel % page_width - mask.x);
        mask.cover[place] = static_cast<float>(count) / static_cast<float>(sample_count);
    }
    return mask;
}

/// Computes each layer as the difference between two successive stages of the drawing. The layers, composed
/// in order, reproduce each stage except for rounding errors. In a transparent picture the paper is a hidden
/// layer, and the wash is blended by alpha instead of multiplied.
std::vector<PictureLayer> layers_between(const StageColors& stages, uint32_t width, uint32_t height)
{
    const size_t count = size_t{width} * height;
    const auto layer = [&](const char* name, LayerBlend blend) {
        return PictureLayer{.name = name,
                            .blend = blend,
                            .image = {.width = width,
                                      .height = height,
                                      .pixels = std::vector<glm::vec4>(count),
                                      .paper = std::nullopt}};
    };
    std::vector<PictureLayer> layers{
        layer("paper", LayerBlend::normal),
        layer("wash", stages.is_transparent ? LayerBlend::normal : LayerBlend::multiply)};
    layers[0].is_visible = !stages.is_transparent;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 paper(stages.paper[i]);
        const glm::vec3 wash(stages.wash[i]);
        layers[0].image.pixels[i] = glm::vec4(paper, 1.0F);
        layers[1].image.pixels[i] =
            stages.is_transparent
                ? glm::vec4(glm::max(wash - (1.0F - stages.wash[i].w) * stages.paper_color, 0.0F),
                            stages.wash[i].w)
                : glm::vec4(factor(paper.x, wash.x), factor(paper.y, wash.y), factor(paper.z, wash.z), 1.0F);
    }
    std::span<const glm::vec4> below = stages.wash;
    const auto add_laid_over = [&](const char* name, std::span<const glm::vec4> stage) {
        if (stage.empty()) {
            return;
        }
        std::vector<glm::vec4>& pixels = layers.emplace_back(layer(name, LayerBlend::normal)).image.pixels;
        for (size_t i = 0; i < count; ++i) {
            pixels[i] = laid_over(glm::vec3(below[i]), stage[i]);
        }
        below = stage;
    };
    add_laid_over("ink", stages.ink);
    add_laid_over("hatch", stages.hatch);
    add_laid_over("lines", stages.lines);
    add_laid_over("smoke", stages.smoke);
    return layers;
}

} // namespace
} // namespace estampe::frame

namespace estampe {
namespace {

/// Assigns an object number to each draw call: 1 is the ground, other objects have their node's index + 2.
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

/// Makes names unique: the second "leaf" becomes "leaf 2".
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

/// Accumulates the objects, shadows and clouds that the samples of a picture show inside the page's margin.
class Seen {
public:
    Seen(const pose::MeshData& layout, const RenderSettings& settings, const frame::SeenWindow& window)
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
            page.occlusion.empty() ? std::span<const uint16_t>() : gpu::items_of<uint16_t>(page.occlusion);
        const auto clouds =
            page.has_clouds ? gpu::items_of<uint16_t>(page.cloud_cover) : std::span<const uint16_t>();
        for (uint32_t y = window_.min_px.y; y < window_.max_px.y; ++y) {
            for (uint32_t x = window_.min_px.x; x < window_.max_px.x; ++x) {
                const size_t i = size_t{y} * width_ + x;
                const uint32_t number = frame::draw_number(words[i]);
                pixel_things_[i] = number > 0 ? things_.at(number - 1) : 0;
                // A negative value of `sun` means that the surface faces away from the sun or is never lit by
                // it.
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
    frame::SeenWindow window_;
    std::vector<uint32_t> pixel_things_; ///< object number of each pixel in the current sample
    frame::Shares shares_;
    std::vector<float> shadow_; ///< shadow of the sun at each pixel, as a sum over the samples
    /// Light that ambient occlusion removes at each pixel, as a sum over the samples.
    std::vector<float> closed_;
    std::vector<float> clouds_; ///< cloud cover at each pixel, as a sum over the samples
};

} // namespace

LinearImage Renderer::render_linear(const Camera& camera, const Style& style, const RenderSettings& settings)
{
    frame::check_size(impl_->device, settings);
    const features::StyleTables& tables = impl_->tables_of(style);
    const std::optional<glm::vec3> paper = paper::transparent_color(tables.paper);
    frame::LinearPage page = frame::make_linear_page(
        impl_->device, settings,
        {.has_layers = false, .has_smoke = tables.smoke.enabled, .is_transparent = paper.has_value()});
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
    const features::StyleTables& tables = impl.tables_of(style);
    const bool has_smoke = tables.smoke.enabled;
    const std::optional<glm::vec3> paper = paper::transparent_color(tables.paper);
    frame::LinearPage page = frame::make_linear_page(impl.device, settings,
                                                     {.has_layers = true,
                                                      .has_ink = tables.ink.enabled,
                                                      .has_smoke = has_smoke,
                                                      .has_occlusion = tables.occlusion.enabled});
    std::optional<Seen> seen;
    LayeredImage result;
    result.picture = impl.draw_picture(camera, style, settings, &page, [&] {
        if (!seen) {
            seen.emplace(impl.loaded->layout, settings, frame::window_within_margin(tables.paper, settings));
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
