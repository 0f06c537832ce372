// SPDX-License-Identifier: MIT
#include "core/file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <ftw.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/free_memory.hpp"
#include "core/read_scope.hpp"
#include "core/text.hpp"

namespace estampe {
namespace {

/// List of the temporary files and folders that this program has not renamed to their final names yet. The
/// list is never destroyed, because a signal may arrive while the program ends, and its creation takes no
/// memory, because it is read when memory has run out.
struct Registry {
    std::mutex guard;
    std::set<std::filesystem::path> paths;
};

Registry& registry()
{
    alignas(Registry) static std::array<std::byte, sizeof(Registry)> place;
    static auto* const all = new (place.data()) Registry;
    return *all;
}

std::string reason_of(int error)
{
    return std::generic_category().message(error);
}

/// Returns the name of `target` as temporary files contain it: short enough for every file whose own name is
/// not too long.
std::string part_name(const std::filesystem::path& target)
{
    constexpr size_t longest = 200;
    return target.filename().string().substr(0, longest);
}

/// Returns the pattern of a hidden file name beside `target`.
std::string name_beside(const std::filesystem::path& target)
{
    return (target.parent_path() / fmt::format(".{}.part-XXXXXX", part_name(target))).string();
}

/// Returns the path of the file that is replaced if `target` is written: the file to which a symbolic link
/// refers, which need not exist, or else `target` itself.
std::filesystem::path behind_links(const std::filesystem::path& target)
{
    constexpr int most_links = 40; // as in Linux; links may refer to each other
    std::filesystem::path real = target;
    std::error_code failure;
    for (int links = 0; links < most_links && std::filesystem::is_symlink(real, failure); ++links) {
        real = real.parent_path() / std::filesystem::read_symlink(real, failure);
    }
    return real;
}

int remove_entry(const char* path, const struct stat* /*status*/, int /*kind*/, FTW* /*place*/)
{
    std::remove(path);
    return 0;
}

/// Deletes a file, or a folder with its content. Ignores failures. Works without memory, unlike
/// std::filesystem::remove_all, because temporary files must also go when memory has run out.
void remove_without_memory(const char* path) noexcept
{
    constexpr int most_open = 8;
    if (std::remove(path) != 0 && (errno == ENOTEMPTY || errno == EEXIST)) {
        nftw(path, remove_entry, most_open, FTW_DEPTH | FTW_PHYS | FTW_MOUNT);
    }
}

[[noreturn]] void fail_to_begin(const std::filesystem::path& target, int error)
{
    throw Error(fmt::format("cannot write: {}", reason_of(error)), target.string(),
                "choose a folder that exists and may be written");
}

[[noreturn]] void fail_to_rename(const std::filesystem::path& target, int error)
{
    throw Error(fmt::format("cannot write: {}", reason_of(error)), target.string(),
                "try again, or write elsewhere");
}

void write_all(const std::filesystem::path& path, std::span<const std::byte> bytes,
               const std::filesystem::path& target)
{
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    bool is_written = file != nullptr &&
                      (bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size());
    int error = errno;
    if (file != nullptr && std::fclose(file) != 0 && is_written) {
        is_written = false;
        error = errno;
    }
    if (!is_written) {
        throw Error(fmt::format("cannot write: {}", reason_of(error)), target.string(),
                    "make room, or write elsewhere");
    }
}

} // namespace

AtomicFile::AtomicFile(std::filesystem::path target, std::filesystem::path path, int lock)
    : target_(std::move(target)), path_(std::move(path)), lock_(lock)
{
}

AtomicFile AtomicFile::taken(std::filesystem::path target, const std::string& name, int lock)
{
    try {
        std::filesystem::path path(name);
        registry().paths.insert(path);
        return {std::move(target), std::move(path), lock};
    } catch (...) {
        remove_without_memory(name.c_str());
        close(lock);
        throw;
    }
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)), path_(std::move(other.path_)), lock_(std::exchange(other.lock_, -1))
{
    other.path_.clear();
}

AtomicFile::~AtomicFile()
{
    if (lock_ >= 0) {
        close(lock_);
    }
    if (path_.empty()) {
        return;
    }
    const std::lock_guard lock(registry().guard);
    remove_without_memory(path_.c_str());
    registry().paths.erase(path_);
}

AtomicFile AtomicFile::file(const std::filesystem::path& target)
{
    std::error_code failure;
    if (std::filesystem::is_directory(target, failure)) {
        throw Error("is a folder", target.string(), "give the name of a file");
    }
    std::filesystem::path real = behind_links(target);

    struct stat replaced {};

    const bool replaces = stat(real.c_str(), &replaced) == 0;
    if (replaces && access(real.c_str(), W_OK) != 0) {
        throw Error(fmt::format("cannot write: {}", reason_of(errno)), target.string(),
                    "choose another name for -o");
    }
    std::string name = name_beside(real);
    const std::lock_guard lock(registry().guard);
    const int descriptor = mkostemp(name.data(), O_CLOEXEC);
    if (descriptor < 0) {
        fail_to_begin(target, errno);
    }
    (void)flock(descriptor, LOCK_EX | LOCK_NB);
    const mode_t mask = umask(0);
    umask(mask);
    if (replaces && (replaced.st_uid != geteuid() || replaced.st_gid != getegid())) {
        static_cast<void>(fchown(descriptor, replaced.st_uid, replaced.st_gid) == 0);
    }
    fchmod(descriptor, replaces ? replaced.st_mode & 0777U : 0666 & ~mask);
    return taken(std::move(real), name, descriptor);
}

AtomicFile AtomicFile::file(const std::filesystem::path& target, std::span<const std::byte> bytes)
{
    AtomicFile pending = file(target);
    write_all(pending.path(), bytes, target);
    return pending;
}

AtomicFile AtomicFile::folder(const std::filesystem::path& target)
{
    std::string name = name_beside(target);
    const std::lock_guard lock(registry().guard);
    if (mkdtemp(name.data()) == nullptr) {
        fail_to_begin(target, errno);
    }
    const int descriptor = open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0) {
        (void)flock(descriptor, LOCK_EX | LOCK_NB);
    }
    return taken(target, name, descriptor);
}

void AtomicFile::publish()
{
    const std::lock_guard lock(registry().guard);
    if (rename(path_.c_str(), target_.c_str()) != 0) {
        fail_to_rename(target_, errno);
    }
    registry().paths.erase(path_);
    path_.clear();
}

namespace {

/// How a temporary file came to its final name.
enum class Renamed : uint8_t { created, exchanged, replaced };

bool is_file(const std::filesystem::path& path)
{
    struct stat status {};

    return lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

/// Renames `from` to `to`. If both are files, they exchange their names, so that the renaming can be undone.
/// Returns nothing on failure, with the reason in errno.
std::optional<Renamed> rename_undoably(const std::filesystem::path& from, const std::filesystem::path& to)
{
    if (!is_file(from) || !is_file(to)) {
        return rename(from.c_str(), to.c_str()) == 0 ? std::optional(Renamed::created) : std::nullopt;
    }
    if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_EXCHANGE) == 0) {
        return Renamed::exchanged;
    }
    const bool can_exchange = errno != EINVAL && errno != ENOSYS;
    return !can_exchange && rename(from.c_str(), to.c_str()) == 0 ? std::optional(Renamed::replaced)
                                                                  : std::nullopt;
}

/// Undoes rename_undoably() as far as the file system allows.
void undo(Renamed renamed, const std::filesystem::path& from, const std::filesystem::path& to) noexcept
{
    if (renamed != Renamed::replaced) {
        const unsigned flags = renamed == Renamed::exchanged ? RENAME_EXCHANGE : RENAME_NOREPLACE;
        const bool is_back = renameat2(AT_FDCWD, to.c_str(), AT_FDCWD, from.c_str(), flags) == 0;
        if (!is_back && renamed == Renamed::created) {
            remove_without_memory(to.c_str());
        }
    }
}

} // namespace

void AtomicFile::publish_all(std::span<AtomicFile> files)
{
    if (files.size() == 1) {
        files.front().publish();
        return;
    }
    std::vector<Renamed> done;
    done.reserve(files.size()); // Nothing below may run out of memory between two renamings
    const std::lock_guard lock(registry().guard);
    for (const AtomicFile& file : files) {
        if (const auto renamed = rename_undoably(file.path_, file.target_)) {
            done.push_back(*renamed);
            continue;
        }
        const int error = errno;
        for (size_t i = done.size(); i-- > 0;) {
            undo(done[i], files[i].path_, files[i].target_);
        }
        fail_to_rename(file.target_, error);
    }
    for (size_t i = 0; i < files.size(); ++i) {
        // After an exchange the old file has the temporary name, and is deleted with its AtomicFile.
        if (done[i] != Renamed::exchanged) {
            registry().paths.erase(files[i].path_);
            files[i].path_.clear();
        }
    }
}

void remove_left_parts(const std::filesystem::path& folder,
                       const std::function<bool(const std::string&)>& is_wanted)
{
    constexpr std::string_view mark = ".part-";
    constexpr size_t random_letters = 6;
    std::error_code failure;
    std::filesystem::directory_iterator entries(folder.empty() ? "." : folder, failure);
    for (; !failure && entries != std::filesystem::directory_iterator(); entries.increment(failure)) {
        const std::string name = entries->path().filename().string();
        const size_t end = name.rfind(mark);
        if (name.empty() || name.front() != '.' || end == std::string::npos || end < 2 ||
            name.size() != end + mark.size() + random_letters || !is_wanted(name.substr(1, end - 1))) {
            continue;
        }
        const int descriptor = open(entries->path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
        if (descriptor < 0) {
            continue;
        }
        // A program locks its file a moment after it has created the file.
        constexpr time_t just_created_s = 2;

        struct stat status {};

        const bool is_old =
            fstat(descriptor, &status) == 0 && std::time(nullptr) - status.st_mtime > just_created_s;
        if (is_old && flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
            remove_without_memory(entries->path().c_str());
        }
        close(descriptor);
    }
}

void remove_all_pending() noexcept
{
    registry().guard.lock(); // The lock is never released, so that no thread can create another file
    for (const std::filesystem::path& path : registry().paths) {
        remove_without_memory(path.c_str());
    }
    registry().paths.clear();
}

namespace {

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

using FileHandle = std::unique_ptr<std::FILE, FileCloser>;

std::string reason(int error)
{
    return std::generic_category().message(error);
}

} // namespace

std::string lower_extension(const std::filesystem::path& path)
{
    return lower_case(path.extension().string());
}

namespace {

struct OpenFile {
    FileHandle handle;
    uint64_t size = 0;
};

OpenFile open_regular(const std::filesystem::path& path, const ReadScope& scope)
{
    const int descriptor = open_to_read(path, scope, O_RDONLY | O_NONBLOCK);
    if (descriptor < 0) {
        throw Error(fmt::format("cannot open: {}", reason(errno)), path.string());
    }

    struct stat status {};

    FileHandle file(fdopen(descriptor, "rb"));
    if (!file || fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
        throw Error("is not a regular file", path.string());
    }
    return {.handle = std::move(file), .size = static_cast<uint64_t>(status.st_size)};
}

std::vector<std::byte> read_bytes(const OpenFile& file, uint64_t size, const std::filesystem::path& path)
{
    require_memory(size, "reading it", path.string());
    std::vector<std::byte> bytes(size);
    if (std::fread(bytes.data(), 1, bytes.size(), file.handle.get()) != bytes.size()) {
        throw Error("cannot read to the end", path.string());
    }
    return bytes;
}

} // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path, uint64_t max_bytes,
                                 const ReadScope& scope)
{
    const OpenFile file = open_regular(path, scope);
    if (file.size > max_bytes) {
        throw Error(fmt::format("is {} bytes long, more than the limit of {}", file.size, max_bytes),
                    path.string());
    }
    return read_bytes(file, file.size, path);
}

std::vector<std::byte> read_file_start(const std::filesystem::path& path, uint64_t most_bytes,
                                       const ReadScope& scope)
{
    const OpenFile file = open_regular(path, scope);
    return read_bytes(file, std::min(file.size, most_bytes), path);
}

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes)
{
    AtomicFile::file(path, bytes).publish();
}

void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs)
{
    std::error_code problem;
    const std::filesystem::path folder = output.has_parent_path() ? output.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, problem)) {
        throw Error("there is no such folder", folder.string(),
                    "create it first, or write elsewhere with -o");
    }
    const std::filesystem::file_status status = std::filesystem::status(output, problem);
    // A name that is too long for the file system is reported now, before other files are renamed.
    if (problem == std::errc::filename_too_long) {
        throw Error(fmt::format("cannot write: {}", problem.message()), output.string(),
                    "choose a shorter name");
    }
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw Error("exists and is not a regular file", output.string(), "choose another name for -o");
    }
    for (const std::filesystem::path& input : inputs) {
        if (std::filesystem::equivalent(output, input, problem)) {
            throw Error("the output would overwrite an input", output.string(), "choose another name for -o");
        }
    }
    const std::filesystem::path real = behind_links(output);
    const std::string part_of = part_name(real);
    remove_left_parts(real.parent_path(), [&](const std::string& name) { return name == part_of; });
    std::string probe = (folder / ".estampe-XXXXXX").string();
    const int file = mkstemp(probe.data());
    if (file < 0) {
        throw Error(fmt::format("cannot write into this folder: {}", std::strerror(errno)), folder.string(),
                    "write elsewhere with -o");
    }
    close(file);
    unlink(probe.c_str());
}

std::filesystem::path user_cache_folder()
{
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache != nullptr && *cache == '/') {
        return cache;
    }
    const char* home = std::getenv("HOME");
    return home != nullptr && *home == '/' ? std::filesystem::path(home) / ".cache" : std::filesystem::path();
}

void make_private_folder(const std::filesystem::path& folder)
{
    constexpr mode_t for_user = 0700;
    std::error_code failed;
    if (folder.empty() || std::filesystem::is_directory(folder, failed)) {
        return;
    }
    make_private_folder(folder.parent_path());
    if (mkdir(folder.c_str(), for_user) != 0 && errno != EEXIST) {
        throw std::filesystem::filesystem_error("cannot make a folder", folder,
                                                std::error_code(errno, std::generic_category()));
    }
}

std::string fault_of_private_folder(const std::filesystem::path& folder, uid_t user)
{
    struct stat status {};

    if (lstat(folder.c_str(), &status) != 0) {
        return {};
    }
    if (!S_ISDIR(status.st_mode)) {
        return "is no folder";
    }
    if (status.st_uid != user) {
        return "belongs to another user";
    }
    return (status.st_mode & (S_IWGRP | S_IWOTH)) != 0 ? "is writable by other users" : "";
}

} // namespace estampe
