// SPDX-License-Identifier: MIT
#include "viewer/scene_loader.hpp"

#include <atomic>
#include <chrono>

#include <gtest/gtest.h>

#include "support/files.hpp"

namespace estampe::viewer {
namespace {

app::DrawOptions draw_of(const std::string& scene)
{
    app::DrawOptions draw;
    draw.scene = scene;
    return draw;
}

/// The result of the last load.
SceneLoader::Result result_of(SceneLoader& loader)
{
    for (;;) {
        if (auto result = loader.take()) {
            return *result;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

TEST(SceneLoader, GivesTheSceneOrSaysWhyNot)
{
    std::atomic<int> wakes = 0;
    SceneLoader loader([&] { ++wakes; });
    loader.load(draw_of(test::square_scene().string()));
    const SceneLoader::Result read = result_of(loader);
    ASSERT_TRUE(std::holds_alternative<std::shared_ptr<const LoadedFile>>(read));
    EXPECT_FALSE(std::get<0>(read)->bounds.empty());
    EXPECT_GT(wakes, 0);
    EXPECT_TRUE(loader.share()) << "glTF tells how far it is";
    loader.load(draw_of("nowhere.glb"));
    const SceneLoader::Result missing = result_of(loader);
    ASSERT_TRUE(std::holds_alternative<std::string>(missing));
    EXPECT_NE(std::get<1>(missing).find("nowhere.glb"), std::string::npos);
}

TEST(SceneLoader, OnlyTheLastCounts)
{
    SceneLoader loader([] {});
    loader.load(draw_of(test::square_scene().string()));
    loader.load(draw_of("nowhere.glb"));
    EXPECT_TRUE(std::holds_alternative<std::string>(result_of(loader)));
    loader.load(draw_of(test::square_scene().string()));
    loader.cancel();
    EXPECT_FALSE(loader.is_loading());
    while (loader.is_busy()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_FALSE(loader.take());
}

} // namespace
} // namespace estampe::viewer
