// SPDX-License-Identifier: MIT
#pragma once

namespace estampe::viewer {

/// How large pictures are drawn while something moves, as a share of the view's sides: as large as lets 15
/// of them come in a second.
class Resolution {
public:
    static constexpr double wanted_s = 1.0 / 15.0;
    static constexpr double least = 0.125;

    [[nodiscard]] double scale() const { return scale_; }

    /// A picture of `scale` took so long. A single slow one, as when the driver compiles, changes nothing.
    void drawn(double scale, double seconds);

private:
    double scale_ = 0.25; ///< the first picture comes soon
    double slow_s_ = 0.0; ///< what the picture before took, where that was too long
};

} // namespace estampe::viewer
