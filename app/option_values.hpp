// SPDX-License-Identifier: MIT
#pragma once

// Options that several commands share, and the parsing of their values.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <estampe/scene.hpp>

#include "options.hpp"

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace estampe::app {

inline constexpr uint32_t largest_side_px = 65535;

/// Returns the option of `command` with a long name such as "set"; null if there is none. CLI11's own search
/// (get_option_no_throw) ends the program if memory runs out in it.
[[nodiscard]] const CLI::Option* find_option(const CLI::App& command, const std::string& long_name);

/// Parses a picture's size such as "1920x1080". Throws UsageError for other text, or if a side is 0 or larger
/// than largest_side_px.
[[nodiscard]] std::pair<uint32_t, uint32_t> parse_size(const std::string& text);

/// Parses a raster path: "auto", "hardware" or "compute". Throws UsageError for other text.
[[nodiscard]] RasterPath parse_raster_path(const std::string& text);

/// Parses a camera: "auto", a name or index, "eye=x,y,z target=x,y,z fov=degrees", or "azimuth=degrees
/// elevation=degrees". Throws UsageError when one of the last two is malformed.
[[nodiscard]] CameraChoice parse_camera(const std::string& text);

/// Parses a named view: "front", "three-quarter" and so on. Throws UsageError listing the views for an
/// unknown name.
[[nodiscard]] CameraChoice parse_view(const std::string& text);

/// Checks the value of --device. Throws UsageError unless `text` is "auto", "cpu" or an index.
void check_device(const std::string& text);

/// Checks a whole number that was typed. Throws UsageError, which names `option`, unless `typed` lies within
/// `least` and `most`.
void check_range(const char* option, uint32_t typed, uint32_t least, uint32_t most);

/// Assignments that `--draft` adds to a style. The assignments turn off or coarsen effects that are slow and
/// hardly visible.
inline constexpr std::array draft_assignments{"hatch.layers=1",         "contour.intersection.enabled=false",
                                              "ink.cell_mm=0.8",        "ink.age_s=1",
                                              "ink.steps_per_s=8",      "smoke.cells=32",
                                              "smoke.step=1.5",         "smoke.age_s=2",
                                              "shadow.sun_map=warped",  "light.shadow_size=1024",
                                              "shadow.local_size=256",  "shadow.sun_radius_deg=0",
                                              "shadow.lamp_radius_m=0", "cloth.effort=0.5",
                                              "occlusion.enabled=false"};

/// Returns the style that `--style` names, or the default style, with the assignments of `--set` applied.
/// Throws UsageError for an invalid assignment, Error for a style that cannot be read. The style may name
/// files within `confine`, and assignments any file that is not confined to a batch.
[[nodiscard]] Style read_style(const std::string& name, const std::vector<std::string>& assignments,
                               const Confinement& confine = {});

/// Returns the scope for the files of the style that `name` names: the folders of all its files.
[[nodiscard]] ReadScope style_scope(const std::string& name, const Confinement& confine);

/// The options for reading a scene: --up, --input-format and --confine.
class SceneOptions {
public:
    /// Adds the options to the command; this object must outlive the parsing.
    void add_to(CLI::App& command);

    /// Returns the axis of the file that points up, if one was typed. Throws UsageError for an invalid axis.
    [[nodiscard]] std::optional<UpAxis> up() const;

    /// Returns the format of a piped scene; empty if the user typed no format. Throws UsageError for an
    /// unknown format.
    [[nodiscard]] std::string format() const;

    [[nodiscard]] Confinement confinement() const { return {.is_on = is_confined_, .jobs = {}}; }

private:
    bool is_confined_ = false;
    std::string up_;
    std::string format_;
};

/// The options --max-memory and --max-seconds.
class LimitOptions {
public:
    /// Adds the options to the command; this object must outlive the parsing.
    void add_to(CLI::App& command);

    /// Returns the limits; what was not typed is not limited. Throws UsageError for invalid values.
    [[nodiscard]] WorkLimits read() const;

private:
    std::string memory_;
    std::optional<double> seconds_;
};

/// Parses an amount of memory such as "500M" or "4G": a number of bytes, or of powers of 1024 bytes with K,
/// M, G or T. Returns nothing for other text, and for amounts of less than one byte.
[[nodiscard]] std::optional<uint64_t> parse_bytes(std::string_view text);

/// Adds the option `--no-cache` to the command. The option takes effect while the command line is read: see
/// gpu::keep_pipelines().
void add_no_cache_flag(CLI::App& command);

} // namespace estampe::app
