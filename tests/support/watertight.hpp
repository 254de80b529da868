// SPDX-License-Identifier: BSD-3-Clause
// Whether sheets can be passed along links between cells without being counted.
#pragma once

#include <limits>

#include <gtest/gtest.h>

#include "immersed/crossings.hpp"
#include "parallel/field.hpp"
#include "support/surfaces.hpp"

namespace luff::test {

/// Sum of `side` over the hits of every link: how many sheets lie between P and N.
inline Field3<int> net_crossings(const Decomposition& ranks, const std::vector<immersed::Crossing>& hits)
{
  auto net = make_field3<int>(ranks.owned());
  for (const immersed::Crossing& hit : hits)
    net[hit.axis](hit.cell[0], hit.cell[1], hit.cell[2]) += hit.side;
  return net;
}

/// How many sheets, signed, lie between each cell and the first one, counted along x, y and z in turn.
inline Field<int> winding(const Decomposition& ranks, const Field3<int>& net)
{
  Field<int> number(ranks.owned());
  const Index3 n = ranks.cells();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        if (i + j + k > 0)
          number(i, j, k) = i > 0   ? number(i - 1, j, k) - net[0](i, j, k)
                            : j > 0 ? number(i, j - 1, k) - net[1](i, j, k)
                                    : number(i, j, k - 1) - net[2](i, j, k);
  return number;
}

/// Links whose hits do not match the numbers of their ends: there a path of links goes around or through the sheet.
inline int leaks(const Decomposition& ranks, const Field3<int>& net, const Field<int>& number)
{
  int count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    IndexBox faces = ranks.owned();
    if (!ranks.periodic(axis))
      ++faces.lo[axis];
    for (int k = faces.lo[2]; k < faces.hi[2]; ++k)
      for (int j = faces.lo[1]; j < faces.hi[1]; ++j)
        for (int i = faces.lo[0]; i < faces.hi[0]; ++i) {
          Index3 p{i, j, k};
          p[axis] = (p[axis] > 0 ? p[axis] : ranks.cells()[axis]) - 1;
          count += number(p[0], p[1], p[2]) - number(i, j, k) != net[axis](i, j, k);
        }
  }
  return count;
}

/// No path of links passes a mesh whose rim, if any, lies outside the centres without counting its sheets: every loop
/// of links crosses it as often one way as the other.
inline ::testing::AssertionResult is_watertight(const Decomposition& ranks, const std::vector<immersed::Crossing>& hits)
{
  const auto net = net_crossings(ranks, hits);
  const int leaking = leaks(ranks, net, winding(ranks, net));
  if (leaking > 0)
    return ::testing::AssertionFailure() << leaking << " links leak among " << hits.size() << " hits";
  if (hits.empty())
    return ::testing::AssertionFailure() << "nothing was hit";
  return ::testing::AssertionSuccess();
}

inline TriangleMesh any_closed_surface(Chance& chance)
{
  switch (chance.index(3)) {
    case 0:
      return cube();
    case 1:
      return sphere(1);
    default:
      return sphere(2);
  }
}

inline TriangleMesh placed(const TriangleMesh& mesh, const Mat3& turn, double size, const Vec3& where)
{
  return mapped(mesh, [&](const Vec3& x) { return Vec3(where + turn * (size * x)); });
}

/// A closed surface in the middle of the grids, turned at random, or not turned at all.
inline TriangleMesh any_placed_surface(Chance& chance)
{
  const Mat3 turn = chance.index(4) == 0 ? Mat3::Identity().eval() : chance.turn();
  return placed(any_closed_surface(chance), turn, 0.45 + 0.1 * chance.number(), 0.2 * chance.vector());
}

/// A sheet turned at random and so large that its rim is outside; folded along a line or at every vertex.
inline TriangleMesh any_spanning_sheet(Chance& chance)
{
  const double fold = 2.0 * chance.number();
  const double crease = chance.index(2) * 0.02;
  const auto folded = mapped(sheet(chance.index(2) == 0 ? 2 : 14), [&](const Vec3& x) {
    return Vec3(x[0], x[1], fold * std::abs(x[0]) + crease * chance.number());
  });
  return placed(folded, chance.turn(), 9.0, 0.1 * chance.vector());
}

/// Coordinates moved by one unit in the last place, up, down or not at all.
inline TriangleMesh jostled(const TriangleMesh& mesh, Chance& chance)
{
  return mapped(mesh, [&](Vec3 x) {
    for (int axis = 0; axis < 3; ++axis)
      if (const int way = chance.index(3) - 1; way != 0)
        x[axis] = std::nextafter(x[axis], way * std::numeric_limits<double>::infinity());
    return x;
  });
}

}  // namespace luff::test
