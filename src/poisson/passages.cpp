// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/passages.hpp"

#include <algorithm>
#include <limits>

namespace luff::poisson {

namespace {

/// Sides are one part if what joins them is at least this times what leads out of either: about one, but no ratio of
/// small integers, so that round-off decides nothing on equal cells.
constexpr double wide = 0.93;

}  // namespace

void Passages::reset(int unknowns)
{
  open_.clear();
  sides_.clear();
  out_.assign(unknowns, 0.0);
}

const std::vector<int>& Passages::parts()
{
  label_joined();
  for (bool changed = true; changed;) {
    changed = false;
    for (const Pair& sides : sides_)
      changed = (part_[sides.a] == part_[sides.b] && separate(sides)) || changed;
  }
  return part_;
}

/// What any open coefficient joins.
void Passages::label_joined()
{
  part_.resize(unknowns());
  for (int m = 0; m < unknowns(); ++m)
    part_[m] = m;
  for (const Edge& e : open_) {
    const auto [kept, gone] = std::minmax(part_[e.a], part_[e.b]);
    if (kept != gone)
      std::replace(part_.begin(), part_.end(), int(gone), int(kept));
  }
}

/// Parts two sides if the least sum of coefficients that joins them is small.  Both stay connected.
bool Passages::separate(const Pair& sides)
{
  const int old = part_[sides.a];
  const double cut = least_cut(sides.a, sides.b);
  double out_a = 0.0;
  double out_b = 0.0;
  for (int m = 0; m < unknowns(); ++m)
    if (part_[m] == old)
      (from_[m] >= 0 ? out_a : out_b) += out_[m];
  if (cut >= wide * std::min(out_a, out_b))
    return false;
  for (const bool a : {true, false}) {
    int first = -1;
    for (int m = 0; m < unknowns(); ++m)
      if (part_[m] == old && (from_[m] >= 0) == a)
        first = first < 0 ? m : first;
    for (int m = first; m < unknowns(); ++m)
      if (part_[m] == old && (from_[m] >= 0) == a)
        part_[m] = first;
  }
  return true;
}

/// The least sum of coefficients that parts a from b, which is the largest flow between them
/// [ford_1956_maximal]; then from_ tells what stays with a.
double Passages::least_cut(int a, int b)
{
  room_.assign(unknowns() * unknowns(), 0.0);
  for (const Edge& e : open_)
    if (part_[e.a] == part_[a] && part_[e.b] == part_[a]) {
      room(e.a, e.b) += e.coefficient;
      room(e.b, e.a) += e.coefficient;
    }
  double flow = 0.0;
  while (find_way(a, b)) {
    double least = std::numeric_limits<double>::max();
    for (int m = b; m != a; m = from_[m])
      least = std::min(least, room(from_[m], m));
    for (int m = b; m != a; m = from_[m]) {
      room(from_[m], m) -= least;
      room(m, from_[m]) += least;
    }
    flow += least;
  }
  return flow;
}

/// The way of fewest steps from a to b with room left.
bool Passages::find_way(int a, int b)
{
  from_.assign(unknowns(), -1);
  front_.assign(1, a);
  from_[a] = a;
  for (std::size_t t = 0; t < front_.size() && from_[b] < 0; ++t) {
    const int n = front_[t];
    for (int m = 0; m < unknowns(); ++m)
      if (from_[m] < 0 && room(n, m) > 0.0) {
        from_[m] = n;
        front_.push_back(m);
      }
  }
  return from_[b] >= 0;
}

}  // namespace luff::poisson
