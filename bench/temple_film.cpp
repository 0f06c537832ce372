// SPDX-License-Identifier: MIT
// What frames of the temple's film cost the device. Between frames it is kept busy with another picture, as a
// device with little to do lowers its clocks. estampe_bench_temple_film --help

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/renderer.hpp>

#include "temple/flight.hpp"
#include "temple/temple.hpp"
#include "temple/world.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

struct Options {
    std::string device = "auto";
    std::string style = "temple-day";
    std::vector<std::string> set;
    std::string pictures;
    uint64_t seed = 1;
    glm::uvec2 size_px{1920, 1080};
    std::vector<int> starts{1, 400, 800, 1200};
    int frames = 54;
    int warming = 1;
    bool passes = false;
};

constexpr double frames_per_s = 24.0;
constexpr int uncounted = 6; ///< frames of a stretch, in which shaders are compiled and memory is found

/// Holds a device's clocks up.
class Warmer {
public:
    Warmer(const std::string& device, glm::uvec2 size_px)
        : scene_(temple::build_temple(1)), camera_(scene_camera(scene_, pose_scene(scene_, 0.0), "court")),
          renderer_({.device = device}), style_(Style::load("temple-day")), size_px_(size_px)
    {
        renderer_.set_scene(scene_);
    }

    void warm(int pictures)
    {
        for (int i = 0; i < pictures; ++i) {
            static_cast<void>(renderer_.render(
                camera_, style_,
                {.width = size_px_.x, .height = size_px_.y, .samples = 32, .time_passes = false}));
        }
    }

private:
    Scene scene_;
    Camera camera_;
    Renderer renderer_;
    Style style_;
    glm::uvec2 size_px_;
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
        base_ = Style::load(options.style);
        for (const std::string& assignment : options.set) {
            base_.set(assignment);
        }
        renderer_.emplace(RendererOptions{.device = options.device});
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
                gpu_ms_.push_back(renderer_->gpu_ms());
                const bool is_slowest = renderer_->gpu_ms() >= std::ranges::max(gpu_ms_);
                if (is_slowest) {
                    slowest_ms_.clear();
                }
                for (const PassTiming& pass : renderer_->timings()) {
                    passes_ms_[pass.name] += pass.gpu_ms / options_.frames;
                    if (is_slowest) {
                        slowest_ms_[pass.name] += pass.gpu_ms;
                    }
                }
            }
            if (!options_.pictures.empty()) {
                save_png(image, fmt::format("{}/{:05}.png", options_.pictures, start_ + i));
            }
        }
    }

    [[nodiscard]] const std::vector<double>& gpu_ms() const { return gpu_ms_; }

    void print() const
    {
        std::vector<double> ms = gpu_ms_;
        std::ranges::sort(ms);
        const auto slowest = std::ranges::max_element(gpu_ms_) - gpu_ms_.begin();
        fmt::print("frames {} to {}: mean {:.3f}, median {:.3f}, most {:.3f} ms of frame {}\n",
                   start_ + uncounted, start_ + uncounted + options_.frames - 1,
                   std::accumulate(ms.begin(), ms.end(), 0.0) / static_cast<double>(ms.size()),
                   ms[ms.size() / 2], ms.back(), start_ + uncounted + slowest);
        if (!options_.passes) {
            return;
        }
        std::vector<std::pair<double, std::string>> passes;
        for (const auto& [name, pass_ms] : passes_ms_) {
            passes.emplace_back(pass_ms, name);
        }
        std::ranges::sort(passes, std::ranges::greater{});
        for (const auto& [pass_ms, name] : passes) {
            const auto of_slowest = slowest_ms_.find(name);
            fmt::print("  {:<32} {:.4f} ms, {:.4f} in the slowest frame\n", name, pass_ms,
                       of_slowest != slowest_ms_.end() ? of_slowest->second : 0.0);
        }
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
                                 {.width = options_.size_px.x,
                                  .height = options_.size_px.y,
                                  .time_s = time_s,
                                  .continuity = is_first ? Continuity::starts : Continuity::follows,
                                  .exposure_end = Moment{flight_->camera(opened_s), opened_s},
                                  .time_passes = options_.passes});
    }

    const Options& options_;
    int start_;
    temple::World world_;
    std::optional<temple::Flight> flight_;
    Style base_;
    std::optional<Renderer> renderer_;
    std::vector<double> gpu_ms_;
    std::map<std::string, double> passes_ms_; ///< on average
    std::map<std::string, double> slowest_ms_;
};

void measure(const Options& options)
{
    std::optional<Warmer> warmer;
    if (options.warming > 0) {
        warmer.emplace(options.device, options.size_px);
    }
    std::vector<double> all;
    for (const int start : options.starts) {
        Stretch stretch(options, start);
        stretch.draw(warmer ? &*warmer : nullptr);
        stretch.print();
        all.insert(all.end(), stretch.gpu_ms().begin(), stretch.gpu_ms().end());
    }
    fmt::print("all {}: mean {:.3f}, most {:.3f} ms\n", all.size(),
               std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size()),
               std::ranges::max(all));
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App program("Draws stretches of the temple's film, and measures what frames cost the device");
    program.add_option("--device", options.device, "auto, cpu or an index")->capture_default_str();
    program.add_option("--style", options.style)->capture_default_str();
    program.add_option("--set", options.set, "A parameter of the style, KEY=VALUE");
    program.add_option("--seed", options.seed)->capture_default_str();
    program.add_option("--width", options.size_px.x)->capture_default_str();
    program.add_option("--height", options.size_px.y)->capture_default_str();
    program.add_option("--starts", options.starts, "The first frames of stretches")->capture_default_str();
    program.add_option("--frames", options.frames, "Of each stretch, besides the first few")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    program
        .add_option("--warming", options.warming,
                    "Pictures of 32 samples between frames that keep the clocks up")
        ->capture_default_str();
    program.add_option("--pictures", options.pictures, "A folder that frames are written to");
    program.add_flag("--passes", options.passes,
                     "Also what each pass costs on average, with which a frame takes longer");
    CLI11_PARSE(program, argc, argv);
    try {
        measure(options);
    } catch (const Error& problem) {
        fmt::print(stderr, "{}\n", problem.what());
        return 1;
    }
    return 0;
}
