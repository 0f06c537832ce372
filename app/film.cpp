// SPDX-License-Identifier: MIT
#include "film.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/film.hpp>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/job_limits.hpp"
#include "core/long_jobs.hpp"
#include "drawing.hpp"
#include "features/common/style_tables.hpp"
#include "film_camera.hpp"
#include "film_frames.hpp"
#include "messages.hpp"
#include "options.hpp"
#include "piped_scene.hpp"
#include "process.hpp"
#include "render.hpp"
#include "scene_details.hpp"
#include "techniques/motion_blur/motion_blur.hpp"
#include "worlds.hpp"

namespace estampe::app {
namespace {

/// Playing time of an animation in seconds, from the start of the file's time range.
double playing_s(const Animation& animation)
{
    const double left_s = static_cast<double>(animation.duration_s) - static_cast<double>(animation.start_s);
    return left_s > 0.0 ? left_s : animation.duration_s;
}

/// Sets the start of the film: without --time the film begins at the start of the file's time range.
RenderCommand with_begin(RenderCommand command, const Scene& scene, Index animation)
{
    if (!command.draw.has_time && animation < scene.animations.size()) {
        command.draw.time_s = scene.animations[animation].start_s;
    }
    return command;
}

/// Returns the duration of a film that shows all movement. Throws Error if nothing moves.
double moving_s(const DrawOptions& draw, bool is_own_film, const Scene& scene, Index animation)
{
    if (const worlds::Description* const world = world_of(draw.scene)) {
        const std::optional<double>& length_s = is_own_film ? world->film_s : world->show_s;
        if (length_s) {
            return *length_s;
        }
    }
    if (scene.animations.empty()) {
        throw Error("nothing in the scene moves, so a film of it has no length", draw.scene,
                    "give --frames, or --turntable to go around it");
    }
    return playing_s(scene.animations.at(animation));
}

/// Returns the film's settings, with the last frame and the file's frame rate filled in.
FilmChoice with_end(FilmChoice film, const DrawOptions& draw, const Scene& scene, Index animation)
{
    // Lowest frame rate that is accepted from a scene's file; a lower or too high rate in the file is
    // ignored.
    constexpr double least_rate = 1.0;
    constexpr double most_rate = 240.0;
    constexpr double turn_s = 5.0;
    if (!film.has_rate && scene.frames_per_s && *scene.frames_per_s >= least_rate &&
        *scene.frames_per_s <= most_rate) {
        film.frames_per_s = *scene.frames_per_s;
    }
    if (film.last > 0) {
        return film;
    }
    const double length_s = film.turntable ? turn_s : moving_s(draw, film.flies, scene, animation);
    const double frames = std::round(length_s * film.frames_per_s);
    if (!(frames <= most_frames)) {
        throw Error(fmt::format("the film would be {:.0f} s long, {:.0f} frames; a film has at most {}",
                                length_s, frames, most_frames),
                    draw.scene, "give --frames, such as --frames 240");
    }
    film.last = std::max(1U, static_cast<uint32_t>(frames));
    return film;
}

/// Adds the content of a file, or of all files of a folder and its folders.
void add_content(Hash& hash, const std::filesystem::path& input, const ReadScope& scope)
{
    std::vector<std::filesystem::path> files{input};
    if (std::filesystem::is_directory(input)) {
        files.assign(std::filesystem::recursive_directory_iterator(input), {});
        std::ranges::sort(files);
    }
    for (const std::filesystem::path& file : files) {
        if (std::filesystem::is_regular_file(file)) {
            hash.add_text(file.filename().string());
            hash.add_all(read_file(file, any_length, scope));
        }
    }
}

/// Returns a hash of everything that the film's frames depend on.
uint64_t fingerprint(const DrawOptions& draw, const FilmChoice& film, const Scene& scene,
                     const Renderer& renderer)
{
    Hash hash;
    hash.add_text(ESTAMPE_VERSION);
    hash.add_text(draw.style.to_toml());
    hash.add_text(renderer.device().name + renderer.device().driver + name_of(renderer.raster_path()));
    hash.add_text(draw.scene);
    const ReadScope scope = input_scope(draw);
    for (const std::filesystem::path& input : input_files(draw, scene)) {
        add_content(hash, input, scope);
    }
    hash.add(draw.page.width);
    hash.add(draw.page.height);
    for (const std::string& assignment : draw.world) {
        hash.add_text(assignment);
    }
    hash.add(draw.world.size());
    hash.add(draw.samples);
    hash.add(draw.is_draft);
    hash.add(draw.time_s);
    hash.add_text(draw.animation);
    hash.add_text(draw.load.variant);
    hash.add(static_cast<uint64_t>(scene.nodes.size()));
    hash.add(draw.camera.kind);
    hash.add_text(draw.camera.name);
    hash.add(draw.camera.placed.eye);
    hash.add(draw.camera.placed.target);
    hash.add(draw.camera.placed.up);
    hash.add(draw.camera.placed.vertical_fov_rad);
    hash.add(draw.camera.placed.orthographic_half_height_m.value_or(0.0));
    hash.add(draw.camera.placed.shift);
    const ViewDirection& from = draw.camera.direction;
    hash.add(from.azimuth_deg);
    hash.add(from.elevation_deg);
    hash.add(from.distance_m.value_or(0.0));
    hash.add(from.target.value_or(glm::dvec3(0.0)));
    hash.add(from.target.has_value());
    hash.add(from.fov_deg.value_or(0.0));
    hash.add(from.half_height_m.value_or(0.0));
    hash.add(from.parallel);
    hash.add(draw.camera.parallel);
    hash.add(draw.load.up.has_value());
    hash.add(draw.load.up.value_or(UpAxis::y));
    hash.add(film.first);
    hash.add(film.frames_per_s);
    // The hash includes the number of the last frame. The number of the last frame determines how far a
    // turntable turns per frame, and what a view of all movement must contain.
    hash.add(film.last);
    hash.add(film.turntable);
    hash.add(film.flies);
    return hash.value();
}

/// Calls `work`, which draws a frame or reads what the next frame needs, and returns its result. The work is
/// finished even if the time limit is over meanwhile, so that the film can be continued. Only work that takes
/// longer than the whole limit is given up.
template <typename Work>
auto to_its_end(const Work& work)
{
    JobLimits::OfThread limits = JobLimits::of_thread();
    if (limits.end != JobLimits::Clock::time_point::max()) {
        limits.end += std::chrono::duration_cast<JobLimits::Clock::duration>(
            std::chrono::duration<double>(limits.seconds));
    }
    const JobLimits of_work(limits);
    return work();
}

/// A film that is being drawn.
class FilmJob {
public:
    FilmJob(const RenderCommand& command, const FilmChoice& film, const Scene& scene, Index animation,
            Renderer& renderer)
        : draw_(command.draw), film_(film), scene_(scene), animation_(animation), renderer_(renderer),
          animator_(std::in_place, draw_, scene, worlds::Occasion::film),
          path_(film.flies ? animator_->film_camera(scene) : nullptr),
          camera_(draw_, scene, animation, time_s(film.first), time_s(film.last), film.turntable, path_),
          frames_(draw_.output, fingerprint(draw_, film, scene, renderer), draw_.confine.jobs),
          times_passes_(command.timings)
    {
        tell_end();
        if (is_film(draw_.output)) {
            writer_.emplace(draw_.output, draw_.page.width, draw_.page.height, film.frames_per_s,
                            is_transparent(draw_.style));
        }
        warn_if_empty(scene);
    }

    /// Finds out where an earlier run of the film stopped, and adds the frames of that run to the film file.
    /// Returns the number of the next frame to draw.
    [[nodiscard]] uint32_t recall()
    {
        frames_.remove_left_parts();
        const std::optional<FilmState> state = film_.resume ? frames_.state(film_.first) : std::nullopt;
        if (!state) {
            if (film_.resume) {
                print_notes({"nothing was left to go on with; the film begins with its first frame"});
            }
            frames_.make_folder();
            frames_.forget();
            return film_.first;
        }
        const uint32_t next = std::min(state->next, film_.last + 1);
        print_notes({fmt::format("goes on with frame {} of {}", next, film_.last)});
        for (uint32_t number = film_.first; number < next && writer_; ++number) {
            writer_->add(frames_.load(number));
        }
        kept_ = {next, state->memory};
        recall_kept();
        return next;
    }

    /// Draws all frames from frame `next` on, or until a signal arrives or the time limit is over. Returns
    /// the number of the first frame that is not drawn.
    [[nodiscard]] uint32_t draw_from(uint32_t next)
    {
        constexpr double keep_s = 5.0;
        const uint32_t count = film_.last + 1 - film_.first;
        const auto share = [&](uint32_t number) { return static_cast<double>(number - film_.first) / count; };
        Progress progress("film", share(next));
        FilmQueue queue(frames_, writer_ ? &*writer_ : nullptr);
        Clock::time_point kept = Clock::now();
        // The program checks for a signal once per frame. With two checks, a signal between the checks would
        // end the film after a frame without a saved state. The film could then not be continued.
        bool stops = was_told_to_stop() || is_time_up();
        while (next <= film_.last && !stops) {
            progress.show(share(next), fmt::format("frame {} of {}", next, film_.last));
            const Clock::time_point start = Clock::now();
            FilmQueue::Frame frame{.number = next};
            outlasting_lost_devices(next, [&] {
                frame.image = to_its_end([&] { return draw_frame(next); });
                stops = stops || was_told_to_stop() || is_time_up();
                if (stops || next == film_.last || seconds_since(kept) > keep_s) {
                    frame.memory = to_its_end([&] { return renderer_.film_memory(); });
                }
            });
            add_cost(next, seconds_since(start));
            if (frame.memory) {
                kept_ = {next + 1, *frame.memory};
                kept = Clock::now();
            }
            queue.push(std::move(frame));
            ++next;
        }
        queue.finish();
        progress.clear();
        return next;
    }

    /// Finishes the film's file; if drawing was stopped, the film ends with the last frame drawn.
    void finish(bool is_whole)
    {
        if (writer_) {
            writer_->finish();
        }
        if (is_whole) {
            frames_.finish();
        }
    }

    [[nodiscard]] const FilmCost& cost() const { return cost_; }

private:
    /// Tells the film's world where its camera path ends.
    void tell_end()
    {
        if (path_ && path_->end_s()) {
            animator_->end_at(draw_.time_s + *path_->end_s());
        }
    }

    /// Brings world and renderer to the state after the last frame whose memory was kept.
    void recall_kept()
    {
        for (uint32_t number = film_.first; number < kept_.next; ++number) {
            animator_->go_to(time_s(number), camera_.at(time_s(number), turn_at(number)));
        }
        renderer_.recall_film(kept_.memory);
    }

    /// Calls `draw`, which draws frame `number`. If the graphics device is lost, opens another one, brings it
    /// to the state before the frame, and calls `draw` again.
    template <typename Draw>
    void outlasting_lost_devices(uint32_t number, const Draw& draw)
    {
        constexpr int most_losses = 3; // Of one frame: a frame that kills each device is not drawn forever
        for (int losses = 0;; ++losses) {
            try {
                if (losses > 0) {
                    to_its_end([&] { open_again(number); });
                }
                draw();
                return;
            } catch (const DeviceLost&) {
                if (losses == most_losses) {
                    throw;
                }
                print_warnings({fmt::format("the graphics device was lost in frame {}; the film goes on with "
                                            "another",
                                            number)});
            }
        }
    }

    /// Opens another device, and brings it to the state before frame `number`: from the memory of an earlier
    /// frame, or from the film's beginning. The frames between are drawn again, but not written.
    void open_again(uint32_t number)
    {
        RendererOptions options = draw_.device;
        if (!renderer_.device().software) {
            // A second measurement might choose the other path, which does not give the same bytes.
            options.raster = renderer_.raster_path();
        }
        renderer_ = Renderer(options);
        set_scene(renderer_, scene_, draw_);
        animator_.emplace(draw_, scene_, worlds::Occasion::film);
        tell_end();
        if (kept_.next > film_.first) {
            recall_kept();
        }
        for (uint32_t earlier = std::max(kept_.next, film_.first); earlier < number; ++earlier) {
            static_cast<void>(draw_frame(earlier));
        }
    }

    void add_cost(uint32_t number, double drawing_s)
    {
        cost_.drawing_s += drawing_s;
        if (times_passes(number)) {
            ++cost_.timed_frames;
            for (const PassTiming& pass : renderer_.timings()) {
                cost_.gpu_ms_of_passes[pass.name] += pass.gpu_ms;
            }
        } else {
            cost_.gpu_ms.push_back(renderer_.gpu_ms());
        }
    }

    /// Returns whether the time of each pass is measured in a frame. In all other frames, the time of the
    /// whole frame is measured.
    [[nodiscard]] bool times_passes(uint32_t number) const
    {
        constexpr uint32_t every = 4;
        return times_passes_ && (number - film_.first) % every == 0;
    }

    void warn_if_empty(const Scene& scene) const
    {
        constexpr uint32_t parts = 8;
        std::vector<Moment> moments;
        const uint64_t length = std::max(film_.last, film_.first) - film_.first;
        for (uint32_t part = 0; part <= parts && !path_; ++part) {
            const auto number = static_cast<uint32_t>(film_.first + length * part / parts);
            moments.push_back({camera_.at(time_s(number), turn_at(number)), time_s(number)});
        }
        if (!moments.empty()) {
            warn_of_empty_film(draw_, scene, animation_, moments);
        }
    }

    [[nodiscard]] double time_s(uint32_t number) const
    {
        return draw_.time_s + (number - 1) / film_.frames_per_s;
    }

    /// Returns the position of a frame, or of a time between two frames, in the turn of a turntable film, 0
    /// to 1.
    [[nodiscard]] double turn_at(double number) const
    {
        return film_.turntable ? (number - film_.first) / (film_.last + 1 - film_.first) : 0.0;
    }

    /// Returns the time half an exposure before a frame. For the first frame the function returns the time
    /// half an exposure after the frame. The time before the first frame would be the end of a looping
    /// animation.
    [[nodiscard]] std::optional<Moment> exposure_end(uint32_t number,
                                                     const motion_blur::MotionBlurStyle& style) const
    {
        if (!motion_blur::is_wanted(style)) {
            return std::nullopt;
        }
        const double half_frames = 0.5 * static_cast<double>(style.shutter_deg) / 360.0;
        const double frames = time_s(number) * film_.frames_per_s < half_frames ? half_frames : -half_frames;
        const double then_s = time_s(number) + frames / film_.frames_per_s;
        return Moment{camera_.at(then_s, turn_at(number + frames)), then_s};
    }

    [[nodiscard]] Image draw_frame(uint32_t number)
    {
        RenderSettings settings = settings_of(draw_, animation_);
        settings.time_s = time_s(number);
        settings.continuity = number == film_.first ? Continuity::starts : Continuity::follows;
        settings.time_passes = times_passes(number);
        const Camera camera = camera_.at(settings.time_s, turn_at(number));
        const Style style = animator_->show(renderer_, settings.time_s, camera);
        settings.exposure_end = exposure_end(number, style.tables().motion_blur);
        Image image = renderer_.render(camera, style, settings);
        if (!has_noted_) {
            print_notes(renderer_.notes());
            has_noted_ = true;
        }
        return image;
    }

    const DrawOptions& draw_;
    const FilmChoice& film_;
    const Scene& scene_;
    Index animation_;
    Renderer& renderer_;
    std::optional<WorldAnimator> animator_;
    /// Camera path of the world's own film; null for other films.
    std::shared_ptr<const worlds::CameraPath> path_;
    FilmCamera camera_;
    FilmFrames frames_;
    std::optional<FilmWriter> writer_;
    FilmState
        kept_; ///< last state from which the film can be taken up again; its `next` is 1 if there is none
    bool times_passes_;
    FilmCost cost_;
    bool has_noted_ = false;
};

void print_cost(const FilmCost& cost, uint32_t frames, double whole_s)
{
    std::vector<std::pair<double, std::string>> passes;
    double sum_ms = 0.0;
    for (const auto& [name, gpu_ms] : cost.gpu_ms_of_passes) {
        passes.emplace_back(gpu_ms / std::max(cost.timed_frames, 1U), name);
        sum_ms += passes.back().first;
    }
    std::ranges::sort(passes, std::greater());
    fmt::print("{:<30} GPU ms a frame\n", "pass, all of one name");
    for (const auto& [gpu_ms, name] : passes) {
        fmt::print("{:<30} {:>14.3f}\n", name, gpu_ms);
    }
    fmt::print("{:<30} {:>14.3f}\n", "all passes", sum_ms);
    if (!cost.gpu_ms.empty()) {
        const double mean_ms = std::accumulate(cost.gpu_ms.begin(), cost.gpu_ms.end(), 0.0) /
                               static_cast<double>(cost.gpu_ms.size());
        fmt::print("{:<30} {:>14.3f}, most {:.3f}\n", "frame, passes side by side", mean_ms,
                   std::ranges::max(cost.gpu_ms));
    }
    fmt::print("\n");
    fmt::print("frames {:>8}\ndrawn  {:>8.2f} s\nwhole  {:>8.2f} s\n", frames, cost.drawing_s, whole_s);
}

} // namespace

FilmCost draw_film(Renderer& renderer, const Scene& scene, const RenderCommand& command)
{
    check_outputs(command, input_files(command.draw, scene));
    const Index animation = choose_animation(command.draw, scene);
    const RenderCommand timed = with_begin(command, scene, animation);
    const DrawOptions& draw = timed.draw;
    if (const std::string note = note_of_animations(draw, scene); !note.empty()) {
        print_notes({note});
    }
    const FilmChoice film = with_end(*command.film, draw, scene, animation);
    FilmJob job(timed, film, scene, animation, renderer);
    const uint32_t next = job.draw_from(job.recall());
    const bool is_whole = next > film.last;
    const bool is_late = !is_whole && !was_told_to_stop();
    if (!is_late) {
        job.finish(is_whole);
    }
    if (!is_whole) {
        throw Error(fmt::format("stopped after frame {} of {}{}", next - 1, film.last,
                                is_late ? ": the time of --max-seconds is over" : ""),
                    draw.output, "the same command with --resume goes on from there");
    }
    return job.cost();
}

void draw_film(const RenderCommand& command)
{
    const DrawOptions& draw = command.draw;
    const Clock::time_point start = Clock::now();
    std::future<Renderer> opening = std::async(launch_if_possible, [&draw] { return Renderer(draw.device); });
    const Scene scene = load_scene_of(draw);
    print_warnings(scene.warnings);
    if (!draw.load.up) {
        print_notes(up_axis_notes(scene, draw.scene));
    }
    const FilmChoice film = with_end(*command.film, draw, scene, choose_animation(draw, scene));
    Renderer renderer = opening.get();
    set_scene(renderer, scene, draw);
    tell_of_signals();
    const FilmCost cost = draw_film(renderer, scene, command);
    if (command.timings) {
        print_cost(cost, film.last + 1 - film.first, seconds_since(start));
    }
}

} // namespace estampe::app
