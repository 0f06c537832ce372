// SPDX-License-Identifier: MIT
#pragma once

// Folders of the user into which no other user may write, such as caches whose files are trusted.

#include <filesystem>
#include <string>

#include <unistd.h>

namespace estampe {

/// Creates the folder, and the folders above it, unless they exist. New folders are for the user alone,
/// whatever the user's umask. Throws std::filesystem::filesystem_error.
void make_private_folder(const std::filesystem::path& folder);

/// Returns why files in the folder cannot be trusted: the folder is a link, belongs to another user than
/// `user`, or is writable by other users. Empty if the files can be trusted, and if there is no such folder.
[[nodiscard]] std::string fault_of_private_folder(const std::filesystem::path& folder,
                                                  uid_t user = geteuid());

} // namespace estampe
