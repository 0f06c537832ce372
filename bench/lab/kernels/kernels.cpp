// SPDX-License-Identifier: MIT
#include "lab/kernels/kernels.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <estampe/error.hpp>

#include "common/command_line.hpp"
#include "gpu/graph/execute.hpp"
#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "lab/commands.hpp"
#include "lab/tables.hpp"

namespace estampe::lab::kernels {
namespace {

constexpr const char* measured_pass = "kernel";

/// The output of a kernel.
struct Left {
    std::optional<gpu::BufferId> words;
    std::optional<gpu::ImageId> picture;
};

void read_inputs(gpu::Graph& graph, const Kernel& kernel, gpu::Pass& pass)
{
    if (kernel.texture != nullptr) {
        pass.sample(import_uploaded(graph, "texture", *kernel.texture));
    }
    if (kernel.words != nullptr) {
        pass.read(import_whole(graph, "words", *kernel.words));
    }
}

gpu::ImageId new_picture(gpu::Graph& graph, const Kernel& kernel)
{
    return graph.image("picture",
                       {.width = kernel.size_px.x, .height = kernel.size_px.y, .format = kernel.picture});
}

Left declare_drawing(gpu::Graph& graph, const Kernel& kernel)
{
    auto pass = graph.raster(measured_pass, *kernel.vertex, *kernel.fragment);
    read_inputs(graph, kernel, pass);
    const gpu::ImageId drawn = pass.color(new_picture(graph, kernel));
    pass.variant(kernel.variant).push(kernel.numbers).draw(kernel.vertex_count);
    return {.picture = drawn};
}

Left declare(gpu::Graph& graph, const Kernel& kernel)
{
    if (kernel.vertex != nullptr) {
        return declare_drawing(graph, kernel);
    }
    auto pass = graph.compute(measured_pass, *kernel.compute);
    Left left;
    if (kernel.leaves_picture) {
        read_inputs(graph, kernel, pass);
        left.picture = pass.write(new_picture(graph, kernel));
    } else {
        left.words =
            pass.write(graph.buffer("results", {.size_bytes = sizeof(uint32_t) * kernel.numbers.threads}));
        read_inputs(graph, kernel, pass);
    }
    pass.variant(kernel.variant).push(kernel.numbers);
    if (kernel.size_px.x > 0) {
        pass.dispatch_over(kernel.size_px.x, kernel.size_px.y);
    } else {
        pass.dispatch_items(kernel.numbers.threads);
    }
    return left;
}

void check(gpu::Executor& executor, gpu::Device& device, const Entry& entry, const Kernel& kernel)
{
    constexpr uint32_t looked_at = 1024;
    const uint32_t count = kernel.numbers.threads;
    gpu::Buffer back(device, "results", sizeof(uint32_t) * uint64_t{count}, gpu::MemoryUse::readback);
    gpu::Graph graph;
    const Left left = declare(graph, kernel);
    if (left.words) {
        add_read_back(graph, "back", *left.words, back);
    } else {
        add_read_back(graph, "back", *left.picture, back);
    }
    executor.run(graph);
    const auto words = gpu::items_of<uint32_t>(back);
    for (uint32_t i = 0; i < std::min(looked_at, count); ++i) {
        const auto index = static_cast<uint32_t>(uint64_t{i} * (count - 1) / looked_at);
        if (!kernel.is_right(index, words[index])) {
            throw Error(fmt::format("left 0x{:08x} at {}, which is wrong", words[index], index),
                        fmt::format("{}: {}", entry.name, kernel.name),
                        "the device's driver miscompiles this kernel");
        }
    }
}

/// A kernel with its graph, ready to be run repeatedly.
struct Ready {
    gpu::Graph graph;
    std::vector<double> took_ms;
};

/// CPU time of all threads of this process.
double processor_ms()
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void run_once_timed(gpu::Executor& executor, bool software, Ready& ready)
{
    const double begin_ms = processor_ms();
    executor.run(ready.graph);
    ready.took_ms.push_back(software ? processor_ms() - begin_ms : executor.timings().front().gpu_ms);
}

std::vector<double> ratios(const std::vector<double>& own, const std::vector<double>& other)
{
    std::vector<double> result;
    for (size_t i = 0; i < own.size(); ++i) {
        result.push_back(own[i] / std::max(other[i], 1e-9));
    }
    return result;
}

} // namespace

ExperimentResult run_experiment(gpu::Device& device, const Entry& entry, Effort effort, uint32_t rounds)
{
    const Experiment experiment = entry.make(device, effort);
    gpu::Executor executor(device);
    std::vector<Ready> ready(experiment.kernels.size());
    for (size_t i = 0; i < ready.size(); ++i) {
        const Kernel& kernel = experiment.kernels[i];
        check(executor, device, entry, kernel);
        const Left left = declare(ready[i].graph, kernel);
        if (left.words) {
            ready[i].graph.export_buffer(*left.words);
        } else {
            ready[i].graph.export_image(*left.picture);
        }
    }
    // A GPU raises its clock rate only after some time under load.
    const uint32_t warm_up = device.info().software ? 1 : 5;
    for (uint32_t round = 0; round < warm_up + rounds; ++round) {
        for (Ready& one : ready) {
            if (round == warm_up) {
                one.took_ms.clear();
            }
            run_once_timed(executor, device.info().software, one);
        }
    }
    ExperimentResult result{.name = entry.name, .about = entry.about, .kernels = {}};
    for (size_t i = 0; i < ready.size(); ++i) {
        const size_t against = experiment.kernels[i].against;
        result.kernels.push_back({.name = experiment.kernels[i].name,
                                  .against = experiment.kernels[against].name,
                                  .ms = spread_of(ready[i].took_ms),
                                  .ratio = spread_of(ratios(ready[i].took_ms, ready[against].took_ms))});
    }
    return result;
}

KernelsResult run_experiments(const std::string& device_name, const std::vector<const Entry*>& entries,
                              uint32_t rounds, const std::function<void(const Entry&)>& on_experiment)
{
    gpu::Device device(RendererOptions{.device = device_name});
    const DeviceInfo& info = device.info();
    KernelsResult result{.device = info.name,
                         .driver = info.driver,
                         .software = info.software,
                         .rounds = rounds,
                         .experiments = {}};
    for (const Entry* const entry : entries) {
        on_experiment(*entry);
        result.experiments.push_back(
            run_experiment(device, *entry, info.software ? Effort::processor : Effort::gpu, rounds));
    }
    return result;
}

std::unique_ptr<gpu::Image> texture_of(gpu::Device& device, uint32_t side, gpu::Format format,
                                       const std::function<uint32_t(uint32_t)>& word_of)
{
    const gpu::ImageDesc desc{.width = side, .height = side, .format = format};
    auto image = std::make_unique<gpu::Image>(device, "texture", desc);
    upload_layers(device, *image, [&](uint32_t) {
        std::vector<uint32_t> words(size_t{side} * side);
        for (uint32_t p = 0; p < words.size(); ++p) {
            words[p] = word_of(p);
        }
        const auto bytes = std::as_bytes(std::span(words));
        return gpu::LayerPixels{{std::vector<std::byte>(bytes.begin(), bytes.end())}};
    });
    return image;
}

std::unique_ptr<gpu::Buffer> words_of(gpu::Device& device, uint32_t count,
                                      const std::function<uint32_t(uint32_t)>& word_of)
{
    std::vector<uint32_t> words(count);
    for (uint32_t p = 0; p < count; ++p) {
        words[p] = word_of(p);
    }
    return std::make_unique<gpu::Buffer>(gpu::upload_buffer(device, "words", words));
}

const std::vector<Entry>& all_experiments()
{
    static const std::vector<Entry> entries{
        {"reads", "Reads of a texture, each after the last or all at once", reads},
        {"branches", "Two kinds of work, by blocks of threads that do the same", branches},
        {"leaving", "Nine pixels in ten have nothing to do: leave, or work for nothing", leaving},
        {"loops", "Eight steps, by loops of all kinds", loops},
        {"min", "The smaller of two numbers, said in four ways", minima},
        {"corners", "Work at the corners of triangles, or at each pixel", corners},
        {"order", "Sixteen reads, in an order that memory likes or not", memory_order},
        {"dead-code", "Work that does not matter, or only seems not to", dead_code},
        {"stages", "A page by a compute shader, and by a fragment shader", stages},
        {"occupancy", "Threads that wait for memory, and what else each holds", occupancy},
    };
    return entries;
}

namespace {

size_t widest_name(const KernelsResult& result)
{
    size_t widest = 0;
    for (const ExperimentResult& experiment : result.experiments) {
        for (const KernelResult& kernel : experiment.kernels) {
            widest = std::max(widest, kernel.name.size());
        }
    }
    return widest;
}

} // namespace

std::string text_of(const KernelsResult& result)
{
    const size_t width = widest_name(result);
    std::string text = fmt::format(
        "{}, {}\n{} of {} rounds in turn: median, and quartiles of the ratio to the row that has none\n",
        result.device, result.driver, result.software ? "Processor time" : "GPU time", result.rounds);
    for (const ExperimentResult& experiment : result.experiments) {
        text += fmt::format("\n{}: {}\n{:<{}} {:>9} {:>7} {:>7} {:>7}\n", experiment.name, experiment.about,
                            "", width, "ms", "ratio", "low", "high");
        for (const KernelResult& kernel : experiment.kernels) {
            text += fmt::format("{:<{}} {:>9.3f}", kernel.name, width, kernel.ms.median);
            text += kernel.name == kernel.against
                        ? std::string("\n")
                        : fmt::format(" {:>7.2f} {:>7.2f} {:>7.2f}\n", kernel.ratio.median, kernel.ratio.low,
                                      kernel.ratio.high);
        }
    }
    return text;
}

std::string json_of(const KernelsResult& result)
{
    nlohmann::ordered_json json{{"device", result.device},
                                {"driver", result.driver},
                                {"software", result.software},
                                {"rounds", result.rounds},
                                {"experiments", nlohmann::ordered_json::array()}};
    for (const ExperimentResult& experiment : result.experiments) {
        nlohmann::ordered_json kernels = nlohmann::ordered_json::array();
        for (const KernelResult& kernel : experiment.kernels) {
            kernels.push_back({{"name", kernel.name},
                               {"against", kernel.against},
                               {"ms", spread_json(kernel.ms)},
                               {"ratio", spread_json(kernel.ratio)}});
        }
        json["experiments"].push_back(
            {{"name", experiment.name}, {"about", experiment.about}, {"kernels", std::move(kernels)}});
    }
    return json.dump(2) + "\n";
}

std::string csv_of(const KernelsResult& result)
{
    std::string text = "experiment,kernel,against,ms,ms_low,ms_high,ratio,ratio_low,ratio_high\n";
    for (const ExperimentResult& experiment : result.experiments) {
        for (const KernelResult& kernel : experiment.kernels) {
            text += fmt::format("{},\"{}\",\"{}\",{},{},{},{},{},{}\n", experiment.name, kernel.name,
                                kernel.against, kernel.ms.median, kernel.ms.low, kernel.ms.high,
                                kernel.ratio.median, kernel.ratio.low, kernel.ratio.high);
        }
    }
    return text;
}

} // namespace estampe::lab::kernels

namespace estampe::lab {
namespace {

struct KernelsOptions {
    std::vector<std::string> names; ///< names of experiments; empty: all
    uint32_t rounds = 9;
    std::string device = "auto";
    ResultFiles files;
};

std::string kernels_footer()
{
    return R"(Examples:
  estampe_lab kernels
  estampe_lab kernels reads order --rounds 25 --json here.json

Each experiment does one thing in several ways, in turn, and checks what each leaves. docs/laboratory.md
explains what they show.

Experiments:
)" + list_of(kernels::all_experiments());
}

void run_kernels(const KernelsOptions& options)
{
    options.files.check();
    const kernels::KernelsResult result = kernels::run_experiments(
        options.device, chosen(kernels::all_experiments(), options.names), options.rounds,
        [](const kernels::Entry& entry) { fmt::print(stderr, "{}: {}\n", entry.name, entry.about); });
    fmt::print("{}", text_of(result));
    options.files.write(result);
}

} // namespace

Job add_kernels(CLI::App& command)
{
    const auto options = std::make_shared<KernelsOptions>();
    command.footer(kernels_footer());
    command.add_option("NAME", options->names, "Experiments to run, see below [all]")
        ->type_name("NAME")
        ->check(bench::one_of("experiment", names_of(kernels::all_experiments())));
    command
        .add_option("--rounds", options->rounds, "How often each kernel is run, of which the median counts")
        ->type_name("N")
        ->capture_default_str()
        ->check(bench::up_to(10000));
    bench::add_no_cache_flag(command);
    bench::add_device_option(command, options->device);
    options->files.add_to(command);
    return [options] { run_kernels(*options); };
}

} // namespace estampe::lab
