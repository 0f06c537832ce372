// SPDX-License-Identifier: MIT
#include "batch_options.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/text.hpp"
#include "no_cache.hpp"
#include "option_values.hpp"
#include "usage_error.hpp"

namespace estampe::app {
namespace {

constexpr const char* batch_examples = R"(Examples:
  estampe batch jobs.toml
  estampe batch jobs.toml --shard 2/4 --report part2.json      (the second quarter of the jobs)

A file of jobs has a table [[job]] for each picture, with the options of estampe render as keys, and one
[defaults] for what all have unless they say otherwise:

  [defaults]
  size = "1920x1080"
  samples = 4

  [[job]]
  scene = "helmet.gltf"
  output = "helmet.png"
  style = "pencil"
  set = ["hatch.width_mm=0.5", "paper.seed=7"]

  [[job]]                                  # 2 x 2 x 3 pictures
  scene = ["fox.glb", "chapel.glb"]
  camera = ["auto", "eye=2,1,3 target=0,0.5,0"]
  style = ["comic", "engraving", "wash"]
  output = "out/{scene}-{camera}-{style}.png"

Of lists of scenes, cameras, views and styles each is drawn with each. In the output's name {scene} is the
file's name without its extension, {style} the style's, {camera} a name or else a number, {view} the side, as
in view = ["front", "top"], and {n} the number of the job.
Jobs are drawn in their order by one process; a scene is loaded once for all that come one after another.
A job that fails does not stop the others. The report says what became of each; Ctrl-C finishes the job in
hand and leaves a report of what is done.

Exit status: 0 all done, 1 a job failed, or it was stopped, 2 the command line is wrong.)";

} // namespace

void BatchOptions::add_to(CLI::App& app)
{
    CLI::App& command = *app.add_subcommand("batch", "Draw many pictures, as a file of jobs has them");
    command.footer(batch_examples);
    command.add_option("JOBS", jobs_, "TOML file of jobs")->required()->type_name("FILE");
    command
        .add_option("--shard", shard_,
                    "Only the I-th of N parts, for several machines: runs of jobs, all\nabout as long")
        ->type_name("I/N");
    command
        .add_option("--report", report_,
                    "Where the report goes [JOBS.report.json, with a shard\nJOBS.I-of-N.report.json]")
        ->type_name("JSON");
    add_no_cache_flag(command);
    command.add_option("--device", device_, "auto, cpu, or an index that estampe devices lists")
        ->type_name("DEVICE")
        ->capture_default_str();
    command.add_option("--raster", raster_, "hardware, compute, or auto")
        ->type_name("PATH")
        ->capture_default_str();
}

BatchCommand BatchOptions::read() const
{
    BatchCommand batch{.jobs = jobs_, .report = report_};
    if (!shard_.empty()) {
        const char* const end = shard_.data() + shard_.size();
        const auto first = std::from_chars(shard_.data(), end, batch.shard);
        const bool has_slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
        const auto second = has_slash ? std::from_chars(first.ptr + 1, end, batch.shards) : first;
        constexpr uint32_t most_shards = 1000000;
        if (!has_slash || second.ec != std::errc{} || second.ptr != end || batch.shard < 1 ||
            batch.shard > batch.shards || batch.shards > most_shards) {
            throw UsageError(fmt::format("{} is no part of jobs", in_quotes(shard_)), "--shard",
                             "write 1/4 for the first of four");
        }
    }
    if (batch.report.empty()) {
        const std::filesystem::path jobs(jobs_);
        const std::string part =
            batch.shards > 1 ? fmt::format(".{}-of-{}", batch.shard, batch.shards) : std::string();
        batch.report = (jobs.parent_path() / (jobs.stem().string() + part + ".report.json")).string();
    }
    check_device(device_);
    batch.device.device = device_;
    batch.device.raster = parse_raster_path(raster_);
    return batch;
}

} // namespace estampe::app
