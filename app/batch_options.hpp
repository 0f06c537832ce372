// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "options.hpp"

namespace estampe::app {

/// The options of `estampe batch` as they are typed.
class BatchOptions {
public:
    /// Adds the command to `app`; this object must outlive the parsing.
    void add_to(CLI::App& app);

    /// What was typed, looked at. Throws UsageError for a mistake in it.
    [[nodiscard]] BatchCommand read() const;

private:
    std::string jobs_;
    std::string report_;
    std::string shard_;
    std::string device_ = "auto";
    std::string raster_ = "auto";
};

} // namespace estampe::app
