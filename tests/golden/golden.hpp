// SPDX-License-Identifier: MIT
#pragma once

// Golden pictures: what a scene looked like when a person last approved it. They guard the look alone; what
// can be stated as a number is tested as one.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <estampe/image.hpp>

namespace estampe::test {

/// How far a render may be from its golden picture; the figures are those of ImageDifference. The defaults
/// let rounding in another build of the driver pass, and neither a line that moves nor a tone that drifts.
struct GoldenTolerance {
    uint32_t channel_limit = 2;      ///< in steps of 1/255
    double failing_fraction = 0.001; ///< pixels that may be beyond it
    double delta_e_mean = 0.1;
    double delta_e_p95 = 0.5;
    std::string reason = {}; ///< why a figure is looser than the default; then it must not be empty
};

struct GoldenFolders {
    std::filesystem::path golden;   ///< NAME.png, under version control
    std::filesystem::path failures; ///< NAME.actual.png and NAME.difference.png of what failed
    bool renew = false;             ///< write the golden picture instead of comparing
};

/// Compares `image` with the golden picture `name`. Returns nothing when they match, else what is wrong and
/// where the pictures lie. A missing golden picture is a failure. When renewing it writes, prints a line and
/// returns nothing.
[[nodiscard]] std::optional<std::string> golden_failure(const Image& image, const std::string& name,
                                                        const GoldenTolerance& tolerance,
                                                        const GoldenFolders& folders);

/// Tiles of one size side by side, row by row.
[[nodiscard]] Image sheet_of(const std::vector<Image>& tiles, uint32_t columns);

/// Fails the running GoogleTest unless `image` matches tests/golden/NAME.png. The pictures of a failure go to
/// golden-failures/ in the working directory. Renews if the environment has ESTAMPE_RENEW_GOLDENS=1:
/// script/goldens.
void expect_matches_golden(const Image& image, const std::string& name,
                           const GoldenTolerance& tolerance = {});

} // namespace estampe::test
