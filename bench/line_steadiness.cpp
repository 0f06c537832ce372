// SPDX-License-Identifier: MIT
// How steady lines are: a mesh turns before the camera, and every pixel of line that has no line within a few
// pixels in the frame before or after counts. estampe_bench_line_steadiness --help

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/renderer.hpp>

#include "scene/pose.hpp"
#include "scene/subdivision.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

struct Options {
    std::string scene;
    std::string device = "auto";
    std::vector<std::string> settings;
    std::string frames_to;
    uint32_t levels = 0;
    uint32_t frames = 41;
    uint32_t width = 1920;
    uint32_t height = 1080;
    double step_deg = 0.25;
    double reach_px = 4.0;
    bool stills = false;
    bool timings = false;
};

Scene loaded(const Options& options)
{
    Scene scene = load_scene(options.scene);
    if (options.levels > 0) {
        for (Mesh& mesh : scene.meshes) {
            for (Primitive& primitive : mesh.primitives) {
                primitive = subdivided(primitive, options.levels);
            }
        }
    }
    return scene;
}

size_t triangle_count(const Scene& scene)
{
    size_t count = 0;
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            count += primitive.indices.size() / 3;
        }
    }
    return count;
}

/// Black lines on white, no tone, no grain.
Style line_style(const Options& options)
{
    Style style = Style::load("comic");
    for (const char* setting :
         {"hatch.drawn=false", "picture.ground=none", "wash.strength=0", "paper.grain=0",
          "paper.color=#ffffff", "paper.ink_break=0", "bleed.width_mm=0", "contour.ink=#000000"}) {
        style.set(setting);
    }
    for (const std::string& setting : options.settings) {
        style.set(setting);
    }
    return style;
}

std::vector<uint8_t> lines_in(const Image& image)
{
    std::vector<uint8_t> lines(size_t{image.width} * image.height);
    for (size_t i = 0; i < lines.size(); ++i) {
        lines[i] = image.rgba[4 * i + 1] < 128 ? 1 : 0;
    }
    return lines;
}

/// What lies within `reach_px` of a line.
std::vector<uint8_t> grown(const std::vector<uint8_t>& lines, uint32_t width, uint32_t height,
                           double reach_px)
{
    std::vector<uint8_t> result(lines.size(), 0);
    const int reach = static_cast<int>(reach_px);
    for (int y = 0; y < static_cast<int>(height); ++y) {
        for (int x = 0; x < static_cast<int>(width); ++x) {
            if (lines[static_cast<size_t>(y) * width + static_cast<size_t>(x)] == 0) {
                continue;
            }
            for (int dy = -reach; dy <= reach; ++dy) {
                for (int dx = -reach; dx <= reach; ++dx) {
                    const int px = x + dx;
                    const int py = y + dy;
                    if (dx * dx + dy * dy <= reach_px * reach_px && px >= 0 && py >= 0 &&
                        px < static_cast<int>(width) && py < static_cast<int>(height)) {
                        result[static_cast<size_t>(py) * width + static_cast<size_t>(px)] = 1;
                    }
                }
            }
        }
    }
    return result;
}

double percent_alone(const std::vector<uint8_t>& lines, const std::vector<uint8_t>& near_lines)
{
    size_t count = 0;
    size_t alone = 0;
    for (size_t i = 0; i < lines.size(); ++i) {
        count += lines[i];
        alone += lines[i] != 0 && near_lines[i] == 0 ? 1U : 0U;
    }
    return count > 0 ? 100.0 * static_cast<double>(alone) / static_cast<double>(count) : 0.0;
}

Camera turned(const Camera& camera, double angle_deg)
{
    const double angle = glm::radians(angle_deg);
    const glm::dvec3 away = camera.eye - camera.target;
    Camera result = camera;
    result.eye = camera.target + glm::dvec3(std::cos(angle) * away.x + std::sin(angle) * away.z, away.y,
                                            std::cos(angle) * away.z - std::sin(angle) * away.x);
    return result;
}

double median(std::vector<double>& values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void measure(const Options& options)
{
    const Scene scene = loaded(options);
    Renderer renderer({.device = options.device});
    renderer.set_scene(scene);
    const Style style = line_style(options);
    const Camera first = framing_camera(scene, pose_scene(scene, 0.0, no_index),
                                        static_cast<double>(options.width) / options.height);
    std::vector<double> shares;
    std::vector<double> lines_ms;
    std::map<std::string, std::vector<double>> pass_ms;
    std::vector<uint8_t> lines_before;
    std::vector<uint8_t> near_before;
    for (uint32_t frame = 0; frame < options.frames; ++frame) {
        RenderSettings settings{.width = options.width, .height = options.height, .time_passes = true};
        settings.continuity = options.stills ? Continuity::still
                              : frame == 0   ? Continuity::starts
                                             : Continuity::follows;
        const Image image = renderer.render(turned(first, frame * options.step_deg), style, settings);
        double sum_ms = 0.0;
        for (const PassTiming& pass : renderer.timings()) {
            if (pass.name.starts_with("contour/")) {
                sum_ms += pass.gpu_ms;
                pass_ms[pass.name].push_back(pass.gpu_ms);
            }
        }
        lines_ms.push_back(sum_ms);
        if (!options.frames_to.empty()) {
            save_png(image, fmt::format("{}/{:03}.png", options.frames_to, frame));
        }
        std::vector<uint8_t> lines = lines_in(image);
        std::vector<uint8_t> near_lines = grown(lines, options.width, options.height, options.reach_px);
        if (frame > 0) {
            shares.push_back(percent_alone(lines, near_before));
            shares.push_back(percent_alone(lines_before, near_lines));
        }
        lines_before = std::move(lines);
        near_before = std::move(near_lines);
    }
    for (auto& [name, times] : pass_ms) {
        if (options.timings) {
            fmt::print("{:28} {:8.3f} ms x {}\n", name, median(times), times.size() / options.frames);
        }
    }
    const double mean =
        std::accumulate(shares.begin(), shares.end(), 0.0) / static_cast<double>(shares.size());
    fmt::print(
        "{}: {} triangles, {} frames of {} degrees at {}x{}: line pixels without a line within {} px in "
        "the neighbouring frame: mean {:.4f} %, worst {:.4f} %\n",
        options.scene, triangle_count(scene), options.frames, options.step_deg, options.width, options.height,
        options.reach_px, mean, *std::max_element(shares.begin(), shares.end()));
    fmt::print("lines on {}: median {:.3f} ms a frame\n", renderer.device().name, median(lines_ms));
}

} // namespace

int main(int count, char** arguments)
{
    Options options;
    CLI::App app("Measures how steady lines are while a scene turns");
    app.add_option("scene", options.scene)->required();
    app.add_option("--levels", options.levels, "Subdivide so many times first");
    app.add_option("--frames", options.frames)->check(CLI::Range(2, 100000));
    app.add_option("--width", options.width);
    app.add_option("--height", options.height);
    app.add_option("--step-deg", options.step_deg);
    app.add_option("--reach-px", options.reach_px);
    app.add_option("--set", options.settings, "One parameter of the style; may be repeated");
    app.add_option("--device", options.device);
    app.add_option("--frames-to", options.frames_to, "Folder to write the frames to");
    app.add_flag("--stills", options.stills, "No frame goes on from the one before");
    app.add_flag("--timings", options.timings, "Time of every pass that draws lines");
    CLI11_PARSE(app, count, arguments);
    try {
        measure(options);
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
    return 0;
}
