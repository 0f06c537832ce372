// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "options.hpp"

namespace CLI {
class App;
}

namespace estampe::app {

/// The options of `estampe bench`, `bench lights`, `bench lab` and `bench roofline` as they are typed.
class BenchOptions {
public:
    /// Adds the command to `app`; this object must outlive the parsing.
    void add_to(CLI::App& app);

    /// What was typed, looked at. Throws UsageError for a mistake in it.
    [[nodiscard]] Command read() const;

private:
    [[nodiscard]] BenchCommand read_series() const;
    [[nodiscard]] BenchLightsCommand read_lights() const;
    [[nodiscard]] BenchLabCommand read_lab() const;
    [[nodiscard]] BenchRooflineCommand read_roofline() const;
    void add_lights_to(CLI::App& bench);
    void add_lab_to(CLI::App& bench);
    void add_roofline_to(CLI::App& bench);
    void add_files_to(CLI::App& command);
    void add_common_to(CLI::App& command);
    [[nodiscard]] RendererOptions device() const;

    CLI::App* lights_ = nullptr;
    CLI::App* lab_ = nullptr;
    CLI::App* roofline_ = nullptr;
    std::vector<std::string> names_;
    std::vector<std::string> compared_;
    std::string json_file_;
    std::string csv_file_;
    std::string plots_;
    double most_share_ = 1.0;
    double least_share_ = 0.02;
    std::string size_ = "1280x720";
    uint32_t frames_ = 9;
    std::string device_ = "auto";
    std::string raster_ = "auto";
    std::vector<uint32_t> counts_;
    uint32_t shadowed_ = 0;
    bool million_ = false;
    bool moving_ = false;
    bool json_ = false;
    std::string output_;
};

} // namespace estampe::app
