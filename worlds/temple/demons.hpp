// SPDX-License-Identifier: MIT
#pragma once

// All the demons of a temple: where they are held, how they stand in a scene, and what they do to sand and
// page.

#include <functional>
#include <span>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "demon.hpp"
#include "kit.hpp"
#include "plan.hpp"
#include "sand.hpp"
#include "site.hpp"

namespace temple {

/// Where the demons of a temple are: in cells, those that are shut first; one in the last hall; and some free
/// ones in the court, on the avenue, by the giant and in the dunes.
[[nodiscard]] std::vector<Haunt> find_haunts(const Plan& plan, const Site& site);

class Demons {
public:
    Demons(const Plan& plan, const Site& site, const estampe::Terrain& desert, uint64_t seed);

    /// So much on, in steps of a 60th of a second; what is left over is kept for the next time. `walker_m` is
    /// whom they watch and shy away from, and `wind_m_s` the wind along x and z. Cost: 20 us a step.
    void step(double seconds, const glm::dvec3& walker_m, const glm::vec2& wind_m_s = {});

    /// From now on this one runs out. Throws std::out_of_range where there is none.
    void dissolve(size_t demon) { all_.at(demon).dissolve(); }

    [[nodiscard]] std::span<const Demon> all() const { return all_; }

    /// Adds their nodes as they stand now: bodies of skinned meshes, `wisp N` that give particles, and `stain
    /// N` that are zones of ink. Their two materials come after those that are there.
    void add_to(estampe::Scene& scene) const;

    /// Where their nodes are now, for Renderer::place(); `first` is the scene's node `demon 0`. Those that
    /// `is_hidden` says of have no size and give no smoke.
    [[nodiscard]] std::vector<estampe::NodePlace>
    places(estampe::Index first, const std::function<bool(const Demon&)>& is_hidden = {}) const;

    /// What their presence does to the sand: one for each that is on it.
    [[nodiscard]] std::vector<Hollow> hollows() const;

private:
    std::vector<Demon> all_;
    uint64_t seed_ = 0;
    double owed_s_ = 0.0;
};

} // namespace temple
