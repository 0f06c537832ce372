// SPDX-License-Identifier: MIT
// Measures the cost of frames of the temple. "walk": a walker goes from the dunes to the last hall and back;
// measures each frame's time, and the memory. "film": draws parts of the film. Between two frames the device
// draws another picture, because an idle device lowers its clock rate.
// estampe_bench_temple --help

#include <algorithm>
#include <ctime>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>

#include <estampe/renderer.hpp>

#include "common/command_line.hpp"
#include "common/film.hpp"
#include "common/measuring.hpp"
#include "temple/cameras.hpp"
#include "temple/temple.hpp"
#include "temple/visit.hpp"
#include "temple/world.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

struct WalkOptions {
    bench::FilmOptions film{.style = "temple-day", .width = 320, .height = 180};
    uint64_t seed = 1;
    double minutes = 10.0;
    double frames_per_s = 1.0;
};

/// Resident memory of this program, in megabytes.
double resident_mb()
{
    std::ifstream file("/proc/self/statm");
    uint64_t whole = 0;
    uint64_t resident = 0;
    file >> whole >> resident;
    return 1e-6 * static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

struct Frame {
    double at_s = 0.0;
    double wall_ms = 0.0;
    double gpu_ms = 0.0;
    double cpu_ms = 0.0; ///< time of all threads: the cost of drawing on a CPU, even if other programs use it
    double resident_mb = 0.0;
    double device_mb = 0.0;
    glm::dvec3 eye_m{0.0};
};

class Walk {
public:
    explicit Walk(const WalkOptions& options)
        : options_(options), scene_(temple::build_temple(options.seed)), visit_(scene_, options.seed),
          tour_(visit_, options.seed), renderer_({.device = options.film.device}),
          style_(options.film.load_style())
    {
        renderer_.set_scene(scene_);
    }

    void run()
    {
        const auto frames = static_cast<int>(60.0 * options_.minutes * options_.frames_per_s);
        if (frames <= first) {
            throw CLI::ValidationError("--minutes", fmt::format("must come to more than {} frames", first));
        }
        for (int number = 0; number < frames; ++number) {
            const double until_s = (number + 1) / options_.frames_per_s;
            for (; time_s_ < until_s; time_s_ += walk::Walker::step_s) {
                visit_.go(tour_.intent(), walk::Walker::step_s, time_s_);
                turn_head();
            }
            draw(number);
        }
    }

    void print() const
    {
        const auto of = [&](auto member) {
            std::vector<double> values;
            for (size_t i = first; i < frames_.size(); ++i) {
                values.push_back(frames_[i].*member);
            }
            std::ranges::sort(values);
            return values;
        };
        fmt::print("{} on {}, {} x {}, seed {}: {} frames of {} minutes, {} rounds, last hall {}\n",
                   options_.film.style, renderer_.device().name, options_.film.width, options_.film.height,
                   options_.seed, frames_.size(), options_.minutes, tour_.rounds(),
                   visit_.since_arrival_s() ? "reached" : "not reached");
        for (const auto& [name, member] :
             {std::pair("wall ms", &Frame::wall_ms), std::pair("gpu ms", &Frame::gpu_ms),
              std::pair("processor ms", &Frame::cpu_ms)}) {
            const std::vector<double> ms = of(member);
            const double median = ms[ms.size() / 2];
            fmt::print("{}: median {:.2f}, 99 % {:.2f}, most {:.2f} = {:.2f} medians; over 3 medians: {}\n",
                       name, median, ms[ms.size() * 99 / 100], ms.back(), ms.back() / median,
                       std::ranges::count_if(ms, [&](double value) { return value > 3.0 * median; }));
        }
        for (const auto& [name, member] :
             {std::pair("memory", &Frame::resident_mb), std::pair("device memory", &Frame::device_mb)}) {
            const std::vector<double> mb = of(member);
            const size_t quarter = first + (frames_.size() - first) / 4;
            fmt::print("{}: {:.1f} MB after a quarter, {:.1f} MB in the end, most {:.1f}\n", name,
                       frames_[quarter].*member, frames_.back().*member, mb.back());
        }
        std::vector<Frame> slow(frames_.begin() + first, frames_.end());
        std::ranges::sort(slow, std::ranges::greater{}, &Frame::wall_ms);
        for (size_t i = 0; i < std::min<size_t>(slow.size(), 5); ++i) {
            fmt::print("  {:.1f} ms at {:.0f} s, {:.1f} {:.1f} {:.1f}\n", slow[i].wall_ms, slow[i].at_s,
                       slow[i].eye_m.x, slow[i].eye_m.y, slow[i].eye_m.z);
        }
        if (options_.film.passes) {
            fmt::print("{}", by_passes_.passes_table());
        }
    }

private:
    static constexpr int first = 4; ///< number of first frames, in which shaders are still compiled

    /// The walker looks in the direction of the walk.
    void turn_head()
    {
        const glm::dvec3& v = visit_.walker().velocity_m_per_s();
        const glm::dvec3 level(v.x, 0.0, v.z);
        if (glm::length(level) > 0.3) {
            look_ = glm::normalize(glm::mix(look_, glm::normalize(level), 0.02));
        }
    }

    void draw(int number)
    {
        const temple::Visit& visit = visit_;
        const glm::dvec3 eye = visit.walker().eye_m();
        if (const auto prints = visit_.walker().take_prints(); !prints.empty()) {
            renderer_.press(prints);
        }
        if (const auto since_s = visit.since_arrival_s();
            since_s && *since_s < temple::Ending::lasts_s + 2.0) {
            renderer_.set_brightness(visit.ending().lights(*since_s));
        }
        const Camera camera{.eye = eye, .target = eye + look_, .vertical_fov_rad = 0.92, .near_m = 0.1};
        const std::clock_t cpu_begin = std::clock();
        const bench::WallClock clock;
        const Image image =
            renderer_.render(camera, style_,
                             {.width = options_.film.width,
                              .height = options_.film.height,
                              .time_s = time_s_,
                              .continuity = number == 0 ? Continuity::starts : Continuity::follows,
                              .time_passes = options_.film.passes});
        Frame frame{.at_s = time_s_, .wall_ms = clock.ms(), .eye_m = eye};
        frame.cpu_ms = 1e3 * static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC;
        frame.gpu_ms = renderer_.gpu_ms();
        if (number >= first) {
            by_passes_.add(frame.gpu_ms, renderer_.timings());
        }
        frame.resident_mb = resident_mb();
        frame.device_mb = 1e-6 * static_cast<double>(renderer_.device_memory_bytes());
        frames_.push_back(frame);
        options_.film.save(image, number);
    }

    const WalkOptions& options_;
    Scene scene_;
    temple::Visit visit_;
    temple::Tour tour_;
    Renderer renderer_;
    Style style_;
    glm::dvec3 look_{0.0, 0.0, -1.0};
    double time_s_ = 0.0;
    std::vector<Frame> frames_;
    bench::Rounds by_passes_; ///< passes of the frames that count
};

bench::Job add_walk(CLI::App& command)
{
    const auto options = std::make_shared<WalkOptions>();
    options->film.add_to(command);
    command.add_option("--seed", options->seed, "Random seed of the temple")->capture_default_str();
    command.add_option("--minutes", options->minutes, "Length of the walk")->capture_default_str();
    command.add_option("--fps", options->frames_per_s, "Frames drawn per second of the walk")
        ->capture_default_str();
    return [options] {
        Walk walk(*options);
        walk.run();
        walk.print();
    };
}

struct StretchOptions {
    bench::FilmOptions film{.style = "temple-day"};
    uint64_t seed = 1;
    std::vector<int> starts{1, 400, 800, 1200};
    int frames = 54;
    int warming = 1;
};

constexpr double frames_per_s = 24.0;
constexpr int uncounted = 6; ///< number of first frames, which compile shaders and allocate memory

/// Draws another picture, so that the device keeps its clock rate.
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

/// A part of the film, simulated from the part's beginning.
class Stretch {
public:
    Stretch(const StretchOptions& options, int start) : options_(options), start_(start), world_(options.seed)
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
        constexpr double half_shutter = 0.25; // half of a 180 degree shutter, in frames
        const double opened_s = moment_s(number + (is_first ? half_shutter : -half_shutter));
        return renderer_->render(camera, world_.style(base_, camera),
                                 {.width = options_.film.width,
                                  .height = options_.film.height,
                                  .time_s = time_s,
                                  .continuity = is_first ? Continuity::starts : Continuity::follows,
                                  .exposure_end = Moment{flight_->camera(opened_s), opened_s},
                                  .time_passes = options_.film.passes});
    }

    const StretchOptions& options_;
    int start_;
    temple::World world_;
    std::optional<temple::Flight> flight_;
    Style base_;
    std::optional<Renderer> renderer_;
    bench::Rounds rounds_;
};

void measure_film(const StretchOptions& options)
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

bench::Job add_film(CLI::App& command)
{
    const auto options = std::make_shared<StretchOptions>();
    options->film.add_to(command);
    command.add_option("--seed", options->seed, "Random seed of the temple")->capture_default_str();
    command.add_option("--starts", options->starts, "First frame of each stretch")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    command.add_option("--frames", options->frames, "Frames of each stretch that count, after the first few")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    command
        .add_option("--warming", options->warming,
                    "Pictures of 32 samples between frames that keep the clocks up")
        ->capture_default_str();
    return [options] { measure_film(*options); };
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Measures frames of the temple", "estampe_bench_temple");
    app.require_subcommand(1);
    bench::Job job;
    bench::add_command(app, "walk", "Draw a walk through the temple, and measure each frame", add_walk, job);
    bench::add_command(app, "film", "Draw stretches of the film, and measure what frames cost the device",
                       add_film, job);
    return bench::run(app, argc, argv, [&] { job(); });
}
