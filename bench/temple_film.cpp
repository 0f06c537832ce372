// SPDX-License-Identifier: MIT
// What frames of the temple's film cost the device. Between frames it is kept busy with another picture, as a
// device with little to do lowers its clocks. estampe_bench_temple_film --help

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <estampe/renderer.hpp>

#include "common/command_line.hpp"
#include "common/film.hpp"
#include "common/measuring.hpp"
#include "temple/cameras.hpp"
#include "temple/temple.hpp"
#include "temple/world.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

struct Options {
    bench::FilmOptions film{.style = "temple-day"};
    uint64_t seed = 1;
    std::vector<int> starts{1, 400, 800, 1200};
    int frames = 54;
    int warming = 1;
};

constexpr double frames_per_s = 24.0;
constexpr int uncounted = 6; ///< frames of a stretch, in which shaders are compiled and memory is found

/// Holds a device's clocks up.
class Warmer {
public:
    explicit Warmer(const bench::FilmOptions& film)
        : scene_(temple::build_temple(1)), camera_(scene_camera(scene_, pose_scene(scene_, 0.0), "court")),
          renderer_({.device = film.device}), style_(Style::load("temple-day")), width_(film.width),
          height_(film.height)
    {
        renderer_.set_scene(scene_);
    }

    void warm(int pictures)
    {
        for (int i = 0; i < pictures; ++i) {
            static_cast<void>(renderer_.render(
                camera_, style_, {.width = width_, .height = height_, .samples = 32, .time_passes = false}));
        }
    }

private:
    Scene scene_;
    Camera camera_;
    Renderer renderer_;
    Style style_;
    uint32_t width_;
    uint32_t height_;
};

/// A stretch of the film, begun where it begins.
class Stretch {
public:
    Stretch(const Options& options, int start) : options_(options), start_(start), world_(options.seed)
    {
        const Scene scene = world_.scene();
        world_.meet(scene);
        world_.film();
        flight_.emplace(scene, options.seed);
        world_.end_at(flight_->arrives_s());
        base_ = options.film.load_style();
        renderer_.emplace(RendererOptions{.device = options.film.device});
        renderer_->set_scene(scene);
    }

    void draw(Warmer* warmer)
    {
        for (int i = 0; i < uncounted + options_.frames; ++i) {
            if (warmer != nullptr) {
                warmer->warm(i == 0 ? 20 : options_.warming);
            }
            const Image image = draw_frame(start_ + i, i == 0);
            if (i >= uncounted) {
                rounds_.add(renderer_->gpu_ms(), renderer_->timings());
            }
            options_.film.save(image, start_ + i);
        }
    }

    [[nodiscard]] const bench::Rounds& rounds() const { return rounds_; }

    void print() const
    {
        const std::vector<double>& ms = rounds_.times_ms();
        const auto slowest = std::ranges::max_element(ms) - ms.begin();
        fmt::print("frames {} to {}: {}, mean {:.3f}, most {:.3f} ms of frame {}\n{}", start_ + uncounted,
                   start_ + uncounted + options_.frames - 1, rounds_.text(), rounds_.mean_ms(),
                   rounds_.most_ms(), start_ + uncounted + slowest,
                   options_.film.passes ? rounds_.passes_table() : "");
    }

private:
    [[nodiscard]] Image draw_frame(int number, bool is_first)
    {
        const auto moment_s = [](double frame) { return (frame - 1.0) / frames_per_s; };
        const double time_s = moment_s(number);
        const Camera camera = flight_->camera(time_s);
        world_.go_to(time_s, camera);
        world_.show(*renderer_);
        world_.press(*renderer_);
        constexpr double half_shutter = 0.25; // of 180 degrees, in frames
        const double opened_s = moment_s(number + (is_first ? half_shutter : -half_shutter));
        return renderer_->render(camera, world_.style(base_, camera),
                                 {.width = options_.film.width,
                                  .height = options_.film.height,
                                  .time_s = time_s,
                                  .continuity = is_first ? Continuity::starts : Continuity::follows,
                                  .exposure_end = Moment{flight_->camera(opened_s), opened_s},
                                  .time_passes = options_.film.passes});
    }

    const Options& options_;
    int start_;
    temple::World world_;
    std::optional<temple::Flight> flight_;
    Style base_;
    std::optional<Renderer> renderer_;
    bench::Rounds rounds_;
};

void measure(const Options& options)
{
    std::optional<Warmer> warmer;
    if (options.warming > 0) {
        warmer.emplace(options.film);
    }
    bench::Rounds all;
    for (const int start : options.starts) {
        Stretch stretch(options, start);
        stretch.draw(warmer ? &*warmer : nullptr);
        stretch.print();
        for (const double ms : stretch.rounds().times_ms()) {
            all.add(ms);
        }
    }
    fmt::print("all {}: mean {:.3f}, most {:.3f} ms\n", all.times_ms().size(), all.mean_ms(), all.most_ms());
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Draws stretches of the temple's film, and measures what frames cost the device",
                 "estampe_bench_temple_film");
    options.film.add_to(app);
    app.add_option("--seed", options.seed, "Random seed of the temple")->capture_default_str();
    app.add_option("--starts", options.starts, "First frame of each stretch")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--frames", options.frames, "Frames of each stretch that count, after the first few")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--warming", options.warming,
                   "Pictures of 32 samples between frames that keep the clocks up")
        ->capture_default_str();
    return bench::run(app, argc, argv, [&] { measure(options); });
}
