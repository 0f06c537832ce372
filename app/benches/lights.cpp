// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "benches/series.hpp"
#include "commands.hpp"
#include "core/file.hpp"
#include "pass_history.hpp"
#include "text.hpp"

namespace estampe::app {
namespace {

constexpr int shadow_texels = 512; // side of a spot's map, and of each of a lamp's six

/// GPU time of a frame, by what it is for.
struct Cost {
    double light_ms = 0.0;
    double shadow_ms = 0.0;
    double frame_ms = 0.0;
};

struct Row {
    uint32_t lights = 0;
    Cost with;
    Cost without; ///< no local light
};

Cost cost_of(const std::vector<PassTiming>& passes, const std::vector<double>& frames_ms)
{
    Cost cost;
    cost.frame_ms = median(frames_ms);
    for (const PassTiming& pass : passes) {
        cost.light_ms += pass.name.starts_with("light") ? pass.gpu_ms : 0.0;
        const bool draws_shadow = pass.name.starts_with("shadow") || pass.name.starts_with("local shadows") ||
                                  pass.name.starts_with("cluster bounds");
        cost.shadow_ms += draws_shadow ? pass.gpu_ms : 0.0;
    }
    return cost;
}

/// Frames of one scene; the first one, which compiles and uploads, does not count.
class Measured {
public:
    Measured(const BenchLightsCommand& command, const Scene& scene)
        : command_(command), renderer_(command.device)
    {
        style_.set(fmt::format("shadow.local_size={}", shadow_texels));
        renderer_.set_scene(scene);
        draw(0.0, false);
        frames_ms_.clear();
    }

    /// Either what passes cost is asked for, or what the frame does, as it takes longer by that.
    void draw(double time_s, bool by_passes)
    {
        const RenderSettings settings{
            .width = command_.width, .height = command_.height, .time_s = time_s, .time_passes = by_passes};
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
    const BenchLightsCommand& command_;
    Renderer renderer_;
    Style style_;
    PassHistory history_;
    std::vector<double> frames_ms_;
};

Row measure(const BenchLightsCommand& command, uint32_t count, std::string& device)
{
    Scene scene = field_of_balls(command.million ? 1e6 : 70e3);
    Measured without(command, scene);
    const uint32_t shadowed = std::min(command.shadowed, count);
    add_lights(scene, count, shadowed);
    if (command.moving) {
        animate_shadowed(scene, shadowed);
    }
    Measured with(command, scene);
    const uint32_t frames = 2 * command.frames;
    for (uint32_t frame = 0; frame < frames; ++frame) {
        const bool by_passes = frame % 2 == 1;
        without.draw(0.0, by_passes);
        with.draw(command.moving ? (frame + 1.0) / (frames + 1.0) : 0.0, by_passes);
    }
    device = with.device();
    return {count, with.cost(), without.cost()};
}

std::string table(const BenchLightsCommand& command, const std::vector<Row>& rows, const std::string& device)
{
    std::string text = fmt::format("{}, {}x{}, {} with shadows, median of {} frames, GPU ms\n\n", device,
                                   command.width, command.height, command.shadowed, command.frames);
    text += fmt::format("{:>7} {:>10} {:>10} {:>10} {:>10} {:>8}\n", "lights", "light", "no lights",
                        "shadows", "frame", "ratio");
    for (const Row& row : rows) {
        text += fmt::format("{:>7} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f} {:>8.2f}\n", row.lights,
                            row.with.light_ms, row.without.light_ms, row.with.shadow_ms, row.with.frame_ms,
                            row.with.light_ms / row.without.light_ms);
    }
    return text;
}

std::string json_of(const BenchLightsCommand& command, const std::vector<Row>& rows,
                    const std::string& device)
{
    nlohmann::ordered_json json{{"device", device},         {"width", command.width},
                                {"height", command.height}, {"shadowed", command.shadowed},
                                {"moving", command.moving}, {"million", command.million},
                                {"frames", command.frames}};
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

/// Milliseconds of the light passes over the logarithm of the number of lights, with and without them.
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

} // namespace

void run(const BenchLightsCommand& command)
{
    if (!command.output.empty()) {
        check_output(command.output, {});
    }
    std::vector<uint32_t> counts = command.counts;
    std::sort(counts.begin(), counts.end());
    std::vector<Row> rows;
    std::string device;
    rows.reserve(counts.size());
    for (const uint32_t count : counts) {
        rows.push_back(measure(command, count, device));
    }
    fmt::print("{}", command.json ? json_of(command, rows, device) : table(command, rows, device));
    if (!command.output.empty()) {
        const std::string svg = plot(rows);
        write_file_atomically(command.output, std::as_bytes(std::span(svg)));
    }
}

} // namespace estampe::app
