// SPDX-License-Identifier: MIT
// Measures how steady lines are. A mesh turns before the camera. A line pixel counts as unsteady if the frame
// before or after has no line within a few pixels. estampe_bench_line_steadiness --help

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <estampe/renderer.hpp>

#include "common/command_line.hpp"
#include "common/film.hpp"
#include "common/measuring.hpp"
#include "scene/pose.hpp"
#include "scene/smooth_surface.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

struct Options {
    std::string scene;
    bench::FilmOptions film{.style = "comic"};
    uint32_t levels = 0;
    uint32_t frames = 41;
    double step_deg = 0.25;
    double reach_px = 4.0;
    bool stills = false;
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

/// Black lines on white, without tone and grain, unless --set changes this.
Style line_style(const bench::FilmOptions& film)
{
    bench::FilmOptions plain = film;
    plain.assignments = {"hatch.enabled=false", "picture.ground=false", "wash.strength=0",
                         "paper.grain=0",       "paper.color=#ffffff",  "paper.ink_break=0",
                         "bleed.enabled=false", "contour.ink=#000000"};
    plain.assignments.insert(plain.assignments.end(), film.assignments.begin(), film.assignments.end());
    return plain.load_style();
}

std::vector<uint8_t> lines_in(const Image& image)
{
    std::vector<uint8_t> lines(size_t{image.width} * image.height);
    for (size_t i = 0; i < lines.size(); ++i) {
        lines[i] = image.rgba[4 * i + 1] < 128 ? 1 : 0;
    }
    return lines;
}

/// The pixels within `reach_px` of a line.
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

/// Finds the passes that draw lines.
std::vector<PassTiming> line_passes(const Renderer& renderer)
{
    std::vector<PassTiming> passes = renderer.timings();
    std::erase_if(passes, [](const PassTiming& pass) { return !pass.name.starts_with("contour/"); });
    return passes;
}

void measure(const Options& options)
{
    const Scene scene = loaded(options);
    const uint32_t width = options.film.width;
    const uint32_t height = options.film.height;
    Renderer renderer({.device = options.film.device});
    renderer.set_scene(scene);
    const Style style = line_style(options.film);
    const Camera first =
        framing_camera(scene, pose_scene(scene, 0.0, no_index), static_cast<double>(width) / height);
    std::vector<double> shares;
    bench::Rounds lines_drawn;
    std::vector<uint8_t> lines_before;
    std::vector<uint8_t> near_before;
    for (uint32_t frame = 0; frame < options.frames; ++frame) {
        RenderSettings settings{.width = width, .height = height, .time_passes = true};
        settings.continuity = options.stills ? Continuity::still
                              : frame == 0   ? Continuity::starts
                                             : Continuity::follows;
        const Image image = renderer.render(turned(first, frame * options.step_deg), style, settings);
        const std::vector<PassTiming> passes = line_passes(renderer);
        lines_drawn.add(bench::sum_ms(passes), passes);
        options.film.save(image, static_cast<int>(frame));
        std::vector<uint8_t> lines = lines_in(image);
        std::vector<uint8_t> near_lines = grown(lines, width, height, options.reach_px);
        if (frame > 0) {
            shares.push_back(percent_alone(lines, near_before));
            shares.push_back(percent_alone(lines_before, near_lines));
        }
        lines_before = std::move(lines);
        near_before = std::move(near_lines);
    }
    const double mean =
        std::accumulate(shares.begin(), shares.end(), 0.0) / static_cast<double>(shares.size());
    fmt::print(
        "{}: {} triangles, {} frames of {} degrees at {}x{}: line pixels without a line within {} px in "
        "the neighbouring frame: mean {:.4f} %, worst {:.4f} %\n",
        options.scene, triangle_count(scene), options.frames, options.step_deg, width, height,
        options.reach_px, mean, std::ranges::max(shares));
    fmt::print("lines on {}: {} a frame\n{}", renderer.device().name, lines_drawn.text(),
               options.film.passes ? lines_drawn.passes_table() : "");
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Measures how steady lines are while a scene turns", "estampe_bench_line_steadiness");
    app.add_option("scene", options.scene)->required();
    options.film.add_to(app);
    app.add_option("--levels", options.levels, "Subdivide so many times first");
    app.add_option("--frames", options.frames)->capture_default_str()->check(CLI::Range(2, 100000));
    app.add_option("--step-deg", options.step_deg, "Turn from frame to frame")->capture_default_str();
    app.add_option("--reach-px", options.reach_px, "Distance within which a line counts as the same one")
        ->capture_default_str();
    app.add_flag("--stills", options.stills, "Draw each frame as a still, without the frame before it");
    return bench::run(app, argc, argv, [&] { measure(options); });
}
