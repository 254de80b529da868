// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/multigrid.hpp"

#include <algorithm>

#include "poisson/stages.hpp"

namespace luff::poisson {

namespace {

constexpr int sweeps = 2;
constexpr double coarsest_cells = 100;      // dense inverse of at most this size
constexpr double shared_cells = 20000;      // below this, work is repeated on every rank rather than shared out
constexpr double smallest_reduction = 1.4;  // a level must be smaller than the one before by this factor

double product(const Index3& n)
{
  return static_cast<double>(n[0]) * n[1] * n[2];
}

std::array<std::vector<int>, 3> merge_all(const Box& box, double width, bool keep_blocks)
{
  std::array<std::vector<int>, 3> first;
  for (int a = 0; a < 3; ++a)
    first[a] = merge_pairs(box.lines[a], 2.05 * width, keep_blocks);
  return first;
}

/// Merges for the next level: cells grow to about twice `width`, which is raised until enough cells merge.
std::array<std::vector<int>, 3> next_merges(const Box& box, double& width, bool keep_blocks)
{
  double widest = 0.0;
  for (const Line& line : box.lines)
    widest = std::max(widest, *std::max_element(line.h.begin(), line.h.end()));
  auto first = merge_all(box, width, keep_blocks);
  const auto cells = [&] { return (first[0].size() - 1.0) * (first[1].size() - 1.0) * (first[2].size() - 1.0); };
  while (cells() * smallest_reduction > product(box.cells()) && width <= widest) {
    width *= 1.25;
    first = merge_all(box, width, keep_blocks);
  }
  width *= 2.0;
  return first;
}

/// Place of a cell in a list of the cells of a box, i fastest.
std::ptrdiff_t position(const IndexBox& box, const Index3& c)
{
  return (c[0] - box.lo[0]) +
         static_cast<std::ptrdiff_t>(box.extent(0)) *
             ((c[1] - box.lo[1]) + static_cast<std::ptrdiff_t>(box.extent(1)) * (c[2] - box.lo[2]));
}

IndexBox block_of(const Box& fine, const Box& coarse, const IndexBox& owned)
{
  IndexBox block{{0, 0, 0}, coarse.cells()};
  for (int a = 1; a < 3; ++a) {
    const std::vector<int>& splits = fine.lines[a].splits;
    const auto b = std::find(splits.begin(), splits.end(), owned.lo[a]) - splits.begin();
    block.lo[a] = coarse.lines[a].splits[b];
    block.hi[a] = coarse.lines[a].splits[b + 1];
  }
  return block;
}

}  // namespace

Multigrid::Multigrid(const Box& box, const IndexBox& owned, const Neighbourhood& neighbourhood,
                     const StoredCoefficients::Source& source)
    : comm_(neighbourhood.comm)
{
  const bool ranks = neighbourhood.split[1] || neighbourhood.split[2];
  const auto kind = source ? Level::Kind::Stored : Level::Kind::Product;
  levels_.push_back(std::make_unique<Level>(box, owned, ranks ? &neighbourhood : nullptr, kind));
  add_levels(neighbourhood);
  if (source) {
    levels_[0]->coefficients().load(owned, source);
    levels_[0]->coefficients().close(levels_[0]->exchange());
    for (std::size_t l = 0; l < transfers_.size(); ++l)
      coarsen_coefficients(l);
  }
  set_blocked({});
}

void Multigrid::add_levels(const Neighbourhood& neighbourhood)
{
  double width = 1.0;
  while (true) {
    Level& fine = *levels_.back();
    const Box& box = fine.box();
    if (product(box.cells()) <= coarsest_cells && !fine.distributed())
      return;
    const auto first = next_merges(box, width, fine.distributed());
    Box coarse;
    std::array<Merge, 3> merges;
    for (int a = 0; a < 3; ++a) {
      coarse.lines[a] = coarse_line(box.lines[a], first[a]);
      merges[a] = make_merge(box.lines[a], coarse.lines[a], first[a]);
    }
    const double before = product(box.cells());
    const double cells = product(coarse.cells());
    if (cells == before && !fine.distributed())
      return;
    const bool share = fine.distributed() && cells > shared_cells && cells < before;
    const IndexBox block = share ? block_of(box, coarse, fine.layout().owned) : IndexBox{{0, 0, 0}, coarse.cells()};
    const auto kind = stored() ? Level::Kind::Stored : Level::Kind::Product;
    levels_.push_back(std::make_unique<Level>(coarse, block, share ? &neighbourhood : nullptr, kind));
    transfers_.push_back(std::make_unique<Transfer>(fine, *levels_.back(), std::move(merges)));
  }
}

namespace {

/// A coarse coefficient is the sum of the fine ones of its face times fine over coarse distance.
StoredCoefficients::Source sum_of_fine(const StoredCoefficients& fine, const std::array<Merge, 3>& merges)
{
  return [&fine, &merges](int axis, const Index3& C) {
    Index3 lo, hi;
    for (int a = 0; a < 3; ++a) {
      lo[a] = merges[a].first[C[a]];
      hi[a] = a == axis ? lo[a] + 1 : merges[a].first[C[a] + 1];
    }
    double sum = 0.0;
    for (int k = lo[2]; k < hi[2]; ++k)
      for (int j = lo[1]; j < hi[1]; ++j)
        for (int i = lo[0]; i < hi[0]; ++i)
          sum += fine.face(axis, {i, j, k});
    return sum * merges[axis].scale[C[axis]];
  };
}

}  // namespace

/// Level l + 1 from level l, all of it.
void Multigrid::coarsen_coefficients(std::size_t l)
{
  Level& fine = *levels_[l];
  Level& coarse = *levels_[l + 1];
  StoredCoefficients& coefficients = coarse.coefficients();
  const bool gather = fine.distributed() && !coarse.distributed();
  if (gather)
    coefficients.clear();
  const IndexBox own = gather ? block_of(fine.box(), coarse.box(), fine.layout().owned) : coarse.layout().owned;
  coefficients.load(own, sum_of_fine(fine.coefficients(), transfers_[l]->merges()));
  for (int a = 0; a < 3 && gather; ++a)
    fine.sum_over_ranks(coefficients.values(a));
  coefficients.close(coarse.exchange());
}

/// The same where fine coefficients changed; takes the fine faces and returns the coarse ones.
void Multigrid::coarsen_coefficients(std::size_t l, std::vector<FaceIndex>& changed)
{
  const std::array<Merge, 3>& merges = transfers_[l]->merges();
  std::vector<FaceIndex> coarse_faces;
  for (const FaceIndex& f : changed) {
    Index3 C;
    bool on_coarse_face = true;
    for (int a = 0; a < 3; ++a) {
      const int n = static_cast<int>(merges[a].parent.size());
      C[a] = f.cell[a] < n ? merges[a].parent[f.cell[a]] : static_cast<int>(merges[a].first.size()) - 1;
      on_coarse_face = on_coarse_face && (a != f.axis || merges[a].first[C[a]] == f.cell[a]);
    }
    if (on_coarse_face)
      coarse_faces.push_back({f.axis, C});
  }
  std::sort(coarse_faces.begin(), coarse_faces.end());
  coarse_faces.erase(std::unique(coarse_faces.begin(), coarse_faces.end()), coarse_faces.end());
  levels_[l + 1]->coefficients().load(coarse_faces, sum_of_fine(levels_[l]->coefficients(), merges));
  levels_[l + 1]->coefficients().close(levels_[l + 1]->exchange());
  changed = std::move(coarse_faces);
}

void Multigrid::update_coefficients(std::span<const FaceIndex> faces, const StoredCoefficients::Source& source)
{
  levels_[0]->coefficients().load(faces, source);
  levels_[0]->coefficients().close(levels_[0]->exchange());
  std::vector<FaceIndex> changed(faces.begin(), faces.end());
  for (std::size_t l = 0; l < transfers_.size(); ++l)
    if (product(levels_[l + 1]->box().cells()) > shared_cells)
      coarsen_coefficients(l, changed);
    else
      coarsen_coefficients(l);
}

/// Cuts are the same on every rank, and so must be what they read of coefficients that other ranks hold.
void Multigrid::share_cells_near_cuts(std::size_t l)
{
  if (stored() && levels_[l]->distributed())
    levels_[l]->coefficients().share_cells(cells_near_cuts(cuts_[l], levels_[l + 1]->box(), transfers_[l]->merges()),
                                           comm_);
}

void Multigrid::set_blocked(std::span<const FaceIndex> faces)
{
  if (stored() && levels_[0]->distributed())
    levels_[0]->coefficients().share_cells(cells_beside(levels_[0]->box(), faces), comm_);
  cuts_.clear();
  cuts_.push_back(cuts_of_blocked_faces(levels_[0]->box(), faces));
  for (std::size_t l = 0; l < transfers_.size(); ++l) {
    share_cells_near_cuts(l);
    cuts_.push_back(coarsen_cuts(cuts_[l], levels_[l]->box(), levels_[l + 1]->box(), transfers_[l]->merges()));
  }
  for (std::size_t l = 0; l < levels_.size(); ++l)
    levels_[l]->set_cuts(cuts_[l]);
  for (std::size_t l = 0; l < transfers_.size(); ++l)
    transfers_[l]->set_cuts(cuts_[l], cuts_[l + 1]);
  coarsest_.factorise(*levels_.back(), cuts_.back());
}

/// Coarsening only ever joins what is connected, so components of the coarsest level and pockets are those of the
/// fluid.
void Multigrid::label_components(std::vector<int>& component, std::vector<char>& floating) const
{
  component.clear();
  floating = coarsest_.floating();
  int pockets = 0;
  for (const Cuts& cuts : cuts_)
    pockets += cuts.pockets;
  if (floating.size() + pockets <= 1)
    return;
  const Box& coarsest = levels_.back()->box();
  const auto cells = static_cast<std::ptrdiff_t>(product(coarsest.cells()));
  component.assign(coarsest_.component().begin(), coarsest_.component().begin() + cells);
  std::vector<int> extras(coarsest_.component().begin() + cells, coarsest_.component().end());
  for (std::size_t l = transfers_.size(); l-- > 0;) {
    const Box& fine = levels_[l]->box();
    const Box& coarse = levels_[l + 1]->box();
    const IndexBox& home = levels_[l + 1]->layout().owned;
    const auto offset = static_cast<int>(floating.size());
    const auto label_of_parent = [&](Unknown x) {
      const Unknown X = parent(cuts_[l], fine, cuts_[l + 1], coarse, transfers_[l]->merges(), x);
      if (is_pocket(X))
        return offset + static_cast<int>(X - first_pocket);
      if (!is_cell(X))
        return extras[extra_number(X)];
      const Index3 C = coarse.cell(X);
      return home.contains(C) ? component[position(home, C)] : -1;
    };
    std::vector<int> fine_component;
    const IndexBox& owned = levels_[l]->layout().owned;
    for (int k = owned.lo[2]; k < owned.hi[2]; ++k)
      for (int j = owned.lo[1]; j < owned.hi[1]; ++j)
        for (int i = owned.lo[0]; i < owned.hi[0]; ++i)
          fine_component.push_back(label_of_parent(fine.key({i, j, k})));
    std::vector<int> fine_extras;
    for (std::size_t e = 0; e < cuts_[l].extras.size(); ++e)
      fine_extras.push_back(label_of_parent(extra_unknown(static_cast<int>(e))));
    component = std::move(fine_component);
    extras = std::move(fine_extras);
    floating.insert(floating.end(), cuts_[l + 1].pockets, 1);
  }
}

void Multigrid::smooth_from_zero(Level& level)
{
  RowExchange& halo = level.exchange();
  const IndexBox& owned = level.layout().owned;
  const int threads = threads_for(owned);
  const Colours residual = level.residual_colours();
  if (residual == Colours::Both)
    std::fill_n(level.u.data(), level.u.size(), 0.0f);
  level.relax_extras(Level::Order::Forward, /*from_zero=*/true);
  const int stages = 2 * sweeps + (residual == Colours::Both ? 2 : 1);
  const auto stage = [&](int s, int k) {
    if (s == 0)
      level.start_plane(k);
    else if (s < 2 * sweeps)
      level.relax_plane(k, s % 2);
    else
      level.residual_plane(k, s - 2 * sweeps);
  };
  if (halo.within_planes() && level.extras() == 0) {
    run_stages(owned.lo[2], owned.hi[2], stages, threads, stage);
    return;
  }
  for (int s = 0; s < stages; ++s) {
    if (s > 0 && s < 2 * sweeps && s % 2 == 0)
      level.relax_extras(Level::Order::Forward, /*from_zero=*/false);
    run_stages(owned.lo[2], owned.hi[2], 1, threads, [&](int, int k) { stage(s, k); });
    if (s < 2 * sweeps)
      halo.exchange(level.u.data(), s % 2 == 0 ? Colours::Red : Colours::Black);
  }
  level.residual_extras();
}

void Multigrid::smooth(Level& level, Transfer& correction, const PlaneWork& after)
{
  RowExchange& halo = level.exchange();
  const IndexBox& owned = level.layout().owned;
  const int threads = threads_for(owned);
  correction.begin_prolongation();
  const int stages = 2 * sweeps + 1;
  const auto stage = [&](int s, int k) {
    if (s == 0)
      correction.prolong_plane(k);
    else if (s < stages)
      level.relax_plane(k, s % 2);
    else
      after(k);
  };
  if (halo.within_planes() && level.extras() == 0) {
    run_stages(owned.lo[2], owned.hi[2], stages + 1, threads, stage);
    return;
  }
  for (int s = 0; s < stages; ++s) {
    run_stages(owned.lo[2], owned.hi[2], 1, threads, [&](int, int k) { stage(s, k); });
    if (s == 0)
      halo.exchange(level.u.data(), level.residual_colours());
    else
      halo.exchange(level.u.data(), s % 2 == 0 ? Colours::Red : Colours::Black);
    if (s > 0 && s % 2 == 0)
      level.relax_extras(Level::Order::Backward, /*from_zero=*/false);
  }
  run_stages(owned.lo[2], owned.hi[2], 1, threads, [&](int, int k) { after(k); });
}

void Multigrid::solve_coarsest(const PlaneWork& after)
{
  Level& level = *levels_.back();
  coarsest_.solve(level);
  const IndexBox& owned = level.layout().owned;
  for (int k = owned.lo[2]; k < owned.hi[2]; ++k) {
    level.exchange().close_plane(level.u.data(), k, Colours::Both);
    after(k);
  }
  level.exchange().exchange(level.u.data(), Colours::Both);
}

void Multigrid::cycle(std::size_t l, const PlaneWork& after)
{
  if (l + 1 == levels_.size()) {
    solve_coarsest(after);
    return;
  }
  levels_[l]->prepare_threads();
  smooth_from_zero(*levels_[l]);
  transfers_[l]->restrict_residual();
  cycle(l + 1, [](int) {});
  smooth(*levels_[l], *transfers_[l], after);
}

}  // namespace luff::poisson
