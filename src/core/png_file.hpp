// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace estampe {

/// A PNG picture of eight bits a channel that is written as it comes, row by row, for pictures that memory
/// does not hold. Until publish() the file of that name is what it was.
class PngFile {
public:
    /// `dots_per_m` of 0 says nothing of the size on paper. Throws Error when the file cannot be written.
    PngFile(const std::filesystem::path& path, uint32_t width, uint32_t height, uint32_t dots_per_m = 0);
    ~PngFile();
    PngFile(const PngFile&) = delete;
    PngFile& operator=(const PngFile&) = delete;

    /// The next rows, of four bytes a pixel. Throws Error when the disk is full.
    void add_rows(std::span<const uint8_t> rgba);

    /// To be called after the last row. Throws Error when the disk is full, and for rows too few.
    void publish();

private:
    struct Writer;
    std::unique_ptr<Writer> writer_;
};

} // namespace estampe
