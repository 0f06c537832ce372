// SPDX-License-Identifier: MIT
#include "viewer/studio.hpp"

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "features/common/style_tables.hpp"
#include "support/folder.hpp"

namespace estampe::viewer {
namespace {

float width_mm(const EditedStyle& edited)
{
    return edited.style().tables().hatch.width_mm;
}

TEST(EditedStyle, UndoAndRedoGoStepByStep)
{
    EditedStyle edited("", Style());
    const float first = width_mm(edited);
    edited.set("hatch.width_mm=1");
    edited.set("hatch.width_mm=2");
    edited.undo();
    EXPECT_EQ(width_mm(edited), 1.0F);
    edited.undo();
    EXPECT_EQ(width_mm(edited), first);
    EXPECT_FALSE(edited.can_undo());
    edited.redo();
    edited.redo();
    EXPECT_EQ(width_mm(edited), 2.0F);
    EXPECT_FALSE(edited.can_redo());
    edited.undo();
    edited.set("hatch.width_mm=3");
    EXPECT_FALSE(edited.can_redo()) << "what was undone is forgotten";
    edited.undo();
    EXPECT_EQ(width_mm(edited), 1.0F);
}

TEST(EditedStyle, ADragIsOneStep)
{
    EditedStyle edited("", Style());
    const float first = width_mm(edited);
    for (const float value : {0.5F, 0.6F, 0.7F}) {
        edited.style().tables().hatch.width_mm = value;
        edited.changed();
    }
    edited.finish_change_if_any();
    edited.finish_change_if_any();
    edited.undo();
    EXPECT_EQ(width_mm(edited), first);
}

TEST(EditedStyle, APresetIsAStepAndWhatParametersGoBackTo)
{
    EditedStyle edited("", Style());
    edited.load("pencil");
    EXPECT_EQ(edited.name(), "pencil");
    EXPECT_EQ(edited.base().to_toml(), Style::load("pencil").to_toml());
    edited.undo();
    EXPECT_EQ(edited.name(), "");
    EXPECT_EQ(edited.style().to_toml(), Style().to_toml());
    EXPECT_THROW(edited.load("no-such-preset"), Error);
    EXPECT_EQ(edited.style().to_toml(), Style().to_toml());
    EXPECT_THROW(edited.set("hatch.width_mm=1000"), Error);
    EXPECT_EQ(edited.style().to_toml(), Style().to_toml());
}

TEST(EditedStyle, WhatIsSavedReadsBack)
{
    const test::Folder folder;
    const std::filesystem::path path = folder.path() / "mine.toml";
    EditedStyle edited("comic", Style::load("comic"));
    edited.set("hatch.width_mm=0.5");
    edited.save(path);
    EXPECT_EQ(edited.name(), path.string());
    EXPECT_EQ(Style::load(path.string()).to_toml(), edited.style().to_toml());
    EXPECT_THROW(edited.save(folder.path() / "nowhere" / "mine.toml"), Error);
}

} // namespace
} // namespace estampe::viewer
