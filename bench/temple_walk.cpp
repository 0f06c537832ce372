// SPDX-License-Identifier: MIT
// What a long walk through the temple costs: the time of each frame, and memory on the way. A walker goes
// from the dunes to the last hall and back, and is drawn as it goes. estampe_bench_temple_walk --help

#include <algorithm>
#include <ctime>
#include <fstream>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>

#include <estampe/renderer.hpp>

#include "common/command_line.hpp"
#include "common/film.hpp"
#include "common/measuring.hpp"
#include "temple/temple.hpp"
#include "temple/visit.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

struct Options {
    bench::FilmOptions film{.style = "temple-day", .width = 320, .height = 180};
    uint64_t seed = 1;
    double minutes = 10.0;
    double frames_per_s = 1.0;
};

/// What the program itself has of the machine's memory.
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
    double cpu_ms = 0.0; ///< of all threads: what a processor that draws spends, however busy it is
    double resident_mb = 0.0;
    double device_mb = 0.0;
    glm::dvec3 eye_m{0.0};
};

class Walk {
public:
    explicit Walk(const Options& options)
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
    static constexpr int first = 4; ///< frames in which shaders are still compiled

    /// A walker looks where it goes.
    void turn_head()
    {
        const glm::dvec3& v = visit_.walker().velocity_m_s();
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

    const Options& options_;
    Scene scene_;
    temple::Visit visit_;
    temple::Tour tour_;
    Renderer renderer_;
    Style style_;
    glm::dvec3 look_{0.0, 0.0, -1.0};
    double time_s_ = 0.0;
    std::vector<Frame> frames_;
    bench::Rounds by_passes_; ///< frames that count
};

} // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Draws a walk through the temple, and measures each frame", "estampe_bench_temple_walk");
    options.film.add_to(app);
    app.add_option("--seed", options.seed, "Random seed of the temple")->capture_default_str();
    app.add_option("--minutes", options.minutes, "Length of the walk")->capture_default_str();
    app.add_option("--fps", options.frames_per_s, "Frames drawn per second of the walk")
        ->capture_default_str();
    return bench::run(app, argc, argv, [&] {
        Walk walk(options);
        walk.run();
        walk.print();
    });
}
