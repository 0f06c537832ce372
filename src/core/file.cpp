// SPDX-License-Identifier: MIT
#include "core/file.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/free_memory.hpp"
#include "core/pending.hpp"

namespace estampe {
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
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return extension;
}

std::vector<std::byte> read_file(const std::filesystem::path& path, uint64_t max_bytes)
{
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) {
        throw Error(fmt::format("cannot open: {}", reason(errno)), path.string());
    }

    struct stat status {};

    const FileHandle file(fdopen(descriptor, "rb"));
    if (!file || fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
        throw Error("is not a regular file", path.string());
    }
    const auto size = static_cast<uint64_t>(status.st_size);
    if (size > max_bytes) {
        throw Error(fmt::format("is {} bytes long, more than the limit of {}", size, max_bytes),
                    path.string());
    }
    require_memory(size, "reading it", path.string());
    std::vector<std::byte> bytes(size);
    if (std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) {
        throw Error("cannot read to the end", path.string());
    }
    return bytes;
}

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes)
{
    Pending::file(path, bytes).publish();
}

} // namespace estampe
