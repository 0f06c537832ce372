// SPDX-License-Identifier: MIT
// Draws a world that was registered only for this test, by its name and through the same code as all others.
#include <initializer_list>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "drawing.hpp"
#include "film.hpp"
#include "render.hpp"
#include "support/folder.hpp"
#include "support/gpu_device.hpp"
#include "world/test_world.hpp"

namespace estampe::app {
namespace {

/// The command of a drawing as in `estampe batch`, on the device of the tests.
RenderCommand draw(std::initializer_list<std::string> words)
{
    std::vector<const char*> all{"estampe", "render"};
    for (const std::string& word : words) {
        all.push_back(word.c_str());
    }
    RenderCommand command =
        std::get<RenderCommand>(read_command_line(static_cast<int>(all.size()), all.data()).value());
    const Scene scene = load_scene_of(command.draw);
    Renderer& renderer = test::shared_renderer();
    set_scene(renderer, scene, command.draw);
    if (command.film) {
        draw_film(renderer, scene, command);
    } else {
        draw_and_write(renderer, scene, command);
    }
    return command;
}

TEST(AppWorldPictures, AWorldIsDrawnByNameWithItsOption)
{
    worlds::test::know_box();
    const test::Folder folder;
    const std::string wide = (folder.path() / "wide.png").string();
    const std::string narrow = (folder.path() / "narrow.png").string();
    static_cast<void>(draw({"box", "-o", narrow, "--size", "96x54"}));
    const DrawOptions options = draw({"box", "-o", wide, "--size", "96x54", "--world", "width=3"}).draw;
    EXPECT_NE(load_image(wide).rgba, load_image(narrow).rgba);

    worlds::test::BoxWorld world(3.0);
    const Scene scene = world.scene();
    const Camera camera = choose_camera(options, scene, no_index);
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    world.go_to(0.0, camera);
    world.show(renderer);
    EXPECT_EQ(load_image(wide).rgba,
              renderer.render(camera, options.style, settings_of(options, no_index)).rgba);
}

TEST(AppWorldPictures, ItsOwnFilmHasItsLengthAndMoves)
{
    worlds::test::know_box();
    const test::Folder folder;
    static_cast<void>(draw({"box", "-o", (folder.path() / "%d.png").string(), "--size", "96x54", "--film"}));
    const auto frame = [&](int number) { return folder.path() / (std::to_string(number) + ".png"); };
    ASSERT_TRUE(std::filesystem::exists(frame(5))) << "0.2 s of 24 frames a second";
    EXPECT_FALSE(std::filesystem::exists(frame(6)));
    EXPECT_NE(load_image(frame(1)).rgba, load_image(frame(5)).rgba);
}

} // namespace
} // namespace estampe::app
