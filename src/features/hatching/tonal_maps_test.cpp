// SPDX-License-Identifier: MIT
#include "features/hatching/hatching.hpp"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "support/folder.hpp"

namespace estampe::features {
namespace {

/// Sets the cache to a folder of its own during its lifetime.
class CacheFolder {
public:
    CacheFolder()
    {
        const char* before = std::getenv("XDG_CACHE_HOME");
        before_ = before != nullptr ? before : "";
        setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
    }

    ~CacheFolder()
    {
        before_.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", before_.c_str(), 1);
    }

    CacheFolder(const CacheFolder&) = delete;
    CacheFolder& operator=(const CacheFolder&) = delete;

    [[nodiscard]] std::filesystem::path path() const { return folder_.path(); }

private:
    test::Folder folder_;
    std::string before_;
};

MapChoice small_map(int seed)
{
    return {.drawn = {.size_px = 64, .length_px = 30.0F, .seed = seed}};
}

TEST(TonalMaps, AreKeptAndReadBackTheSame)
{
    const CacheFolder folder;
    const MapChoice choice = small_map(1);
    const hatch::MapData drawn = load_map(choice);
    ASSERT_TRUE(std::filesystem::exists(kept_map(choice.drawn)));
    const hatch::MapData kept = load_map(choice);
    EXPECT_EQ(kept.level_of_tone, drawn.level_of_tone);
    EXPECT_EQ(kept.threshold_of_level, drawn.threshold_of_level);
    EXPECT_NE(kept_map(small_map(2).drawn), kept_map(choice.drawn));
    EXPECT_NE(load_map(small_map(2)).level_of_tone, drawn.level_of_tone);
}

TEST(TonalMaps, ThatWereKeptAndDamagedAreDrawnAnew)
{
    const CacheFolder folder;
    const MapChoice choice = small_map(1);
    const hatch::MapData drawn = load_map(choice);
    std::ofstream(kept_map(choice.drawn)) << "no map";
    EXPECT_EQ(load_map(choice).level_of_tone, drawn.level_of_tone);
    EXPECT_GT(std::filesystem::file_size(kept_map(choice.drawn)), 1000U);
}

TEST(TonalMaps, AreNotKeptWhereOtherUsersWrite)
{
    using std::filesystem::perms;
    const CacheFolder folder;
    const MapChoice choice = small_map(1);
    const hatch::MapData drawn = load_map(choice);
    std::filesystem::rename(kept_map(small_map(1).drawn), kept_map(small_map(2).drawn));
    EXPECT_EQ(load_map(small_map(2)).level_of_tone, drawn.level_of_tone) << "the file of the cache is used";
    std::filesystem::permissions(folder.path() / "estampe", perms::all);
    EXPECT_NE(load_map(small_map(2)).level_of_tone, drawn.level_of_tone);
    static_cast<void>(load_map(choice));
    EXPECT_FALSE(std::filesystem::exists(kept_map(choice.drawn)));
}

} // namespace
} // namespace estampe::features
