// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace estampe {

/// A zip archive that grows in memory, in the order in which files are added; the same files give the same
/// bytes. What is added must outlive it. All throw Error when memory runs out.
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
