// SPDX-License-Identifier: MIT
// Measures how steady lines are. A mesh turns before the camera. A line pixel counts as unsteady if the frame
// before or after has no line within a few pixels, and blinks if neither of the two frames has even a faint
// one: a line that is thinner than a pixel gets lighter and darker while it moves over the pixels. Also
// measures the lengths of the strokes of the first frame. estampe_bench_line_steadiness --help

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <estampe/renderer.hpp>
#include <estampe/vector_drawing.hpp>

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

/// The pixels that are darker than `lightest`.
std::vector<uint8_t> lines_in(const Image& image, uint8_t lightest)
{
    std::vector<uint8_t> lines(size_t{image.width} * image.height);
    for (size_t i = 0; i < lines.size(); ++i) {
        lines[i] = image.rgba[4 * i + 1] < lightest ? 1 : 0;
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

/// Share of the line pixels for which `is_counted` holds, in percent.
template <class IsCounted>
double percent_of(const std::vector<uint8_t>& lines, const IsCounted& is_counted)
{
    size_t count = 0;
    size_t counted = 0;
    for (size_t i = 0; i < lines.size(); ++i) {
        count += lines[i];
        counted += lines[i] != 0 && is_counted(i) ? 1U : 0U;
    }
    return count > 0 ? 100.0 * static_cast<double>(counted) / static_cast<double>(count) : 0.0;
}

/// The lines of one frame.
struct LinePixels {
    std::vector<uint8_t> lines;
    std::vector<uint8_t> near_lines;       ///< the pixels within the reach of a line
    std::vector<uint8_t> near_faint_lines; ///< the pixels within the reach of a line, even of a faint one

    [[nodiscard]] double percent_away_from(const LinePixels& other) const
    {
        return percent_of(lines, [&](size_t i) { return other.near_lines[i] == 0; });
    }

    /// Share of the line pixels without even a faint line nearby in the frame before and in the frame after.
    [[nodiscard]] double percent_blinking(const LinePixels& before, const LinePixels& after) const
    {
        return percent_of(lines, [&](size_t i) {
            return before.near_faint_lines[i] == 0 && after.near_faint_lines[i] == 0;
        });
    }
};

/// How long the pen's strokes of contours are on a page of this size.
std::string stroke_lengths(Renderer& renderer, const Camera& camera, const Style& style,
                           const RenderSettings& settings)
{
    constexpr double short_mm = 1.5;
    std::vector<double> lengths_mm;
    for (const VectorStroke& stroke : renderer.draw_strokes(camera, style, settings).strokes) {
        if (stroke.kind != StrokeKind::hatch && stroke.kind != StrokeKind::frame) {
            double length_mm = 0.0;
            for (size_t i = 1; i < stroke.points.size(); ++i) {
                length_mm += glm::distance(stroke.points[i - 1].page_mm, stroke.points[i].page_mm);
            }
            lengths_mm.push_back(length_mm);
        }
    }
    if (lengths_mm.empty()) {
        return "no strokes";
    }
    std::ranges::sort(lengths_mm);
    const auto shorter = std::ranges::lower_bound(lengths_mm, short_mm) - lengths_mm.begin();
    return fmt::format("{} strokes of contours, {:.1f} % shorter than {} mm, median {:.2f} mm",
                       lengths_mm.size(),
                       100.0 * static_cast<double>(shorter) / static_cast<double>(lengths_mm.size()),
                       short_mm, lengths_mm[lengths_mm.size() / 2]);
}

double mean_of(const std::vector<double>& values)
{
    return values.empty()
               ? 0.0
               : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
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
    std::vector<double> blinks;
    bench::Rounds lines_drawn;
    std::array<LinePixels, 3> frames; // the present frame, the frame before, and the one before that
    for (uint32_t frame = 0; frame < options.frames; ++frame) {
        RenderSettings settings{.width = width, .height = height, .time_passes = true};
        settings.continuity = options.stills ? Continuity::still
                              : frame == 0   ? Continuity::starts
                                             : Continuity::follows;
        const Image image = renderer.render(turned(first, frame * options.step_deg), style, settings);
        const std::vector<PassTiming> passes = line_passes(renderer);
        lines_drawn.add(bench::sum_ms(passes), passes);
        options.film.save(image, static_cast<int>(frame));
        std::rotate(frames.begin(), frames.end() - 1, frames.end());
        std::vector<uint8_t> lines = lines_in(image, 128);
        std::vector<uint8_t> near_lines = grown(lines, width, height, options.reach_px);
        frames[0] = {.lines = std::move(lines),
                     .near_lines = std::move(near_lines),
                     .near_faint_lines = grown(lines_in(image, 224), width, height, options.reach_px)};
        if (frame > 0) {
            shares.push_back(frames[0].percent_away_from(frames[1]));
            shares.push_back(frames[1].percent_away_from(frames[0]));
        }
        if (frame > 1) {
            blinks.push_back(frames[1].percent_blinking(frames[2], frames[0]));
        }
    }
    fmt::print(
        "{}: {} triangles, {} frames of {} degrees at {}x{}: line pixels without a line within {} px in "
        "the neighbouring frame: mean {:.4f} %, worst {:.4f} %; without even a faint one in both: {:.4f} "
        "%\n{}\n",
        options.scene, triangle_count(scene), options.frames, options.step_deg, width, height,
        options.reach_px, mean_of(shares), std::ranges::max(shares), mean_of(blinks),
        stroke_lengths(renderer, first, style, {.width = width, .height = height}));
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
