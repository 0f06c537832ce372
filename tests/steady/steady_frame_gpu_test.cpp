// SPDX-License-Identifier: MIT
// A steady frame: the scene and the style are as they were, the camera moves on. What the processor does for
// it should be little, and nothing of it a request to the heap.

#include <ctime>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "steady/counted_heap.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

constexpr int frames_before = 12; // compile, upload, make room
constexpr int frames_counted = 25;
constexpr uint64_t own_requests = 1; // the picture that is handed out

/// Balls on a floor, a sun and three lamps.
Scene balls()
{
    Scene scene;
    scene.materials.push_back({.name = "chalk"});
    scene.meshes.push_back({.primitives = {shapes::plane(20.0F, 20.0F, 4)}});
    scene.meshes.push_back({.primitives = {shapes::sphere(1.0F, 32, 16)}});
    const auto add = [&](Node node) {
        scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
        scene.nodes.push_back(std::move(node));
    };
    add({.name = "floor", .mesh = 0});
    for (int i = 0; i < 5; ++i) {
        add({.name = "ball", .transform = {.translation = {3.0 * i - 6.0, 1.0, 0.0}}, .mesh = 1});
    }
    scene.lights.push_back({.type = LightType::directional, .intensity = 2.0F});
    scene.lights.push_back({.type = LightType::point, .intensity = 10.0F, .range_m = 6.0F});
    const glm::dquat down = glm::angleAxis(-1.0, glm::dvec3(1.0, 0.0, 0.0));
    add({.name = "sun", .transform = {.rotation = down}, .light = 0});
    for (int i = 0; i < 3; ++i) {
        add({.name = "lamp", .transform = {.translation = {4.0 * i - 4.0, 3.0, 2.0}}, .light = 1});
    }
    return scene;
}

/// The camera goes round the scene, a little each frame.
Camera camera_at(int frame)
{
    const double angle = 0.002 * frame;
    return {.eye = {14.0 * std::sin(angle), 6.0, 14.0 * std::cos(angle)}, .target = {0.0, 1.0, 0.0}};
}

double thread_ms()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Steady {
    std::vector<uint64_t> requests; ///< to the heap, by frame
    std::vector<double> cpu_ms;     ///< of the thread that asks for the frame: drivers draw in others
};

Steady draw_on(Renderer& renderer, const Style& style, const std::function<double(int frame)>& time_s)
{
    Steady steady;
    steady.requests.reserve(frames_counted);
    steady.cpu_ms.reserve(frames_counted);
    for (int frame = 0; frame < frames_before + frames_counted; ++frame) {
        const RenderSettings settings{.width = 160, .height = 90, .time_s = time_s(frame)};
        const double begin_ms = thread_ms();
        const uint64_t before = test::heap_count().times;
        const Image picture = renderer.render(camera_at(frame), style, settings);
        if (frame >= frames_before) {
            steady.requests.push_back(test::heap_count().times - before);
            steady.cpu_ms.push_back(thread_ms() - begin_ms);
        }
    }
    std::ranges::sort(steady.cpu_ms);
    return steady;
}

/// Whatever the style draws with.
TEST(SteadyFrame, AsksNothingOfTheHeap)
{
    Style with_occlusion;
    with_occlusion.set("occlusion.enabled=true");
    const std::vector<std::pair<std::string, Style>> styles{{"default", Style()},
                                                            {"occlusion", with_occlusion},
                                                            {"chirico", Style::load("chirico")},
                                                            {"ukiyoe", Style::load("ukiyoe")}};
    for (const auto& [name, style] : styles) {
        Renderer renderer({.device = "cpu"});
        renderer.set_scene(balls());
        const Steady steady = draw_on(renderer, style, [](int) { return 0.0; });
        const uint64_t most = *std::ranges::max_element(steady.requests);
        RecordProperty(name + "_cpu_ms", std::to_string(steady.cpu_ms.front()));
        std::printf("%s: %lu requests, %.3f ms of processor at least, %.3f in the middle\n", name.c_str(),
                    static_cast<unsigned long>(most), steady.cpu_ms.front(),
                    steady.cpu_ms[steady.cpu_ms.size() / 2]);
        EXPECT_EQ(most, own_requests) << name;
    }
}

/// Two textures, of the scene and of the style, whose path is too long for a small text.
TEST(SteadyFrame, AsksNothingOfTheHeapForShadeTextures)
{
    const test::Folder folder;
    const Image violet{.width = 1, .height = 1, .rgba = {90, 60, 150, 255}};
    save_png(violet, folder / "shade-of-a-long-name.png");
    Scene scene = balls();
    scene.textures.push_back({.image = violet});
    scene.materials[0].toon.emplace().shade_texture.texture = 0;
    Style pictured;
    pictured.set("wash.shade_texture=" + (folder / "shade-of-a-long-name.png").string());
    for (const Style& style : {Style(), pictured}) {
        Renderer renderer({.device = "cpu"});
        renderer.set_scene(scene);
        const Steady steady = draw_on(renderer, style, [](int) { return 0.0; });
        EXPECT_EQ(*std::ranges::max_element(steady.requests), own_requests);
        EXPECT_NE(renderer.graph_dot().find("surface/shade"), std::string::npos);
    }
}

TEST(CountedHeap, CountsWhatIsAskedFor)
{
    const test::HeapCount before = test::heap_count();
    const std::vector<int> list(1000, 1);
    EXPECT_EQ(test::heap_count().times, before.times + 1);
    EXPECT_GE(test::heap_count().bytes, before.bytes + list.size() * sizeof(int));
}

} // namespace
} // namespace estampe
