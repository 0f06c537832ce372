// SPDX-License-Identifier: MIT
#include "render.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <future>
#include <span>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/work_limits.hpp>

#include "commands.hpp"
#include "core/exr.hpp"
#include "core/file.hpp"
#include "core/free_memory.hpp"
#include "core/image_codec.hpp"
#include "core/long_jobs.hpp"
#include "core/spread.hpp"
#include "core/text.hpp"
#include "drawing.hpp"
#include "features/particles/particles.hpp"
#include "film.hpp"
#include "film_frames.hpp"
#include "gpu/pass_costs.hpp"
#include "messages.hpp"
#include "options.hpp"
#include "output/layer_bytes.hpp"
#include "output/layer_files.hpp"
#include "output/pictures.hpp"
#include "output/svg.hpp"
#include "process.hpp"
#include "report.hpp"
#include "scene_details.hpp"
#include "worlds.hpp"

namespace estampe::app {
namespace {

constexpr int usual_quality = 92;

ExrNumbers exr_numbers(const PictureChoice& choice)
{
    return choice.depth == 32 ? ExrNumbers::single : ExrNumbers::half;
}

bool is_layers_exr(const PictureChoice& choice)
{
    return lower_extension(choice.layers) == ".exr";
}

/// Returns the picture's resolution in dots per metre; 0 if the picture has no size in print.
uint32_t dots_per_m(const PageSize& page)
{
    constexpr double inches_a_m = 1000.0 / 25.4;
    return static_cast<uint32_t>(std::lround(page.dots_per_inch.value_or(0.0) * inches_a_m));
}

uint64_t pixels_of(const RenderSettings& settings)
{
    return uint64_t{settings.width} * settings.height;
}

/// Whether the picture is streamed to its file while it is drawn. A large picture is streamed, if no other
/// output needs the picture.
bool is_written_as_drawn(const RenderCommand& command, const RenderSettings& settings)
{
    constexpr uint64_t most_in_memory = uint64_t{1} << 24U;
    const PictureChoice& choice = command.picture;
    return choice.format == PictureFormat::png && choice.depth == 8 && choice.layers.empty() &&
           choice.layer.empty() && command.motion.empty() && command.repeat == 1 &&
           command.draw.output != standard_output && pixels_of(settings) > most_in_memory;
}

/// Draws the picture in bands, and shows progress if it takes long.
void draw_bands(Renderer& renderer, const Camera& camera, const Style& style, const RenderSettings& settings,
                const std::function<void(const Image&)>& take)
{
    Progress progress("picture", 0.0);
    renderer.render_bands(camera, style, settings,
                          {.take = take, .progress = [&](double share) { progress.show(share); }});
    progress.clear();
}

Image draw_in_memory(Renderer& renderer, const Camera& camera, const Style& style,
                     const RenderSettings& settings)
{
    require_memory(4 * pixels_of(settings),
                   fmt::format("a picture of {} x {} pixels", settings.width, settings.height), "--size",
                   "write a PNG file, which is written as it is drawn, or draw a smaller picture");
    Image image{.width = settings.width, .height = settings.height};
    draw_bands(renderer, camera, style, settings, [&](const Image& rows) {
        image.rgba.reserve(4 * pixels_of(settings));
        image.rgba.insert(image.rgba.end(), rows.rgba.begin(), rows.rgba.end());
    });
    return image;
}

std::vector<std::byte> encode(const DrawnPicture& picture, const PictureChoice& choice, uint32_t dots_per_m)
{
    switch (choice.format) {
    case PictureFormat::jpeg:
        return output::encode_jpeg(picture.bytes, choice.quality.value_or(usual_quality), dots_per_m);
    case PictureFormat::webp:
        return output::encode_webp(picture.bytes, choice.quality);
    case PictureFormat::openraster:
        return output::encode_openraster(picture.layers.value());
    case PictureFormat::exr:
        return output::encode_picture_exr(picture.floats.value(), exr_numbers(choice));
    default:
        return picture.floats ? output::encode_deep_png(*picture.floats, dots_per_m)
                              : encode_png(picture.bytes, dots_per_m);
    }
}

/// Checks the name of a new folder. Throws Error unless a folder of this name can be created.
void check_new_folder(std::filesystem::path folder)
{
    if (!folder.has_filename()) {
        folder = folder.parent_path();
    }
    std::error_code problem;
    if (std::filesystem::is_directory(folder, problem) && std::filesystem::is_empty(folder, problem)) {
        return;
    }
    if (std::filesystem::exists(folder, problem)) {
        throw Error("exists and is no empty folder", folder.string(),
                    "remove it, or give --layers the name of a new folder");
    }
    check_output(folder, {});
}

std::vector<std::byte> encode_named(const DrawnPicture& picture, const RenderCommand& command)
{
    try {
        return encode(picture, command.picture, dots_per_m(command.draw.page));
    } catch (const Error& error) {
        throw Error(error.what(), command.draw.output);
    }
}

void write_to_standard_output(std::span<const std::byte> bytes)
{
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0) {
        throw Error(fmt::format("standard output cannot be written: {}", std::strerror(errno)));
    }
}

} // namespace

DrawnPicture draw_picture(Renderer& renderer, const Camera& camera, const RenderCommand& command,
                          const Style& style, const RenderSettings& settings)
{
    const PictureChoice& choice = command.picture;
    const bool is_deep =
        choice.format == PictureFormat::exr || (choice.format == PictureFormat::png && choice.depth > 8);
    DrawnPicture picture;
    if (choice.format == PictureFormat::openraster || !choice.layers.empty() || !choice.layer.empty()) {
        picture.layers = renderer.render_layers(camera, style, settings);
        picture.bytes = picture.layers->picture;
        if (is_deep) {
            picture.floats = flattened(*picture.layers);
        }
        if (!choice.layer.empty()) {
            picture.floats = output::one_layer(*picture.layers, choice.layer);
            picture.bytes = output::encoded_bytes(*picture.floats);
            if (!is_deep) {
                picture.floats.reset();
            }
        }
    } else if (is_deep) {
        picture.floats = renderer.render_linear(camera, style, settings);
    } else if (is_written_as_drawn(command, settings)) {
        picture.file = std::make_unique<PngFile>(command.draw.output, settings.width, settings.height,
                                                 dots_per_m(command.draw.page));
        draw_bands(renderer, camera, style, settings,
                   [&](const Image& rows) { picture.file->add_rows(rows.rgba); });
    } else {
        picture.bytes = draw_in_memory(renderer, camera, style, settings);
    }
    return picture;
}

void check_outputs(const RenderCommand& command, const std::vector<std::filesystem::path>& inputs)
{
    const DrawOptions& draw = command.draw;
    const PictureChoice& choice = command.picture;
    if (draw.output != standard_output) {
        // The folder of numbered frames may be missing at this point: it is created when the film is drawn.
        const std::filesystem::path folder = std::filesystem::path(draw.output).parent_path();
        const bool makes_folder =
            is_numbered(draw.output) && !folder.empty() && !std::filesystem::exists(folder);
        check_output(makes_folder ? folder : std::filesystem::path(draw.output), inputs);
        for (const std::filesystem::path& input : inputs) {
            if (is_numbered(draw.output) && is_frame_of(draw.output, input)) {
                throw Error("the film would overwrite an input", input.string(),
                            "choose another name for -o");
            }
        }
    }
    if (!command.motion.empty()) {
        check_output(command.motion, inputs);
    }
    if (is_layers_exr(choice)) {
        check_output(choice.layers, inputs);
    } else if (!choice.layers.empty()) {
        check_new_folder(choice.layers);
    }
}

namespace {

/// Writes bytes to a file, or to standard output if `output` is "-".
void write_output(const std::string& output, std::span<const std::byte> bytes)
{
    if (output == standard_output) {
        write_to_standard_output(bytes);
    } else {
        write_file_atomically(output, bytes);
    }
}

/// Writes either all files of a command or none, and afterwards writes to standard output. Throws Error
/// naming what cannot be written.
void write_pictures(DrawnPicture& picture, const Renderer& renderer, const RenderCommand& command)
{
    if (picture.file) {
        picture.file->publish();
        return;
    }
    const std::vector<std::byte> bytes = encode_named(picture, command);
    const PictureChoice& choice = command.picture;
    std::vector<AtomicFile> files;
    if (command.draw.output != standard_output) {
        files.push_back(AtomicFile::file(command.draw.output, bytes));
    }
    if (is_layers_exr(choice)) {
        files.push_back(AtomicFile::file(
            choice.layers, output::encode_layers_exr(picture.layers.value(), exr_numbers(choice))));
    } else if (!choice.layers.empty()) {
        const int bits = choice.format == PictureFormat::png ? choice.depth : 8;
        files.push_back(output::pending_layers(picture.layers.value(), choice.layers, bits));
    }
    if (!command.motion.empty()) {
        files.push_back(AtomicFile::file(command.motion, encode_motion(renderer.motion(), command.motion)));
    }
    AtomicFile::publish_all(files);
    if (command.draw.output == standard_output) {
        write_to_standard_output(bytes);
    }
}

/// Measures the wall time of a job's steps.
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
    using Milliseconds = std::chrono::duration<double, std::milli>;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
    std::vector<std::pair<std::string, double>> steps_;
};

/// Returns whether the style draws drifting clouds or flying particles in the scene.
bool has_weather(const DrawOptions& draw, const Scene& scene)
{
    const features::StyleTables& style = draw.style.tables();
    const sky::CloudStyle& clouds = style.clouds;
    return clouds.coverage > 0.0F || clouds.flocks > 0.0F || clouds.streaks > 0.0F ||
           !features::emitting_nodes(scene, style.particles.emitters).empty();
}

/// Checks the name of --layer, so that a misspelt name is found before anything is drawn.
void check_layer(const RenderCommand& command, const Scene& scene)
{
    if (!command.picture.layer.empty()) {
        check_layer_name(scene, command.picture.layer);
    }
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

/// Prints the requested text to stdout, or to stderr if the picture goes to standard output.
void tell(const RenderCommand& command, const std::string& text)
{
    if (command.draw.output == standard_output || command.is_quiet) {
        say(text);
    } else {
        fmt::print("{}", text);
    }
}

/// Returns the render settings of the command's pictures.
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

/// Returns the settings for extracting strokes as paths. The precision of paths depends on the page's size in
/// pixels, so a large page is reduced to one that can be drawn in one piece.
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

/// Sets the exact size of the page for strokes. Pixels of a page are not exactly square, because a page has a
/// whole number of pixels.
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
    check_outputs(command, input_files(command.draw, scene));
    check_layer(command, scene);
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
    const LimitedWork limits(draw.limits);
    check_outputs(command, {draw.scene, draw.lightmap});
    if (command.film) {
        draw_film(command);
        return;
    }

    StepClock clock;
    compile_quickly_if_soon_drawn(command);
    // The renderer opens while the file is read; errors in the file are reported first.
    std::future<Renderer> opening = std::async(launch_if_possible, [&draw] { return Renderer(draw.device); });
    const Scene scene = load_scene_of(draw);
    print_warnings(scene.warnings);
    check_outputs(command, input_files(draw, scene));
    check_layer(command, scene);
    if (!draw.load.up) {
        print_notes(up_axis_notes(scene, draw.scene));
    }
    tell_of_time(draw, scene);
    const Index animation = choose_animation(draw, scene);
    // For a large scene, choosing a camera that shows the whole scene takes as long as the upload, so both
    // run in parallel.
    std::future<Camera> choosing =
        std::async(launch_if_possible, [&] { return choose_camera(draw, scene, animation); });
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
        // In every second frame, the time of each pass is measured; in all other frames, the time of the
        // whole frame.
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
    // Without a report, nothing below may fail: a command that fails leaves no files.
    if (reports) {
        clock.finish("write");
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
