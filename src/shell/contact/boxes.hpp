// SPDX-License-Identifier: BSD-3-Clause
// Which of many boxes overlap.
#pragma once

#include <algorithm>
#include <vector>

#include "core/vec3.hpp"

namespace luff::shell {

/// Axis-aligned boxes around pieces of surface.
struct Boxes {
  std::vector<Vec3> low;
  std::vector<Vec3> high;

  int size() const { return static_cast<int>(low.size()); }
  void clear()
  {
    low.clear();
    high.clear();
  }
  void grow(double by)
  {
    for (Vec3& corner : low)
      corner.array() -= by;
    for (Vec3& corner : high)
      corner.array() += by;
  }
};

inline bool overlap(const Boxes& a, int i, const Boxes& b, int j)
{
  return (a.low[i].array() <= b.high[j].array()).all() && (b.low[j].array() <= a.high[i].array()).all();
}

/// Sweep along one axis over two sets of boxes.
class Sweep {
 public:
  /// Call visit(i, j) for every box i of `a` that overlaps box j of `b`, in an order that depends on the boxes only.
  template <class Visit>
  void operator()(const Boxes& a, const Boxes& b, Visit visit)
  {
    sort_starts(a, b);
    open_a_.clear();
    open_b_.clear();
    for (const Start& start : starts_) {
      if (start.of_a)
        meet(open_b_, b, start.at, [&](int j) {
          if (overlap(a, start.index, b, j))
            visit(start.index, j);
        });
      else
        meet(open_a_, a, start.at, [&](int i) {
          if (overlap(a, i, b, start.index))
            visit(i, start.index);
        });
      (start.of_a ? open_a_ : open_b_).push_back(start.index);
    }
  }

 private:
  /// Where a box begins on the axis.
  struct Start {
    double at;
    int index;
    bool of_a;
  };

  /// Along the axis in which the boxes of `a` spread most.
  void sort_starts(const Boxes& a, const Boxes& b)
  {
    starts_.clear();
    if (a.size() == 0 || b.size() == 0)
      return;
    Vec3 low = a.low[0], high = a.low[0];
    for (const Vec3& corner : a.low) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    (high - low).maxCoeff(&axis_);
    for (int i = 0; i < a.size(); ++i)
      starts_.push_back({a.low[i][axis_], i, true});
    for (int j = 0; j < b.size(); ++j)
      starts_.push_back({b.low[j][axis_], j, false});
    std::sort(starts_.begin(), starts_.end(), [](const Start& l, const Start& r) {
      return l.at != r.at ? l.at < r.at : (l.of_a != r.of_a ? l.of_a : l.index < r.index);
    });
  }

  /// Visit the boxes that are still open at `at`, forgetting those that ended.
  template <class Visit>
  void meet(std::vector<int>& open, const Boxes& boxes, double at, Visit visit) const
  {
    std::size_t kept = 0;
    for (const int i : open)
      if (boxes.high[i][axis_] >= at) {
        open[kept++] = i;
        visit(i);
      }
    open.resize(kept);
  }

  int axis_ = 0;
  std::vector<Start> starts_;
  std::vector<int> open_a_;
  std::vector<int> open_b_;
};

}  // namespace luff::shell
