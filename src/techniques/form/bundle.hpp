// SPDX-License-Identifier: MIT
#pragma once

// Multigrid solver for 2D vector fields on a graph: one vector per node. Each link of the graph states by
// which rotation or reflection the vectors at its two nodes should differ.

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::form {

/// A 2 x 2 matrix, row by row. The matrix has single precision to save memory bandwidth.
struct Block {
    float xx = 0.0F, xy = 0.0F, yx = 0.0F, yy = 0.0F;
};

inline glm::dvec2 times(const Block& m, glm::dvec2 v)
{
    return {double{m.xx} * v.x + double{m.xy} * v.y, double{m.yx} * v.x + double{m.yy} * v.y};
}

inline glm::dvec2 transposed_times(const Block& m, glm::dvec2 v)
{
    return {double{m.xx} * v.x + double{m.yx} * v.y, double{m.xy} * v.x + double{m.yy} * v.y};
}

inline glm::dvec2 times(const glm::dvec3& symmetric, glm::dvec2 v)
{
    return {symmetric.x * v.x + symmetric.y * v.y, symmetric.y * v.x + symmetric.z * v.y};
}

inline Block product(const Block& a, const Block& b)
{
    return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
            a.yx * b.xy + a.yy * b.yy};
}

inline Block transposed(const Block& m)
{
    return {m.xx, m.yx, m.xy, m.yy};
}

inline float strength(const Block& m)
{
    return m.xx * m.xx + m.xy * m.xy + m.yx * m.yx + m.yy * m.yy;
}

/// Returns the orthogonal matrix (rotation or reflection) that is nearest to the matrix -m.
inline Block nearest_orthogonal(const Block& m)
{
    const glm::vec2 rotation(-m.xx - m.yy, m.xy - m.yx);
    const glm::vec2 reflection(m.yy - m.xx, -m.xy - m.yx);
    const float turn = glm::length(rotation);
    const float mirror = glm::length(reflection);
    if (std::max(turn, mirror) <= 0.0F) {
        return {1.0F, 0.0F, 0.0F, 1.0F};
    }
    if (turn >= mirror) {
        const glm::vec2 c = rotation / turn;
        return {c.x, -c.y, c.y, c.x};
    }
    const glm::vec2 c = reflection / mirror;
    return {c.x, c.y, c.y, -c.x};
}

using Vectors = std::vector<glm::dvec2>;

/// A link requests that the vector at `to` equals the vector at `from`, rotated by `turn_rad`. If `mirrors`
/// is set, the rotated vector is also mirrored in the x axis.
struct Link {
    uint32_t from = 0;
    uint32_t to = 0;
    double weight = 0.0;
    double turn_rad = 0.0;
    bool mirrors = false;
};

/// The energy of a vector field z on a graph, stored as a matrix A. The energy is the sum over all links of
/// weight |z_to - T z_from|^2, where z_to and z_from are the vectors at the link's ends, and T is the link's
/// rotation or reflection. Each node has a mass (matrix M). A hierarchy of coarser graphs merges neighbouring
/// nodes whose links agree.
class Bundle {
public:
    Bundle(uint32_t node_count, const std::vector<Link>& links, std::vector<double> masses);

    /// Solves (A + diag(pulls)) z = right for the vector field z, where A is the energy's matrix, diag(pulls)
    /// a diagonal matrix, and `right` the right-hand side. Uses conjugate gradients, preconditioned by one
    /// multigrid cycle. Stops when the residual has fallen to `tolerance` times the first residual, or after
    /// 60 rounds. Each connected part of the graph needs at least one node with a pull above zero; otherwise
    /// the part's solution is not unique.
    [[nodiscard]] Vectors solve(const std::vector<double>& pulls, const Vectors& right, double tolerance);

    /// Finds a smooth vector field that is close to `targets` at the nodes with a large value in `pulls`:
    /// calls solve() with the right-hand side diag(pulls) targets.
    [[nodiscard]] Vectors attract(const std::vector<double>& pulls, const Vectors& targets, double tolerance);

    /// Returns a field of unit vectors with nearly the least energy. Alternates diffusion and normalization
    /// on each multigrid level, from the coarsest to the finest level. Diffusion smooths over about the
    /// distance `reach`, but at least over a few nodes. `reach` squared has the unit of the masses. Starts
    /// from random vectors with `seed`.
    [[nodiscard]] Vectors relax(double reach, uint32_t seed);

private:
    struct Level {
        /// For each row of the matrix: index of the row's first entry in `columns` and `blocks`.
        std::vector<uint32_t> starts;
        std::vector<uint32_t> columns;
        std::vector<Block> blocks;        ///< entries of the matrix that are not on the diagonal
        std::vector<glm::dvec3> diagonal; ///< diagonal entries of the matrix, symmetric: xx, xy, yy
        std::vector<double> masses;
        std::vector<double> shifts; ///< values that are added to the diagonal
        std::vector<glm::dvec3> inverse_diagonal;
        /// For each node: the number of the node's group, which is a node of the next coarser multigrid
        /// level.
        std::vector<uint32_t> coarse;
        /// For each node: orthogonal matrix that maps the vector of the node's group to the node's vector.
        std::vector<Block> from_coarse;
        Vectors x, b, r; ///< work vectors of a multigrid cycle

        [[nodiscard]] uint32_t size() const { return static_cast<uint32_t>(diagonal.size()); }
    };

    static bool aggregate(Level& fine);
    static bool is_small(const Level& level);
    static Level coarsen(const Level& fine);
    void set_shifts(std::vector<double> finest);
    void set_shift(double per_mass);
    void invert_diagonals();
    static glm::dvec2 off_diagonal(const Level& level, uint32_t row, const Vectors& x);
    static void smooth(const Level& level, Vectors& x, const Vectors& b, bool forward);
    static void apply(const Level& level, const Vectors& x, Vectors& out);
    void cycle(size_t index, Vectors& x, const Vectors& b);
    void diffuse(size_t index, Vectors& z, double reach, int times);

    std::vector<Level> levels_;
};

} // namespace estampe::form
