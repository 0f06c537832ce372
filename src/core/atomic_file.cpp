// SPDX-License-Identifier: MIT
#include "core/atomic_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe {
namespace {

/// What is pending in this program. Never taken down: a signal may come while the program ends.
struct Registry {
    std::mutex guard;
    std::set<std::filesystem::path> paths;
};

Registry& registry()
{
    static auto* const all = new Registry;
    return *all;
}

std::string reason_of(int error)
{
    return std::generic_category().message(error);
}

/// Beside `target`, hidden, and short enough for any target whose own name is not too long.
std::string name_beside(const std::filesystem::path& target)
{
    constexpr size_t longest = 200;
    const std::string name = target.filename().string().substr(0, longest);
    return (target.parent_path() / fmt::format(".{}.part-XXXXXX", name)).string();
}

[[noreturn]] void fail_to_begin(const std::filesystem::path& target, int error)
{
    throw Error(fmt::format("cannot write: {}", reason_of(error)), target.string(),
                "choose a folder that exists and may be written");
}

void write_all(const std::filesystem::path& path, std::span<const std::byte> bytes,
               const std::filesystem::path& target)
{
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    bool is_written = file != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
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

AtomicFile::AtomicFile(std::filesystem::path target, std::filesystem::path path)
    : target_(std::move(target)), path_(std::move(path))
{
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)), path_(std::move(other.path_))
{
    other.path_.clear();
}

AtomicFile::~AtomicFile()
{
    if (path_.empty()) {
        return;
    }
    const std::lock_guard lock(registry().guard);
    std::error_code failure;
    std::filesystem::remove_all(path_, failure);
    registry().paths.erase(path_);
}

AtomicFile AtomicFile::file(const std::filesystem::path& target)
{
    std::error_code failure;
    if (std::filesystem::is_directory(target, failure)) {
        throw Error("is a folder", target.string(), "give the name of a file");
    }
    std::string name = name_beside(target);
    const std::lock_guard lock(registry().guard);
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) {
        fail_to_begin(target, errno);
    }
    const mode_t mask = umask(0);
    umask(mask);
    fchmod(descriptor, 0666 & ~mask);
    close(descriptor);
    registry().paths.insert(name);
    return {target, name};
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
    registry().paths.insert(name);
    return {target, name};
}

void AtomicFile::publish()
{
    std::error_code failure;
    const std::lock_guard lock(registry().guard);
    std::filesystem::rename(path_, target_, failure);
    if (failure) {
        throw Error(fmt::format("cannot write: {}", failure.message()), target_.string());
    }
    registry().paths.erase(path_);
    path_.clear();
}

void remove_all_pending() noexcept
{
    registry().guard.lock(); // for ever
    for (const std::filesystem::path& path : registry().paths) {
        std::error_code failure;
        std::filesystem::remove_all(path, failure);
    }
    registry().paths.clear();
}

} // namespace estampe
