// SPDX-License-Identifier: MIT
#include "batch_jobs.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "core/file.hpp"
#include "core/text.hpp"
#include "style/suggest.hpp"
#include "style/toml_words.hpp"
#include "usage_error.hpp"
#include "world_options.hpp"

namespace estampe::app {
namespace {

using style::WordEntry;
using style::WordTable;

/// Options of `estampe render`, and its scene. What is of measuring and of the device is not here.
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

/// Of which lists make many jobs of one.
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

/// A job's own keys, and those of [defaults] that it does not have.
using Entries = std::map<std::string, WordEntry>;

Entries with_defaults(const WordTable& job, const Entries& defaults)
{
    Entries entries;
    for (const WordEntry& entry : job.entries) {
        check_entry(entry);
        entries.insert_or_assign(entry.key, entry);
    }
    // A size in pixels and a page stand for each other, and so do a camera and a view.
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

/// What stands for a word in the name of a file: paths and placements have no place there.
std::string name_part(const WordEntry& entry, size_t index)
{
    const std::string& word = entry.words[index];
    const bool is_placement = word.find('=') != std::string::npos;
    return is_placement ? std::to_string(index + 1) : std::filesystem::path(word).stem().string();
}

void replace_all(std::string& text, const std::string& what, const std::string& with)
{
    for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
        text.replace(at, what.size(), with);
    }
}

/// Throws Error where one table stands for more jobs than anybody waits for.
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

/// Appends all jobs that one table stands for, the last of the varied keys changing the quickest.
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

std::vector<BatchJob> read_jobs(const std::string& file)
{
    constexpr uint64_t most_bytes = uint64_t{16} << 20U;
    const std::vector<std::byte> bytes = read_file(file, most_bytes);
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

std::vector<BatchJob> shard_of(const std::vector<BatchJob>& jobs, uint32_t shard, uint32_t shards)
{
    const auto bound = [&](uint64_t i) { return static_cast<std::ptrdiff_t>(i * jobs.size() / shards); };
    return {jobs.begin() + bound(shard - 1), jobs.begin() + bound(shard)};
}

RenderCommand command_of(const BatchJob& job, const RendererOptions& device)
{
    std::vector<const char*> arguments{"estampe", "render"};
    for (const std::string& argument : job.arguments) {
        arguments.push_back(argument.c_str());
    }
    try {
        const std::optional<Command> command =
            read_command_line(static_cast<int>(arguments.size()), arguments.data());
        RenderCommand render = std::get<RenderCommand>(command.value());
        if (render.draw.output == standard_output) {
            throw Error("a job of a batch writes a file", "output");
        }
        render.draw.device = device;
        render.is_quiet = true;
        return render;
    } catch (const UsageError& problem) {
        throw Error(problem.what(), job.where);
    }
}

} // namespace estampe::app
