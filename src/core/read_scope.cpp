// SPDX-License-Identifier: MIT
#include "core/read_scope.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/descriptor.hpp"

namespace estampe {
namespace {

using Parts = std::vector<std::string>;

/// Returns the parts of a path from the root folder, as the path is written: symbolic links and ".." stay.
Parts parts_of(const std::filesystem::path& path)
{
    std::error_code failed;
    Parts parts;
    for (const std::filesystem::path& part : std::filesystem::absolute(path.empty() ? "." : path, failed)) {
        if (!part.empty() && part != "." && part != "/") {
            parts.push_back(part.string());
        }
    }
    return parts;
}

/// Returns the parts of `path` below `folder`; nothing if the path does not begin with the folder.
std::optional<Parts> parts_below(const Parts& folder, const Parts& path)
{
    const auto [at_folder, at_path] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return at_folder == folder.end() ? std::optional(Parts(at_path, path.end())) : std::nullopt;
}

std::string joined(const Parts& parts)
{
    return parts.empty() ? std::string(".") : fmt::format("{}", fmt::join(parts, "/"));
}

/// Opens a path below the folder `root` with openat2(). Returns -1 with errno set if this fails.
int open_by_kernel(int root, const Parts& parts, int flags)
{
    open_how how{};
    how.flags = static_cast<uint64_t>(flags);
    how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS | RESOLVE_NO_MAGICLINKS;
    constexpr int most_tries = 16;
    for (int tries = 0; tries < most_tries; ++tries) {
        const long opened = syscall(SYS_openat2, root, joined(parts).c_str(), &how, sizeof how);
        // The kernel answers EAGAIN if a folder was moved meanwhile.
        if (opened >= 0 || errno != EAGAIN) {
            return static_cast<int>(opened);
        }
    }
    return -1;
}

bool is_link(int folder, const std::string& name)
{
    struct stat status {};

    return fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(status.st_mode);
}

/// Opens a path below the folder `root` part by part. Returns -1 with errno set if this fails; errno is ELOOP
/// for a symbolic link.
int open_by_parts(int root, const Parts& parts, int flags)
{
    Descriptor folder(openat(root, ".", O_PATH | O_DIRECTORY | O_CLOEXEC));
    for (size_t i = 0; folder.number() >= 0 && i + 1 < parts.size(); ++i) {
        const int next =
            openat(folder.number(), parts[i].c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        if (next < 0 && errno == ENOTDIR && is_link(folder.number(), parts[i])) {
            errno = ELOOP;
        }
        folder.reset(next);
    }
    if (folder.number() < 0) {
        return -1;
    }
    const std::string last = parts.empty() ? std::string(".") : parts.back();
    Descriptor opened(openat(folder.number(), last.c_str(), flags | O_NOFOLLOW));

    struct stat status {};

    // With O_PATH, openat() opens the link itself.
    const bool is_path_of_link =
        opened.number() >= 0 && fstat(opened.number(), &status) == 0 && S_ISLNK(status.st_mode);
    if (is_path_of_link || (opened.number() < 0 && errno == ENOTDIR && is_link(folder.number(), last))) {
        opened.reset(-1);
        errno = ELOOP;
    }
    return opened.release();
}

int open_below(int root, const Parts& parts, int flags, ScopeWalk walk)
{
    if (walk == ScopeWalk::by_parts) {
        return open_by_parts(root, parts, flags);
    }
    const int opened = open_by_kernel(root, parts, flags);
    // Kernels before 5.6 lack openat2(); filters of containers may answer EPERM to calls that they do not
    // know.
    const bool is_unknown = opened < 0 && (errno == ENOSYS || errno == EPERM);
    return is_unknown ? open_by_parts(root, parts, flags) : opened;
}

std::string in_words(const ReadScope& scope)
{
    std::vector<std::string> names;
    for (const std::filesystem::path& folder : scope.folders) {
        names.push_back(folder.empty() ? "." : folder.string());
    }
    return fmt::format("the folder{} {}", names.size() == 1 ? "" : "s", fmt::join(names, ", "));
}

constexpr const char* remedy = "put the file there without links and .., or leave out --confine";

} // namespace

bool leads_upwards(std::string_view name)
{
    while (!name.empty()) {
        const size_t end = std::min(name.find_first_of("/\\"), name.size());
        if (name.substr(0, end) == "..") {
            return true;
        }
        name.remove_prefix(std::min(end + 1, name.size()));
    }
    return false;
}

void fail_outside(std::string_view name, const ReadScope& scope, const std::string& where)
{
    constexpr size_t most_letters = 200;
    const std::string shown(name.substr(0, most_letters));
    throw OutsideScope(fmt::format("{}lies outside {}, to which --confine limits reading",
                                   shown == where ? "" : shown + " ", in_words(scope)),
                       where, remedy);
}

void require_inside(std::string_view name, const ReadScope& scope, const std::string& where)
{
    const bool is_absolute = name.starts_with('/') || name.starts_with('\\');
    if (scope.is_limited() && (is_absolute || leads_upwards(name))) {
        fail_outside(name, scope, where);
    }
}

int open_to_read(const std::filesystem::path& path, const ReadScope& scope, int flags, ScopeWalk walk)
{
    flags |= O_CLOEXEC;
    if (!scope.is_limited()) {
        return open(path.c_str(), flags);
    }
    const Parts parts = parts_of(path);
    const std::filesystem::path* root = nullptr;
    Parts rest = parts;
    for (const std::filesystem::path& folder : scope.folders) {
        const std::optional<Parts> below = parts_below(parts_of(folder), parts);
        // The longest folder is the one that the user named for this file.
        if (below && (root == nullptr || below->size() < rest.size())) {
            root = &folder;
            rest = *below;
        }
    }
    if (root == nullptr || std::ranges::find(rest, "..") != rest.end()) {
        fail_outside(path.string(), scope, path.string());
    }
    const Descriptor folder(open(root->empty() ? "." : root->c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (folder.number() < 0) {
        return -1;
    }
    const int opened = open_below(folder.number(), rest, flags, walk);
    if (opened < 0 && errno == EXDEV) {
        fail_outside(path.string(), scope, path.string());
    }
    if (opened < 0 && errno == ELOOP) {
        throw OutsideScope(
            fmt::format("is a symbolic link or lies behind one, which may lead outside {}", in_words(scope)),
            path.string(), remedy);
    }
    return opened;
}

} // namespace estampe
