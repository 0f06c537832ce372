// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/command_line.hpp"
#include "core/file.hpp"
#include "core/spread.hpp"
#include "gpu/pass_costs.hpp"
#include "lab/commands.hpp"
#include "lab/series.hpp"

namespace estampe::lab {
namespace {

constexpr int shadow_texels = 512; // side in texels of a spot's shadow map, and of each of a lamp's six maps

constexpr const char* lights_footer = R"(Examples:
  estampe_lab lights -o lights.svg
  estampe_lab lights --counts 34 --shadowed 4 --million --size 1920x1080 --json

Each count is measured in turn with frames without local lights, so that the ratio of the two does not depend
on how busy the machine is.)";

struct LightsOptions {
    std::vector<uint32_t> counts{1, 3, 10, 30, 100, 300, 1000};
    uint32_t shadowed = 0; ///< number of lights that cast shadows: spots alternate with points
    bool million = false;  ///< the scene has a million triangles instead of ten thousand
    bool moving = false;   ///< shadowed lights move from frame to frame
    bench::Size size;
    uint32_t frames = 9;
    RendererOptions device;
    std::string output; ///< an .svg file for the plot; empty: no plot
    bool json = false;
};

/// GPU time of a frame, divided by purpose.
struct Cost {
    double light_ms = 0.0;
    double shadow_ms = 0.0;
    double frame_ms = 0.0;
};

struct Row {
    uint32_t lights = 0;
    Cost with;
    Cost without; ///< cost without local lights
};

Cost cost_of(const std::vector<PassTiming>& passes, const std::vector<double>& frames_ms)
{
    Cost cost;
    cost.frame_ms = median_of(frames_ms);
    for (const PassTiming& pass : passes) {
        cost.light_ms += pass.name.starts_with("light") ? pass.gpu_ms : 0.0;
        const bool draws_shadow = pass.name.starts_with("shadow") || pass.name.starts_with("local shadows") ||
                                  pass.name.starts_with("cluster bounds");
        cost.shadow_ms += draws_shadow ? pass.gpu_ms : 0.0;
    }
    return cost;
}

/// Draws frames of one scene. The first frame does not count, because it compiles shaders and uploads the
/// scene.
class Measured {
public:
    Measured(const LightsOptions& options, const Scene& scene) : options_(options), renderer_(options.device)
    {
        style_.set(fmt::format("shadow.local_size={}", shadow_texels));
        renderer_.set_scene(scene);
        draw(0.0, false);
        frames_ms_.clear();
    }

    /// Measures either the passes or the whole frame, because timing the passes makes a frame slower.
    void draw(double time_s, bool by_passes)
    {
        const RenderSettings settings{.width = options_.size.width,
                                      .height = options_.size.height,
                                      .time_s = time_s,
                                      .time_passes = by_passes};
        static_cast<void>(renderer_.render(view_of_field(), style_, settings));
        if (by_passes) {
            history_.add(renderer_.timings());
        } else {
            frames_ms_.push_back(renderer_.gpu_ms());
        }
    }

    [[nodiscard]] Cost cost() const { return cost_of(history_.medians(), frames_ms_); }

    [[nodiscard]] std::string device() const { return renderer_.device().name; }

private:
    const LightsOptions& options_;
    Renderer renderer_;
    Style style_;
    gpu::PassHistory history_;
    std::vector<double> frames_ms_;
};

Row measure(const LightsOptions& options, uint32_t count, std::string& device)
{
    Scene scene = field_of_balls(options.million ? 1e6 : 70e3);
    Measured without(options, scene);
    const uint32_t shadowed = std::min(options.shadowed, count);
    add_lights(scene, count, shadowed);
    if (options.moving) {
        animate_shadowed(scene, shadowed);
    }
    Measured with(options, scene);
    const uint32_t frames = 2 * options.frames;
    for (uint32_t frame = 0; frame < frames; ++frame) {
        const bool by_passes = frame % 2 == 1;
        without.draw(0.0, by_passes);
        with.draw(options.moving ? (frame + 1.0) / (frames + 1.0) : 0.0, by_passes);
    }
    device = with.device();
    return {count, with.cost(), without.cost()};
}

std::string table(const LightsOptions& options, const std::vector<Row>& rows, const std::string& device)
{
    std::string text = fmt::format("{}, {}x{}, {} with shadows, median of {} frames, GPU ms\n\n", device,
                                   options.size.width, options.size.height, options.shadowed, options.frames);
    text += fmt::format("{:>7} {:>10} {:>10} {:>10} {:>10} {:>8}\n", "lights", "light", "no lights",
                        "shadows", "frame", "ratio");
    for (const Row& row : rows) {
        text += fmt::format("{:>7} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f} {:>8.2f}\n", row.lights,
                            row.with.light_ms, row.without.light_ms, row.with.shadow_ms, row.with.frame_ms,
                            row.with.light_ms / row.without.light_ms);
    }
    return text;
}

std::string json_of(const LightsOptions& options, const std::vector<Row>& rows, const std::string& device)
{
    nlohmann::ordered_json json{{"device", device},
                                {"width", options.size.width},
                                {"height", options.size.height},
                                {"shadowed", options.shadowed},
                                {"moving", options.moving},
                                {"million", options.million},
                                {"frames", options.frames}};
    for (const Row& row : rows) {
        json["rows"].push_back({{"lights", row.lights},
                                {"light_ms", row.with.light_ms},
                                {"light_ms_without", row.without.light_ms},
                                {"shadow_ms", row.with.shadow_ms},
                                {"frame_ms", row.with.frame_ms},
                                {"ratio", row.with.light_ms / row.without.light_ms}});
    }
    return json.dump(2) + "\n";
}

/// Plots milliseconds of the light passes over the logarithm of the number of lights, with and without the
/// local lights.
std::string plot(const std::vector<Row>& rows)
{
    constexpr double width = 480.0;
    constexpr double height = 280.0;
    constexpr double margin = 50.0;
    const double most_lights = std::max(10.0, static_cast<double>(rows.back().lights));
    double most_ms = 1e-9;
    for (const Row& row : rows) {
        most_ms = std::max({most_ms, row.with.light_ms, row.without.light_ms});
    }
    const auto x_of = [&](double lights) {
        return margin + (width - 2.0 * margin) * std::log(lights) / std::log(most_lights);
    };
    const auto y_of = [&](double ms) { return height - margin - (height - 2.0 * margin) * ms / most_ms; };
    std::string svg = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                                  "font-family=\"sans-serif\" font-size=\"11\">\n"
                                  "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
                                  width, height);
    const auto line = [&](const char* color, auto value) {
        std::string points;
        for (const Row& row : rows) {
            points += fmt::format("{:.1f},{:.1f} ", x_of(row.lights), y_of(value(row)));
        }
        svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"2\" points=\"{}\"/>\n",
                           color, points);
    };
    line("#999999", [](const Row& row) { return row.without.light_ms; });
    line("#1b1a22", [](const Row& row) { return row.with.light_ms; });
    for (const Row& row : rows) {
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                           x_of(row.lights), height - margin + 16.0, row.lights);
    }
    for (const double part : {0.0, 0.5, 1.0}) {
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:.3g}</text>\n",
                           margin - 6.0, y_of(part * most_ms) + 4.0, part * most_ms);
    }
    return svg + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">lights</text>\n"
                             "<text x=\"{}\" y=\"24\">GPU ms of the light passes; grey: without local lights"
                             "</text>\n</svg>\n",
                             0.5 * width, height - 12.0, margin);
}

void measure_lights(const LightsOptions& options)
{
    if (!options.output.empty()) {
        check_output(options.output, {});
    }
    std::vector<uint32_t> counts = options.counts;
    std::ranges::sort(counts);
    std::vector<Row> rows;
    std::string device;
    rows.reserve(counts.size());
    for (const uint32_t count : counts) {
        rows.push_back(measure(options, count, device));
    }
    fmt::print("{}", options.json ? json_of(options, rows, device) : table(options, rows, device));
    ResultFiles::write_text(options.output, [&] { return plot(rows); });
}

} // namespace

Job add_lights(CLI::App& command)
{
    const auto options = std::make_shared<LightsOptions>();
    command.footer(lights_footer);
    command.add_option("--counts", options->counts, "How many local lights [1 3 10 30 100 300 1000]")
        ->type_name("N,N,...")
        ->delimiter(',')
        ->check(bench::up_to(100000));
    command
        .add_option("--shadowed", options->shadowed,
                    "How many of them throw shadows: spots and points in turn")
        ->type_name("N")
        ->capture_default_str();
    command.add_flag("--million", options->million, "A million triangles instead of some ten thousand");
    command.add_flag("--moving", options->moving, "Move the lights that throw shadows from frame to frame");
    add_drawing_options(command, options->size, options->frames, options->device);
    command.add_option("-o,--output", options->output, "Also write a plot, NAME.svg")
        ->type_name("FILE")
        ->check(bench::ends_in(".svg"));
    command.add_flag("--json", options->json, "Print JSON");
    return [options] { measure_lights(*options); };
}

} // namespace estampe::lab
