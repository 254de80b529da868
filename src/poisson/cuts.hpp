// SPDX-License-Identifier: BSD-3-Clause
// What blocked faces change on every level: the coefficients of cells near a sheet, and cells that hold several values.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "poisson/cell_map.hpp"
#include "poisson/line.hpp"
#include "poisson/stored_coefficients.hpp"

namespace luff::poisson {

/// An unknown of a level: a cell (its key, >= 0), or the e-th extra unknown (-1 - e).
using Unknown = std::int64_t;
inline constexpr Unknown no_unknown = std::numeric_limits<Unknown>::min();
/// Stands for the p = 0 beyond a Dirichlet side.
inline constexpr Unknown outside = no_unknown + 1;
/// Stands for the n-th closed pocket: a part of the fluid that lies whole in one coarse cell, and needs no correction.
inline constexpr Unknown first_pocket = no_unknown + 2;
[[nodiscard]] constexpr bool is_pocket(Unknown x)
{
  return x >= first_pocket && x < no_unknown / 2;
}
[[nodiscard]] constexpr bool is_cell(Unknown x)
{
  return x >= 0;
}
[[nodiscard]] constexpr int extra_number(Unknown x)
{
  return static_cast<int>(-1 - x);
}
[[nodiscard]] constexpr Unknown extra_unknown(int e)
{
  return -1 - static_cast<Unknown>(e);
}

/// The three axes of a level, and the clean 7-point operator on it: without any blocked face, the coefficient of a face
/// being area / distance = h h / d; or with stored coefficients, which know of blocked faces, but not of cells that
/// hold several values.
struct Box {
  std::array<Line, 3> lines;
  const StoredCoefficients* stored = nullptr;

  [[nodiscard]] Index3 cells() const { return {lines[0].n, lines[1].n, lines[2].n}; }
  [[nodiscard]] Unknown key(const Index3& c) const
  {
    return c[0] + static_cast<Unknown>(lines[0].n) * (c[1] + static_cast<Unknown>(lines[1].n) * c[2]);
  }
  [[nodiscard]] Index3 cell(Unknown key) const
  {
    const Unknown n0 = lines[0].n;
    const Unknown n1 = lines[1].n;
    return {static_cast<int>(key % n0), static_cast<int>(key / n0 % n1), static_cast<int>(key / n0 / n1)};
  }
  /// Sides are numbered 2 axis + (0 low, 1 high).  False beyond the domain.
  [[nodiscard]] bool neighbour(const Index3& c, int side, Index3& result) const
  {
    result = c;
    result[side / 2] = lines[side / 2].neighbour(c[side / 2], side % 2);
    return result[side / 2] >= 0;
  }
  [[nodiscard]] double coefficient(const Index3& c, int side) const
  {
    if (stored != nullptr)
      return stored->coefficient(c, side);
    const int a = side / 2;
    const int b = (a + 1) % 3;
    const int e = (a + 2) % 3;
    return lines[a].inverse_d[c[a] + side % 2] * lines[b].h[c[b]] * lines[e].h[c[e]];
  }
  /// Root mean square of the diagonal of the clean operator, within the spread of widths; of the part of this rank
  /// where coefficients are stored.
  [[nodiscard]] double typical_diagonal() const;
  [[nodiscard]] double measure(const Index3& c) const
  {
    return lines[0].measure[c[0]] * lines[1].measure[c[1]] * lines[2].measure[c[2]];
  }
};

/// Places in Cuts::links of what leads from one unknown.
struct LinkRange {
  int begin = 0;
  int end = 0;
};

/// A cell whose coefficients or interpolation may differ from the clean ones.
struct CutCell {
  Index3 cell{};
  std::array<double, 6> coefficient{};  ///< to the neighbouring cells, per side
  double measure = 0.0;                 ///< finest cells that its value stands for
  int parts = -1;                       ///< row of Cuts::parts where its children do not all hang together, or -1
  LinkRange links;
  [[nodiscard]] bool split() const { return parts >= 0; }
};

/// An unknown beside the one of its cell: a part of the fluid inside a coarse cell that no open face joins to the rest.
struct Extra {
  Index3 cell{};
  double measure = 0.0;
  LinkRange links;
};

/// Side of links between two unknowns of one cell.
inline constexpr int within = -1;

/// A coefficient between two unknowns of which one at least is an extra; each is listed from both ends.
struct Link {
  Unknown from = no_unknown;
  Unknown to = no_unknown;
  int side = 0;  ///< of `from`'s cell, or within
  double coefficient = 0.0;
};

/// What the interpolation to `fine` differs by from the linear one of the clean operator: u_fine += weight u_coarse.
struct Interpolation {
  Unknown fine = no_unknown;
  Unknown coarse = no_unknown;
  double weight = 0.0;
};

/// All that blocked faces change on one level, the same on every rank: sheets are small beside the fluid.
struct Cuts {
  std::vector<CutCell> cells;
  CellMap find;
  std::vector<Extra> extras;
  std::vector<Link> links;                    ///< sorted by (from, to, side)
  std::vector<std::array<Unknown, 8>> parts;  ///< unknown that stands for each child of a split cell
  int pockets = 0;
  std::vector<Unknown> parent_of_extra;      ///< on the next coarser level; filled by coarsen_cuts
  std::vector<Interpolation> interpolation;  ///< from the next coarser level; filled by coarsen_cuts

  [[nodiscard]] const CutCell* at(Unknown key) const
  {
    const int n = find.find(key);
    return n < 0 ? nullptr : &cells[n];
  }
  /// Of a cell that is in `cells`, or of one of `extras`.
  [[nodiscard]] std::span<const Link> links_from(const LinkRange& range) const
  {
    return {links.data() + range.begin, links.data() + range.end};
  }
  [[nodiscard]] std::span<const Link> links_from_extra(int e) const { return links_from(extras[e].links); }
};

/// Cells whose coefficients coarsen_cuts() may read from a box, sorted.
[[nodiscard]] std::vector<Index3> cells_near_cuts(const Cuts& fine_cuts, const Box& coarse,
                                                  const std::array<Merge, 3>& merges);

/// Cells beside blocked faces, sorted.
[[nodiscard]] std::vector<Index3> cells_beside(const Box& box, std::span<const FaceIndex> faces);

/// The finest level: cells beside blocked faces.
[[nodiscard]] Cuts cuts_of_blocked_faces(const Box& box, std::span<const FaceIndex> faces);

/// The next coarser level.  Inside every coarse cell, fine unknowns joined by open links become one unknown, unless a
/// narrow passage alone joins them (Passages); the largest is the cell's own, the others become extras, so that two
/// sides of a sheet are never averaged before they really meet.  Parts without a link to the outside become pockets.
[[nodiscard]] Cuts coarsen_cuts(Cuts& fine_cuts, const Box& fine, const Box& coarse,
                                const std::array<Merge, 3>& merges);

/// The coarse unknown of a fine one, or the pocket that holds it; that of a fine cell.
[[nodiscard]] Unknown parent(const Cuts& fine_cuts, const Box& fine, const Cuts& coarse_cuts, const Box& coarse,
                             const std::array<Merge, 3>& merges, Unknown x);
[[nodiscard]] Unknown parent_of_cell(const Cuts& coarse_cuts, const Box& coarse, const std::array<Merge, 3>& merges,
                                     const Index3& cell);

}  // namespace luff::poisson
