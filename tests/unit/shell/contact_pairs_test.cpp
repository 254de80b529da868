// SPDX-License-Identifier: BSD-3-Clause
// Pairs of surface pieces: distances, barrier energy and its derivatives, safe moves.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <vector>

#include "shell/contact/advancement.hpp"
#include "shell/contact/barrier.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

constexpr PairKind both_kinds[] = {PairKind::PointTriangle, PairKind::EdgeEdge};

Corners random_corners(unsigned seed)
{
  const Eigen::VectorXd r = test::random_vector(12, seed);
  return {r.segment<3>(0), r.segment<3>(3), r.segment<3>(6), r.segment<3>(9)};
}

Corners scaled(const Corners& x, double by)
{
  return {by * x[0], by * x[1], by * x[2], by * x[3]};
}

/// Points of the first and the second piece on a grid of n steps.
struct Samples {
  std::vector<Vec3> first, second;
};

Samples samples(PairKind kind, const Corners& x, int n)
{
  Samples s;
  for (int i = 0; i <= n; ++i) {
    const double u = static_cast<double>(i) / n;
    if (kind == PairKind::EdgeEdge) {
      s.first.push_back(x[0] + u * (x[1] - x[0]));
      s.second.push_back(x[2] + u * (x[3] - x[2]));
      continue;
    }
    for (int j = 0; i + j <= n; ++j)
      s.second.push_back(x[1] + u * (x[2] - x[1]) + static_cast<double>(j) / n * (x[3] - x[1]));
  }
  if (kind == PairKind::PointTriangle)
    s.first.push_back(x[0]);
  return s;
}

double sampled_distance(PairKind kind, const Corners& x, int n)
{
  const Samples s = samples(kind, x, n);
  double least = 1e300;
  for (const Vec3& p : s.first)
    for (const Vec3& q : s.second)
      least = std::min(least, (p - q).norm());
  return least;
}

void expect_closest(PairKind kind, const Corners& x)
{
  constexpr int n = 40;
  const Closest c = closest(kind, x);
  Vec3 between = Vec3::Zero();
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    EXPECT_GE(std::abs(c.weight[k]), 0);
    EXPECT_LE(std::abs(c.weight[k]), 1);
    between += c.weight[k] * x[k];
    sum += c.weight[k];
  }
  EXPECT_NEAR(sum, 0, 1e-15);
  EXPECT_NEAR((between - c.distance * c.normal).norm(), 0, 1e-14);
  const double sampled = sampled_distance(kind, x, n);
  EXPECT_LE(c.distance, sampled + 1e-14);
  EXPECT_GE(c.distance, sampled - 4.0 / n) << "a sample is never farther than this from the closest point";
}

TEST(ClosestPoints, NoSampledPairOfPointsIsCloserAndTheWeightsGiveTheDistance)
{
  for (const PairKind kind : both_kinds)
    for (unsigned seed = 1; seed <= 200; ++seed)
      expect_closest(kind, random_corners(seed));
}

TEST(ClosestPoints, ParallelCollinearAndVanishingEdgesHaveTheirDistance)
{
  const auto distance = [](const Corners& x) { return edge_edge(x).distance; };
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_DOUBLE_EQ(distance({o, x, y, x + y}), 1) << "parallel, side by side";
  EXPECT_DOUBLE_EQ(distance({o, x, x + y, y}), 1) << "parallel, one turned";
  EXPECT_DOUBLE_EQ(distance({o, x, 2 * x, 3 * x}), 1) << "on one line";
  EXPECT_DOUBLE_EQ(distance({o, x, 0.5 * x, 3 * x}), 0) << "on one line, overlapping";
  EXPECT_DOUBLE_EQ(distance({o, x, 2 * x + y, 3 * x + y}), std::numbers::sqrt2) << "parallel, apart";
  EXPECT_DOUBLE_EQ(distance({o, o, z, z + x}), 1) << "one without length";
  EXPECT_DOUBLE_EQ(distance({o, o, z, z}), 1) << "both without length";
  EXPECT_NEAR(distance({o, x, Vec3(0, 1e-3, 0), Vec3(1, 1e-3, 1e-12)}), 1e-3, 1e-15) << "parallel to 1e-12";
}

TEST(ClosestPoints, ATriangleWithoutAreaCountsAsItsEdges)
{
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0);
  EXPECT_DOUBLE_EQ(point_triangle({0.5 * x + y, o, x, 2 * x}).distance, 1);
  EXPECT_DOUBLE_EQ(point_triangle({y, o, o, o}).distance, 1);
}

TEST(ClosestPoints, ScalingByAPowerOfTwoChangesNoWeight)
{
  for (const PairKind kind : both_kinds)
    for (unsigned seed = 1; seed <= 20; ++seed)
      for (const double by : {0x1p-60, 0x1p60}) {
        const Closest a = closest(kind, random_corners(seed)), b = closest(kind, scaled(random_corners(seed), by));
        EXPECT_EQ(a.weight, b.weight);
        EXPECT_EQ(a.distance * by, b.distance);
      }
}

TEST(Barrier, SlopeAndCurvatureAreDerivativesAndVanishAtTheReach)
{
  constexpr double reach = 0.3, stiffness = 7, step = 1e-6;
  for (const double d : {0.01, 0.1, 0.2, 0.29}) {
    const BarrierValue low = barrier(d - step, reach, stiffness), high = barrier(d + step, reach, stiffness);
    const BarrierValue b = barrier(d, reach, stiffness);
    EXPECT_NEAR((high.energy - low.energy) / (2 * step), b.slope, 1e-6 * std::abs(b.slope) + 1e-9);
    EXPECT_NEAR((high.slope - low.slope) / (2 * step), b.curvature, 1e-6 * b.curvature + 1e-7);
    EXPECT_LT(b.slope, 0);
    EXPECT_GT(b.curvature, 0);
  }
  const BarrierValue at_reach = barrier(reach * (1 - 1e-8), reach, stiffness);
  EXPECT_LT(std::abs(at_reach.energy) + std::abs(at_reach.slope) + std::abs(at_reach.curvature), 1e-5);
  EXPECT_NEAR(barrier(0.534 * reach, reach, stiffness).slope, -stiffness, 0.02 * stiffness);
}

ContactPair pair_of(PairKind kind, const Corners& x, double reach)
{
  const double lengths = (x[1] - x[0]).squaredNorm() * (x[3] - x[2]).squaredNorm();
  return {{0, 1, 2, 3}, kind, 0.7, reach, 0.05 * lengths};
}

double gradient_error(const ContactPair& pair, const Corners& x)
{
  constexpr double stiffness = 3, step = 1e-6;
  const PairGradient exact = pair_gradient(pair, x, stiffness);
  PairGradient differences;
  for (int i = 0; i < 12; ++i) {
    Corners low = x, high = x;
    low[i / 3][i % 3] -= step;
    high[i / 3][i % 3] += step;
    differences[i] = (pair_energy(pair, high, stiffness) - pair_energy(pair, low, stiffness)) / (2 * step);
  }
  return (differences - exact).norm() / exact.norm();
}

TEST(ContactPairEnergy, GradientIsThatOfTheEnergyWhereverTheClosestPointsAre)
{
  int corner = 0, inside = 0;
  for (const PairKind kind : both_kinds)
    for (unsigned seed = 1; seed <= 200; ++seed) {
      const Corners x = random_corners(seed);
      const Closest c = closest(kind, x);
      if (c.distance < 0.05)
        continue;
      int zero = 0;
      for (const double w : c.weight)
        zero += w == 0 ? 1 : 0;
      corner += zero == 2 ? 1 : 0;
      inside += zero == 0 ? 1 : 0;
      EXPECT_LT(gradient_error(pair_of(kind, x, 2 * c.distance), x), 1e-6) << "seed " << seed;
    }
  EXPECT_GT(corner, 20);
  EXPECT_GT(inside, 20);
}

TEST(ContactPairEnergy, GradientOfNearlyParallelEdgesIncludesTheMollifier)
{
  for (const double angle : {0.02, 0.1, 0.2}) {
    const Corners x{Vec3(0, 0, 0), Vec3(1, 0.1, 0), Vec3(-0.1, 0.1 * angle, 0.3),
                    Vec3(1.1, 0.11 + 1.1 * angle, 0.3 + 0.2 * angle)};
    const ContactPair pair = pair_of(PairKind::EdgeEdge, x, 0.6);
    ASSERT_LT((x[1] - x[0]).cross(x[3] - x[2]).squaredNorm(), pair.parallel);
    EXPECT_LT(gradient_error(pair, x), 1e-6);
    ContactPair plain = pair;
    plain.parallel = 1e-12;
    EXPECT_GT((pair_gradient(pair, x, 3) - pair_gradient(plain, x, 3)).norm(),
              0.05 * pair_gradient(plain, x, 3).norm());
  }
}

TEST(ContactPairEnergy, OfParallelEdgesIsZero)
{
  const Corners x{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0.1, 0), Vec3(1, 0.1, 0)};
  EXPECT_EQ(pair_energy(pair_of(PairKind::EdgeEdge, x, 0.3), x, 3), 0);
  EXPECT_EQ(pair_gradient(pair_of(PairKind::EdgeEdge, x, 0.3), x, 3).norm(), 0);
}

TEST(ContactPairEnergy, HasNoNetForceNorMoment)
{
  for (const PairKind kind : both_kinds)
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const Corners x = random_corners(seed);
      const PairGradient g = pair_gradient(pair_of(kind, x, 3), x, 1);
      Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
      for (int k = 0; k < 4; ++k) {
        force += g.segment<3>(3 * k);
        moment += x[k].cross(g.segment<3>(3 * k));
      }
      EXPECT_LT(force.norm(), 1e-13 * g.norm());
      EXPECT_LT(moment.norm(), 1e-12 * g.norm());
    }
}

/// Largest error of the exact Hessian against differences of the gradient, relative.
double hessian_error(const ContactPair& pair, const Corners& x)
{
  constexpr double stiffness = 3, step = 1e-6;
  const PairHessian exact = exact_pair_hessian(pair, x, stiffness);
  PairHessian differences;
  for (int i = 0; i < 12; ++i) {
    Corners low = x, high = x;
    low[i / 3][i % 3] -= step;
    high[i / 3][i % 3] += step;
    differences.col(i) = (pair_gradient(pair, high, stiffness) - pair_gradient(pair, low, stiffness)) / (2 * step);
  }
  return (differences - exact).norm() / exact.norm();
}

TEST(ExactContactPairHessian, IsTheDerivativeOfTheGradientWhereverTheClosestPointsAre)
{
  int free_ends[3] = {};  // pairs of which none, one or two weights are at a bound
  for (const PairKind kind : both_kinds)
    for (unsigned seed = 1; seed <= 200; ++seed) {
      const Corners x = random_corners(seed);
      const Closest c = closest(kind, x);
      double least = 1;  // of the weights that aren't zero: differences must not take it to its bound
      int zero = 0;
      for (const double w : c.weight) {
        zero += w == 0 ? 1 : 0;
        least = w == 0 ? least : std::min(least, std::abs(w));
      }
      if (c.distance < 0.05 || least < 1e-3)
        continue;
      ++free_ends[zero];
      EXPECT_LT(hessian_error(pair_of(kind, x, 2 * c.distance), x), 1e-5) << "seed " << seed;
    }
  for (const int n : free_ends)
    EXPECT_GT(n, 20);
}

TEST(ExactContactPairHessian, IncludesTheMollifierOfNearlyParallelEdges)
{
  for (const double angle : {0.02, 0.1, 0.2}) {
    const Corners x{Vec3(0, 0, 0), Vec3(1, 0.1, 0), Vec3(-0.1, 0.1 * angle, 0.3),
                    Vec3(1.1, 0.11 + 1.1 * angle, 0.3 + 0.2 * angle)};
    const ContactPair pair = pair_of(PairKind::EdgeEdge, x, 0.6);
    ASSERT_LT((x[1] - x[0]).cross(x[3] - x[2]).squaredNorm(), pair.parallel);
    EXPECT_LT(hessian_error(pair, x), 1e-5) << angle;
  }
}

TEST(ContactPairHessian, IsSymmetricAndPositiveSemiDefinite)
{
  for (const PairKind kind : both_kinds)
    for (unsigned seed = 1; seed <= 50; ++seed) {
      const Corners x = random_corners(seed);
      const PairHessian H = pair_hessian(pair_of(kind, x, 3), x, 1);
      EXPECT_LT((H - H.transpose()).norm(), 1e-14 * H.norm());
      const Eigen::SelfAdjointEigenSolver<PairHessian> eigen(H);
      EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-13 * eigen.eigenvalues().maxCoeff());
    }
}

TEST(ContactPairHessian, IsThatOfTheEnergyAlongTheNormal)
{
  for (const PairKind kind : both_kinds)
    for (unsigned seed = 1; seed <= 50; ++seed) {
      const Corners x = random_corners(seed);
      const Closest c = closest(kind, x);
      if (c.distance < 0.05)
        continue;
      const ContactPair pair = pair_of(kind, x, 2 * c.distance);
      Eigen::Matrix<double, 12, 1> along = Eigen::Matrix<double, 12, 1>::Zero();  // only the first piece moves
      for (int k = 0; k < (kind == PairKind::PointTriangle ? 1 : 2); ++k)
        along.segment<3>(3 * k) = c.normal;
      constexpr double step = 1e-5;
      Corners low = x, high = x;
      for (int k = 0; k < 4; ++k) {
        low[k] -= step * along.segment<3>(3 * k);
        high[k] += step * along.segment<3>(3 * k);
      }
      const double differences = along.dot(pair_gradient(pair, high, 1) - pair_gradient(pair, low, 1)) / (2 * step);
      EXPECT_NEAR(along.dot(pair_hessian(pair, x, 1) * along), differences, 1e-6 * std::abs(differences));
    }
}

/// Least distance on the way, sampled.
double least_distance(PairKind kind, const Corners& x, const Corners& dx, double fraction)
{
  double least = 1e300;
  for (int n = 0; n <= 200; ++n) {
    Corners y;
    for (int k = 0; k < 4; ++k)
      y[k] = x[k] + n / 200.0 * fraction * dx[k];
    least = std::min(least, closest(kind, y).distance);
  }
  return least;
}

TEST(SafeFraction, LeavesHalfTheDistanceOnTheWholeWayForAnyMotion)
{
  int stopped = 0;
  for (const PairKind kind : both_kinds)
    for (unsigned seed = 1; seed <= 500; ++seed) {
      const Corners x = random_corners(seed), dx = scaled(random_corners(seed + 1000), 5);
      const double fraction = safe_fraction(kind, x, dx, 0.5);
      EXPECT_GT(fraction, 0);
      EXPECT_GE(least_distance(kind, x, dx, fraction), 0.5 * closest(kind, x).distance * (1 - 1e-12));
      stopped += fraction < 1 ? 1 : 0;
    }
  EXPECT_GT(stopped, 100);
}

TEST(SafeFraction, OfAPointShotThroughATriangleStopsItBefore)
{
  const Corners x{Vec3(0.2, 0.2, 1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const Corners dx{Vec3(0, 0, -1e6), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  const double fraction = safe_fraction(PairKind::PointTriangle, x, dx, 0.5);
  EXPECT_NEAR(1e6 * fraction, 0.5, 0.0051) << "half of the way to the triangle, to a hundredth";
  EXPECT_LE(1e6 * fraction, 0.5);
}

TEST(SafeFraction, OfEdgesThatCrossInFlightStopsThemBefore)
{
  const Corners x{Vec3(-1, 0, 0.5), Vec3(1, 0, 0.5), Vec3(0, -1, 0), Vec3(0, 1, 0)};
  const Corners dx{Vec3(0, 0, -1), Vec3(0, 0, -1), Vec3::Zero(), Vec3::Zero()};
  const double fraction = safe_fraction(PairKind::EdgeEdge, x, dx, 0.5);
  EXPECT_GT(fraction, 0.247);
  EXPECT_LE(fraction, 0.25);
}

TEST(SafeFraction, OfPiecesThatPassAsideOrTravelTogetherIsOne)
{
  const Corners x{Vec3(-5, 0, 0.3), Vec3(0, -1, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const Corners pass{Vec3(11, 0, 0), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  EXPECT_LT(safe_fraction(PairKind::PointTriangle, x, pass, 0.5), 1);
  EXPECT_EQ(safe_fraction(PairKind::PointTriangle, x, pass, 0.04), 1) << "it passes at 0.06 of the first distance";
  const Vec3 far(1e9, -1e9, 1e9);
  EXPECT_EQ(safe_fraction(PairKind::PointTriangle, x, {far, far, far, far}, 0.5), 1);
  const Corners away{Vec3(-100, 0, 0), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  EXPECT_EQ(safe_fraction(PairKind::PointTriangle, x, away, 0.5), 1);
}

}  // namespace
}  // namespace luff::shell
