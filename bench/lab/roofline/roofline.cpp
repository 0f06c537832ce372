// SPDX-License-Identifier: MIT
#include "lab/roofline/roofline.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/command_line.hpp"
#include "common/measuring.hpp"
#include "gpu/graph/execute.hpp"
#include "gpu/pass_costs.hpp"
#include "gpu/resources.hpp"
#include "lab/commands.hpp"
#include "lab/tables.hpp"
#include "shaders/roof_arithmetic_comp.hpp"
#include "shaders/roof_copy_comp.hpp"

namespace estampe::lab::roofline {
namespace {

/// Seconds of the fastest run. The first run creates the pipeline and does not count.
double least_s(gpu::Executor& executor, bool software, const gpu::Graph& graph, uint32_t rounds)
{
    double least = std::numeric_limits<double>::max();
    for (uint32_t round = 0; round <= rounds; ++round) {
        const bench::WallClock clock;
        executor.run(graph);
        const double wall_s = 1e-3 * clock.ms();
        if (round > 0) {
            const double gpu_s = 1e-3 * executor.timings().back().gpu_ms;
            least = std::min(least, software ? wall_s : gpu_s);
        }
    }
    return std::max(least, 1e-9);
}

/// On some systems all unwritten pages of memory share one physical page, which stays in the cache.
void write_all(gpu::Executor& executor, gpu::Buffer& buffer)
{
    gpu::Graph graph;
    auto pass = graph.custom("fill");
    const gpu::BufferId filled =
        pass.touch_write(import_whole(graph, "filled", buffer), gpu::Access::transfer_write);
    pass.execute([filled](gpu::Recorder& recorder) {
        vkCmdFillBuffer(recorder.commands(), recorder.buffer(filled).handle(), 0, VK_WHOLE_SIZE, 1);
    });
    executor.run(graph);
}

double copied_bytes_a_s(gpu::Device& device, gpu::Executor& executor, uint32_t rounds)
{
    const bool software = device.info().software;
    const uint32_t count = software ? 1U << 21U : 1U << 24U;
    const uint64_t size_bytes = 16ULL * count;
    gpu::Buffer from(device, "from", size_bytes, gpu::MemoryUse::device);
    gpu::Buffer to(device, "to", size_bytes, gpu::MemoryUse::device);
    write_all(executor, from);
    write_all(executor, to);
    gpu::Graph graph;
    auto pass = graph.compute("copy", shaders::roof_copy_comp);
    pass.read(import_whole(graph, "from", from));
    static_cast<void>(pass.write(import_whole(graph, "to", to)));
    pass.push(count).dispatch_items(count);
    return 2.0 * static_cast<double>(size_bytes) / least_s(executor, software, graph, rounds);
}

double computed_operations_a_s(gpu::Executor& executor, bool software, uint32_t rounds)
{
    struct Constants {
        uint32_t threads, rounds;
        float factor, step_up;
    };

    constexpr double operations_a_round = 2.0 * 64.0;
    const Constants constants{
        .threads = software ? 1U << 15U : 1U << 21U, .rounds = 256, .factor = 0.999F, .step_up = 0.001F};
    gpu::Graph graph;
    auto pass = graph.compute("arithmetic", shaders::roof_arithmetic_comp);
    const gpu::BufferId results =
        pass.write(graph.buffer("results", {.size_bytes = sizeof(float) * constants.threads}));
    pass.push(constants).dispatch_items(constants.threads);
    graph.export_buffer(results);
    return operations_a_round * constants.rounds * constants.threads /
           least_s(executor, software, graph, rounds);
}

} // namespace

Ceilings measure_ceilings(gpu::Device& device, uint32_t rounds)
{
    gpu::Executor executor(device);
    const bool software = device.info().software;
    return {.bytes_a_s = copied_bytes_a_s(device, executor, rounds),
            .operations_a_s = computed_operations_a_s(executor, software, rounds)};
}

namespace {

BenchPicture of_series(std::string_view name, double amount, uint32_t width, uint32_t height)
{
    const auto& series = all_series();
    const auto found = std::ranges::find_if(series, [&](const Series& one) { return name == one.name; });
    return found->picture(amount, width, height);
}

/// A picture with triangles, lights, shadows, hatching, contours, occlusion and a lens.
BenchPicture field(bool software, uint32_t width, uint32_t height)
{
    BenchPicture picture{.scene = field_of_balls(software ? 70e3 : 1e6),
                         .camera = view_of_field(),
                         .style = {},
                         .width = width,
                         .height = height};
    add_lights(picture.scene, 40, 4);
    picture.style.set("occlusion.enabled=true");
    picture.style.set("lens.enabled=true");
    picture.style.set("lens.f_number=1");
    return picture;
}

BenchPicture smoke(bool software, uint32_t width, uint32_t height)
{
    return of_series("smoke", software ? 32768 : 2097152, width, height);
}

BenchPicture ink(bool /*software*/, uint32_t width, uint32_t height)
{
    return of_series("ink", static_cast<double>(width) * height, width, height);
}

BenchPicture cloth(bool software, uint32_t width, uint32_t height)
{
    return of_series("cloth", software ? 4096 : 65536, width, height);
}

BenchPicture ground(bool software, uint32_t width, uint32_t height)
{
    return of_series("ground", software ? 16384 : 262144, width, height);
}

} // namespace

const std::vector<Entry>& all_pictures()
{
    static const std::vector<Entry> entries{
        {"field", "Triangles, 40 lights, 4 shadows, hatching, contours, occlusion and a lens", field},
        {"smoke", "A fluid of three dimensions, its light and its drawing", smoke},
        {"ink", "A fluid of two dimensions on the page", ink},
        {"cloth", "A sheet in the wind", cloth},
        {"ground", "Dunes found anew in every frame", ground},
    };
    return entries;
}

namespace {

/// The summed cost of all passes with one name in one frame.
struct FrameCost {
    double ms = 0.0;
    uint64_t bytes = 0;
    std::optional<uint64_t> operations = 0;
};

using Frame = std::map<std::string, FrameCost>;

void add(Frame& frame, const gpu::PassWork& pass)
{
    FrameCost& cost = frame[pass.name];
    cost.ms += pass.ms;
    cost.bytes += pass.bytes;
    cost.operations = cost.operations && pass.operations ? std::optional(*cost.operations + *pass.operations)
                                                         : std::nullopt;
}

/// Records all runs during its lifetime.
class Watch {
public:
    explicit Watch(Frame& frame)
    {
        gpu::watch_runs([&frame](std::span<const gpu::PassWork> passes) {
            for (const gpu::PassWork& pass : passes) {
                add(frame, pass);
            }
        });
    }

    ~Watch() { gpu::watch_runs({}); }

    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
};

std::vector<Frame> draw(Renderer& renderer, const BenchPicture& picture, uint32_t frames)
{
    renderer.set_scene(picture.scene);
    const uint32_t warm_up = renderer.device().software ? 1 : 12;
    std::vector<Frame> drawn;
    for (uint32_t i = 0; i < warm_up + frames; ++i) {
        RenderSettings settings{.width = picture.width, .height = picture.height};
        if (picture.moves) {
            settings.time_s = i / 60.0;
            settings.continuity = i == 0 ? Continuity::starts : Continuity::follows;
        }
        if (i < warm_up) {
            static_cast<void>(renderer.render(picture.camera, picture.style, settings));
            continue;
        }
        Frame frame;
        const Watch watch(frame);
        static_cast<void>(renderer.render(picture.camera, picture.style, settings));
        drawn.push_back(std::move(frame));
    }
    return drawn;
}

PictureCost cost_of(const Entry& entry, const std::vector<Frame>& frames, double least_share)
{
    PictureCost picture{.name = entry.name, .about = entry.about, .passes = {}};
    for (const auto& [name, last] : frames.back()) {
        std::vector<double> times_ms;
        for (const Frame& frame : frames) {
            const auto found = frame.find(name);
            times_ms.push_back(found == frame.end() ? 0.0 : found->second.ms);
        }
        picture.passes.push_back(
            {.name = name, .ms = spread_of(times_ms), .bytes = last.bytes, .operations = last.operations});
        picture.ms += picture.passes.back().ms.median;
    }
    for (PassCost& pass : picture.passes) {
        pass.share = pass.ms.median / std::max(picture.ms, 1e-9);
    }
    std::erase_if(picture.passes, [&](const PassCost& pass) { return pass.share < least_share; });
    std::ranges::stable_sort(picture.passes, std::ranges::greater{}, &PassCost::share);
    return picture;
}

} // namespace

Result measure(const std::vector<const Entry*>& entries, const Plan& plan,
               const std::function<void(const Entry&)>& on_picture)
{
    Result result{.width = plan.width, .height = plan.height, .frames = plan.frames, .pictures = {}};
    {
        gpu::Device device(plan.device);
        result.device = device.info().name;
        result.driver = device.info().driver;
        result.software = device.info().software;
        result.ceilings = measure_ceilings(device, 9);
    }
    for (const Entry* const entry : entries) {
        on_picture(*entry);
        Renderer renderer(plan.device);
        const BenchPicture picture = entry->picture(result.software, plan.width, plan.height);
        result.pictures.push_back(cost_of(*entry, draw(renderer, picture, plan.frames), plan.least_share));
    }
    return result;
}

double share_of_copy(const PassCost& pass, const Ceilings& ceilings)
{
    return static_cast<double>(pass.bytes) / std::max(1e-3 * pass.ms.median, 1e-12) / ceilings.bytes_a_s;
}

std::optional<double> share_of_arithmetic(const PassCost& pass, const Ceilings& ceilings)
{
    if (!pass.operations) {
        return std::nullopt;
    }
    return static_cast<double>(*pass.operations) / std::max(1e-3 * pass.ms.median, 1e-12) /
           ceilings.operations_a_s;
}

namespace {

std::string in_percent(std::optional<double> share)
{
    return share ? fmt::format("{:.1f}", 100.0 * *share) : std::string("-");
}

std::string row_of(const PassCost& pass, const Ceilings& ceilings)
{
    return fmt::format("{:<36} {:>9.4f} {:>6.1f} {:>9.2f} {:>8} {:>9} {:>8}\n", pass.name, pass.ms.median,
                       100.0 * pass.share, 1e-6 * static_cast<double>(pass.bytes),
                       in_percent(share_of_copy(pass, ceilings)),
                       pass.operations ? fmt::format("{:.2f}", 1e-6 * static_cast<double>(*pass.operations))
                                       : std::string("-"),
                       in_percent(share_of_arithmetic(pass, ceilings)));
}

} // namespace

std::string text_of(const Result& result)
{
    std::string text = fmt::format("{}, {}\n{}x{}, medians of {} frames, each pass by itself, {}\n"
                                   "The device copies {:.4g} GB/s (read and written together) and computes "
                                   "{:.4g} Gop/s (32-bit floats)\n",
                                   result.device, result.driver, result.width, result.height, result.frames,
                                   result.software ? "wall time" : "GPU time",
                                   1e-9 * result.ceilings.bytes_a_s, 1e-9 * result.ceilings.operations_a_s);
    for (const PictureCost& picture : result.pictures) {
        text += fmt::format("\n{}: {}, {:.3f} ms\n{:<36} {:>9} {:>6} {:>9} {:>8} {:>9} {:>8}\n", picture.name,
                            picture.about, picture.ms, "", "ms", "% time", "MB", "% copy", "Mop", "% arith");
        for (const PassCost& pass : picture.passes) {
            text += row_of(pass, result.ceilings);
        }
    }
    return text;
}

std::string json_of(const Result& result)
{
    nlohmann::ordered_json json{{"device", result.device},
                                {"driver", result.driver},
                                {"software", result.software},
                                {"width", result.width},
                                {"height", result.height},
                                {"frames", result.frames},
                                {"bytes_a_s", result.ceilings.bytes_a_s},
                                {"operations_a_s", result.ceilings.operations_a_s},
                                {"pictures", nlohmann::ordered_json::array()}};
    for (const PictureCost& picture : result.pictures) {
        nlohmann::ordered_json passes = nlohmann::ordered_json::array();
        for (const PassCost& pass : picture.passes) {
            nlohmann::ordered_json one{{"name", pass.name},
                                       {"ms", spread_json(pass.ms)},
                                       {"share", pass.share},
                                       {"bytes", pass.bytes},
                                       {"share_of_copy", share_of_copy(pass, result.ceilings)}};
            if (pass.operations) {
                one["operations"] = *pass.operations;
                one["share_of_arithmetic"] = *share_of_arithmetic(pass, result.ceilings);
            }
            passes.push_back(std::move(one));
        }
        json["pictures"].push_back({{"name", picture.name},
                                    {"about", picture.about},
                                    {"ms", picture.ms},
                                    {"passes", std::move(passes)}});
    }
    return json.dump(2) + "\n";
}

std::string csv_of(const Result& result)
{
    std::string text = "picture,pass,ms,share,bytes,share_of_copy,operations,share_of_arithmetic\n";
    for (const PictureCost& picture : result.pictures) {
        for (const PassCost& pass : picture.passes) {
            const auto arithmetic = share_of_arithmetic(pass, result.ceilings);
            text += fmt::format("{},\"{}\",{},{},{},{},{},{}\n", picture.name, pass.name, pass.ms.median,
                                pass.share, pass.bytes, share_of_copy(pass, result.ceilings),
                                pass.operations ? std::to_string(*pass.operations) : std::string(),
                                arithmetic ? fmt::format("{}", *arithmetic) : std::string());
        }
    }
    return text;
}

} // namespace estampe::lab::roofline

namespace estampe::lab {
namespace {

struct RooflineOptions {
    std::vector<std::string> names; ///< names of pictures; empty: all
    roofline::Plan plan;
    bench::Size size;
    ResultFiles files;
};

std::string roofline_footer()
{
    return R"(Examples:
  estampe_lab roofline
  estampe_lab roofline field --size 1920x1080 --json here.json

Each pass runs by itself. Its bytes are those of all that it binds, each counted once; its operations are
counted in its shader, each loop once, so that the share of the arithmetic is a lower bound for kernels that
loop. docs/laboratory.md says more.

Pictures:
)" + list_of(roofline::all_pictures());
}

void measure_passes(RooflineOptions& options)
{
    options.files.check();
    options.plan.width = options.size.width;
    options.plan.height = options.size.height;
    const roofline::Result result = roofline::measure(
        chosen(roofline::all_pictures(), options.names), options.plan,
        [](const roofline::Entry& entry) { fmt::print(stderr, "{}: {}\n", entry.name, entry.about); });
    fmt::print("{}", text_of(result));
    options.files.write(result);
}

} // namespace

Job add_roofline(CLI::App& command)
{
    const auto options = std::make_shared<RooflineOptions>();
    command.footer(roofline_footer());
    command.add_option("NAME", options->names, "Pictures to draw, see below [all]")
        ->type_name("NAME")
        ->check(bench::one_of("picture", names_of(roofline::all_pictures())));
    command
        .add_option("--least", options->plan.least_share,
                    "Leave out passes below this share of a picture's time")
        ->type_name("SHARE")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 0.999999).description(""));
    add_drawing_options(command, options->size, options->plan.frames, options->plan.device);
    options->files.add_to(command);
    return [options] { measure_passes(*options); };
}

} // namespace estampe::lab
