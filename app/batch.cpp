// SPDX-License-Identifier: MIT
#include "batch.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <map>
#include <span>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <estampe/error.hpp>
#include <estampe/work_limits.hpp>

#include "commands.hpp"
#include "core/failure.hpp"
#include "core/file.hpp"
#include "core/job_limits.hpp"
#include "core/text.hpp"
#include "drawing.hpp"
#include "film.hpp"
#include "messages.hpp"
#include "option_values.hpp"
#include "options.hpp"
#include "process.hpp"
#include "render.hpp"
#include "scene_details.hpp"
#include "style/names.hpp"
#include "style/schema.hpp"
#include "style/toml.hpp"
#include "worlds.hpp"

namespace estampe::app {
namespace {

constexpr const char* batch_examples = R"(Examples:
  estampe batch jobs.toml
  estampe batch jobs.toml --shard 2/4 --report part2.json      (the second quarter of the jobs)

A file of jobs has a table [[job]] for each picture. Its keys are the options of estampe render. A table
[defaults] holds values for all jobs that do not set them:

  [defaults]
  size = "1920x1080"
  samples = 4

  [[job]]
  scene = "helmet.gltf"
  output = "helmet.png"
  style = "pencil"
  set = ["hatch.width_mm=0.5", "drawing.seed=7"]

  [[job]]                                  # 2 x 2 x 3 pictures
  scene = ["fox.glb", "chapel.glb"]
  camera = ["auto", "eye=2,1,3 target=0,0.5,0"]
  style = ["comic", "engraving", "wash"]
  output = "out/{scene}-{camera}-{style}.png"

Lists of scenes, cameras, views and styles are combined: every scene is drawn by every camera in every style.
In the name of the output, {scene} is the name of the scene's file without its extension, {style} the name of
the style, {camera} the name or number of the camera, {view} the side, as in view = ["front", "top"], and {n}
the number of the job.
One process draws the jobs in order, and loads a scene once for all consecutive jobs that use it. A job that
fails does not stop the others; the report says how each job ended. Ctrl-C finishes the current job and
writes a report of what is done.

Exit status: 0 all done, 1 a job failed, or it was stopped, 2 the command line is wrong.)";

} // namespace

void BatchOptions::add_to(CLI::App& app)
{
    CLI::App& command = *app.add_subcommand("batch", "Draw many pictures, as a TOML file of jobs lists them");
    command.footer(batch_examples);
    command.add_option("JOBS", jobs_, "TOML file that lists the jobs")->required()->type_name("FILE");
    command
        .add_option("--shard", shard_,
                    "Draw only part I of N, to share jobs between machines. All parts\n"
                    "have about as many jobs.")
        ->type_name("I/N");
    command
        .add_option("--report", report_,
                    "File for the report on all jobs [JOBS.report.json, with a shard\n"
                    "JOBS.I-of-N.report.json]")
        ->type_name("JSON");
    add_confine_flag(command, is_confined_);
    limits_.add_to(command);
    add_no_cache_flag(command);
    command
        .add_option("--device", device_,
                    "Device to draw on: auto, cpu, or an index that estampe devices lists")
        ->type_name("DEVICE")
        ->capture_default_str();
    command
        .add_option("--raster", raster_,
                    "Way to turn triangles into pixels: hardware, compute or auto. The word\n"
                    "auto takes the faster way on this device.")
        ->type_name("PATH")
        ->capture_default_str();
}

BatchCommand BatchOptions::read() const
{
    BatchCommand batch{.jobs = jobs_, .report = report_};
    if (!shard_.empty()) {
        const size_t slash = std::min(shard_.find('/'), shard_.size() - 1);
        batch.shard = number_from<uint32_t>(shard_.substr(0, slash)).value_or(0);
        batch.shards = number_from<uint32_t>(shard_.substr(slash + 1)).value_or(0);
        constexpr uint32_t most_shards = 1000000;
        if (batch.shard < 1 || batch.shard > batch.shards || batch.shards > most_shards) {
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
    batch.limits = limits_.read();
    if (is_confined_) {
        batch.confine = {.is_on = true, .jobs = ReadScope::beside(jobs_)};
    }
    return batch;
}

namespace {

using style::WordEntry;
using style::WordTable;

/// Keys that a batch job may have: the options of `estampe render`, and its scene. Options for measuring and
/// for the device are left out.
const std::vector<std::string>& job_keys()
{
    static const std::vector<std::string> keys{
        "scene",     "output",       "size",      "page",       "dpi",      "landscape", "camera",  "time",
        "animation", "style",        "set",       "samples",    "lightmap", "tile",      "quality", "depth",
        "layers",    "layer",        "motion",    "since",      "hidden",   "plotter",   "seed",    "terrain",
        "frames",    "fps",          "turntable", "resume",     "world",    "film",      "view",    "ortho",
        "up",        "input-format", "variant",   "transparent"};
    return keys;
}

/// Keys of a batch job that may have a list of values; each value makes a separate job.
constexpr std::array varied_keys{"scene", "camera", "view", "style"};

bool is_varied(const std::string& key)
{
    return std::ranges::find(varied_keys, key) != varied_keys.end();
}

void check_entry(const WordEntry& entry)
{
    const std::vector<std::string>& keys = job_keys();
    if (std::ranges::find(keys, entry.key) == keys.end()) {
        if (!world_option_as_typed(entry.key, "").empty()) {
            throw Error(fmt::format("{} is an option of a world", in_quotes(entry.key)), entry.where,
                        fmt::format("write world = \"{}=VALUE\"", entry.key));
        }
        const std::string meant = style::nearest(entry.key, keys);
        throw Error(fmt::format("unknown key {}", in_quotes(entry.key)), entry.where,
                    meant.empty() ? "a job has the options of estampe render as keys"
                                  : fmt::format("did you mean {}?", in_quotes(meant)));
    }
    if (entry.words.empty() ||
        (entry.is_list && entry.key != "set" && entry.key != "world" && !is_varied(entry.key))) {
        throw Error(fmt::format("{} takes {}", in_quotes(entry.key),
                                entry.words.empty() ? "at least one word" : "no list"),
                    entry.where);
    }
}

/// The keys of one batch job: the job's own keys, and the keys of [defaults] that the job does not set.
using Entries = std::map<std::string, WordEntry>;

Entries with_defaults(const WordTable& job, const Entries& defaults)
{
    Entries entries;
    for (const WordEntry& entry : job.entries) {
        check_entry(entry);
        entries.insert_or_assign(entry.key, entry);
    }
    // The key `page` of a job replaces the key `size` of [defaults], and the reverse. The keys `camera` and
    // `view` replace each other in the same way.
    const bool has_camera = entries.contains("camera");
    const bool has_view = entries.contains("view");
    const bool has_size = entries.contains("size");
    const bool has_page = entries.contains("page");
    for (const auto& [key, entry] : defaults) {
        const bool is_of_page = key == "page" || key == "dpi" || key == "landscape";
        if (!(has_page && key == "size") && !(has_size && is_of_page) && !(has_view && key == "camera") &&
            !(has_camera && key == "view")) {
            entries.emplace(key, entry);
        }
    }
    return entries;
}

const WordEntry& required(const Entries& entries, const char* key, const std::string& where)
{
    const auto found = entries.find(key);
    if (found == entries.end()) {
        throw Error(fmt::format("this job has no {}", in_quotes(key)), where);
    }
    return found->second;
}

/// Returns a short name instead of a word that cannot be part of an output's file name, such as a path or a
/// camera placement.
std::string name_part(const WordEntry& entry, size_t index)
{
    const std::string& word = entry.words[index];
    if (word.find('=') != std::string::npos) { // The word is a camera placement
        return std::to_string(index + 1);
    }
    std::vector<std::string> stems;
    for (const std::string& part : entry.key == "style" ? style::parts_of(word) : std::vector{word}) {
        stems.push_back(std::filesystem::path(part).stem().string());
    }
    return fmt::format("{}", fmt::join(stems, "+"));
}

/// Checks the number of jobs that one table of the job file makes. Throws Error if there are too many jobs.
void check_job_count(const std::vector<const WordEntry*>& varied, const std::string& where)
{
    constexpr size_t most = 1'000'000;
    size_t count = 1;
    for (const WordEntry* entry : varied) {
        if (entry->words.size() > most / count) {
            throw Error(fmt::format("stands for more than {} pictures", most), where,
                        "lists are drawn each with each: write shorter ones, or several jobs");
        }
        count *= entry->words.size();
    }
}

/// Appends all jobs that one table of the job file makes. Of the keys with several values, the last key
/// changes fastest from job to job.
void append_jobs(const WordTable& table, const Entries& entries, std::vector<BatchJob>& jobs)
{
    const WordEntry& scene = required(entries, "scene", table.where);
    const WordEntry& output = required(entries, "output", table.where);
    std::vector<const WordEntry*> varied;
    for (const char* key : varied_keys) {
        if (const auto found = entries.find(key); found != entries.end()) {
            varied.push_back(&found->second);
        }
    }
    check_job_count(varied, table.where);
    std::vector<size_t> choice(varied.size(), 0);
    for (bool is_left = true; is_left;) {
        BatchJob job{.number = static_cast<uint32_t>(jobs.size() + 1),
                     .where = table.where,
                     .scene = scene.words.at(choice.front()),
                     .output = output.words.front(),
                     .arguments = {}};
        for (size_t i = 0; i < varied.size(); ++i) {
            replace_all(job.output, fmt::format("{{{}}}", varied[i]->key), name_part(*varied[i], choice[i]));
            if (varied[i]->key != "scene") {
                job.arguments.push_back(fmt::format("--{}={}", varied[i]->key, varied[i]->words[choice[i]]));
            }
        }
        replace_all(job.output, "{n}", std::to_string(job.number));
        jobs.push_back(std::move(job));
        is_left = false;
        for (size_t i = varied.size(); i-- > 0 && !is_left;) {
            is_left = ++choice[i] < varied[i]->words.size();
            choice[i] = is_left ? choice[i] : 0;
        }
    }
}

std::vector<std::string> plain_arguments(const Entries& entries)
{
    std::vector<std::string> arguments;
    for (const auto& [key, entry] : entries) {
        if (key == "output" || is_varied(key)) {
            continue;
        }
        for (const std::string& word : entry.words) {
            if (!entry.is_switch) {
                arguments.push_back(fmt::format("--{}={}", key, word));
            } else if (word == "true") {
                arguments.push_back("--" + key);
            }
        }
    }
    return arguments;
}

void check_outputs_differ(const std::vector<BatchJob>& jobs)
{
    std::map<std::filesystem::path, const BatchJob*> writers;
    for (const BatchJob& job : jobs) {
        const auto path = std::filesystem::absolute(job.output).lexically_normal();
        const auto [other, is_new] = writers.emplace(path, &job);
        if (!is_new) {
            throw Error(
                fmt::format("jobs {} and {} both write {}", other->second->number, job.number, job.output),
                job.where, "{scene}, {camera}, {view}, {style} or {n} in the name tell them apart");
        }
    }
}

} // namespace

std::vector<BatchJob> read_jobs(const std::string& file, const ReadScope& scope)
{
    constexpr uint64_t most_bytes = uint64_t{16} << 20U;
    const std::vector<std::byte> bytes = read_file(file, most_bytes, scope);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::vector<WordTable> tables = style::parse_toml_words(text, file);
    Entries defaults;
    for (const WordTable& table : tables) {
        if (table.name == "defaults") {
            defaults = with_defaults(table, {});
        } else if (table.name != "job") {
            throw Error(fmt::format("unknown table {}", in_quotes(table.name)), table.where,
                        "a file of jobs has [[job]] and [defaults]");
        }
    }
    std::vector<BatchJob> jobs;
    for (const WordTable& table : tables) {
        if (table.name != "job") {
            continue;
        }
        const Entries entries = with_defaults(table, defaults);
        const size_t first = jobs.size();
        append_jobs(table, entries, jobs);
        const std::vector<std::string> plain = plain_arguments(entries);
        for (size_t i = first; i < jobs.size(); ++i) {
            jobs[i].arguments.insert(jobs[i].arguments.end(), plain.begin(), plain.end());
            jobs[i].arguments.insert(jobs[i].arguments.end(),
                                     {"--output=" + jobs[i].output, "--", jobs[i].scene});
        }
    }
    if (jobs.empty()) {
        throw Error("holds no job", file, "a table [[job]] with a scene and an output is one");
    }
    check_outputs_differ(jobs);
    return jobs;
}

namespace {

/// Returns the jobs of one of `shards` parts of the batch. Parts are numbered from 1 and contain consecutive
/// jobs. The numbers of jobs in two parts differ by one at most.
std::vector<BatchJob> shard_of(const std::vector<BatchJob>& jobs, uint32_t shard, uint32_t shards)
{
    const auto bound = [&](uint64_t i) { return static_cast<std::ptrdiff_t>(i * jobs.size() / shards); };
    return {jobs.begin() + bound(shard - 1), jobs.begin() + bound(shard)};
}

} // namespace

RenderCommand command_of(const BatchJob& job, const RendererOptions& device, const Confinement& confine)
{
    std::vector<const char*> arguments{"estampe", "render"};
    for (const std::string& argument : job.arguments) {
        arguments.push_back(argument.c_str());
    }
    try {
        const std::optional<Command> command =
            read_command_line(static_cast<int>(arguments.size()), arguments.data(), &confine);
        RenderCommand render = std::get<RenderCommand>(command.value());
        if (render.draw.output == standard_output) {
            throw Error("a job of a batch writes a file", "output");
        }
        for (const std::string& output : {render.draw.output, render.picture.layers, render.motion}) {
            if (!output.empty()) {
                check_output_inside(output, confine.jobs);
            }
        }
        render.draw.device = device;
        render.is_quiet = true;
        return render;
    } catch (const UsageError& problem) {
        throw Error(problem.what(), job.where);
    }
}

namespace {

using Json = nlohmann::ordered_json;

/// Result of one batch job.
struct JobResult {
    enum class Status : uint8_t { not_begun, done, failed };
    Status status = Status::not_begun;
    std::string error; ///< error message of a failed job
    double seconds = 0.0;
};

const char* name_of_status(JobResult::Status status)
{
    return status == JobResult::Status::done     ? "done"
           : status == JobResult::Status::failed ? "failed"
                                                 : "not begun";
}

Json job_json(const BatchJob& job, const JobResult& result)
{
    Json json{{"job", job.number},
              {"place", job.where},
              {"scene", job.scene},
              {"output", job.output},
              {"status", name_of_status(result.status)}};
    if (result.status != JobResult::Status::not_begun) {
        json["seconds"] = result.seconds;
    }
    if (!result.error.empty()) {
        json["error"] = result.error;
    }
    return json;
}

/// Writes one result per job to the batch's report file. The report is replaced completely or not at all.
/// Throws Error when it cannot be written.
void write_report(const BatchCommand& command, const std::string& device, const std::vector<BatchJob>& jobs,
                  const std::vector<JobResult>& results)
{
    const auto count = [&](JobResult::Status status) {
        return std::ranges::count(results, status, &JobResult::status);
    };
    Json json{{"program", "estampe " ESTAMPE_VERSION},
              {"device", device},
              {"jobs_file", command.jobs},
              {"shard", fmt::format("{}/{}", command.shard, command.shards)},
              {"done", count(JobResult::Status::done)},
              {"failed", count(JobResult::Status::failed)},
              {"not_begun", count(JobResult::Status::not_begun)},
              {"jobs", Json::array()}};
    for (size_t i = 0; i < jobs.size(); ++i) {
        json["jobs"].push_back(job_json(jobs[i], results[i]));
    }
    // Names in the report come from files and may hold bytes that are not UTF-8; these bytes are replaced.
    const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    write_file_atomically(command.report, std::as_bytes(std::span(text)));
}

/// Keeps the scene that the renderer has, so that following jobs with the same scene need not load it again.
class SceneKeeper {
public:
    explicit SceneKeeper(Renderer& renderer) : renderer_(renderer) {}

    /// Returns the scene of the options `draw`. Sets the renderer's scene and lightmap if they differ from
    /// the last job's. Throws Error when scene or lightmap cannot be read.
    [[nodiscard]] const Scene& ensure(const DrawOptions& draw)
    {
        if (is_there_ && load_the_same(draw, loaded_) && draw.lightmap == loaded_.lightmap) {
            return scene_;
        }
        is_there_ = false;
        scene_ = load_scene_of(draw);
        print_warnings(scene_.warnings);
        if (!draw.load.up) {
            print_notes(up_axis_notes(scene_, draw.scene));
        }
        set_scene(renderer_, scene_, draw);
        loaded_ = draw;
        is_there_ = true;
        return scene_;
    }

    /// Opens the device again after it was lost, so that the next job does not fail, too. If that fails, the
    /// next job reports why.
    void open_again(const RendererOptions& device)
    {
        is_there_ = false;
        try {
            renderer_ = Renderer(device);
        } catch (const std::exception&) {
            return; // The renderer of the lost device stays
        }
    }

private:
    Renderer& renderer_;
    Scene scene_;
    DrawOptions loaded_; ///< Options with which `scene_` was read
    bool is_there_ = false;
};

JobResult draw_job(Renderer& renderer, SceneKeeper& scenes, const BatchJob& job, const std::string& jobs_file,
                   const RendererOptions& device, const Confinement& confine)
{
    const Clock::time_point start = Clock::now();
    JobResult result{.status = JobResult::Status::failed};
    try {
        const RenderCommand command = command_of(job, device, confine);
        check_outputs(command, {command.draw.scene, command.draw.lightmap, jobs_file});
        const Scene& scene = scenes.ensure(command.draw);
        if (command.film) {
            draw_film(renderer, scene, command);
        } else {
            draw_and_write(renderer, scene, command);
        }
        result.status = JobResult::Status::done;
    } catch (const DeviceLost& problem) {
        result.error = one_line(problem.what());
        scenes.open_again(device);
    } catch (const std::exception&) {
        result.error = one_line(message_of_caught());
    }
    result.seconds = seconds_since(start);
    return result;
}

/// Ends the batch. Throws Error if jobs failed or were not started.
void conclude(const BatchCommand& command, const std::vector<JobResult>& results)
{
    const auto count = [&](JobResult::Status status) {
        return std::ranges::count(results, status, &JobResult::status);
    };
    const std::string remedy = fmt::format("{} tells which", command.report);
    if (const auto left = count(JobResult::Status::not_begun); left > 0) {
        throw Error(fmt::format("stopped with {} of {} jobs not begun{}", left, results.size(),
                                is_time_up() ? ": the time of --max-seconds is over" : ""),
                    command.jobs, remedy);
    }
    if (const auto failed = count(JobResult::Status::failed); failed > 0) {
        throw Error(fmt::format("{} of {} jobs failed", failed, results.size()), command.jobs, remedy);
    }
}

} // namespace

void run(const BatchCommand& command)
{
    const LimitedWork limits(command.limits);
    const std::vector<BatchJob> jobs =
        shard_of(read_jobs(command.jobs, command.confine.jobs), command.shard, command.shards);
    check_output_inside(command.report, command.confine.of(command.report));
    check_output(command.report, {command.jobs});
    std::vector<JobResult> results(jobs.size());
    tell_of_signals();
    Renderer renderer(command.device);
    SceneKeeper scenes(renderer);
    Progress progress("batch", 0.0);
    // The report is written after each job, so that a report exists even if the program is stopped.
    const auto report = [&] { write_report(command, renderer.device().name, jobs, results); };
    report();
    for (size_t i = 0; i < jobs.size() && !was_told_to_stop() && !is_time_up(); ++i) {
        progress.show(static_cast<double>(i) / static_cast<double>(jobs.size()),
                      fmt::format("job {} of {}", i + 1, jobs.size()));
        results[i] = draw_job(renderer, scenes, jobs[i], command.jobs, command.device, command.confine);
        progress.clear();
        if (results[i].status == JobResult::Status::failed) {
            print_warnings({fmt::format("job {}: {}", jobs[i].number, results[i].error)});
        }
        report();
    }
    conclude(command, results);
}

} // namespace estampe::app
