// SPDX-License-Identifier: MIT
#include "film.hpp"

#include <cmath>
#include <future>

#include <estampe/error.hpp>
#include <estampe/film.hpp>
#include <fmt/format.h>

#include "clock.hpp"
#include "core/at_once.hpp"
#include "core/hash.hpp"
#include "drawing.hpp"
#include "film_camera.hpp"
#include "film_frames.hpp"
#include "film_queue.hpp"
#include "frame/style_tables.hpp"
#include "progress.hpp"
#include "signals.hpp"
#include "techniques/motion_blur/motion_blur.hpp"
#include "text.hpp"

namespace estampe::app {
namespace {

/// The choice, with a last frame.
FilmChoice with_end(FilmChoice film, const DrawOptions& draw, const Scene& scene, Index animation)
{
    constexpr double turn_s = 5.0;
    if (film.last > 0) {
        return film;
    }
    if (scene.animations.empty() && !film.turntable) {
        throw Error("nothing in the scene moves, so a film of it has no length", draw.scene,
                    "give --frames, or --turntable to go around it");
    }
    const double length_s =
        film.turntable || scene.animations.empty() ? turn_s : scene.animations.at(animation).duration_s;
    film.last = std::max(1U, static_cast<uint32_t>(std::lround(length_s * film.frames_per_s)));
    return film;
}

/// Of all that the frames hang on.
uint64_t fingerprint(const DrawOptions& draw, const FilmChoice& film, const Scene& scene,
                     const Renderer& renderer)
{
    Hash hash;
    hash.add_text(ESTAMPE_VERSION);
    hash.add_text(draw.style.to_toml());
    hash.add_text(renderer.device().name + renderer.device().driver + name_of(renderer.raster_path()));
    for (const std::string& file : {draw.scene, draw.lightmap}) {
        if (!file.empty()) {
            hash.add(std::filesystem::file_size(file));
            hash.add(std::filesystem::last_write_time(file).time_since_epoch().count());
        }
    }
    hash.add(draw.page.width);
    hash.add(draw.page.height);
    hash.add(draw.samples);
    hash.add(draw.time_s);
    hash.add_text(draw.animation);
    hash.add(static_cast<uint64_t>(scene.nodes.size()));
    hash.add(draw.camera.kind);
    hash.add_text(draw.camera.name);
    hash.add(draw.camera.placed.eye);
    hash.add(draw.camera.placed.target);
    hash.add(draw.camera.placed.up);
    hash.add(draw.camera.placed.vertical_fov_rad);
    hash.add(draw.camera.placed.orthographic_half_height_m.value_or(0.0));
    hash.add(film.first);
    hash.add(film.frames_per_s);
    // It says how far each frame of a turn goes, and how much a view of all that moves has to hold.
    hash.add(film.last);
    hash.add(film.turntable);
    return hash.value();
}

/// One film being drawn.
class FilmJob {
public:
    FilmJob(const RenderCommand& command, const FilmChoice& film, const Scene& scene, Index animation,
            Renderer& renderer)
        : draw_(command.draw), film_(film), animation_(animation), renderer_(renderer),
          camera_(draw_, scene, animation, time_s(film.first), time_s(film.last), film.turntable),
          frames_(draw_.output, fingerprint(draw_, film, scene, renderer))
    {
        if (is_film(draw_.output)) {
            writer_.emplace(draw_.output, draw_.page.width, draw_.page.height, film.frames_per_s);
        }
    }

    /// The frame that an earlier run would have drawn next, after giving the film those it drew.
    [[nodiscard]] uint32_t recall()
    {
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
            writer_->add(load_image(frames_.path_of(number)));
        }
        renderer_.recall_film(state->memory);
        return next;
    }

    /// Draws all from frame `next` on, or to that in hand when a signal came. Returns the frame after the
    /// last.
    [[nodiscard]] uint32_t draw_from(uint32_t next)
    {
        constexpr double keep_s = 5.0;
        const uint32_t count = film_.last + 1 - film_.first;
        const auto share = [&](uint32_t number) { return static_cast<double>(number - film_.first) / count; };
        Progress progress("film", share(next));
        FilmQueue queue(frames_, writer_ ? &*writer_ : nullptr);
        Clock::time_point kept = Clock::now();
        for (; next <= film_.last && !was_told_to_stop(); ++next) {
            progress.show(share(next), fmt::format("frame {} of {}", next, film_.last));
            const Clock::time_point start = Clock::now();
            FilmQueue::Frame frame{.number = next, .image = draw_frame(next)};
            drawing_s_ += seconds_since(start);
            if (was_told_to_stop() || next == film_.last || seconds_since(kept) > keep_s) {
                frame.memory = renderer_.film_memory();
                kept = Clock::now();
            }
            queue.push(std::move(frame));
        }
        queue.finish();
        progress.clear();
        return next;
    }

    /// Ends what was drawn: a film as far as it goes.
    void finish(bool is_whole)
    {
        if (writer_) {
            writer_->finish();
        }
        if (is_whole) {
            frames_.finish();
        }
    }

    /// Spent on drawing alone.
    [[nodiscard]] double drawing_s() const { return drawing_s_; }

private:
    [[nodiscard]] double time_s(uint32_t number) const
    {
        return draw_.time_s + (number - 1) / film_.frames_per_s;
    }

    /// Of a frame, or between two.
    [[nodiscard]] double turn_at(double number) const
    {
        return film_.turntable ? (number - film_.first) / (film_.last + 1 - film_.first) : 0.0;
    }

    /// Half an exposure before a frame; or after the first, as before the beginning an animation is at its
    /// end.
    [[nodiscard]] std::optional<Moment> exposure_end(uint32_t number) const
    {
        const motion_blur::MotionBlurStyle& style = draw_.style.tables().motion_blur;
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
        settings.exposure_end = exposure_end(number);
        Image image = renderer_.render(camera_.at(settings.time_s, turn_at(number)), draw_.style, settings);
        if (!has_noted_) {
            print_notes(renderer_.notes());
            has_noted_ = true;
        }
        return image;
    }

    const DrawOptions& draw_;
    const FilmChoice& film_;
    Index animation_;
    Renderer& renderer_;
    FilmCamera camera_;
    FilmFrames frames_;
    std::optional<FilmWriter> writer_;
    double drawing_s_ = 0.0;
    bool has_noted_ = false;
};

} // namespace

void draw_film(const RenderCommand& command)
{
    const DrawOptions& draw = command.draw;
    const Clock::time_point start = Clock::now();
    std::future<Renderer> opening = std::async(at_once, [&draw] { return Renderer(draw.device); });
    const Scene scene = load_scene_of(draw);
    print_warnings(scene.warnings);
    const Index animation = choose_animation(draw, scene);
    const FilmChoice film = with_end(*command.film, draw, scene, animation);
    Renderer renderer = opening.get();
    set_scene(renderer, scene, draw);
    tell_of_signals();
    FilmJob job(command, film, scene, animation, renderer);
    const uint32_t next = job.draw_from(job.recall());
    job.finish(next > film.last);
    if (next <= film.last) {
        throw Error(fmt::format("stopped after frame {} of {}", next - 1, film.last), draw.output,
                    "the same command with --resume goes on from there");
    }
    if (command.timings) {
        fmt::print("frames {:>8}\ndrawn  {:>8.2f} s\nwhole  {:>8.2f} s\n", film.last + 1 - film.first,
                   job.drawing_s(), seconds_since(start));
    }
}

} // namespace estampe::app
