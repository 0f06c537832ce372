// SPDX-License-Identifier: MIT
// Tests how much ink of the previous pictures remains.
#include "afterglow.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "support/gpu_device.hpp"
#include "support/layers.hpp"

namespace estampe::features {
namespace {

constexpr glm::uvec2 size_px(24, 16);

/// Ink of a picture in which one column is black. The column's number increases with time.
std::vector<float> picture(Afterglow& afterglow, uint32_t column, bool follows = true,
                           glm::uvec2 page_px = size_px)
{
    auto ink =
        test::Layer::coverage(page_px, [=](glm::uvec2 pixel) { return pixel.x == column ? 1.0F : 0.0F; });
    const AfterglowPlan plan =
        afterglow.plan(test::shared_device(), page_px, 0.5 * column, follows, {.half_life_s = 0.5F});
    gpu::Graph graph;
    std::vector<float> drawn =
        test::run_and_read_coverage(graph, afterglow.record(graph, plan, ink.in(graph)));
    afterglow.drawn(plan);
    return drawn;
}

void expect_trail(const std::vector<float>& drawn, const std::vector<float>& first_columns)
{
    for (size_t i = 0; i < first_columns.size(); ++i) {
        EXPECT_NEAR(drawn[i], first_columns[i], 1e-3) << "column " << i;
    }
    EXPECT_EQ(*std::max_element(drawn.begin() + static_cast<int64_t>(first_columns.size()),
                                drawn.begin() + size_px.x),
              0.0F);
}

TEST(Afterglow, HalvesWithEachHalfLife)
{
    Afterglow afterglow;
    expect_trail(picture(afterglow, 0, false), {1.0F});
    expect_trail(picture(afterglow, 1), {0.5F, 1.0F});
    expect_trail(picture(afterglow, 2), {0.25F, 0.5F, 1.0F});
}

TEST(Afterglow, GoesOnFromNothingElse)
{
    Afterglow afterglow;
    static_cast<void>(picture(afterglow, 0));
    expect_trail(picture(afterglow, 1, false), {0.0F, 1.0F});
    afterglow.invalidate(Event::lights_changed);
    expect_trail(picture(afterglow, 2), {0.0F, 0.5F, 1.0F});
    afterglow.invalidate(Event::scene_replaced);
    expect_trail(picture(afterglow, 3), {0.0F, 0.0F, 0.0F, 1.0F});
    expect_trail(picture(afterglow, 1), {0.0F, 1.0F}); // time goes back
    static_cast<void>(picture(afterglow, 2, true, size_px + 8U));
    expect_trail(picture(afterglow, 3), {0.0F, 0.0F, 0.0F, 1.0F}); // the page has another size
}

TEST(Afterglow, AnotherRunGoesOnFromItsMemory)
{
    gpu::Executor executor(test::shared_device());
    FilmWriter writer(test::shared_device(), executor);
    Afterglow first;
    first.save(writer);
    EXPECT_TRUE(writer.take().empty()) << "there is nothing yet";
    static_cast<void>(picture(first, 0));
    static_cast<void>(picture(first, 1));
    first.save(writer);
    const std::vector<std::byte> memory = writer.take();
    Afterglow second;
    FilmReader reader(test::shared_device(), memory);
    second.load(reader);
    EXPECT_TRUE(reader.is_at_end());
    EXPECT_EQ(picture(second, 2), picture(first, 2));
    FilmReader cut(test::shared_device(), std::span(memory).first(memory.size() - 1));
    EXPECT_THROW(second.load(cut), Error);
}

} // namespace
} // namespace estampe::features
