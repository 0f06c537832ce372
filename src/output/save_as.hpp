// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include <estampe/error.hpp>

#include "core/file.hpp"

namespace estampe::output {

/// Writes the bytes that `encode` makes to `path`, beside it first. What `encode` throws names the file.
template <class Encode>
void save_as(const std::filesystem::path& path, const Encode& encode)
{
    std::vector<std::byte> bytes;
    try {
        bytes = encode();
    } catch (const Error& error) {
        throw error.where().empty() ? Error(error.what(), path.string()) : error;
    }
    write_file_atomically(path, bytes);
}

} // namespace estampe::output
