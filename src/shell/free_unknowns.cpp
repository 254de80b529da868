// SPDX-License-Identifier: BSD-3-Clause
// The displacements that are not held, numbered one after the other.
#include "shell/free_unknowns.hpp"

namespace luff::shell {

FreeUnknowns::FreeUnknowns(const std::vector<char>& held) : unknown_(held.size(), -1)
{
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!held[i]) {
      unknown_[i] = size();
      entries_.push_back(static_cast<int>(i));
    }
}

Eigen::VectorXd FreeUnknowns::expanded(const Eigen::Ref<const Eigen::VectorXd>& free) const
{
  Eigen::VectorXd full = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(unknown_.size()));
  full(entries_) = free;
  return full;
}

/// By symmetry, column j is read from row j of the blocks.
FreeTriangle::FreeTriangle(const BlockPattern& pattern, const FreeUnknowns& unknowns)
{
  pattern_.start.push_back(0);
  for (const int j : unknowns.entries()) {
    for (int s = pattern.row_start[j / 3]; s < pattern.row_start[j / 3 + 1]; ++s)
      for (int d = 0; d < 3; ++d) {
        const int i = 3 * pattern.column[s] + d;
        if (i > j || unknowns.unknown_[i] < 0)
          continue;
        pattern_.row.push_back(unknowns.unknown_[i]);
        source_.push_back(9 * static_cast<std::size_t>(s) + 3 * (j % 3) + d);
      }
    pattern_.start.push_back(static_cast<int>(pattern_.row.size()));
  }
  values_.resize(source_.size());
}

const std::vector<double>& FreeTriangle::values(const BlockMatrix& A)
{
  for (std::size_t s = 0; s < source_.size(); ++s)
    values_[s] = A.values()[source_[s]];
  return values_;
}

}  // namespace luff::shell
