// SPDX-License-Identifier: MIT
#include "core/private_folder.hpp"

#include <cerrno>
#include <system_error>

#include <sys/stat.h>

namespace estampe {

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
