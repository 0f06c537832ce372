// SPDX-License-Identifier: MIT
#include "frame/page.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace estampe::frame {
namespace {

TEST(SeenWindow, HoldsEveryPixelThatTheMarginsEdgeLeaves)
{
    constexpr float strays_mm = 0.085F; // how far the edge in compose.comp strays to either side
    for (const glm::uvec2 page_px : {glm::uvec2(96, 54), glm::uvec2(640, 360), glm::uvec2(1920, 1080)}) {
        for (const glm::vec2 from_px : {glm::vec2(0.0F), glm::vec2(32.0F, 16.0F)}) {
            const paper::PaperStyle style;
            const float pixels_per_mm = static_cast<float>(page_px.y) / style.height_mm;
            const SeenWindow seen = seen_window(style, page_px, pixels_per_mm, from_px);
            const paper::Window window =
                paper::window_of(style, static_cast<float>(page_px.x) / pixels_per_mm);
            for (int axis = 0; axis < 2; ++axis) {
                for (uint32_t pixel = 0; pixel < page_px[axis]; ++pixel) {
                    const float middle_px = static_cast<float>(pixel) + 0.5F + from_px[axis];
                    const float beyond_px = std::max(window.min_mm[axis] * pixels_per_mm - middle_px,
                                                     middle_px - window.max_mm[axis] * pixels_per_mm);
                    const bool shows = beyond_px < 0.5F + strays_mm * pixels_per_mm;
                    const bool is_held = pixel >= seen.min_px[axis] && pixel < seen.max_px[axis];
                    EXPECT_TRUE(is_held || !shows) << page_px.x << ": " << axis << ", " << pixel;
                }
            }
            EXPECT_LT(seen.max_px.x, page_px.x);
        }
    }
}

} // namespace
} // namespace estampe::frame
