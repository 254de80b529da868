// SPDX-License-Identifier: BSD-3-Clause
#include "grid/quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/error.hpp"

namespace luff::grid {

namespace {

/// What remains of a difference of numbers of order one.
constexpr double rounding = 1e-12;

using Three = std::array<Vec3, 3>;

Three mean_edges(const Grid& grid, const Index3& c)
{
  Three T;
  for (int a = 0; a < 3; ++a) {
    const Index3 high = stepped(c, a, 1);
    T[a] = grid.face_centre(a, high[0], high[1], high[2]) - grid.face_centre(a, c[0], c[1], c[2]);
  }
  return T;
}

Vec3 area_vector(const Grid& grid, int a, const Index3& c)
{
  return grid.area_vector(a, c[0], c[1], c[2]);
}

double largest_cosine(const Three& vectors)
{
  double largest = 0.0;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    largest = std::max(largest, std::abs(vectors[a].normalized().dot(vectors[b].normalized())));
  }
  return largest;
}

/// The worst of one number over the cells of all ranks.
class Search {
 public:
  enum class For { Largest, Smallest };
  explicit Search(For what) : sign_(what == For::Largest ? 1.0 : -1.0) {}

  void look_at(double value, const Index3& cell)
  {
    // A cell without size has no number: nothing is worse.
    const double badness = std::isnan(value) ? std::numeric_limits<double>::max() : sign_ * value;
    if (badness <= badness_)
      return;
    badness_ = badness;
    value_ = value;
    cell_ = cell;
  }

  /// Collective.
  [[nodiscard]] Worst over_ranks(const Grid& grid) const
  {
    struct {
      double badness;
      int rank;
    } mine{badness_, grid.ranks().rank()}, worst{};
    MPI_Allreduce(&mine, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, grid.ranks().comm());
    Worst result{value_, cell_, grid.owned().grown(1).contains(cell_) ? grid.centre(cell_) : Vec3::Zero()};
    MPI_Bcast(&result.value, 1, MPI_DOUBLE, worst.rank, grid.ranks().comm());
    MPI_Bcast(result.cell.data(), 3, MPI_INT, worst.rank, grid.ranks().comm());
    MPI_Bcast(result.place.data(), 3, MPI_DOUBLE, worst.rank, grid.ranks().comm());
    return result;
  }

  void start_at(const Index3& cell) { cell_ = cell; }

 private:
  double sign_;
  double badness_ = -std::numeric_limits<double>::max();
  double value_ = 0.0;
  Index3 cell_{};
};

/// Largest ratio of the volume of a cell and that of its next along any direction; beyond a side the halo repeats.
double volume_growth(const Grid& grid, const Index3& c)
{
  const double V = grid.volume(c[0], c[1], c[2]);
  double largest = 1.0;
  for (int a = 0; a < 3; ++a) {
    const Index3 next = stepped(c, a, 1);
    const double ratio = grid.volume(next[0], next[1], next[2]) / V;
    largest = std::max({largest, ratio, 1.0 / ratio});
  }
  return largest;
}

std::string at(const Worst& worst)
{
  return fmt::format("cell ({}, {}, {}) at ({:.6g}, {:.6g}, {:.6g})", worst.cell[0], worst.cell[1], worst.cell[2],
                     worst.place[0], worst.place[1], worst.place[2]);
}

}  // namespace

CellQuality cell_quality(const Grid& grid, int i, int j, int k)
{
  const Index3 c{i, j, k};
  const Three T = mean_edges(grid, c);
  const Three S{T[1].cross(T[2]), T[2].cross(T[0]), T[0].cross(T[1])};
  CellQuality q;
  q.skew = largest_cosine(S);
  q.volume = grid.volume(i, j, k) / (T[0].norm() * T[1].norm() * T[2].norm());
  q.jacobian = std::numeric_limits<double>::max();
  Vec3 sum = Vec3::Zero();
  double largest_area = 0.0;
  double shortest = T[0].norm();
  double longest = shortest;
  for (int a = 0; a < 3; ++a) {
    const Vec3 low = area_vector(grid, a, c);
    const Vec3 high = area_vector(grid, a, stepped(c, a, 1));
    sum += high - low;
    largest_area = std::max({largest_area, low.norm(), high.norm()});
    q.jacobian = std::min(q.jacobian, T[a].dot(low + high) / (T[a].norm() * (low + high).norm()));
    shortest = std::min(shortest, T[a].norm());
    longest = std::max(longest, T[a].norm());
  }
  q.gap = sum.norm() / largest_area;
  q.aspect = longest / shortest;
  return q;
}

GridQuality measure_quality(const Grid& grid)
{
  using enum Search::For;
  Search gap(Largest), volume(Smallest), jacobian(Smallest), skew(Largest), aspect(Largest), growth(Largest);
  for (Search* search : {&gap, &volume, &jacobian, &skew, &aspect, &growth})
    search->start_at(grid.owned().lo);
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    const Index3 c{i, j, k};
    const CellQuality q = cell_quality(grid, i, j, k);
    gap.look_at(q.gap, c);
    volume.look_at(q.volume, c);
    jacobian.look_at(q.jacobian, c);
    skew.look_at(q.skew, c);
    aspect.look_at(q.aspect, c);
    growth.look_at(volume_growth(grid, c), c);
  });
  return {gap.over_ranks(grid),  volume.over_ranks(grid), jacobian.over_ranks(grid),
          skew.over_ranks(grid), aspect.over_ranks(grid), growth.over_ranks(grid)};
}

void require_sound(const GridQuality& quality)
{
  const auto bad = [](double value) { return !(value > rounding); };
  if (bad(quality.volume.value))
    fail_input(
        "the grid's {} has {} volume ({:.3g} of the product of its edges); nodes must be in order along all three "
        "directions",
        at(quality.volume), quality.volume.value < -rounding ? "negative" : "no", quality.volume.value);
  if (bad(quality.jacobian.value))
    fail_input("the grid's {} is folded: its edges run against its faces (cosine {:.3g}, must be positive)",
               at(quality.jacobian), quality.jacobian.value);
  if (!(quality.gap.value <= rounding))
    fail_input("the faces of the grid's {} leave a gap of {:.3g} of their area; they must close to round-off",
               at(quality.gap), quality.gap.value);
}

std::vector<std::string> quality_warnings(const GridQuality& quality)
{
  std::vector<std::string> warnings;
  if (quality.skew.value > largest_skew)
    warnings.push_back(fmt::format(
        "the grid is skewed: the cosine between faces is {:.3f} in {} (better below {}): the pressure takes "
        "more iterations",
        quality.skew.value, at(quality.skew), largest_skew));
  if (quality.growth.value > largest_volume_growth)
    warnings.push_back(
        fmt::format("the grid grows by {:.2f} from one cell to the next near {} (better below {}): that "
                    "costs accuracy",
                    quality.growth.value, at(quality.growth), largest_volume_growth));
  if (quality.aspect.value > largest_aspect)
    warnings.push_back(fmt::format("the grid has an aspect ratio of {:.0f} in {} (better below {})",
                                   quality.aspect.value, at(quality.aspect), largest_aspect));
  return warnings;
}

void require_periodic_sides(const Grid& grid, const NodeSource& source)
{
  const Decomposition& ranks = grid.ranks();
  for (int a = 0; a < 3; ++a) {
    if (!ranks.periodic(a))
      continue;
    IndexBox low = grid.owned();
    for (int d = 0; d < 3; ++d)
      ++low.hi[d];
    low.lo[a] = 0;
    low.hi[a] = 1;
    IndexBox high = low;
    high.lo[a] = grid.cells()[a];
    high.hi[a] = grid.cells()[a] + 1;
    const std::vector<Vec3> first = source(low);
    const std::vector<Vec3> last = source(high);
    const auto corner = [&](int index) {
      const Index3 node = stepped({0, 0, 0}, a, index);
      return source({node, {node[0] + 1, node[1] + 1, node[2] + 1}}).front();
    };
    const Vec3 period = corner(grid.cells()[a]) - corner(0);
    std::size_t n = 0;
    Search search(Search::For::Largest);
    search.start_at(grid.owned().lo);
    for_each_cell_in_order(low, [&](int i, int j, int k) {
      search.look_at((last[n] - first[n] - period).norm(), {i, j, k});
      ++n;
    });
    // Nodes of the high ends have no cell of their own; only their numbers are told.
    const Worst worst = search.over_ranks(grid);
    constexpr double share = 1e-6;
    if (worst.value > share * grid.smallest_width())
      fail_input(
          "opposite sides along {} are periodic, but the node opposite ({}, {}, {}) lies {:.3g} from where a "
          "translation "
          "by ({:.6g}, {:.6g}, {:.6g}) takes it; sides must be the same but for a translation",
          std::array{"xi", "eta", "zeta"}[a], worst.cell[0], worst.cell[1], worst.cell[2], worst.value, period[0],
          period[1], period[2]);
  }
}

}  // namespace luff::grid
