// SPDX-License-Identifier: MIT
#include "techniques/tam/files/map_files.hpp"

#include <fstream>

#include <estampe/image.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/file.hpp"
#include "techniques/tam/test_support.hpp"

namespace estampe::tam {
namespace {

namespace fs = std::filesystem;
using testing::Folder;
using testing::message_of;
using testing::small_style;

TonalArtMap without_thresholds(TonalArtMap map)
{
    map.threshold_of_level.clear();
    return map;
}

const TonalArtMap& pen_map()
{
    static const TonalArtMap map = without_thresholds(make_map(small_style(Tool::pen, 256)));
    return map;
}

void paint(const fs::path& file, const Gray8& coverage, uint32_t size_px)
{
    save_png(picture_of(coverage, size_px), file);
}

std::string folder_complaint(const fs::path& path)
{
    return message_of([&] { static_cast<void>(read_map(path)); });
}

TEST(MapFolder, ReadsBackWhatItWroteInEveryForm)
{
    const Folder folder;
    for (const char* name : {"map.tam", "pictures/", "map.dds", "pictures2"}) {
        write_map(pen_map(), folder / name);
        const PaintedMap read = read_map(folder / name);
        EXPECT_EQ(read.map.level_of_tone, pen_map().level_of_tone) << name;
        EXPECT_TRUE(read.warnings.empty()) << name;
        for (size_t tone = 0; tone < pen_map().darkness.size(); ++tone) {
            EXPECT_NEAR(read.map.darkness[tone], pen_map().darkness[tone], 0.01F);
        }
    }
    EXPECT_EQ(read_map(folder / "pictures").map, pen_map()); // tam.toml stores the darkness exactly
}

TEST(MapFolder, DerivesLevelsFromTonesAlone)
{
    const Folder folder;
    for (size_t tone = 0; tone < pen_map().darkness.size(); ++tone) {
        paint(folder / fmt::format("my tone {}.png", tone + 1), pen_map().level_of_tone[tone][0], 256);
    }
    const PaintedMap read = read_map(folder.path());
    ASSERT_EQ(read.warnings.size(), 1U);
    const std::vector<std::vector<Gray8>>& tones = read.map.level_of_tone;
    for (size_t tone = 0; tone < tones.size(); ++tone) {
        for (size_t level = 0; level < tones[tone].size(); ++level) {
            EXPECT_NEAR(mean_coverage(tones[tone][level]), read.map.darkness[tone], 0.03)
                << "tone " << tone << " level " << level;
            for (size_t texel = 0; tone > 0 && texel < tones[tone][level].size(); ++texel) {
                ASSERT_GE(tones[tone][level][texel], tones[tone - 1][level][texel]);
            }
        }
    }
}

TEST(MapFolder, KeepsThePaintedLevelsAndDerivesTheRest)
{
    const Folder folder;
    for (size_t tone = 0; tone < 2; ++tone) {
        for (size_t level = 0; level < 3; ++level) {
            paint(folder / fmt::format("t{}l{}.png", tone + 1, level), pen_map().level_of_tone[tone][level],
                  256U >> level);
        }
    }
    const PaintedMap read = read_map(folder.path());
    for (size_t level = 0; level < 3; ++level) {
        EXPECT_EQ(read.map.level_of_tone[1][level], pen_map().level_of_tone[1][level]);
    }
    EXPECT_NEAR(mean_coverage(read.map.level_of_tone[1][4]), read.map.darkness[1], 0.03);
}

TEST(MapFolder, AddsWhatADarkerToneLacks)
{
    const Folder folder;
    Gray8 lighter(size_t{64} * 64);
    Gray8 darker(size_t{64} * 64);
    for (size_t x = 4; x < 60; ++x) {
        lighter[size_t{10} * 64 + x] = 255;
        darker[size_t{30} * 64 + x] = 255;
        darker[size_t{31} * 64 + x] = 255;
    }
    paint(folder / "1.png", lighter, 64);
    paint(folder / "2.png", darker, 64);
    const PaintedMap read = read_map(folder.path());
    EXPECT_EQ(read.map.level_of_tone[1][0][size_t{10} * 64 + 20], 255);
    EXPECT_NE(read.warnings.front().find("tone 2 lacked 100.0 %"), std::string::npos);
}

TEST(MapFolder, ReadsAFolderOfDdsFilesOneATone)
{
    const Folder folder;
    TonalArtMap one = pen_map();
    for (size_t tone = 0; tone < 3; ++tone) {
        one.darkness = {pen_map().darkness[tone]};
        one.level_of_tone = {pen_map().level_of_tone[tone]};
        write_file_atomically(folder / fmt::format("tone{}.dds", tone), encode_dds(one));
    }
    EXPECT_EQ(read_map(folder.path()).map.level_of_tone[2], pen_map().level_of_tone[2]);
}

TEST(MapFolder, SaysWhichFileIsWrong)
{
    const Folder folder;
    EXPECT_NE(folder_complaint(folder.path()).find("holds no PNG or DDS files"), std::string::npos);
    EXPECT_NE(folder_complaint(folder / "none").find("none: cannot open"), std::string::npos);
    const Gray8 dark(size_t{64} * 64, 100);
    paint(folder / "tone1.png", dark, 64);
    paint(folder / "tone2.png", dark, 64);
    EXPECT_NE(folder_complaint(folder.path()).find("tone 2 has 39.2 % ink, no more"), std::string::npos)
        << folder_complaint(folder.path());
    paint(folder / "tone2.png", Gray8(size_t{32} * 32, 200), 32);
    EXPECT_NE(folder_complaint(folder.path()).find("tone2.png: is 32 px wide"), std::string::npos);
    std::ofstream(folder / "tone2.png") << "no picture";
    EXPECT_NE(folder_complaint(folder.path()).find("tone2.png: is not a PNG"), std::string::npos);
    fs::rename(folder / "tone2.png", folder / "tone2_level0.png");
    EXPECT_NE(folder_complaint(folder.path()).find("does not tell tone and level"), std::string::npos);
    fs::rename(folder / "tone2_level0.png", folder / "another 1.png");
    EXPECT_NE(folder_complaint(folder.path()).find("is the same tone and level as"), std::string::npos);
    fs::remove(folder / "another 1.png");
    fs::rename(folder / "tone1.png", folder / "tone1_level1.png");
    EXPECT_NE(folder_complaint(folder.path()).find("level 0 of this tone is missing"), std::string::npos);
    fs::remove(folder / "tone1_level1.png");
    save_png(Image{.width = 2, .height = 1, .rgba = std::vector<uint8_t>(8)}, folder / "tone1.png");
    EXPECT_NE(folder_complaint(folder.path()).find("is 2 x 1 pixels"), std::string::npos);
}

TEST(MapFolder, DoesNotWriteOverWhatIsThere)
{
    const Folder folder;
    fs::create_directory(folder / "mine");
    std::ofstream(folder / "mine/letter.txt") << "dear";
    EXPECT_NE(message_of([&] { write_map(pen_map(), folder / "mine/"); }).find("is not empty"),
              std::string::npos);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
    EXPECT_NE(message_of([&] { write_map(pen_map(), folder / "none/mine/"); }).find("cannot write"),
              std::string::npos);
}

} // namespace
} // namespace estampe::tam
