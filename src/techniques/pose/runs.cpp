// SPDX-License-Identifier: MIT
#include "techniques/pose/runs.hpp"

#include <algorithm>

namespace estampe::pose {
namespace {

bool stands_otherwise(const shared::DrawRecord& before, const shared::DrawRecord& now)
{
    return before.anchor_from_object != now.anchor_from_object || before.first_joint != now.first_joint ||
           before.first_morph_weight != now.first_morph_weight;
}

bool weighs_otherwise(const shared::DrawRecord& draw, const PoseData& before, const PoseData& now)
{
    const auto weights = [&](const PoseData& pose) {
        return std::span(pose.morph_weights).subspan(draw.first_morph_weight, draw.morph_target_count);
    };
    return draw.morph_target_count > 0 && !std::ranges::equal(weights(before), weights(now));
}

/// Runs in ascending order, of which the two with the least between them become one where there is no room.
class Collector {
public:
    void add(const VertexRun& run)
    {
        if (count_ > 0 && end_of(runs_[count_ - 1]) == run.first) {
            runs_[count_ - 1].count += run.count;
            return;
        }
        runs_[count_++] = run;
        if (count_ == runs_.size()) {
            join_nearest();
        }
    }

    [[nodiscard]] VertexRuns runs() const
    {
        VertexRuns runs;
        for (size_t i = 0; i < count_; ++i) {
            runs.push_back(runs_[i]);
        }
        return runs;
    }

private:
    static uint32_t end_of(const VertexRun& run) { return run.first + run.count; }

    void join_nearest()
    {
        size_t nearest = 1;
        const auto gap = [&](size_t i) { return runs_[i].first - end_of(runs_[i - 1]); };
        for (size_t i = 2; i < count_; ++i) {
            nearest = gap(i) < gap(nearest) ? i : nearest;
        }
        runs_[nearest - 1].count = end_of(runs_[nearest]) - runs_[nearest - 1].first;
        std::copy(runs_.begin() + static_cast<std::ptrdiff_t>(nearest) + 1,
                  runs_.begin() + static_cast<std::ptrdiff_t>(count_),
                  runs_.begin() + static_cast<std::ptrdiff_t>(nearest));
        --count_;
    }

    std::array<VertexRun, 9> runs_{};
    size_t count_ = 0;
};

} // namespace

VertexRuns runs_to_pose(const MeshData& meshes, const PoseData* before, const PoseData& now,
                        std::span<const uint32_t> written_over)
{
    if (before == nullptr) {
        return {VertexRun{.first = 0, .count = static_cast<uint32_t>(meshes.draw_of_vertex.size())}};
    }
    // Which joints a skin has is not known here: all skinned bodies are taken to move with any of them.
    const bool have_joints_moved = before->joints != now.joints;
    Collector runs;
    for (uint32_t i = 0; i < now.draws.size(); ++i) {
        const shared::DrawRecord& draw = now.draws[i];
        const bool is_skinned = draw.first_skin_vertex != shared::no_skin;
        if (stands_otherwise(before->draws[i], draw) || (is_skinned && have_joints_moved) ||
            weighs_otherwise(draw, *before, now) || std::ranges::binary_search(written_over, i)) {
            runs.add({.first = draw.first_posed_vertex, .count = draw.vertex_count});
        }
    }
    return runs.runs();
}

} // namespace estampe::pose
