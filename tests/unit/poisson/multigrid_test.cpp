// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/multigrid.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "poisson/conjugate_gradients.hpp"

namespace luff::poisson {
namespace {

struct Problem {
  Index3 cells;
  double growth = 1.0;  ///< of widths along each axis
  char sides = 'N';     ///< all: Neumann, Dirichlet below x, Periodic
  double closed = 0.0;  ///< fraction of faces blocked at random

  [[nodiscard]] Box box() const
  {
    Box box;
    for (int a = 0; a < 3; ++a) {
      std::vector<double> h(cells[a]);
      double width = 1.0;
      for (double& value : h) {
        value = width;
        width *= growth;
      }
      const SideCondition low = sides == 'D' && a == 0 ? SideCondition::Dirichlet : SideCondition::Neumann;
      box.lines[a] = make_line(std::move(h), sides == 'P', {low, SideCondition::Neumann}, {0, cells[a]});
    }
    return box;
  }
  [[nodiscard]] std::vector<FaceIndex> blocked() const
  {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<FaceIndex> faces;
    for (int a = 0; a < 3; ++a)
      for (int k = 0; k < cells[2]; ++k)
        for (int j = 0; j < cells[1]; ++j)
          for (int i = 0; i < cells[0]; ++i)
            if (const Index3 c{i, j, k}; (c[a] > 0 || sides == 'P') && uniform(random) < closed)
              faces.push_back({a, c});
    return faces;
  }
};

std::vector<Problem> problems()
{
  return {{{12, 11, 13}},
          {{12, 11, 13}, 1.2},
          {{9, 15, 14}, 1.1, 'D', 0.1},
          {{9, 15, 14}, 1.0, 'P', 0.1},
          {{12, 11, 13}, 1.0, 'N', 0.3},
          {{14, 12, 10}, 1.15, 'N', 0.4},
          {{30, 1, 16}, 1.0, 'N', 0.1}};
}

template <class Visit>
void for_unknowns(const Level& level, Visit visit)
{
  const auto [nx, ny, nz] = level.box().cells();
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        visit(level.layout().index(i, j, k), (i + j + k) & 1, level.box().key({i, j, k}));
  for (int e = 0; e < level.extras(); ++e)
    visit(level.layout().size + e, 0, extra_unknown(e));
}

/// All levels of a problem.
struct OnOneRank {
  explicit OnOneRank(const Problem& problem)
      : box(problem.box()), multigrid(box, {{0, 0, 0}, box.cells()}, neighbourhood)
  {
    multigrid.set_blocked(problem.blocked());
  }

  Box box;
  Neighbourhood neighbourhood{.comm = MPI_COMM_SELF};
  Multigrid multigrid;
};

/// Two neighbouring levels and what lies between.
struct Pair {
  explicit Pair(const Problem& problem) : fine_box(problem.box())
  {
    for (int a = 0; a < 3; ++a) {
      const auto first = merge_pairs(fine_box.lines[a], 2.05, /*keep_blocks=*/false);
      coarse_box.lines[a] = coarse_line(fine_box.lines[a], first);
      merges[a] = make_merge(fine_box.lines[a], coarse_box.lines[a], first);
    }
    fine_cuts = cuts_of_blocked_faces(fine_box, problem.blocked());
    coarse_cuts = coarsen_cuts(fine_cuts, fine_box, coarse_box, merges);
    fine = std::make_unique<Level>(fine_box, IndexBox{{0, 0, 0}, fine_box.cells()}, nullptr);
    coarse = std::make_unique<Level>(coarse_box, IndexBox{{0, 0, 0}, coarse_box.cells()}, nullptr);
    fine->set_cuts(fine_cuts);
    coarse->set_cuts(coarse_cuts);
    transfer = std::make_unique<Transfer>(*fine, *coarse, merges);
    transfer->set_cuts(fine_cuts, coarse_cuts);
  }
  void prolong()
  {
    std::fill_n(fine->u.data(), fine->u.size(), 0.0f);
    for (int k = 0; k < coarse_box.cells()[2]; ++k)
      coarse->exchange().close_plane(coarse->u.data(), k, Colours::Both);
    coarse->exchange().exchange(coarse->u.data(), Colours::Both);
    transfer->begin_prolongation();
    for (int k = 0; k < fine_box.cells()[2]; ++k)
      transfer->prolong_plane(k);
  }
  [[nodiscard]] bool interpolated(int colour, Unknown x) const
  {
    return !is_cell(x) || includes(fine->residual_colours(), colour);
  }
  Box fine_box, coarse_box;
  std::array<Merge, 3> merges;
  Cuts fine_cuts, coarse_cuts;
  std::unique_ptr<Level> fine, coarse;
  std::unique_ptr<Transfer> transfer;
};

TEST(Layout, EndsRowsInWholeVectorsThatReachNoCellOfTheNext)
{
  for (int n = 1; n <= 40; ++n) {
    const Layout layout(IndexBox{{0, 0, 0}, {n, 2, 2}});
    for (int colour = 0; colour < 2; ++colour) {
      const std::ptrdiff_t start = layout.start(0, 0, colour);
      const std::ptrdiff_t before_next_row = layout.start(1, 0, colour) - 1;  // cell -1 where there is one
      for (int parity = 0; parity < 2; ++parity) {
        EXPECT_LE(start + Layout::whole_vectors(layout.count(parity)), before_next_row) << n;
        EXPECT_LT(start + layout.count(parity), before_next_row) << n;
      }
      EXPECT_EQ(start % Layout::vector, 0) << n;
    }
  }
}

TEST(Transfer, ProlongsAConstantExactlyAndNothingIntoClosedPockets)
{
  for (const Problem& problem : problems()) {
    if (problem.sides == 'D')
      continue;  // there p = 0 on a side, and a constant is no null vector
    Pair levels(problem);
    for_unknowns(*levels.coarse, [&](std::ptrdiff_t q, int, Unknown) { levels.coarse->u[q] = 1.0f; });
    levels.prolong();
    for_unknowns(*levels.fine, [&](std::ptrdiff_t q, int colour, Unknown x) {
      const bool pocket =
          is_pocket(parent(levels.fine_cuts, levels.fine_box, levels.coarse_cuts, levels.coarse_box, levels.merges, x));
      if (levels.interpolated(colour, x)) {
        EXPECT_NEAR(levels.fine->u[q], pocket ? 0.0 : 1.0, 1e-6) << x;
      }
    });
  }
}

TEST(Transfer, RestrictsByTheTransposeOfItsProlongation)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-0.5f, 0.5f);
  for (const Problem& problem : problems()) {
    Pair levels(problem);
    Level& fine = *levels.fine;
    Level& coarse = *levels.coarse;
    for_unknowns(coarse, [&](std::ptrdiff_t q, int, Unknown) { coarse.u[q] = uniform(random); });
    levels.prolong();
    for_unknowns(fine, [&](std::ptrdiff_t q, int colour, Unknown x) {
      fine.r[q] = levels.interpolated(colour, x) ? uniform(random) : 0.0f;
    });
    for (int k = 0; k < levels.fine_box.cells()[2]; ++k)
      fine.exchange().close_plane(fine.r.data(), k, Colours::Both);
    double Px_y = 0.0;
    double size = 0.0;
    for_unknowns(fine, [&](std::ptrdiff_t q, int, Unknown) {
      Px_y += static_cast<double>(fine.u[q]) * fine.r[q];
      size += std::abs(static_cast<double>(fine.u[q]) * fine.r[q]);
    });
    levels.transfer->restrict_residual();
    double x_Ry = 0.0;
    for_unknowns(coarse,
                 [&](std::ptrdiff_t q, int, Unknown) { x_Ry += static_cast<double>(coarse.u[q]) * coarse.f[q]; });
    EXPECT_NEAR(Px_y, x_Ry, 1e-6 * size);
  }
}

TEST(Cuts, AreTheSameFromBothEndsOfEveryLink)
{
  for (const Problem& problem : problems()) {
    const Pair levels(problem);
    const Box& box = levels.coarse_box;
    const Cuts& cuts = levels.coarse_cuts;
    const auto coefficient = [&](const Index3& c, int side) {
      const CutCell* cut = cuts.at(box.key(c));
      return cut != nullptr ? cut->coefficient[side] : box.coefficient(c, side);
    };
    for_unknowns(*levels.coarse, [&](std::ptrdiff_t, int, Unknown x) {
      Index3 other;
      for (int side = 0; is_cell(x) && side < 6; ++side)
        if (box.neighbour(box.cell(x), side, other)) {
          EXPECT_NEAR(coefficient(box.cell(x), side), coefficient(other, side ^ 1), 1e-12);
        }
    });
    for (const Link& link : cuts.links) {
      if (link.to == outside)
        continue;
      double back = 0.0;
      const int opposite = link.side == within ? within : link.side ^ 1;
      for (const Link& other :
           is_cell(link.to) ? cuts.links_from(cuts.at(link.to)->links) : cuts.links_from_extra(extra_number(link.to)))
        if (other.to == link.from && other.side == opposite)
          back = other.coefficient;
      EXPECT_NEAR(link.coefficient, back, 1e-12);
    }
  }
}

TEST(Multigrid, IsASymmetricOperator)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  for (const Problem& problem : problems()) {
    OnOneRank alone(problem);
    Multigrid& multigrid = alone.multigrid;
    Level& level = multigrid.finest();
    std::vector<int> component;
    std::vector<char> floating;
    multigrid.label_components(component, floating);
    // Right-hand sides of the singular operator have zero mean on every floating component.
    const auto vector = [&] {
      const auto [nx, ny, nz] = alone.box.cells();
      std::vector<double> x(static_cast<std::size_t>(nx) * ny * nz);
      std::vector<double> sum(floating.size(), 0.0), count(floating.size(), 0.0);
      const auto label = [&](std::size_t q) { return component.empty() ? 0 : component[q]; };
      for (std::size_t q = 0; q < x.size(); ++q) {
        x[q] = uniform(random);
        sum[label(q)] += x[q];
        count[label(q)] += 1.0;
      }
      for (std::size_t q = 0; q < x.size(); ++q)
        x[q] -= floating[label(q)] != 0 ? sum[label(q)] / count[label(q)] : 0.0;
      return x;
    };
    const auto apply = [&](const std::vector<double>& x) {
      std::size_t n = 0;
      for_unknowns(level, [&](std::ptrdiff_t q, int, Unknown) { level.f[q] = static_cast<float>(x[n++]); });
      multigrid.cycle();
      std::vector<double> y;
      for_unknowns(level, [&](std::ptrdiff_t q, int, Unknown) { y.push_back(level.u[q]); });
      return y;
    };
    const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
      double sum = 0.0;
      for (std::size_t q = 0; q < a.size(); ++q)
        sum += a[q] * b[q];
      return sum;
    };
    const std::vector<double> x = vector();
    const std::vector<double> y = vector();
    const std::vector<double> Mx = apply(x);
    const std::vector<double> My = apply(y);
    EXPECT_NEAR(dot(Mx, y), dot(x, My), 2e-6 * std::sqrt(dot(Mx, Mx) * dot(y, y)));
    EXPECT_GT(dot(Mx, x), 0.0);
  }
}

// A step that fails is repeated with half its length, by the same solver.
TEST(ConjugateGradients, KeepNothingOfASolveThatMetNoNumber)
{
  for (const Problem& problem : problems()) {
    OnOneRank alone(problem);
    Multigrid& multigrid = alone.multigrid;
    Level& level = multigrid.finest();
    ConjugateGradients solver(multigrid, nullptr, MPI_COMM_SELF);
    const auto solve = [&](float disturbance) {
      float sign = 1.0f;
      for_unknowns(level, [&](std::ptrdiff_t q, int, Unknown) { level.f[q] = (sign = -sign); });
      level.f[level.layout().index(0, 0, 0)] += disturbance;
      const auto result = solver.solve(1e-3, 3);
      std::vector<float> solution;
      for_unknowns(level, [&](std::ptrdiff_t q, int, Unknown) { solution.push_back(solver.solution()[q]); });
      return std::pair(result.finite, solution);
    };
    const auto before = solve(0.0f);
    EXPECT_TRUE(before.first);
    EXPECT_FALSE(solve(std::numeric_limits<float>::quiet_NaN()).first);
    EXPECT_EQ(solve(0.0f), before);
  }
}

TEST(Multigrid, LabelsTheComponentsThatFloodingFinds)
{
  for (const double closed : {0.3, 0.45, 0.6, 0.75}) {
    const Problem problem{{14, 13, 12}, 1.1, 'N', closed};
    OnOneRank alone(problem);
    const Box& box = alone.box;
    Multigrid& multigrid = alone.multigrid;
    std::vector<int> component;
    std::vector<char> floating;
    multigrid.label_components(component, floating);
    ASSERT_FALSE(component.empty());
    const auto [nx, ny, nz] = box.cells();
    std::vector<int> flood(component.size(), -1);
    int components = 0;
    const Cuts& cuts = multigrid.finest_cuts();
    std::vector<int> label_of_flood;
    for (int start = 0; start < nx * ny * nz; ++start) {
      if (flood[start] >= 0)
        continue;
      std::vector<int> front{start};
      flood[start] = components++;
      label_of_flood.push_back(component[start]);
      while (!front.empty()) {
        const Index3 c = box.cell(front.back());
        front.pop_back();
        EXPECT_EQ(component[box.key(c)], label_of_flood.back());
        const CutCell* cut = cuts.at(box.key(c));
        for (int side = 0; side < 6; ++side) {
          Index3 other;
          const double open = cut != nullptr ? cut->coefficient[side] : box.coefficient(c, side);
          if (open > 0.0 && box.neighbour(c, side, other) && flood[box.key(other)] < 0) {
            flood[box.key(other)] = components - 1;
            front.push_back(static_cast<int>(box.key(other)));
          }
        }
      }
    }
    std::sort(label_of_flood.begin(), label_of_flood.end());
    EXPECT_EQ(std::unique(label_of_flood.begin(), label_of_flood.end()), label_of_flood.end()) << closed;
    EXPECT_GT(components, 1);
  }
}

}  // namespace
}  // namespace luff::poisson
