// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <future>
#include <span>

#include <fmt/format.h>

#include "commands.hpp"
#include "core/at_once.hpp"
#include "core/spread.hpp"
#include "core/text.hpp"
#include "drawing.hpp"
#include "empty_view.hpp"
#include "features/particles/particles.hpp"
#include "film.hpp"
#include "gpu/pass_history.hpp"
#include "output/svg.hpp"
#include "picture_output.hpp"
#include "quick_compile.hpp"
#include "report.hpp"
#include "scene_details.hpp"
#include "single_picture.hpp"
#include "usage_error.hpp"
#include "warnings.hpp"
#include "world_animator.hpp"

namespace estampe::app {
namespace {

/// Wall time of the steps of a job.
class StepClock {
public:
    void finish(const std::string& step)
    {
        const auto now = Clock::now();
        steps_.emplace_back(step, Milliseconds(now - last_).count());
        last_ = now;
    }

    [[nodiscard]] double last_ms() const { return steps_.back().second; }

    [[nodiscard]] double total_ms() const { return Milliseconds(last_ - start_).count(); }

    [[nodiscard]] const std::vector<std::pair<std::string, double>>& steps() const { return steps_; }

private:
    using Clock = std::chrono::steady_clock;
    using Milliseconds = std::chrono::duration<double, std::milli>;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
    std::vector<std::pair<std::string, double>> steps_;
};

/// Whether clouds drift over the scene, or particles fly in it.
bool has_weather(const DrawOptions& draw, const Scene& scene)
{
    const features::StyleTables& style = draw.style.tables();
    const sky::CloudStyle& clouds = style.clouds;
    return clouds.coverage > 0.0F || clouds.flocks > 0.0F || clouds.streaks > 0.0F ||
           !features::emitting_nodes(scene, style.particles.emitters).empty();
}

void tell_of_time(const DrawOptions& draw, const Scene& scene)
{
    if (const std::string note = draw.has_time ? note_of_animations(draw, scene) : ""; !note.empty()) {
        print_notes({note});
    }
    if (draw.time_s != 0.0 && scene.animations.empty() && !scene.terrain && !has_weather(draw, scene)) {
        print_warnings({fmt::format("{}: has no animation, so --time changes nothing", draw.scene)});
    }
}

std::string in_meters(double mm)
{
    return fmt::format("{:.2f} m", 1e-3 * mm);
}

/// Prints what was asked for; beside a picture on standard output, to stderr.
void tell(const RenderCommand& command, const std::string& text)
{
    if (command.draw.output == standard_output || command.is_quiet) {
        say(text);
    } else {
        fmt::print("{}", text);
    }
}

/// What the command's pictures are to be like.
RenderSettings render_settings(const RenderCommand& command, const Scene& scene, Index animation)
{
    RenderSettings settings = settings_of(command.draw, animation);
    if (!command.motion.empty()) {
        DrawOptions before = command.draw;
        before.time_s = command.since_s;
        settings.motion_since = Moment{choose_camera(before, scene, animation), command.since_s};
    }
    return settings;
}

/// Paths are as fine as the page on which they are found: of a large page one that can be drawn at once.
RenderSettings settings_of_strokes(const DrawOptions& draw, Index animation)
{
    constexpr double most_pixels = 16e6;
    constexpr double most_px = 16384.0;
    RenderSettings settings = settings_of(draw, animation);
    const double share = std::min({1.0, most_px / std::max(settings.width, settings.height),
                                   std::sqrt(most_pixels / settings.width / settings.height)});
    if (draw.page.height_mm) {
        settings.width = static_cast<uint32_t>(std::max(share * settings.width, 1.0));
        settings.height = static_cast<uint32_t>(std::max(share * settings.height, 1.0));
    }
    return settings;
}

/// Gives the drawing the exact size of the page: pixels of a page are not quite square, as it has a whole
/// number of them.
void fit_to_page(VectorDrawing& drawing, const PageSize& page)
{
    if (!page.width_mm || !page.height_mm || !(drawing.width_mm > 0.0F && drawing.height_mm > 0.0F)) {
        return;
    }
    const glm::vec2 size_mm(*page.width_mm, *page.height_mm);
    const glm::vec2 scale = size_mm / glm::vec2(drawing.width_mm, drawing.height_mm);
    for (VectorStroke& stroke : drawing.strokes) {
        for (VectorPoint& point : stroke.points) {
            point.page_mm = glm::min(point.page_mm * scale, size_mm);
        }
    }
    drawing.width_mm = size_mm.x;
    drawing.height_mm = size_mm.y;
}

void write_strokes(Renderer& renderer, const Camera& camera, const Style& style, Index animation,
                   const RenderCommand& command)
{
    const DrawOptions& draw = command.draw;
    VectorDrawing drawing = renderer.draw_strokes(camera, style, settings_of_strokes(draw, animation),
                                                  command.hidden ? HiddenLines::kept : HiddenLines::left_out);
    print_notes(renderer.notes());
    fit_to_page(drawing, draw.page);
    if (command.plotter) {
        const PlotterWork before = plotter_work(drawing);
        prepare_for_plotter(drawing);
        const PlotterWork after = plotter_work(drawing);
        tell(command,
             fmt::format("strokes    {:>10} before {:>10} after\n"
                         "pen down   {:>10} before {:>10} after\n"
                         "pen up     {:>10} before {:>10} after\n",
                         before.strokes, after.strokes, in_meters(before.drawn_mm), in_meters(after.drawn_mm),
                         in_meters(before.lifted_mm), in_meters(after.lifted_mm)));
    }
    const std::string text = output::encode_svg(drawing, {.is_for_plotter = command.plotter});
    write_output(draw.output, std::as_bytes(std::span(text)));
}

} // namespace

void draw_and_write(Renderer& renderer, const Scene& scene, const RenderCommand& command)
{
    tell_of_time(command.draw, scene);
    const Index animation = choose_animation(command.draw, scene);
    const Camera camera = choose_camera(command.draw, scene, animation);
    warn_of_empty_view(command.draw, scene, animation, camera);
    const Style style = WorldAnimator(command.draw, scene, worlds::Occasion::picture)
                            .show(renderer, command.draw.time_s, camera);
    if (command.picture.format == PictureFormat::svg) {
        write_strokes(renderer, camera, style, animation, command);
        return;
    }
    DrawnPicture picture =
        draw_picture(renderer, camera, command, style, render_settings(command, scene, animation));
    print_notes(renderer.notes());
    write_pictures(picture, renderer, command);
}

void run(const RenderCommand& command)
{
    const DrawOptions& draw = command.draw;
    check_outputs(command);
    if (command.film) {
        draw_film(command);
        return;
    }

    StepClock clock;
    compile_quickly_if_soon_drawn(command);
    // Opened while the file is read; what is wrong with the file is said first.
    std::future<Renderer> opening = std::async(at_once, [&draw] { return Renderer(draw.device); });
    const Scene scene = load_scene_of(draw);
    print_warnings(scene.warnings);
    if (!draw.load.up) {
        print_notes(up_axis_notes(scene, draw.scene));
    }
    tell_of_time(draw, scene);
    const Index animation = choose_animation(draw, scene);
    // A view of all of a large scene takes as long to choose as its upload.
    std::future<Camera> choosing = std::async(at_once, [&] { return choose_camera(draw, scene, animation); });
    clock.finish("load");
    Renderer renderer = opening.get();
    clock.finish("device");
    set_scene(renderer, scene, draw);
    const Camera camera = choosing.get();
    warn_of_empty_view(draw, scene, animation, camera);
    const Style style =
        WorldAnimator(draw, scene, worlds::Occasion::picture).show(renderer, draw.time_s, camera);
    clock.finish("upload");
    if (command.picture.format == PictureFormat::svg) {
        write_strokes(renderer, camera, style, animation, command);
        return;
    }

    RenderSettings settings = render_settings(command, scene, animation);
    const bool reports = command.timings || command.json;
    gpu::PassHistory passes;
    std::vector<SolverReport> solvers;
    const auto draw_next = [&](bool by_passes) {
        settings.time_passes = by_passes;
        settings.measure_solvers = by_passes;
        DrawnPicture drawn = draw_picture(renderer, camera, command, style, settings);
        if (by_passes) {
            passes.add(renderer.timings());
            solvers = renderer.solver_reports();
        }
        return drawn;
    };
    DrawnPicture picture = draw_next(reports);
    clock.finish("first frame");
    print_notes(renderer.notes());
    std::vector<double> frames_gpu_ms{renderer.gpu_ms()};
    std::vector<double> later_frames_ms;
    for (uint32_t frame = 1; frame < command.repeat; ++frame) {
        // Every second one says what passes cost, the others what a frame does.
        const bool by_passes = reports && frame % 2 == 0;
        if (frame == 1) {
            frames_gpu_ms.clear();
        } else if (frame == 2) {
            passes.forget();
        }
        StepClock frame_clock;
        picture = draw_next(by_passes);
        frame_clock.finish("frame");
        if (!by_passes) {
            later_frames_ms.push_back(frame_clock.last_ms());
            frames_gpu_ms.push_back(renderer.gpu_ms());
        }
    }
    if (!later_frames_ms.empty()) {
        clock.finish("later frames");
    }
    write_pictures(picture, renderer, command);
    clock.finish("write");

    if (reports) {
        TimingReport report{
            renderer.device().name, renderer.raster_path(),   draw.output, settings,     command.repeat,
            passes.medians(),       median_of(frames_gpu_ms), solvers,     clock.steps()};
        report.cpu_ms.emplace_back("total", clock.total_ms());
        if (!later_frames_ms.empty()) {
            report.cpu_ms.emplace_back("median later frame", median_of(later_frames_ms));
        }
        tell(command, report_timings(report, command.json));
    }
}

} // namespace estampe::app
