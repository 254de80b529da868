// SPDX-License-Identifier: BSD-3-Clause
// Sparse matrix of 3 x 3 blocks.
#include "shell/block_matrix.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace luff::shell {

int BlockPattern::slot(int row, int col) const
{
  const auto first = column.begin() + row_start[row], last = column.begin() + row_start[row + 1];
  const auto found = std::lower_bound(first, last, col);
  ensure(found != last && *found == col, "a block outside the pattern");
  return static_cast<int>(found - column.begin());
}

BlockPattern couple(int n_vertices, std::span<const std::vector<int>> groups)
{
  std::vector<std::vector<int>> rows(n_vertices);
  for (int v = 0; v < n_vertices; ++v)
    rows[v].push_back(v);
  for (const auto& group : groups)
    for (const int v : group)
      rows[v].insert(rows[v].end(), group.begin(), group.end());
  BlockPattern pattern;
  pattern.row_start.push_back(0);
  for (auto& row : rows) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    pattern.column.insert(pattern.column.end(), row.begin(), row.end());
    pattern.row_start.push_back(static_cast<int>(pattern.column.size()));
  }
  return pattern;
}

void BlockMatrix::scale(double factor)
{
  for (double& value : values_)
    value *= factor;
}

void BlockMatrix::add_diagonal(double factor, const Eigen::VectorXd& weights)
{
  for (int v = 0; v < pattern_->n_rows(); ++v)
    block(pattern_->slot(v, v)).diagonal().array() += factor * weights[v];
}

double BlockMatrix::trace() const
{
  double sum = 0;
  for (int v = 0; v < pattern_->n_rows(); ++v)
    sum += block(pattern_->slot(v, v)).trace();
  return sum;
}

BlockPattern united(const BlockPattern& pattern, std::span<const std::array<int, 4>> groups)
{
  const int n = pattern.n_rows();
  std::vector<std::pair<int, int>> extra;
  for (const auto& group : groups)
    for (const int row : group)
      for (const int col : group)
        if (row < n && col < n)
          extra.emplace_back(row, col);
  std::sort(extra.begin(), extra.end());
  extra.erase(std::unique(extra.begin(), extra.end()), extra.end());
  BlockPattern result;
  result.row_start.push_back(0);
  auto next = extra.begin();
  for (int row = 0; row < n; ++row) {
    const auto first = pattern.column.begin() + pattern.row_start[row];
    const auto last = pattern.column.begin() + pattern.row_start[row + 1];
    const auto row_begin = static_cast<std::ptrdiff_t>(result.column.size());
    result.column.insert(result.column.end(), first, last);
    const auto middle = static_cast<std::ptrdiff_t>(result.column.size());
    for (; next != extra.end() && next->first == row; ++next)
      if (!std::binary_search(first, last, next->second))
        result.column.push_back(next->second);
    std::inplace_merge(result.column.begin() + row_begin, result.column.begin() + middle, result.column.end());
    result.row_start.push_back(static_cast<int>(result.column.size()));
  }
  return result;
}

void BlockMatrix::add(double factor, const BlockMatrix& other)
{
  if (pattern_ == other.pattern_) {
    for (std::size_t i = 0; i < values_.size(); ++i)
      values_[i] += factor * other.values_[i];
    return;
  }
  ensure(pattern_->n_rows() == other.pattern_->n_rows(), "two matrices of different size");
  for (int row = 0; row < pattern_->n_rows(); ++row) {
    int here = pattern_->row_start[row];
    for (int s = other.pattern_->row_start[row]; s < other.pattern_->row_start[row + 1]; ++s, ++here) {
      while (here < pattern_->row_start[row + 1] && pattern_->column[here] < other.pattern_->column[s])
        ++here;
      ensure(here < pattern_->row_start[row + 1] && pattern_->column[here] == other.pattern_->column[s],
             "a block outside the pattern");
      block(here) += factor * other.block(s);
    }
  }
}

Eigen::VectorXd BlockMatrix::operator*(const Eigen::VectorXd& x) const
{
  Eigen::VectorXd y(x.size());
  for (int row = 0; row < pattern_->n_rows(); ++row) {
    Vec3 sum = Vec3::Zero();
    for (int s = pattern_->row_start[row]; s < pattern_->row_start[row + 1]; ++s)
      sum.noalias() += block(s) * x.segment<3>(3 * pattern_->column[s]);
    y.segment<3>(3 * row) = sum;
  }
  return y;
}

Eigen::MatrixXd BlockMatrix::dense() const
{
  const int n = pattern_->n_rows();
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int row = 0; row < n; ++row)
    for (int s = pattern_->row_start[row]; s < pattern_->row_start[row + 1]; ++s)
      full.block<3, 3>(3 * row, 3 * pattern_->column[s]) = block(s);
  return full;
}

}  // namespace luff::shell
