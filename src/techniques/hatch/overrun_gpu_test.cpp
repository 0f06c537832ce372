// SPDX-License-Identifier: MIT
// Strokes run over the edge of a surface, for lines and for maps.
#include <gtest/gtest.h>

#include "features/hatching/hatching.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "techniques/hatch/hatch_test_canvas.hpp"

namespace estampe {
namespace {

using test::Canvas;

constexpr glm::uvec2 overrun_page_px{160, 120};
constexpr uint32_t edge_px = 100; // the surface ends here
constexpr float overrun_px = 20.0F;

/// Strokes that meet the edge at an angle, on a surface that ends there or continues.
std::vector<float> ink(bool ends, float overrun_mm, hatch::MapImages* map)
{
    const auto seen = [=](glm::uvec2 pixel) { return !ends || pixel.x < edge_px; };
    hatch::HatchStyle style = test::pen();
    style.overrun_mm = overrun_mm;
    style.map_texel_mm = 1.0F;
    Canvas canvas(overrun_page_px, shared::strokes_uv);
    canvas.paint_seen(seen);
    canvas.paint_darkness([=](glm::uvec2 pixel) { return seen(pixel) ? 0.5F : 0.0F; });
    canvas.paint_surface(test::flat_patch(map == nullptr ? 1.0 / 64.0 : 0.9 / 512.0));
    return canvas.ink(style, map);
}

class HatchOverrun : public testing::TestWithParam<hatch::Strokes> {};

TEST_P(HatchOverrun, StrokesGoOnBeyondTheEdgeAndEnd)
{
    std::optional<hatch::MapImages> images;
    if (GetParam() == hatch::Strokes::map) {
        images = hatch::upload_map(test::shared_device(),
                                   features::load_map(features::map_choice(features::StyleTables())),
                                   hatch::MapTone::order, 1.0F);
    }
    hatch::MapImages* map = images ? &*images : nullptr;
    const std::vector<float> cut = ink(true, 0.0F, map);
    const std::vector<float> whole = ink(false, overrun_px, map);
    const std::vector<float> over = ink(true, overrun_px, map);
    double farther = 0.0;
    double beyond = 0.0;
    for (uint32_t i = 0; i < over.size(); ++i) {
        const auto past_px = static_cast<int>(i % overrun_page_px.x) - static_cast<int>(edge_px) + 1;
        if (past_px <= 0) {
            ASSERT_EQ(over[i], cut[i]);
        } else if (static_cast<float>(past_px) < 0.3F * overrun_px) {
            ASSERT_NEAR(over[i], whole[i], 0.05) << i; // coordinates are rounded twice
            beyond += over[i];
        } else if (static_cast<float>(past_px) > overrun_px) {
            ASSERT_EQ(over[i], 0.0F);
        } else {
            farther += over[i];
        }
    }
    EXPECT_GT(beyond, 0.4 * 5.0 * overrun_page_px.y);
    EXPECT_GT(farther, 0.1 * 14.0 * overrun_page_px.y);
    EXPECT_LT(farther, 0.4 * 14.0 * overrun_page_px.y);
}

INSTANTIATE_TEST_SUITE_P(Both, HatchOverrun, testing::Values(hatch::Strokes::lines, hatch::Strokes::map));

} // namespace
} // namespace estampe
