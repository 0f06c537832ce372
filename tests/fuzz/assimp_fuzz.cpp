// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the file, and whatever the process that reads it sends, there is a scene or an
// Error. The first byte tells what the rest is: what the process sends, which is read here so that libFuzzer
// sees every branch; or a file of a format, which is read in a process of its own.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>

#include <unistd.h>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>

#include "core/child/exchange_test_support.hpp"
#include "scene/reader/crossing.hpp"

namespace {

using namespace estampe;

void read_sent(std::span<const std::byte> bytes)
{
    constexpr uint64_t budget_bytes = uint64_t{1} << 26U;
    ByteReader reader = test::reader_of(bytes, budget_bytes, "fuzz");
    Scene scene;
    receive(reader, scene);
    check_received_scene(scene, "fuzz");
    const ScenePose pose = pose_scene(scene, 0.5);
    (void)scene_bounds(scene, pose);
}

void read_file_of(const char* extension, std::span<const std::byte> bytes)
{
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(getpid()) + extension);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    const Scene scene = load_scene(path);
    (void)framing_camera(scene, pose_scene(scene, 0.5), 1.5);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    constexpr std::array extensions{".fbx", ".dae"};
    if (size == 0) {
        return 0;
    }
    const std::span bytes(reinterpret_cast<const std::byte*>(data) + 1, size - 1);
    try {
        if (data[0] < extensions.size()) {
            read_file_of(extensions[data[0]], bytes);
        } else {
            read_sent(bytes);
        }
    } catch (const Error&) {
        return 0;
    }
    return 0;
}
