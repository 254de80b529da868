// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/multigrid.hpp"

#include <algorithm>

#include "poisson/curvilinear_operator.hpp"
#include "poisson/stages.hpp"

namespace luff::poisson {

namespace {

constexpr double coarsest_cells = 200;      // dense inverse of at most this size
constexpr double shared_cells = 20000;      // below this, work is repeated on every rank rather than shared out
constexpr double smallest_reduction = 1.4;  // a level must be smaller than the one before by this factor

double product(const Index3& n)
{
  return static_cast<double>(n[0]) * n[1] * n[2];
}

constexpr int few_sweeps = 2;

/// Sweeps down and up on a level: small ones cost little, and what they leave costs whole iterations.
int sweeps_on(double cells, double finest_cells)
{
  return cells > finest_cells / 4.0 ? few_sweeps : cells > finest_cells / 32.0 ? 3 : 4;
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
  for (const auto& level : levels_)
    sweeps_.push_back(sweeps_on(product(level->box().cells()), product(box.cells())));
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
  for (std::size_t l = 0; l < cross_terms_.size(); ++l) {
    if (l + 1 < cross_terms_.size())
      coarsen_cross_terms(l);
    correction_[l].resize(levels_[l]->u.size());
  }
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
      return home.contains(C) ? component[home.position(C)] : -1;
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

void Multigrid::smooth_cross_terms(CrossTerms& finest)
{
  coarse_cross_terms_.clear();
  cross_terms_.assign(1, &finest);
  sweeps_.assign(levels_.size(), few_sweeps);  // more gain nothing here
  for (std::size_t l = 1; l + 1 < levels_.size(); ++l) {
    coarse_cross_terms_.push_back(std::make_unique<CrossTerms>(*levels_[l]));
    cross_terms_.push_back(coarse_cross_terms_.back().get());
  }
  correction_.resize(cross_terms_.size());
  for (std::size_t l = 0; l < cross_terms_.size(); ++l)
    levels_[l]->keep_whole_residual();
}

namespace {

/// Mean of fine over coarse distance across the two faces of a coarse cell, of the one that has any beside a wall.
/// (Fine over coarse width would be wrong in cells that stay alone.)
double mean_scale(const Merge& merge, int I)
{
  const double low = merge.scale[I];
  const double high = merge.scale[I + 1];
  return low > 0.0 && high > 0.0 ? 0.5 * (low + high) : std::max(low, high);
}

}  // namespace

/// g_C = sum over children of g s_a s_b; none in cells that blocked faces touch, whose differences across open coarse
/// faces no longer are those that the children's terms were made for.
void Multigrid::coarsen_cross_terms(std::size_t l)
{
  Level& fine = *levels_[l];
  Level& coarse = *levels_[l + 1];
  const CrossTerms& terms = *cross_terms_[l];
  CrossTerms& result = *cross_terms_[l + 1];
  const std::array<Merge, 3>& merges = transfers_[l]->merges();
  const auto sum = [&](int pair, const Index3& C) {
    double total = 0.0;
    for (int k = merges[2].first[C[2]]; k < merges[2].first[C[2] + 1]; ++k)
      for (int j = merges[1].first[C[1]]; j < merges[1].first[C[1] + 1]; ++j)
        for (int i = merges[0].first[C[0]]; i < merges[0].first[C[0] + 1]; ++i)
          total += terms.value(pair, {i, j, k});
    for (const int a : cross_pairs[pair])
      total *= mean_scale(merges[a], C[a]);
    return total;
  };
  const bool gather = fine.distributed() && !coarse.distributed();
  for (int pair = 0; pair < 3 && gather; ++pair)
    std::fill_n(result.values(pair).data(), result.values(pair).size(), 0.0f);
  const IndexBox own = gather ? block_of(fine.box(), coarse.box(), fine.layout().owned) : coarse.layout().owned;
  result.load(own, sum);
  for (const CutCell& cut : cuts_[l + 1].cells)
    for (int pair = 0; pair < 3 && own.contains(cut.cell); ++pair)
      result.values(pair)[coarse.layout().index(cut.cell)] = 0.0f;
  for (int pair = 0; pair < 3 && gather; ++pair)
    fine.sum_over_ranks(result.values(pair));
  result.close();
}

/// Whether sweeps follow each other plane by plane although planes come from beyond this rank's block or a periodic
/// seam; cross terms keep planes that the next one needs, which a wave with gaps would mix up.
bool Multigrid::waves_between_halos(std::size_t l) const
{
  Level& level = *levels_[l];
  return level.exchange().of_planes() && level.extras() == 0 && cross_terms_.empty() &&
         threads_for(level.layout().owned) == 1;
}

/// Whether cells that blocked faces touch are relaxed once more; the same on every rank.  The upward smoothing of cross
/// terms has no counterpart to it.
bool Multigrid::sweeps_beside_cuts(std::size_t l) const
{
  return cross_terms_.empty() && !cuts_[l].cells.empty();
}

namespace {

/// What smoothing does on a plane.  Cut: of the cells that blocked faces touch only.  Extras are relaxed plane by
/// plane, or all at once where planes come from elsewhere.
enum class Stage {
  Prolong,
  Start,
  Red,
  Black,
  CutRed,
  CutBlack,
  EvenExtras,
  OddExtras,
  AllExtras,
  Prepare,
  Residual,
  After
};

void add_extras(std::vector<Stage>& stages, Level& level, Level::Order order)
{
  if (level.extras() == 0)
    return;
  if (!level.exchange().within_planes())
    stages.push_back(Stage::AllExtras);
  else if (order == Level::Order::Forward)
    stages.insert(stages.end(), {Stage::EvenExtras, Stage::OddExtras});
  else
    stages.insert(stages.end(), {Stage::OddExtras, Stage::EvenExtras});
}

std::vector<Stage> stages_down(Level& level, int sweeps, bool beside_cuts, bool cross_terms)
{
  std::vector<Stage> stages{Stage::Start, Stage::Black};
  for (int n = 1; n < sweeps; ++n) {
    add_extras(stages, level, Level::Order::Forward);
    if (n == 1 && beside_cuts) {
      stages.insert(stages.end(), {Stage::CutRed, Stage::CutBlack});
      add_extras(stages, level, Level::Order::Forward);
    }
    stages.insert(stages.end(), {Stage::Red, Stage::Black});
  }
  if (cross_terms)
    stages.push_back(Stage::Prepare);
  stages.push_back(Stage::Residual);
  return stages;
}

std::vector<Stage> stages_up(Level& level, int sweeps, bool beside_cuts)
{
  std::vector<Stage> stages{Stage::Prolong};
  for (int n = 0; n < sweeps; ++n) {
    stages.insert(stages.end(), {Stage::Black, Stage::Red});
    add_extras(stages, level, Level::Order::Backward);
    if (n + 2 == sweeps && beside_cuts) {
      stages.insert(stages.end(), {Stage::CutBlack, Stage::CutRed});
      add_extras(stages, level, Level::Order::Backward);
    }
  }
  stages.push_back(Stage::After);
  return stages;
}

[[nodiscard]] bool relaxes_red(Stage stage)
{
  return stage == Stage::Red || stage == Stage::CutRed;
}

[[nodiscard]] bool relaxes_black(Stage stage)
{
  return stage == Stage::Black || stage == Stage::CutBlack;
}

/// Cells of a colour, or extras where the plane is one of their stage.
void relax(Level& level, Stage stage, int k, Level::Order order)
{
  if (stage == Stage::Red || stage == Stage::Black)
    level.relax_plane(k, stage == Stage::Red ? 0 : 1);
  else if (stage == Stage::CutRed || stage == Stage::CutBlack)
    level.relax_cut_cells_plane(k, stage == Stage::CutRed ? 0 : 1);
  else if ((k & 1) == (stage == Stage::EvenExtras ? 0 : 1))
    level.relax_extras_plane(k, order);
}

/// All stages: in a wave of planes where planes need nothing from elsewhere, in one between the halos where they
/// allow it, else one after the other, each shared before the next.
template <class Work, class Share>
void run_smoothing(Level& level, const std::vector<Stage>& stages, Level::Order order, bool between_halos, int threads,
                   const Work& work, const Share& share)
{
  const IndexBox& owned = level.layout().owned;
  const int count = static_cast<int>(stages.size());
  if (level.exchange().within_planes()) {
    run_stages(owned.lo[2], owned.hi[2], count, threads, work);
    return;
  }
  if (between_halos) {
    run_stages_between_halos(owned.lo[2], owned.hi[2], count, work, share);
    return;
  }
  for (int s = 0; s < count; ++s) {
    if (stages[s] == Stage::AllExtras)
      level.relax_extras(order, /*from_zero=*/false);
    else
      run_stages(owned.lo[2], owned.hi[2], 1, threads, [&](int, int k) { work(s, k); });
    share(s);
  }
}

}  // namespace

void Multigrid::smooth_from_zero(std::size_t l)
{
  Level& level = *levels_[l];
  CrossTerms* const cross = cross_terms_.empty() ? nullptr : cross_terms_[l];
  RowExchange& halo = level.exchange();
  const int threads = threads_for(level.layout().owned);
  const Colours residual = level.residual_colours();
  if (level.colours_clash())
    std::fill_n(level.u.data(), level.u.size(), 0.0f);
  level.relax_extras(Level::Order::Forward, /*from_zero=*/true);
  const auto residual_plane = [&](int k) {
    for (int colour = 0; colour < 2; ++colour)
      if (includes(residual, colour))
        level.residual_plane(k, colour);
    if (cross != nullptr) {
      cross->subtract_plane(k, level.u.data(), level.r.data());
      halo.close_plane(level.r.data(), k, Colours::Both);
    }
  };
  const std::vector<Stage> stages = stages_down(level, sweeps_[l], sweeps_beside_cuts(l), cross != nullptr);
  const auto work = [&](int s, int k) {
    if (stages[s] == Stage::Start)
      level.start_plane(k);
    else if (stages[s] == Stage::Prepare)
      cross->prepare_plane(k, level.u.data());
    else if (stages[s] == Stage::Residual)
      residual_plane(k);
    else
      relax(level, stages[s], k, Level::Order::Forward);
  };
  const auto share = [&](int s) {
    if (s + 1 < static_cast<int>(stages.size()) && stages[s + 1] == Stage::Prepare)
      halo.exchange_with_edges(level.u.data());
    else if (stages[s] == Stage::Start || relaxes_red(stages[s]))
      halo.exchange(level.u.data(), Colours::Red);
    else if (relaxes_black(stages[s]))
      halo.exchange(level.u.data(), Colours::Black);
  };
  if (cross != nullptr)
    cross->keep_all_planes(!halo.within_planes() || threads > 1);
  run_smoothing(level, stages, Level::Order::Forward, waves_between_halos(l), threads, work, share);
  level.residual_extras();
}

void Multigrid::smooth(std::size_t l, const PlaneWork& after)
{
  Level& level = *levels_[l];
  Transfer& correction = *transfers_[l];
  RowExchange& halo = level.exchange();
  const int threads = threads_for(level.layout().owned);
  correction.begin_prolongation();
  const std::vector<Stage> stages = stages_up(level, sweeps_[l], sweeps_beside_cuts(l));
  const auto work = [&](int s, int k) {
    if (stages[s] == Stage::Prolong)
      correction.prolong_plane(k);
    else if (stages[s] == Stage::After)
      after(k);
    else
      relax(level, stages[s], k, Level::Order::Backward);
  };
  const auto share = [&](int s) {
    if (stages[s] == Stage::Prolong)
      halo.exchange(level.u.data(), level.residual_colours());
    else if (relaxes_red(stages[s]))
      halo.exchange(level.u.data(), Colours::Red);
    else if (relaxes_black(stages[s]))
      halo.exchange(level.u.data(), Colours::Black);
  };
  run_smoothing(level, stages, Level::Order::Backward, waves_between_halos(l), threads, work, share);
}

/// u += P u_coarse, r = f - A u with all terms, then u += S^T r: the transpose of smooth_from_zero(), whose sweeps S
/// know of the 7-point part alone.
void Multigrid::smooth_with_cross_terms(std::size_t l, const PlaneWork& after)
{
  Level& level = *levels_[l];
  CrossTerms& cross = *cross_terms_[l];
  Values& e = correction_[l];
  RowExchange& halo = level.exchange();
  const IndexBox& owned = level.layout().owned;
  const int threads = threads_for(owned);
  transfers_[l]->begin_prolongation();
  const auto add = [&](int k) {
    for (int j = owned.lo[1]; j < owned.hi[1]; ++j)
      for (int colour = 0; colour < 2; ++colour) {
        const std::ptrdiff_t start = level.layout().start(j, k, colour);
        const int m = level.layout().count(Layout::parity(j, k, colour));
        float* __restrict u = level.u.data() + start;
        const float* __restrict own = e.data() + start;
#pragma omp simd
        for (int n = 0; n < m; ++n)
          u[n] += own[n];
      }
    halo.close_plane(level.u.data(), k, Colours::Both);
    after(k);
  };
  constexpr int first_sweep = 3;
  const int last = first_sweep + 2 * sweeps_[l];
  const auto stage = [&](int s, int k) {
    if (s == 0) {
      transfers_[l]->prolong_plane(k);
    } else if (s == 1) {
      cross.prepare_plane(k, level.u.data());
    } else if (s == 2) {
      level.residual_plane(k, 0);
      level.residual_plane(k, 1);
      cross.subtract_plane(k, level.u.data(), level.r.data());
    } else if (s == first_sweep) {
      level.start_plane(k, 1, e, level.r);
    } else if (s < last) {
      level.relax_plane(k, (s - first_sweep + 1) % 2, e, level.r);
    } else {
      add(k);
    }
  };
  if (level.colours_clash())
    std::fill_n(e.data(), e.size(), 0.0f);
  std::fill_n(e.data() + level.layout().size, level.extras(), 0.0f);
  const bool wave = halo.within_planes() && level.extras() == 0;
  cross.keep_all_planes(!wave || threads > 1);
  if (wave) {
    run_stages(owned.lo[2], owned.hi[2], last + 1, threads, stage);
    return;
  }
  for (int s = 0; s < last; ++s) {
    run_stages(owned.lo[2], owned.hi[2], 1, threads, [&](int, int k) { stage(s, k); });
    if (s == 0)
      halo.exchange_with_edges(level.u.data());
    if (s == 2)
      level.residual_extras();
    if (s < first_sweep)
      continue;
    const int sweep = s - first_sweep;
    halo.exchange(e.data(), sweep % 2 == 0 ? Colours::Black : Colours::Red);
    if (sweep % 2 == 1)
      level.relax_extras(Level::Order::Backward, /*from_zero=*/false, e, level.r);
  }
  for (int x = 0; x < level.extras(); ++x)
    level.u[level.layout().size + x] += e[level.layout().size + x];
  run_stages(owned.lo[2], owned.hi[2], 1, threads, [&](int, int k) { stage(last, k); });
  halo.exchange(level.u.data(), Colours::Both);
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
  smooth_from_zero(l);
  transfers_[l]->restrict_residual();
  cycle(l + 1, [](int) {});
  if (cross_terms_.empty())
    smooth(l, after);
  else
    smooth_with_cross_terms(l, after);
}

}  // namespace luff::poisson
