// SPDX-License-Identifier: MIT
// Pictures of known colours against the bytes or floats that they become.
#include <vector>

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "style/parameter.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/paper/paper.hpp"
#include "techniques/paper/paper_test_page.hpp"

namespace estampe::paper {
namespace {

/// Develops pictures one after another with the same sums; returns the pixels after each.
template <class Pixel>
std::vector<std::vector<Pixel>> develop_as(const std::vector<test::Painter<glm::vec4>>& pictures,
                                           glm::uvec2 size_px, PixelForm form)
{
    const uint64_t count = sizeof(Pixel) / sizeof(uint32_t) * size_px.x * size_px.y;
    auto older = test::Layer::color(size_px, [](glm::uvec2) { return glm::vec4(7.0F); });
    gpu::Image sums(test::shared_device(), "sums",
                    {.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba32f});
    gpu::Buffer pixels =
        gpu::upload_buffer(test::shared_device(), "pixels", std::vector<uint32_t>(count, 0x01020304U));
    std::vector<std::vector<Pixel>> results;
    for (uint32_t i = 0; i < pictures.size(); ++i) {
        auto picture = test::Layer::color(size_px, pictures[i]);
        gpu::Graph graph;
        const Accumulation accumulation{.sample_index = i,
                                        .sample_count = static_cast<uint32_t>(pictures.size())};
        const Developed developed =
            add_develop(graph, picture.in(graph), import_sums(graph, sums, accumulation),
                        gpu::import_whole(graph, "pixels", pixels), size_px, accumulation, form);
        results.push_back(test::run_and_read_as<Pixel>(graph, developed.pixels));
    }
    return results;
}

std::vector<std::vector<glm::u8vec4>> develop(const std::vector<test::Painter<glm::vec4>>& pictures,
                                              glm::uvec2 size_px)
{
    return develop_as<glm::u8vec4>(pictures, size_px, PixelForm::srgb_bytes);
}

void expect_developed(const std::vector<glm::u8vec4>& bytes, const test::Painter<glm::vec3>& linear,
                      glm::uvec2 size_px)
{
    for (uint32_t i = 0; i < bytes.size(); ++i) {
        const glm::dvec3 encoded = 255.0 * style::srgb_from_linear(linear({i % size_px.x, i / size_px.x}));
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(bytes[i][channel], encoded[channel], 0.5 + 0.2) << "pixel " << i;
        }
        EXPECT_EQ(bytes[i].w, 255);
    }
}

TEST(Develop, IsOnePassWithTheLayingOfAnOnlySample)
{
    constexpr glm::uvec2 size_px(67, 21); // not a multiple of the workgroup size
    const Layers layers{
        .wash =
            [](glm::uvec2 pixel) {
                return glm::vec4(0.015F * static_cast<float>(pixel.x), 0.5F, 0.9F, 1.0F);
            },
        .hatch = [](glm::uvec2 pixel) { return pixel.y % 3 == 0 ? 0.7F : 0.0F; },
        .lines =
            [](glm::uvec2 pixel) { return glm::vec4(0.1F, 0.0F, 0.0F, pixel.x % 7 == 0 ? 0.8F : 0.0F); }};
    const auto bytes = made_of(layers, size_px, 3.0F, [&](gpu::Graph& graph, const ComposeInputs& inputs) {
        const auto pixels = graph.buffer("pixels", {.size_bytes = sizeof(uint32_t) * size_px.x * size_px.y});
        return test::run_and_read_as<glm::u8vec4>(graph, add_pixels(graph, inputs, {}, pixels));
    });
    const std::vector<glm::vec4> picture = compose(layers, {}, size_px);
    ASSERT_EQ(bytes.size(), picture.size());
    expect_developed(
        bytes, [&](glm::uvec2 pixel) { return glm::vec3(picture[pixel.y * size_px.x + pixel.x]); }, size_px);
}

TEST(Develop, OnePictureBecomesItsBytes)
{
    constexpr glm::uvec2 size_px(64, 16);
    const auto ramp = [](glm::uvec2 pixel) {
        const float t = static_cast<float>(pixel.y * 64 + pixel.x) / 1023.0F;
        return glm::vec4(t, t * t, 1.25F * t - 0.125F, 1.0F);
    };
    expect_developed(
        develop({ramp}, size_px)[0],
        [&](glm::uvec2 pixel) {
            const glm::vec4 rounded = glm::unpackHalf4x16(glm::packHalf4x16(ramp(pixel)));
            return glm::clamp(glm::vec3(rounded), 0.0F, 1.0F);
        },
        size_px);
}

TEST(Develop, SeveralPicturesBecomeTheirMean)
{
    constexpr glm::uvec2 size_px(24, 20);
    std::vector<test::Painter<glm::vec4>> pictures;
    for (uint32_t k = 0; k < 5; ++k) {
        pictures.emplace_back([k](glm::uvec2 pixel) {
            const auto part = [&](uint32_t salt) {
                return static_cast<float>((pixel.x * 37 + pixel.y * 101 + k * 59 + salt) % 97) / 96.0F;
            };
            return glm::vec4(part(1), part(2) * part(3), part(4), 1.0F);
        });
    }
    const auto results = develop(pictures, size_px);
    for (size_t k = 0; k + 1 < results.size(); ++k) {
        EXPECT_EQ(results[k][7], glm::u8vec4(4, 3, 2, 1)) << "only the last writes the picture";
    }
    expect_developed(
        results.back(),
        [&](glm::uvec2 pixel) {
            glm::vec3 sum(0.0F);
            for (const auto& picture : pictures) {
                sum += glm::vec3(picture(pixel));
            }
            return sum / static_cast<float>(pictures.size());
        },
        size_px);
}

TEST(Develop, FloatsAreTheMeanAsItIs)
{
    constexpr glm::uvec2 size_px(64, 40);
    const auto picture = [](float step) {
        return [step](glm::uvec2 pixel) {
            const float t = static_cast<float>(pixel.y * 64 + pixel.x) / 2048.0F;
            return glm::vec4(t + step, 1.5F - t, 0.001F * t, 0.5F * t);
        };
    };
    const auto as_half = [](const glm::vec4& color) { return glm::unpackHalf4x16(glm::packHalf4x16(color)); };
    const auto one = develop_as<glm::vec4>({picture(0.0F)}, size_px, PixelForm::linear_floats)[0];
    const auto two =
        develop_as<glm::vec4>({picture(0.0F), picture(0.25F)}, size_px, PixelForm::linear_floats)[1];
    for (uint32_t i = 0; i < one.size(); ++i) {
        const glm::uvec2 pixel(i % size_px.x, i / size_px.x);
        const glm::vec4 first = as_half(picture(0.0F)(pixel));
        EXPECT_EQ(one[i], first);
        const glm::vec4 mean = 0.5F * (first + as_half(picture(0.25F)(pixel)));
        for (int channel = 0; channel < 4; ++channel) {
            EXPECT_NEAR(two[i][channel], mean[channel], 1e-6F) << "alpha is averaged too";
        }
    }
}

} // namespace
} // namespace estampe::paper
