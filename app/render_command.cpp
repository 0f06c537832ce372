// SPDX-License-Identifier: MIT
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <future>

#include <fmt/format.h>

#include "commands.hpp"
#include "core/at_once.hpp"
#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "core/pending.hpp"
#include "drawing.hpp"
#include "film.hpp"
#include "film_frames.hpp"
#include "pass_history.hpp"
#include "quick_compile.hpp"
#include "report.hpp"
#include "text.hpp"
#include "usage_error.hpp"

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

void check_extension(const std::string& output)
{
    if (is_film_output(output)) {
        return;
    }
    const std::string extension = lower_extension(output);
    if (extension != ".png" && extension != ".svg") {
        throw UsageError(fmt::format("cannot write a picture as {}", in_quotes(extension)), "-o " + output,
                         "the name must end in .png, .svg for strokes, or .mp4, .webm or .gif for films");
    }
}

void warn_of_idle_time(const DrawOptions& draw, const Scene& scene)
{
    if (draw.time_s != 0.0 && scene.animations.empty()) {
        print_warnings({fmt::format("{}: has no animation, so --time changes nothing", draw.scene)});
    }
}

std::string in_meters(double mm)
{
    return fmt::format("{:.2f} m", 1e-3 * mm);
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

void check_outputs(const RenderCommand& command)
{
    const DrawOptions& draw = command.draw;
    check_extension(draw.output);
    const std::filesystem::path folder = std::filesystem::path(draw.output).parent_path();
    const bool makes_folder = is_numbered(draw.output) && !folder.empty() && !std::filesystem::exists(folder);
    check_output(makes_folder ? folder : std::filesystem::path(draw.output), {draw.scene, draw.lightmap});
    if (!command.motion.empty()) {
        check_output(command.motion, {draw.scene, draw.lightmap});
    }
}

void write_strokes(Renderer& renderer, const Camera& camera, Index animation, const RenderCommand& command)
{
    const DrawOptions& draw = command.draw;
    VectorDrawing drawing = renderer.draw_strokes(camera, draw.style, settings_of(draw, animation),
                                                  command.hidden ? HiddenLines::kept : HiddenLines::left_out);
    print_notes(renderer.notes());
    if (command.plotter) {
        const PlotterWork before = plotter_work(drawing);
        prepare_for_plotter(drawing);
        const PlotterWork after = plotter_work(drawing);
        fmt::print("strokes    {:>10} before {:>10} after\n"
                   "pen down   {:>10} before {:>10} after\n"
                   "pen up     {:>10} before {:>10} after\n",
                   before.strokes, after.strokes, in_meters(before.drawn_mm), in_meters(after.drawn_mm),
                   in_meters(before.lifted_mm), in_meters(after.lifted_mm));
    }
    save_svg(drawing, draw.output, {.is_for_plotter = command.plotter});
}

/// Both files, or none.
void write_pictures(const Image& image, const Renderer& renderer, const RenderCommand& command)
{
    Pending picture = Pending::file(command.draw.output, encode_png(image));
    if (!command.motion.empty()) {
        save_motion(renderer.motion(), command.motion);
    }
    picture.publish();
}

} // namespace

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
    const Scene scene = load_scene(draw.scene);
    print_warnings(scene.warnings);
    warn_of_idle_time(draw, scene);
    const Index animation = choose_animation(draw, scene);
    // A view of all of a large scene takes as long to choose as its upload.
    std::future<Camera> choosing = std::async(at_once, [&] { return choose_camera(draw, scene, animation); });
    clock.finish("load");
    Renderer renderer = opening.get();
    clock.finish("device");
    set_scene(renderer, scene, draw);
    const Camera camera = choosing.get();
    clock.finish("upload");
    if (lower_extension(draw.output) == ".svg") {
        write_strokes(renderer, camera, animation, command);
        return;
    }

    const RenderSettings settings = render_settings(command, scene, animation);
    PassHistory passes;
    Image image = renderer.render(camera, draw.style, settings);
    clock.finish("first frame");
    print_notes(renderer.notes());
    passes.add(renderer.timings());
    std::vector<double> later_frames_ms;
    for (uint32_t frame = 1; frame < command.repeat; ++frame) {
        if (frame == 1) {
            passes.forget();
        }
        StepClock frame_clock;
        image = renderer.render(camera, draw.style, settings);
        frame_clock.finish("frame");
        later_frames_ms.push_back(frame_clock.last_ms());
        passes.add(renderer.timings());
    }
    if (!later_frames_ms.empty()) {
        clock.finish("later frames");
    }
    write_pictures(image, renderer, command);
    clock.finish("write");

    if (command.timings || command.json) {
        TimingReport report{renderer.device().name, renderer.raster_path(), draw.output,  settings,
                            command.repeat,         passes.medians(),       clock.steps()};
        report.cpu_ms.emplace_back("total", clock.total_ms());
        if (!later_frames_ms.empty()) {
            report.cpu_ms.emplace_back("median later frame", median(later_frames_ms));
        }
        fmt::print("{}", report_timings(report, command.json));
    }
}

} // namespace estampe::app
