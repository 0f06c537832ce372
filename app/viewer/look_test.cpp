// SPDX-License-Identifier: MIT
#include "viewer/studio.hpp"

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "features/common/style_tables.hpp"
#include "support/folder.hpp"

namespace estampe::viewer {
namespace {

float width_mm(const Look& look)
{
    return look.style().tables().hatch.width_mm;
}

TEST(Look, UndoAndRedoGoStepByStep)
{
    Look look("", Style());
    const float first = width_mm(look);
    look.set("hatch.width_mm=1");
    look.set("hatch.width_mm=2");
    look.undo();
    EXPECT_EQ(width_mm(look), 1.0F);
    look.undo();
    EXPECT_EQ(width_mm(look), first);
    EXPECT_FALSE(look.can_undo());
    look.redo();
    look.redo();
    EXPECT_EQ(width_mm(look), 2.0F);
    EXPECT_FALSE(look.can_redo());
    look.undo();
    look.set("hatch.width_mm=3");
    EXPECT_FALSE(look.can_redo()) << "what was undone is forgotten";
    look.undo();
    EXPECT_EQ(width_mm(look), 1.0F);
}

TEST(Look, ADragIsOneStep)
{
    Look look("", Style());
    const float first = width_mm(look);
    for (const float value : {0.5F, 0.6F, 0.7F}) {
        look.style().tables().hatch.width_mm = value;
        look.changed();
    }
    look.finish_change_if_any();
    look.finish_change_if_any();
    look.undo();
    EXPECT_EQ(width_mm(look), first);
}

TEST(Look, APresetIsAStepAndWhatParametersGoBackTo)
{
    Look look("", Style());
    look.load("pencil");
    EXPECT_EQ(look.name(), "pencil");
    EXPECT_EQ(look.base().to_toml(), Style::load("pencil").to_toml());
    look.undo();
    EXPECT_EQ(look.name(), "");
    EXPECT_EQ(look.style().to_toml(), Style().to_toml());
    EXPECT_THROW(look.load("no-such-preset"), Error);
    EXPECT_EQ(look.style().to_toml(), Style().to_toml());
    EXPECT_THROW(look.set("hatch.width_mm=1000"), Error);
    EXPECT_EQ(look.style().to_toml(), Style().to_toml());
}

TEST(Look, WhatIsSavedReadsBack)
{
    const test::Folder folder;
    const std::filesystem::path path = folder.path() / "mine.toml";
    Look look("comic", Style::load("comic"));
    look.set("hatch.width_mm=0.5");
    look.save(path);
    EXPECT_EQ(look.name(), path.string());
    EXPECT_EQ(Style::load(path.string()).to_toml(), look.style().to_toml());
    EXPECT_THROW(look.save(folder.path() / "nowhere" / "mine.toml"), Error);
}

} // namespace
} // namespace estampe::viewer
