// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace estampe {

/// Builds a zip archive in memory, with entries in the order of add(); the same entries give the same bytes.
/// Data passed to add() must outlive the writer. Throws Error if memory runs out.
class ZipWriter {
public:
    ZipWriter();
    ZipWriter(const ZipWriter&) = delete;
    ZipWriter& operator=(const ZipWriter&) = delete;
    ~ZipWriter();

    void add(const std::string& entry, std::span<const std::byte> bytes, bool compress);

    [[nodiscard]] std::vector<std::byte> finish();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace estampe
