// SPDX-License-Identifier: BSD-3-Clause
// Sparse matrix of 3 x 3 blocks, one row of blocks per vertex.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/vec3.hpp"

namespace luff::shell {

/// Which blocks exist; rows sorted by column. Structurally symmetric, diagonal included.
struct BlockPattern {
  std::vector<int> row_start;  ///< n + 1 numbers
  std::vector<int> column;

  int n_rows() const { return static_cast<int>(row_start.size()) - 1; }
  int n_blocks() const { return static_cast<int>(column.size()); }
  /// Number of block (row, column), which must exist.
  int slot(int row, int col) const;
};

/// Pattern in which all vertices of each group are coupled.
BlockPattern couple(int n_vertices, std::span<const std::vector<int>> groups);

/// The pattern with, in addition, all vertices of each group coupled; vertices beyond its rows are left out.
BlockPattern united(const BlockPattern& pattern, std::span<const std::array<int, 4>> groups);

/// Values on a pattern; block s is row-major at values[9 s].
class BlockMatrix {
 public:
  explicit BlockMatrix(std::shared_ptr<const BlockPattern> pattern)
      : pattern_(std::move(pattern)), values_(9 * static_cast<std::size_t>(pattern_->n_blocks()), 0.0)
  {
  }

  using Block = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

  const BlockPattern& pattern() const { return *pattern_; }
  const std::vector<double>& values() const { return values_; }
  void set_zero() { std::fill(values_.begin(), values_.end(), 0.0); }
  Eigen::Map<Block> block(int slot) { return Eigen::Map<Block>(values_.data() + 9 * static_cast<std::size_t>(slot)); }
  Eigen::Map<const Block> block(int slot) const
  {
    return Eigen::Map<const Block>(values_.data() + 9 * static_cast<std::size_t>(slot));
  }
  /// this *= factor.
  void scale(double factor);
  /// this += factor * other, whose blocks must all exist here.
  void add(double factor, const BlockMatrix& other);
  /// this += factor * weights[v] I at every vertex v.
  void add_diagonal(double factor, const Eigen::VectorXd& weights);
  double trace() const;
  Eigen::VectorXd operator*(const Eigen::VectorXd& x) const;
  /// All entries, 3n x 3n; for tests and small problems.
  Eigen::MatrixXd dense() const;

 private:
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<double> values_;
};

}  // namespace luff::shell
