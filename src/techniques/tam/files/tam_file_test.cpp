// SPDX-License-Identifier: MIT
#include "techniques/tam/files/map_files.hpp"

#include <cstring>
#include <memory>

#include <gtest/gtest.h>
#include <zip.h>

#include "core/file.hpp"
#include "techniques/tam/stroke.hpp"
#include "techniques/tam/test_support.hpp"

namespace estampe::tam {
namespace {

using testing::Folder;
using testing::message_of;
using testing::small_map;

const std::vector<std::byte>& small_file()
{
    static const std::vector<std::byte> bytes = encode_tam(small_map());
    return bytes;
}

/// Error message of reading `bytes`; empty if the map is valid.
std::string complaint(std::span<const std::byte> bytes)
{
    return message_of([&] { check_map(decode_tam(bytes, "hostile.tam"), "read"); });
}

/// A file with one entry replaced, or removed where `content` is null.
std::string with_entry(const std::filesystem::path& file, const std::string& entry,
                       const std::string* content)
{
    write_file_atomically(file, small_file());
    int failure = 0;
    zip_t* archive = zip_open(file.c_str(), 0, &failure);
    if (content == nullptr) {
        zip_delete(archive, static_cast<zip_uint64_t>(zip_name_locate(archive, entry.c_str(), 0)));
    } else {
        zip_file_add(archive, entry.c_str(), zip_source_buffer(archive, content->data(), content->size(), 0),
                     ZIP_FL_OVERWRITE);
    }
    zip_close(archive);
    return message_of([&] { static_cast<void>(load_tam(file)); });
}

std::string changed(std::string text, const std::string& from, const std::string& to)
{
    const size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
}

TEST(TamFile, ReadsBackWhatItWrote)
{
    EXPECT_EQ(decode_tam(small_file(), "small.tam"), small_map());
    EXPECT_EQ(encode_tam(small_map()), small_file());
}

TEST(TamFile, KeepsAFileWhenItCannotWrite)
{
    const Folder folder;
    save_tam(small_map(), folder / "map.tam");
    EXPECT_EQ(load_tam(folder / "map.tam"), small_map());
    TonalArtMap broken = small_map();
    broken.darkness.pop_back();
    EXPECT_THROW(save_tam(broken, folder / "map.tam"), Error);
    EXPECT_EQ(load_tam(folder / "map.tam"), small_map());
    EXPECT_THROW(save_tam(small_map(), folder / "none/map.tam"), Error);
}

TEST(TamFile, RefusesATruncatedFile)
{
    for (size_t length = 0; length < small_file().size(); length += 1 + length / 40) {
        EXPECT_NE(complaint(std::span(small_file()).first(length)), "") << length;
    }
}

TEST(TamFile, SurvivesDamage)
{
    Random random(5);
    int refused = 0;
    for (int round = 0; round < 600; ++round) {
        std::vector<std::byte> bytes = small_file();
        for (int i = 0; i < 1 + round % 4; ++i) {
            // Every other change hits the zip directory at the end, which holds the sizes.
            const size_t reach = round % 2 == 0 ? bytes.size() : 3000;
            bytes[bytes.size() - 1 - random.bits() % reach] = static_cast<std::byte>(random.bits());
        }
        refused += complaint(bytes).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, 400);
}

TEST(TamFile, NamesTheEntryThatIsWrong)
{
    const Folder folder;
    const auto file = folder / "map.tam";
    const std::string manifest = manifest_of(small_map());
    const std::string text = "no picture";
    EXPECT_NE(with_entry(file, "tone2_level1.png", nullptr).find("map.tam#/tone2_level1.png: is missing"),
              std::string::npos);
    EXPECT_NE(with_entry(file, "tone2_level1.png", &text).find("tone2_level1.png: is not a PNG"),
              std::string::npos);
    EXPECT_NE(with_entry(file, "tam.toml", nullptr).find("tam.toml: is missing"), std::string::npos);
    EXPECT_NE(with_entry(file, "tam.toml", &text).find("tam.toml:1:"), std::string::npos);

    const auto with_manifest = [&](const std::string& from, const std::string& to) {
        const std::string changed_text = changed(manifest, from, to);
        return with_entry(file, "tam.toml", &changed_text);
    };
    EXPECT_NE(with_manifest("size_px = 32", "size_px = 64").find("is 32 px wide; this level is 64"),
              std::string::npos)
        << with_manifest("size_px = 32", "size_px = 64");
    EXPECT_NE(with_manifest("size_px = 32", "size_px = 1000000000").find("allowed: 32 to 2048"),
              std::string::npos);
    EXPECT_NE(with_manifest("size_px = 32", "size_px = 48").find("power of two"), std::string::npos);
    EXPECT_NE(with_manifest("version = 1", "version = 2").find("map.version = 2"), std::string::npos);
    EXPECT_NE(with_manifest("tone2 = ", "tone2 = 9").find("darkness must rise"), std::string::npos);
    EXPECT_NE(with_manifest("tone2 = ", "tone7 = ").find("tone2 is wanted"), std::string::npos);
    EXPECT_NE(with_manifest("thresholds = true", "thresholds = 1").find("true or false"), std::string::npos);
    EXPECT_EQ(with_manifest("thresholds = true", "thresholds = false"), "");
}

TEST(TamFile, RefusesWhatWouldGrowBeyondItsLimit)
{
    const Folder folder;
    const std::string zeros(size_t{70} << 20, '\0'); // compresses to 70 kB
    EXPECT_NE(with_entry(folder / "map.tam", "tam.toml", &zeros).find("more than the limit"),
              std::string::npos);
    EXPECT_NE(with_entry(folder / "map.tam", "tone1_level0.png", &zeros).find("more than the limit"),
              std::string::npos);
}

TEST(TamFile, RefusesOtherFiles)
{
    EXPECT_NE(complaint({}), "");
    const std::string text(5000, 'x');
    EXPECT_NE(complaint(std::as_bytes(std::span(text))).find("is not a .tam file"), std::string::npos);
    EXPECT_THROW(static_cast<void>(load_tam("/nonexistent/map.tam")), Error);
}

} // namespace
} // namespace estampe::tam
