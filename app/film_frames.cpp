// SPDX-License-Identifier: MIT
#include "film_frames.hpp"

#include <array>
#include <cstring>
#include <regex>
#include <utility>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "confine.hpp"
#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "core/text.hpp"
#include "options.hpp"

namespace estampe::app {
namespace {

const std::regex& number_field()
{
    static const std::regex field("%(0?)([1-9]?)d");
    return field;
}

std::string numbered(const std::string& pattern, uint32_t number)
{
    std::smatch field;
    std::regex_search(pattern, field, number_field());
    const int width = field[2].length() > 0 ? std::stoi(field[2]) : 0;
    const std::string digits =
        field[1].length() > 0 ? fmt::format("{:0{}}", number, width) : fmt::format("{:{}}", number, width);
    return field.prefix().str() + digits + field.suffix().str();
}

constexpr const char* state_name = "film-state";

/// Header of the file with a film's state.
struct StateHead {
    std::array<char, 8> signature{'e', 's', 't', 'f', 'i', 'l', 'm', '1'};
    uint64_t job = 0;
    uint64_t next = 0;
};

} // namespace

bool is_numbered(const std::string& name)
{
    const std::string file = std::filesystem::path(name).filename();
    const auto begin = std::sregex_iterator(file.begin(), file.end(), number_field());
    return std::distance(begin, std::sregex_iterator()) == 1;
}

bool is_frame_of(const std::string& pattern, const std::filesystem::path& file)
{
    const std::filesystem::path target(pattern);
    const auto folder_of = [](const std::filesystem::path& path) {
        return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    };
    std::error_code problem;
    if (!std::filesystem::equivalent(folder_of(target), folder_of(file), problem)) {
        return false;
    }
    const std::string name = file.filename().string();
    const std::string form = target.filename().string();
    std::smatch field;
    std::regex_search(form, field, number_field());
    const auto before = static_cast<size_t>(field.prefix().length());
    const auto behind = static_cast<size_t>(field.suffix().length());
    if (name.size() <= before + behind) {
        return false;
    }
    const std::string_view digits =
        trimmed(std::string_view(name).substr(before, name.size() - before - behind), " ");
    const std::optional<uint32_t> number = number_from<uint32_t>(digits);
    return number && numbered(form, *number) == name;
}

FilmFrames::FilmFrames(const std::string& output, uint64_t job, ReadScope scope)
    : is_of_film_(!is_numbered(output)), job_(job), scope_(std::move(scope))
{
    const std::filesystem::path target(output);
    folder_ = is_of_film_ ? std::filesystem::path(output + ".partial")
                          : (target.has_parent_path() ? target.parent_path() : std::filesystem::path("."));
    pattern_ = is_of_film_ ? "%06d.png" : target.filename().string();
    check_output_inside(folder_ / state_name, scope_);
}

std::filesystem::path FilmFrames::path_of(uint32_t number) const
{
    return folder_ / numbered(pattern_, number);
}

std::optional<FilmState> FilmFrames::state(uint32_t first) const
{
    const std::filesystem::path path = folder_ / state_name;
    if (!std::filesystem::exists(path)) {
        return std::nullopt;
    }
    const std::vector<std::byte> bytes = read_file(path, any_length, scope_);
    StateHead head;
    const StateHead own;
    if (bytes.size() >= sizeof head) {
        std::memcpy(&head, bytes.data(), sizeof head);
    }
    if (bytes.size() < sizeof head || head.signature != own.signature || head.next < first ||
        head.next > uint64_t{most_frames} + 1) {
        throw Error("is damaged", path.string(), "leave out --resume to begin anew");
    }
    if (head.job != job_) {
        throw Error("the run that stopped drew something else: another scene, style, size, camera or device",
                    path.string(), "ask for the same, or leave out --resume to begin anew");
    }
    for (uint32_t number = first; number < head.next; ++number) {
        if (!std::filesystem::exists(path_of(number))) {
            throw Error("is missing, which was drawn before", path_of(number).string(),
                        "leave out --resume to begin anew");
        }
    }
    return FilmState{static_cast<uint32_t>(head.next), {bytes.begin() + sizeof head, bytes.end()}};
}

Image FilmFrames::load(uint32_t number) const
{
    return load_image(path_of(number), scope_);
}

void FilmFrames::save(uint32_t number, const Image& image) const
{
    check_output_inside(path_of(number), scope_);
    write_file_atomically(path_of(number), encode_png(image));
}

void FilmFrames::save_state(const FilmState& state) const
{
    const StateHead head{.job = job_, .next = state.next};
    std::vector<std::byte> bytes(sizeof head);
    std::memcpy(bytes.data(), &head, sizeof head);
    bytes.insert(bytes.end(), state.memory.begin(), state.memory.end());
    write_file_atomically(folder_ / state_name, bytes);
}

void FilmFrames::make_folder() const
{
    std::error_code problem;
    std::filesystem::create_directory(folder_, problem);
    if (!std::filesystem::is_directory(folder_)) {
        throw Error(fmt::format("cannot make this folder: {}", problem.message()), folder_.string(),
                    "write elsewhere with -o");
    }
}

void FilmFrames::remove_left_parts() const
{
    estampe::remove_left_parts(folder_, [this](const std::string& name) {
        return name == state_name || is_frame_of((folder_ / pattern_).string(), folder_ / name);
    });
}

void FilmFrames::forget() const
{
    std::filesystem::remove(folder_ / state_name);
    if (!is_of_film_) {
        return;
    }
    static const std::regex own_name("[0-9]{6,7}\\.png");
    const std::vector<std::filesystem::directory_entry> entries(std::filesystem::directory_iterator(folder_),
                                                                {});
    for (const std::filesystem::directory_entry& entry : entries) {
        if (std::regex_match(entry.path().filename().string(), own_name)) {
            std::filesystem::remove(entry.path());
        }
    }
}

void FilmFrames::finish() const
{
    forget();
    std::error_code problem; // The folder stays if it contains files that are not frames of this film
    if (is_of_film_) {
        std::filesystem::remove(folder_, problem);
    }
}

FilmQueue::FilmQueue(const FilmFrames& frames, FilmWriter* film)
    : frames_(frames), film_(film), thread_([this] { work(); })
{
}

FilmQueue::~FilmQueue()
{
    {
        const std::lock_guard lock(guard_);
        waiting_.clear();
        is_closed_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void FilmQueue::push(Frame frame)
{
    constexpr size_t most_waiting = 3;
    std::unique_lock lock(guard_);
    changed_.wait(lock, [&] { return waiting_.size() < most_waiting || problem_ != nullptr; });
    rethrow_problem();
    waiting_.push_back(std::move(frame));
    changed_.notify_all();
}

void FilmQueue::finish()
{
    std::unique_lock lock(guard_);
    changed_.wait(lock, [&] { return (waiting_.empty() && is_idle_) || problem_ != nullptr; });
    rethrow_problem();
}

void FilmQueue::rethrow_problem()
{
    if (problem_ != nullptr) {
        std::rethrow_exception(problem_);
    }
}

void FilmQueue::work()
{
    std::unique_lock lock(guard_);
    while (true) {
        changed_.wait(lock, [&] { return !waiting_.empty() || is_closed_; });
        if (waiting_.empty()) {
            return;
        }
        const Frame frame = std::move(waiting_.front());
        waiting_.pop_front();
        is_idle_ = false;
        lock.unlock();
        std::exception_ptr problem;
        try {
            frames_.save(frame.number, frame.image);
            if (film_ != nullptr) {
                film_->add(frame.image);
            }
            if (frame.memory) {
                frames_.save_state({frame.number + 1, *frame.memory});
            }
        } catch (...) {
            problem = std::current_exception();
        }
        lock.lock();
        is_idle_ = true;
        if (problem != nullptr) {
            problem_ = problem;
            waiting_.clear();
        }
        changed_.notify_all();
    }
}

} // namespace estampe::app
