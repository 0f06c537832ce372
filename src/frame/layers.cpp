// SPDX-License-Identifier: MIT
#include "frame/layers.hpp"

#include <algorithm>

namespace estampe::frame {
namespace {

/// What multiplies `below` so that it becomes `wanted`.
float factor(float below, float wanted)
{
    return below > 0.0F ? wanted / below : 1.0F;
}

/// What lies on `below` so that it becomes `wanted`, colour multiplied by alpha. Means over samples may ask
/// for more alpha than the mean of their covers: no colour is less than none.
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

} // namespace

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

} // namespace estampe::frame
