// SPDX-License-Identifier: BSD-3-Clause
// Which fine unknowns inside one coarse cell become one coarse unknown.
#pragma once

#include <vector>

namespace luff::poisson {

/// The fine unknowns inside one coarse cell, the coefficients between them, and what leads out of the cell.
///
/// Two sides of a sheet that meet only through a passage narrower than the way on from there are no part: one unknown
/// for both would let everything through, and the coarse levels would underestimate the difference of pressure between
/// them.
class Passages {
 public:
  void reset(int unknowns);
  void join(int a, int b, double coefficient) { open_.push_back({a, b, coefficient}); }
  /// a and b may lie on two sides of a sheet: neighbours with a closed face, or unknowns of one cell.
  void part(int a, int b) { sides_.push_back({a, b}); }
  void lead_out(int a, double coefficient) { out_[a] += coefficient; }

  /// The part of each unknown: the number of the first unknown of it.
  [[nodiscard]] const std::vector<int>& parts();
  [[nodiscard]] bool has_sides() const { return !sides_.empty(); }
  [[nodiscard]] bool leads_out(int a) const { return out_[a] > 0.0; }

 private:
  struct Edge {
    int a, b;
    double coefficient;
  };
  struct Pair {
    int a, b;
  };
  void label_joined();
  double least_cut(int a, int b);
  [[nodiscard]] bool find_way(int a, int b);
  [[nodiscard]] bool separate(const Pair& sides);
  [[nodiscard]] double& room(int a, int b) { return room_[a * unknowns() + b]; }
  [[nodiscard]] int unknowns() const { return static_cast<int>(out_.size()); }

  std::vector<Edge> open_;
  std::vector<Pair> sides_;
  std::vector<double> out_;
  std::vector<int> part_;
  std::vector<double> room_;  // for more flow, from each unknown to each
  std::vector<int> from_;     // where the way came from, -1 where none leads
  std::vector<int> front_;
};

}  // namespace luff::poisson
