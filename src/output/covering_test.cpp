// SPDX-License-Identifier: MIT
// Pixels of transparent pictures, composited onto paper as programs do: in sRGB-encoded integers.
#include "output/layer_bytes.hpp"

#include <random>

#include <gtest/gtest.h>

namespace estampe::output {
namespace {

/// Largest channel difference between a pixel composited onto paper and the drawing there.
double difference(const glm::ivec4& pixel, const glm::vec3& paper, const glm::vec3& drawn,
                  const Arithmetic& in)
{
    double largest = 0.0;
    for (int i = 0; i < 3; ++i) {
        const int below = in.nearest(in.encoded(paper)[i]);
        const int shown = in.nearest(in.over(static_cast<double>(below), pixel[i], pixel.w));
        largest = std::max(largest, std::abs(shown - in.encoded(drawn)[i]));
    }
    return largest;
}

glm::vec3 drawn_on(const glm::vec3& paper, const glm::vec4& page)
{
    return glm::vec3(page) + (1.0F - page.w) * paper;
}

class Straight : public testing::TestWithParam<int> {};

TEST_P(Straight, LaidOnItsOwnPaperIsTheDrawing)
{
    const Arithmetic in(GetParam());
    std::mt19937 random(7);
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    const auto color = [&] { return glm::vec3(share(random), share(random), share(random)); };
    double worst = 0.0;
    for (int i = 0; i < 200000; ++i) {
        const float alpha = i % 10 == 0 ? 0.01F * share(random) : share(random);
        const glm::vec3 paper = i % 3 == 0 ? glm::vec3(1.0F) : color();
        const glm::vec3 pigment = i % 4 == 0 ? paper + 0.01F * (color() - paper) : color();
        const glm::vec4 page(alpha * pigment, alpha);
        worst = std::max(worst, difference(straight(page, paper, in), paper, drawn_on(paper, page), in));
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LE(worst, 1.01);
}

TEST_P(Straight, KeepsWhatIsOpaqueAndWhatIsNotThere)
{
    const Arithmetic in(GetParam());
    const glm::vec3 paper(0.9F, 0.85F, 0.7F);
    EXPECT_EQ(straight(glm::vec4(0.0F), paper, in), glm::ivec4(0));
    const glm::vec3 color(0.2F, 0.5F, 0.7F);
    const glm::ivec4 opaque = straight(glm::vec4(color, 1.0F), paper, in);
    EXPECT_EQ(opaque.w, in.top());
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(opaque[i], in.nearest(in.encoded(color)[i]));
    }
    // White must stay opaque on white paper.
    EXPECT_EQ(straight(glm::vec4(1.0F), glm::vec3(1.0F), in).w, in.top());
    EXPECT_NEAR(straight(glm::vec4(0.5F), glm::vec3(1.0F), in).w, 0.5 * in.top(), 0.5);
}

TEST_P(Straight, DarkInkLooksOnAnyPaperAsIfDrawnThere)
{
    const Arithmetic in(GetParam());
    const double step = in.top() / 255.0;
    const glm::vec3 own(0.92F, 0.87F, 0.76F);
    const glm::vec3 ink(0.0116F, 0.0103F, 0.0144F); // #1c1a20
    double worst = 0.0;
    for (const glm::vec3& paper :
         {glm::vec3(1.0F), glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(0.0F, 0.2F, 0.6F), glm::vec3(0.0F)}) {
        for (float alpha = 0.0F; alpha <= 1.0F; alpha += 1.0F / 64.0F) {
            const glm::vec4 page(alpha * ink, alpha);
            worst =
                std::max(worst, difference(straight(page, own, in), paper, drawn_on(paper, page), in) / step);
        }
    }
    RecordProperty("worst of 255", std::to_string(worst));
    EXPECT_LT(worst, 14.0); // Thin ink on black, where almost nothing is visible
}

INSTANTIATE_TEST_SUITE_P(Bits, Straight, testing::Values(8, 16));

} // namespace
} // namespace estampe::output
