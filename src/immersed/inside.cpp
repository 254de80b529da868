// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/inside.hpp"

#include <algorithm>

namespace luff::immersed {

namespace {

enum class State : signed char { Unknown, Outside, Inside };

State state_of(bool inside)
{
  return inside ? State::Inside : State::Outside;
}

/// Whether the first cell of each row lies inside one body, for the rows of all ranks.
class FirstCells {
 public:
  explicit FirstCells(const grid::Grid& grid)
      : grid_(grid), state_(static_cast<std::size_t>(grid.cells()[1]) * grid.cells()[2], State::Unknown)
  {
  }
  [[nodiscard]] State& at(int j, int k) { return state_[j + static_cast<std::size_t>(grid_.cells()[1]) * k]; }

  /// Every rank learns what the others know; rows that nobody knows anything of have no cut link, and are like their
  /// neighbours.
  void complete()
  {
    MPI_Allreduce(MPI_IN_PLACE, state_.data(), static_cast<int>(state_.size()), MPI_SIGNED_CHAR, MPI_MAX,
                  grid_.ranks().comm());
    if (std::find(state_.begin(), state_.end(), State::Inside) != state_.end())
      spread();
  }

 private:
  void spread()
  {
    const Index3& n = grid_.cells();
    std::vector<std::array<int, 2>> front;
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        if (at(j, k) != State::Unknown)
          front.push_back({j, k});
    while (!front.empty()) {
      const auto [j, k] = front.back();
      front.pop_back();
      for (const auto& [dj, dk] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        std::array<int, 2> row{j + dj, k + dk};
        if (!wrap(row[0], 1) || !wrap(row[1], 2) || at(row[0], row[1]) != State::Unknown)
          continue;
        at(row[0], row[1]) = at(j, k);
        front.push_back(row);
      }
    }
  }
  /// False beyond the domain.
  [[nodiscard]] bool wrap(int& i, int axis) const
  {
    const int n = grid_.cells()[axis];
    if (grid_.ranks().periodic(axis))
      i = (i + n) % n;
    return i >= 0 && i < n;
  }

  const grid::Grid& grid_;
  std::vector<State> state_;
};

/// What one body's hits say of the cells of this rank.
class Walk {
 public:
  Walk(const grid::Grid& grid, std::span<const Crossing> crossings, const ClosedSurface& body)
      : grid_(grid), first_(grid)
  {
    for (const Crossing& hit : crossings)
      if (body.holds(hit.triangle))
        (hit.axis == 0 ? along_ : across_).push_back(hit);
  }

  /// Adds the cells inside, row by row.
  template <class Add>
  void run(Add add)
  {
    learn_from_hits_across();
    learn_from_hits_along();
    first_.complete();
    const IndexBox& owned = grid_.owned();
    auto hit = along_.begin();
    for (int k = owned.lo[2]; k < owned.hi[2]; ++k)
      for (int j = owned.lo[1]; j < owned.hi[1]; ++j) {
        int depth = first_.at(j, k) == State::Inside ? 1 : 0;
        while (in_row(hit, j, k) && hit->cell[0] == 0)
          ++hit;  // a periodic row's first face: the first cell's state is known
        for (int i = owned.lo[0]; i < owned.hi[0]; ++i) {
          for (; in_row(hit, j, k) && hit->cell[0] == i; ++hit)
            depth -= hit->side;
          if (depth > 0)
            add(Index3{i, j, k});
        }
        while (in_row(hit, j, k))
          ++hit;
      }
  }

 private:
  using Iterator = std::vector<Crossing>::const_iterator;
  [[nodiscard]] bool in_row(Iterator hit, int j, int k) const
  {
    return hit != along_.end() && hit->cell[1] == j && hit->cell[2] == k;
  }
  /// The cell before a hit lies inside when the hit leaves the body, the one behind it when it enters.  Of several hits
  /// on one link each cell has its own neighbour.
  void learn_from_hits_across()
  {
    for (std::size_t q = 0; q < across_.size(); ++q) {
      const Crossing& hit = across_[q];
      const auto same_link = [&](std::size_t other) {
        return other < across_.size() && across_[other].axis == hit.axis && across_[other].cell == hit.cell;
      };
      if (q == 0 || !same_link(q - 1))
        learn(stepped(hit.cell, hit.axis, -1), hit.side > 0);
      if (!same_link(q + 1))
        learn(hit.cell, hit.side < 0);
    }
  }
  void learn_from_hits_along()
  {
    for (auto hit = along_.begin(); hit != along_.end();) {
      const int j = hit->cell[1];
      const int k = hit->cell[2];
      bool inside = hit->side > 0;
      for (; in_row(hit, j, k) && hit->cell[0] == 0; ++hit)
        inside = hit->side < 0;
      first_.at(j, k) = state_of(inside);
      while (in_row(hit, j, k))
        ++hit;
    }
  }
  /// Of a row that hits along it cross, these know better.
  void learn(const Index3& cell, bool inside)
  {
    if (grid_.owned().contains(cell))
      first_.at(cell[1], cell[2]) = state_of(inside);
  }

  const grid::Grid& grid_;
  FirstCells first_;
  std::vector<Crossing> along_;   // the x axis
  std::vector<Crossing> across_;  // it
};

}  // namespace

std::vector<InsideCell> find_inside(const grid::Grid& grid, std::span<const Crossing> crossings,
                                    std::span<const ClosedSurface> bodies)
{
  std::vector<InsideCell> inside;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    Walk(grid, crossings, bodies[b]).run([&](const Index3& c) { inside.push_back({c, static_cast<int>(b)}); });
  const auto order = [](const InsideCell& a, const InsideCell& b) {
    return std::array{a.cell[2], a.cell[1], a.cell[0], a.body} < std::array{b.cell[2], b.cell[1], b.cell[0], b.body};
  };
  std::sort(inside.begin(), inside.end(), order);
  const auto same = [](const InsideCell& a, const InsideCell& b) { return a.cell == b.cell; };
  inside.erase(std::unique(inside.begin(), inside.end(), same), inside.end());
  return inside;
}

}  // namespace luff::immersed
