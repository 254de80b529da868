// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/line.hpp"

#include <algorithm>
#include <numeric>

namespace luff::poisson {

namespace {

double side_distance(SideCondition side, double h)
{
  return side == SideCondition::Dirichlet ? 2.0 / h : 0.0;
}

std::vector<double> inverse_distances(const Line& line)
{
  const int n = line.n;
  std::vector<double> inverse(n + 1, 0.0);
  for (int f = 1; f < n; ++f)
    inverse[f] = 2.0 / (line.h[f - 1] + line.h[f]);
  if (line.periodic) {
    // A single periodic cell is its own neighbour: no difference of pressure, no gradient.
    inverse[0] = inverse[n] = n == 1 ? 0.0 : 2.0 / (line.h[n - 1] + line.h[0]);
  } else {
    inverse[0] = side_distance(line.sides[0], line.h.front());
    inverse[n] = side_distance(line.sides[1], line.h.back());
  }
  return inverse;
}

}  // namespace

Line make_line(std::vector<double> h, bool periodic, const std::array<SideCondition, 2>& sides, std::vector<int> splits)
{
  Line line;
  line.n = static_cast<int>(h.size());
  line.periodic = periodic;
  line.sides = sides;
  line.h = std::move(h);
  line.inverse_d = inverse_distances(line);
  line.measure.assign(line.n, 1.0);
  line.splits = std::move(splits);
  return line;
}

std::vector<int> merge_pairs(const Line& line, double target, bool keep_blocks)
{
  std::vector<int> first;
  for (int i = 0; i < line.n;) {
    first.push_back(i);
    const bool block_ends =
        keep_blocks && std::find(line.splits.begin(), line.splits.end(), i + 1) != line.splits.end();
    const bool pair = i + 1 < line.n && line.h[i] + line.h[i + 1] <= target && !block_ends;
    i += pair ? 2 : 1;
  }
  first.push_back(line.n);
  return first;
}

Line coarse_line(const Line& line, const std::vector<int>& first)
{
  Line coarse;
  coarse.n = static_cast<int>(first.size()) - 1;
  coarse.periodic = line.periodic;
  coarse.sides = line.sides;
  coarse.h.resize(coarse.n);
  coarse.measure.resize(coarse.n);
  for (int I = 0; I < coarse.n; ++I) {
    coarse.h[I] = std::accumulate(line.h.begin() + first[I], line.h.begin() + first[I + 1], 0.0);
    coarse.measure[I] = std::accumulate(line.measure.begin() + first[I], line.measure.begin() + first[I + 1], 0.0);
  }
  coarse.inverse_d = inverse_distances(coarse);
  for (const int split : line.splits)
    coarse.splits.push_back(static_cast<int>(std::lower_bound(first.begin(), first.end(), split) - first.begin()));
  return coarse;
}

Merge make_merge(const Line& fine, const Line& coarse, const std::vector<int>& first)
{
  Merge merge;
  merge.first = first;
  merge.parent.resize(fine.n);
  merge.towards.assign(fine.n, 0);
  merge.weight.assign(fine.n, 0.0);
  for (int I = 0; I < coarse.n; ++I) {
    const int a = first[I];
    merge.parent[a] = I;
    if (first[I + 1] - a == 1)
      continue;
    merge.parent[a + 1] = I;
    merge.towards[a] = -1;
    merge.towards[a + 1] = 1;
    merge.weight[a] = 0.5 * fine.h[a + 1] * coarse.inverse_d[I];
    merge.weight[a + 1] = 0.5 * fine.h[a] * coarse.inverse_d[I + 1];
  }
  merge.scale.assign(coarse.n + 1, 0.0);
  for (int F = 0; F <= coarse.n; ++F) {
    const double fine_inverse = fine.inverse_d[first[F]];
    merge.scale[F] = fine_inverse > 0.0 ? coarse.inverse_d[F] / fine_inverse : 0.0;
  }
  return merge;
}

}  // namespace luff::poisson
