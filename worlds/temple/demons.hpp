// SPDX-License-Identifier: MIT
#pragma once

// All demons of a temple: where they are held, their nodes in the scene, and their effects: hollows in the
// sand, stains of ink on the page.

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

/// Returns the grounds on which the demons move, one per demon. Cells come first, shut cells before open
/// ones. One more demon is in the last hall, and some are in the court, on the avenue, by the giant statue
/// and in the dunes.
[[nodiscard]] std::vector<Haunt> find_haunts(const Plan& plan, const Site& site);

class Demons {
public:
    Demons(const Plan& plan, const Site& site, const estampe::Terrain& desert, uint64_t seed);

    /// Advances all demons in steps of a 60th of a second; a remainder is kept for the next call. The demons
    /// watch and avoid a visitor at `walker_m`; `wind_m_per_s` is the wind along x and z. Cost: 20 us per
    /// step.
    void step(double seconds, const glm::dvec3& walker_m, const glm::vec2& wind_m_per_s = {});

    /// Makes the demon with this number dissolve from now on. Throws std::out_of_range if it does not exist.
    void dissolve(size_t demon) { all_.at(demon).dissolve(); }

    [[nodiscard]] std::span<const Demon> all() const { return all_; }

    /// Adds the demons' nodes in their current state: bodies with skinned meshes, nodes named `wisp N` that
    /// emit particles, and nodes named `stain N` from which ink flows. Appends two materials to the scene.
    void add_to(estampe::Scene& scene) const;

    /// Returns the demons' current transforms of nodes, for Renderer::place(); `first` is the index of the
    /// scene's node `demon 0`. Demons for which `is_hidden` returns true have no size and emit no smoke.
    [[nodiscard]] std::vector<estampe::NodePlace>
    places(estampe::Index first, const std::function<bool(const Demon&)>& is_hidden = {}) const;

    /// Returns the hollows that demons press into the sand, one for each demon on sand.
    [[nodiscard]] std::vector<Hollow> hollows() const;

private:
    std::vector<Demon> all_;
    uint64_t seed_ = 0;
    double owed_s_ = 0.0;
};

} // namespace temple
