// SPDX-License-Identifier: MIT
#include "features/lines/lines.hpp"

#include <fstream>
#include <numeric>

#include <estampe/error.hpp>
#include <estampe/image.hpp>
#include <gtest/gtest.h>

#include "support/folder.hpp"

namespace estampe::features {
namespace {

TEST(LineBrushes, ThePenNeedsNoPicture)
{
    EXPECT_FALSE(load_brushes({}));
}

TEST(LineBrushes, EachKindOfLineHasItsOwnOrThatOfAll)
{
    contour::ContourStyle style;
    style.brush = "charcoal";
    style.outline.brush = "pen";
    style.crease.brush = "brush";
    const auto set = load_brushes(style);
    ASSERT_TRUE(set);
    EXPECT_EQ(set->strips.size(), 2U);
    EXPECT_FALSE(set->strip_of_use[shared::line_silhouette]);
    EXPECT_FALSE(set->strip_of_use[shared::line_border]);
    EXPECT_NE(set->strip_of_use[shared::line_boundary], set->strip_of_use[shared::line_crease]);
}

TEST(LineBrushes, NoKindBorrowsFromAnother)
{
    for (const contour::LineKind& each : contour::line_kinds) {
        contour::ContourStyle style;
        style.*each.style = {.brush = "brush"};
        const auto set = load_brushes(style);
        ASSERT_TRUE(set) << each.name;
        EXPECT_FALSE(is_drawn_by_pen(style)) << each.name;
        for (uint32_t kind = 0; kind < shared::line_kind_count; ++kind) {
            const bool is_this = contour::line_kinds[kind].style == each.style;
            EXPECT_EQ(set->strip_of_use[kind].has_value(), is_this) << each.name << ", " << kind;
        }
        EXPECT_FALSE(set->strip_of_use[shared::brush_hidden]);
    }
}

TEST(LineBrushes, LinesThatAreNotLookedForNeedNone)
{
    contour::ContourStyle style;
    style.ridge.brush = "brush";
    EXPECT_FALSE(load_brushes(style));
    EXPECT_TRUE(is_drawn_by_pen(style));
    style.ridge.enabled = true;
    EXPECT_TRUE(load_brushes(style));
}

TEST(LineBrushes, ToolsAreNeitherBlankNorSolidAndMeetWhereTheyRepeat)
{
    contour::ContourStyle style;
    for (const char* name : {"pencil", "charcoal", "brush"}) {
        style.brush = name;
        const auto set = load_brushes(style);
        ASSERT_TRUE(set);
        const std::vector<float>& ink = set->strips.front().ink;
        const float mean = std::accumulate(ink.begin(), ink.end(), 0.0F) / static_cast<float>(ink.size());
        EXPECT_GT(mean, 0.3F) << name;
        EXPECT_LT(mean, 0.95F) << name;
        const auto column = [&](uint32_t x, uint32_t y) {
            return ink[size_t{y} * shared::brush_columns + x];
        };
        float seam = 0.0F;
        float inside = 0.0F;
        for (uint32_t y = 0; y < shared::brush_rows; ++y) {
            seam += std::abs(column(shared::brush_columns - 1, y) - column(0, y));
            for (uint32_t x = 0; x < 32; ++x) {
                inside += std::abs(column(30 * x, y) - column(30 * x + 1, y)) / 32.0F;
            }
        }
        EXPECT_LT(seam, 2.0F * inside + 0.1F) << name;
    }
}

std::string message_of(const std::string& brush)
{
    contour::ContourStyle style;
    style.brush = brush;
    try {
        static_cast<void>(load_brushes(style));
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(LineBrushes, WhatIsNoPictureOfAStrokeIsNamed)
{
    const test::Folder folder;
    const std::string missing = (folder / "missing.png").string();
    EXPECT_NE(message_of(missing).find(missing), std::string::npos);
    const std::string blank = (folder / "blank.png").string();
    save_png({.width = 8, .height = 4, .rgba = std::vector<uint8_t>(size_t{8} * 4 * 4, 0)}, blank);
    EXPECT_NE(message_of(blank).find(blank), std::string::npos);
    EXPECT_NE(message_of(blank).find("no ink"), std::string::npos);
}

} // namespace
} // namespace estampe::features
