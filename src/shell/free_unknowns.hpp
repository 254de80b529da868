// SPDX-License-Identifier: BSD-3-Clause
// The displacements that are not held, numbered one after the other.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "shell/block_matrix.hpp"
#include "shell/multifrontal.hpp"

namespace luff::shell {

/// Between full vectors of 3n entries and the free ones among them.
class FreeUnknowns {
 public:
  /// `held` has 3n flags, 1 = no unknown.
  explicit FreeUnknowns(const std::vector<char>& held);

  int size() const { return static_cast<int>(entries_.size()); }
  /// Entry of the full vector of each unknown, ascending.
  const std::vector<int>& entries() const { return entries_; }
  Eigen::VectorXd restricted(const Eigen::VectorXd& full) const { return full(entries_); }
  /// With zeros where held.
  Eigen::VectorXd expanded(const Eigen::Ref<const Eigen::VectorXd>& free) const;

 private:
  friend class FreeTriangle;
  std::vector<int> entries_;
  std::vector<int> unknown_;  ///< of each entry, or -1
};

/// The upper triangle among the free unknowns of matrices on one pattern.
class FreeTriangle {
 public:
  FreeTriangle(const BlockPattern& pattern, const FreeUnknowns& unknowns);

  const UpperTriangle& pattern() const { return pattern_; }
  /// Values of a symmetric matrix in the order of pattern().row.
  const std::vector<double>& values(const BlockMatrix& A);

 private:
  UpperTriangle pattern_;
  std::vector<std::size_t> source_;  ///< in the blocks' values
  std::vector<double> values_;
};

}  // namespace luff::shell
