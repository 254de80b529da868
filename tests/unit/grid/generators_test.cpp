// SPDX-License-Identifier: BSD-3-Clause
// Generated grids: what their curves, sections and nodes are.
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "grid/generators/aorta.hpp"
#include "grid/generators/centreline.hpp"
#include "grid/generators/disc_section.hpp"
#include "grid/generators/mapped_box.hpp"
#include "grid/generators/pipe.hpp"

namespace luff::grid {
namespace {

using std::numbers::pi;

double orthonormality_error(const CurvePoint& p)
{
  Mat3 frame;
  frame << p.e1, p.e2, p.t;
  return (frame.transpose() * frame - Mat3::Identity()).norm() + std::abs(frame.determinant() - 1.0);
}

std::vector<double> evenly(double from, double to, int cells)
{
  std::vector<double> x;
  for (int i = 0; i <= cells; ++i)
    x.push_back(from + (to - from) * i / cells);
  return x;
}

std::string refusal(const std::function<void()>& act)
{
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Centreline, OfAStraightPieceAndABendEndsWhereTheCircleEnds)
{
  Centreline line(frame_along({1.0, 2.0, 3.0}, {0.0, 0.0, 2.0}));
  line.add_straight(1.5);
  line.add_bend(2.0, pi / 2.0, Vec3::UnitX());
  line.add_straight(0.5);
  EXPECT_NEAR(line.length(), 1.5 + pi + 0.5, 1e-14);
  const CurvePoint end = line.at(line.length());
  EXPECT_LT((end.x - Vec3(1.0 + 2.0 + 0.5, 2.0, 3.0 + 1.5 + 2.0)).norm(), 1e-14);
  EXPECT_LT((end.t - Vec3::UnitX()).norm(), 1e-15);
  EXPECT_EQ(line.curvature(1.0), 0.0);
  EXPECT_NEAR(line.curvature(2.0), 0.5, 1e-15);
}

TEST(Centreline, CarriesAFrameThatDoesNotTurnAboutItsTangent)
{
  Centreline line(frame_along(Vec3::Zero(), {1.0, 0.3, -0.2}));
  line.add_bend(1.0, 1.0, {0.0, 1.0, 0.0});
  line.add_bend(0.7, 1.5, {0.3, 0.0, 1.0});
  constexpr double ds = 1e-5;
  for (double s = 0.1; s < line.length() - 0.1; s += 0.173) {
    EXPECT_LT(orthonormality_error(line.at(s)), 1e-14);
    const Vec3 slope = (line.at(s + ds).e1 - line.at(s - ds).e1) / (2.0 * ds);
    EXPECT_LT(slope.cross(line.at(s).t).norm(), 1e-6) << s;
    EXPECT_LT(((line.at(s + ds).x - line.at(s - ds).x) / (2.0 * ds) - line.at(s).t).norm(), 1e-6) << s;
  }
}

TEST(Centreline, ThroughPointsPassesEachOfThemSmoothly)
{
  std::vector<Vec3> points;
  for (int n = 0; n <= 8; ++n)
    points.emplace_back(std::cos(0.6 * n), std::sin(0.6 * n), 0.3 * n);
  const Centreline line = Centreline::through(points);
  const double helix = std::hypot(0.6, 0.3) * 8;
  EXPECT_NEAR(line.length(), helix, 2e-3 * helix);
  for (const Vec3& x : points) {
    double nearest = 1e9;
    for (int n = 0; n <= 20000; ++n)
      nearest = std::min(nearest, (line.at(line.length() * n / 20000).x - x).norm());
    EXPECT_LT(nearest, 2e-4);
  }
  EXPECT_LT((line.at(0.0).x - points.front()).norm(), 1e-14);
  EXPECT_LT((line.at(line.length()).x - points.back()).norm(), 1e-12);
  for (int n = 1; n < 400; ++n) {  // no corner anywhere
    const double s = line.length() * n / 400;
    EXPECT_LT((line.at(s + 1e-6).t - line.at(s - 1e-6).t).norm(), 1e-5) << s;
    EXPECT_LT(orthonormality_error(line.at(s)), 1e-12);
  }
}

TEST(Centreline, ThroughPointsOfACircleHasItsCurvature)
{
  std::vector<Vec3> points;
  for (int n = 0; n <= 24; ++n)
    points.emplace_back(2.0 * std::cos(pi * n / 24), 2.0 * std::sin(pi * n / 24), 0.0);
  const Centreline line = Centreline::through(points);
  for (double s = 0.2 * line.length(); s < 0.8 * line.length(); s += 0.1)
    EXPECT_NEAR(line.curvature(s), 0.5, 5e-3);
  EXPECT_NEAR(line.length(), 2.0 * pi, 1e-4);
}

TEST(Centreline, RefusesTwoPointsAtOnePlaceAndABendAlongTheTangent)
{
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(refusal([&] { (void)Centreline::through(points); }), "points 1 and 2 of the centreline are the same");
  Centreline line(frame_along(Vec3::Zero(), Vec3::UnitX()));
  EXPECT_NE(refusal([&] { line.add_bend(1.0, 1.0, Vec3::UnitX()); }).find("must point to a side"), std::string::npos);
}

/// Largest |cosine| between the mean edges of cells, and the smallest area.
struct SectionQuality {
  double cosine = 0.0;
  double smallest_area = 1e9;
  double area = 0.0;
};

SectionQuality quality_of_disc(int n)
{
  const auto P = disc_section(n);
  SectionQuality q;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto at = [&](int a, int b) { return P[i + a + (j + b) * (n + 1)]; };
      const Eigen::Vector2d T1 = at(1, 0) + at(1, 1) - at(0, 0) - at(0, 1);
      const Eigen::Vector2d T2 = at(0, 1) + at(1, 1) - at(0, 0) - at(1, 0);
      const Eigen::Vector2d diagonal = at(1, 1) - at(0, 0);
      const Eigen::Vector2d other = at(0, 1) - at(1, 0);
      const double area = 0.5 * (diagonal[0] * other[1] - diagonal[1] * other[0]);
      q.cosine = std::max(q.cosine, std::abs(T1.dot(T2)) / (T1.norm() * T2.norm()));
      q.smallest_area = std::min(q.smallest_area, area);
      q.area += area;
    }
  return q;
}

TEST(DiscSection, HasItsRimOnTheUnitCircleAndMirrorsItself)
{
  constexpr int n = 14;
  const auto P = disc_section(n);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool rim = i == 0 || j == 0 || i == n || j == n;
      const Eigen::Vector2d& x = P[i + j * (n + 1)];
      EXPECT_NEAR(std::max(x.norm(), rim ? 0.0 : 1.0), 1.0, 1e-15);
      const Eigen::Vector2d& mirrored = P[n - i + j * (n + 1)];
      EXPECT_LT((x - Eigen::Vector2d(-mirrored[0], mirrored[1])).norm(), 1e-14);
      const Eigen::Vector2d& swapped = P[j + i * (n + 1)];
      EXPECT_LT((x - Eigen::Vector2d(swapped[1], swapped[0])).norm(), 1e-14);
    }
}

TEST(DiscSection, HasCellsOfLikeSizeThatAreNotTooSkewed)
{
  for (const int n : {8, 16, 48, 100}) {
    const SectionQuality q = quality_of_disc(n);
    EXPECT_LT(q.cosine, n < 50 ? 0.42 : 0.6) << n;  // 0.412 was measured on 48^2, 0.568 on 96^2 cells
    EXPECT_GT(q.smallest_area, 0.3 * q.area / (n * n)) << n;
    EXPECT_NEAR(q.area, pi, pi * pi * pi / (n * n) / 6.0 * 1.3) << n;  // of the polygon of 4 n nearly equal sides
  }
}

TEST(Pipe, HasItsWallAtTheRadiusFromTheCentreline)
{
  Centreline line(frame_along({0.5, 0.0, 0.0}, Vec3::UnitZ()));
  line.add_straight(1.0);
  line.add_bend(2.0, 1.0, Vec3::UnitY());
  const std::vector<double> stations = evenly(0.0, 3.0, 12);
  const auto radius = [](double s) { return 0.4 + 0.1 * s; };
  const CurvilinearNodes pipe = make_pipe({line, stations, 6, radius, nullptr});
  EXPECT_EQ(pipe.cells, (Index3{6, 6, 12}));
  for (int k = 0; k <= 12; ++k) {
    const CurvePoint p = line.at(stations[k]);
    const auto ring = pipe.source({{0, 0, k}, {7, 7, k + 1}});
    for (int j = 0; j <= 6; ++j)
      for (int i = 0; i <= 6; ++i) {
        const Vec3 x = ring[i + 7 * j] - p.x;
        EXPECT_NEAR(x.dot(p.t), 0.0, 1e-14);
        if (i == 0 || i == 6 || j == 0 || j == 6) {
          EXPECT_NEAR(x.norm(), radius(stations[k]), 1e-14);
        }
      }
    EXPECT_GT((ring[6 + 7 * 3] - ring[0 + 7 * 3]).dot(p.e1), 0.0);
    EXPECT_GT((ring[3 + 7 * 6] - ring[3 + 7 * 0]).dot(p.e2), 0.0);
  }
}

TEST(Pipe, RefusesARadiusThatIsNotPositiveAndABendThatFolds)
{
  Centreline line(frame_along(Vec3::Zero(), Vec3::UnitZ()));
  line.add_straight(1.0);
  line.add_bend(2.0, 1.0, Vec3::UnitY());
  const auto pipe = [&](const std::function<double(double)>& radius) {
    return refusal([&] { (void)make_pipe({line, evenly(0.0, 3.0, 12), 4, radius, nullptr}); });
  };
  EXPECT_EQ(pipe([](double s) { return 0.5 - s; }),
            "the radius of the pipe at s = 0.5 is 0; it must be greater than 0 from s = 0 to 3");
  EXPECT_EQ(pipe([](double s) { return s < 2.0 ? 1.0 : 2.5; }),
            "the pipe folds at s = 2: its radius 2.5 must be less than the radius 2 of its bend there");
  EXPECT_NE(pipe([](double) { return std::nan(""); }).find("nan"), std::string::npos);
}

TEST(Annulus, OfAWholeTurnClosesToTheLastBit)
{
  const AnnulusShape shape{frame_along({1.0, -2.0, 0.3}, {1.0, 1.0, 0.2}), evenly(0.5, 1.0, 4),
                           evenly(0.0, 2.0 * pi, 9), evenly(0.0, 2.0, 3)};
  const CurvilinearNodes annulus = make_annulus(shape);
  EXPECT_EQ(annulus.cells, (Index3{4, 9, 3}));
  for (int k = 0; k <= 3; ++k)
    for (int i = 0; i <= 4; ++i) {
      const auto column = annulus.source({{i, 0, k}, {i + 1, 10, k + 1}});
      EXPECT_EQ(column.front(), column.back());
      for (const Vec3& x : column) {
        const Vec3 from_axis = x - shape.start.x - shape.heights[k] * shape.start.t;
        EXPECT_NEAR(from_axis.norm(), shape.radii[i], 1e-14);
      }
    }
}

TEST(Annulus, OfASectorEndsAtItsAngle)
{
  const AnnulusShape shape{CurvePoint{}, {1.0, 2.0}, {0.0, pi / 4.0, pi / 2.0}, {0.0, 1.0}};
  const auto nodes = make_annulus(shape).source({{1, 2, 1}, {2, 3, 2}});
  EXPECT_LT((nodes.front() - Vec3(0.0, 2.0, 1.0)).norm(), 1e-15);
}

TEST(Channel, HasItsNodesBetweenItsWallsAndRefusesWallsThatMeet)
{
  ChannelShape shape{.x = evenly(0.0, 4.0, 8),
                     .fractions = evenly(0.0, 1.0, 5),
                     .z = {0.0, 1.0},
                     .lower = [](double) { return -0.5; },
                     .upper = [](double x) { return 0.5 + 0.1 * x; }};
  const auto nodes = make_channel(shape).source({{8, 0, 0}, {9, 6, 1}});
  EXPECT_NEAR(nodes.front()[1], -0.5, 1e-15);
  EXPECT_NEAR(nodes.back()[1], 0.9, 1e-15);
  EXPECT_NEAR(nodes[2][1], -0.5 + 0.4 * 1.4, 1e-15);
  shape.upper = [](double x) { return 0.5 - 0.5 * x; };
  EXPECT_EQ(refusal([&] { (void)make_channel(shape); }),
            "the channel's walls at x = 2 are at y = -0.5 and -0.5; the lower must lie below the upper");
}

TEST(GridGenerators, GiveTheSameNodesToWhoeverAsksForAPart)
{
  Centreline line(frame_along(Vec3::Zero(), Vec3::UnitZ()));
  line.add_bend(2.0, 1.0, Vec3::UnitY());
  const CurvilinearNodes pipe = make_pipe({line, evenly(0.0, 2.0, 7), 5, [](double) { return 0.5; },
                                           [](double s, double a) { return 0.1 * s * (1.0 + std::cos(3.0 * a)); }});
  const auto all = pipe.source({{0, 0, 0}, {6, 6, 8}});
  const IndexBox part{{1, 2, 3}, {4, 6, 6}};
  std::size_t n = 0;
  const auto nodes = pipe.source(part);
  for_each_cell_in_order(part, [&](int i, int j, int k) { EXPECT_EQ(nodes[n++], all[i + 6 * (j + 6 * k)]); });
}

TEST(Aorta, BeginsBelowTheAnnulusAndEndsInTheDescendingAorta)
{
  constexpr double R = 0.0127;
  const CurvilinearNodes aorta = make_aorta({aorta_inlet, 0.0, 1.0, aorta_outlet()}, 2, R);
  const auto axis = aorta.source({{1, 1, 0}, {2, 2, 4}});
  EXPECT_LT((axis[0] - Vec3(0.0, 0.0, -0.020)).norm(), 1e-12);
  EXPECT_LT(axis[1].norm(), 1e-9);
  EXPECT_LT((axis[3] - Vec3(0.0684, 0.0279, -0.0389)).norm(), 1e-4);  // measured with the prototype
  const auto rim = aorta.source({{2, 1, 1}, {3, 2, 2}});
  EXPECT_NEAR(rim.front().norm(), R, 1e-12);  // the sinus has not begun
}

}  // namespace
}  // namespace luff::grid
