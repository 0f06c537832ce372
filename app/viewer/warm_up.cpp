// SPDX-License-Identifier: MIT
#include "viewer/warm_up.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <unistd.h>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "drawing.hpp"
#include "process.hpp"
#include "worlds.hpp"

namespace estampe::viewer {
namespace {

namespace fs = std::filesystem;

constexpr const char* own_program = "/proc/self/exe";

std::string variable(const char* name)
{
    const char* const value = std::getenv(name);
    return value != nullptr ? value : "";
}

/// Returns a text that identifies this build of the program and the folder of Mesa's shader cache. If the
/// text changes, shaders must be compiled again.
std::string warmth()
{
    Hash hash;
    std::error_code problem;
    hash.add(fs::file_size(own_program, problem));
    hash.add(fs::last_write_time(own_program, problem).time_since_epoch().count());
    hash.add_text(variable("MESA_SHADER_CACHE_DIR"));
    return fmt::format("{:016x}\n", hash.value());
}

std::string text_of(const fs::path& file)
{
    constexpr uint64_t most_bytes = 64;
    try {
        const std::vector<std::byte> bytes = read_file(file, most_bytes);
        std::string text(bytes.size(), '\0');
        std::memcpy(text.data(), bytes.data(), bytes.size());
        return text;
    } catch (const Error&) {
        return {};
    }
}

/// Returns the command-line arguments with which this process was started.
std::vector<std::string> own_words()
{
    constexpr size_t most_bytes = 1 << 20U;
    std::vector<std::string> words;
    std::string all(most_bytes, '\0');
    std::FILE* const file = std::fopen("/proc/self/cmdline", "re");
    if (file == nullptr) {
        return words;
    }
    all.resize(std::fread(all.data(), 1, all.size(), file));
    std::fclose(file);
    for (size_t from = 0; from < all.size(); from += words.back().size() + 1) {
        words.emplace_back(all.c_str() + from);
    }
    return words;
}

} // namespace

fs::path warmth_file()
{
    const std::string cache = variable("XDG_CACHE_HOME");
    const std::string home = variable("HOME");
    const fs::path folder = !cache.empty()  ? fs::path(cache)
                            : !home.empty() ? fs::path(home) / ".cache"
                                            : fs::path();
    return folder.empty() ? folder : folder / "estampe" / "compiled-well";
}

WarmUp::WarmUp(const app::ViewCommand& command) : has_scene_(!command.draw.scene.empty())
{
    const fs::path file = warmth_file();
    is_quick_ = !file.empty() && text_of(file) != warmth() && app::compile_quickly();
}

void WarmUp::begin(const std::string& scene)
{
    std::vector<std::string> words = own_words();
    if (!std::exchange(is_quick_, false) || words.size() < 2) {
        return;
    }
    std::error_code problem;
    words.front() = fs::read_symlink(own_program, problem).string();
    words.insert(words.begin() + 2, "--warm-up");
    if (!has_scene_) {
        words.push_back(scene);
    }
    try {
        process_ = std::make_unique<output::Child>(words, "");
    } catch (const Error&) {
        return; // Nothing is written to the file, so that the next start also compiles without optimisation
    }
}

void warm_up(const app::ViewCommand& command)
{
    constexpr int behind_others = 10;
    std::ignore = nice(behind_others);
    app::compile_well();
    const app::DrawOptions& draw = command.draw;
    const Scene scene = app::load_scene_of(draw);
    const Index animation = app::choose_animation(draw, scene);
    const Camera camera = app::choose_camera(draw, scene, animation);
    Renderer renderer(draw.device);
    app::set_scene(renderer, scene, draw);
    const Style style =
        app::WorldAnimator(draw, scene, worlds::Occasion::walk).show(renderer, draw.time_s, camera);
    RenderSettings settings = app::settings_of(draw, animation);
    for (const Continuity continuity : {Continuity::still, Continuity::starts, Continuity::follows}) {
        settings.continuity = continuity;
        std::ignore = renderer.render(camera, style, settings);
    }
    const fs::path file = warmth_file();
    make_private_folder(file.parent_path());
    const std::string text = warmth();
    write_file_atomically(file, std::as_bytes(std::span(text)));
}

} // namespace estampe::viewer
