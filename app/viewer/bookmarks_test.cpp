// SPDX-License-Identifier: MIT
#include "viewer/studio.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "support/folder.hpp"

namespace estampe::viewer {
namespace {

TEST(Bookmarks, ReadBackAsTheyWere)
{
    const test::Folder folder;
    const std::filesystem::path path = bookmarks_path(folder.path() / "fox.glb");
    EXPECT_EQ(path.filename(), "fox.glb.views.json");
    EXPECT_TRUE(load_bookmarks(path).empty());
    std::vector<Bookmark> kept{{.name = "front \"door\"", .camera = {.eye = {1.1, 2.2, 1e7}}, .time_s = 0.25},
                               {.name = "plan", .animation = 2}};
    kept[1].camera.orthographic_half_height_m = 3.5;
    save_bookmarks(kept, path);
    const std::vector<Bookmark> read = load_bookmarks(path);
    ASSERT_EQ(read.size(), 2U);
    EXPECT_EQ(read[0].name, kept[0].name);
    EXPECT_EQ(read[0].camera.eye, kept[0].camera.eye);
    EXPECT_NEAR(read[0].camera.vertical_fov_rad, kept[0].camera.vertical_fov_rad, 1e-12);
    EXPECT_FALSE(read[0].camera.orthographic_half_height_m);
    EXPECT_EQ(read[0].time_s, 0.25);
    EXPECT_EQ(read[1].camera.orthographic_half_height_m, 3.5);
    EXPECT_EQ(read[1].animation, 2U);
    save_bookmarks({}, path);
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Bookmarks, BrokenFilesAreErrorsThatNameThem)
{
    const test::Folder folder;
    const std::filesystem::path path = folder.path() / "a.views.json";
    for (const char* text : {"", "{", "[]", "{\"views\": [{}]}", "{\"views\": [{\"name\": 3}]}",
                             R"({"views": [{"name": "a", "eye": [1, 2], "target": [0, 0, 0], "up": [0, 1, 0],
                                 "fov_deg": 30, "near_m": 0.1, "time_s": 0, "animation": 0}]})",
                             R"({"views": [{"name": "a", "eye": [1, 2, 1e300], "target": [0, 0, 0],
                                 "up": [0, 1, 0], "fov_deg": 30, "near_m": 0.1, "time_s": 0, "animation": 0}]})"}) {
        std::ofstream(path) << text;
        try {
            static_cast<void>(load_bookmarks(path));
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.where(), path.string());
        }
    }
}

} // namespace
} // namespace estampe::viewer
