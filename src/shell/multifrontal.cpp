// SPDX-License-Identifier: BSD-3-Clause
// Sparse symmetric factorisation A = L D L' by dense fronts.
#include "shell/multifrontal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>
#include <cholmod.h>

#include "core/error.hpp"

namespace luff::shell {

namespace {

/// CHOLMOD's analysis of a pattern: an order of elimination and the fronts, without numbers.
class SymbolicFactor {
 public:
  explicit SymbolicFactor(const UpperTriangle& pattern)
  {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.postorder = 1;
    common_.nmethods = 2;
    common_.method[0].ordering = CHOLMOD_AMD;
    common_.method[1].ordering = CHOLMOD_METIS;
    cholmod_sparse* A =
        cholmod_allocate_sparse(pattern.size(), pattern.size(), pattern.row.size(), 1, 1, 1, CHOLMOD_PATTERN, &common_);
    std::copy(pattern.start.begin(), pattern.start.end(), static_cast<int*>(A->p));
    std::copy(pattern.row.begin(), pattern.row.end(), static_cast<int*>(A->i));
    factor_ = cholmod_analyze(A, &common_);
    cholmod_free_sparse(&A, &common_);
    ensure(factor_ != nullptr && factor_->is_super, "CHOLMOD's analysis failed");
  }
  ~SymbolicFactor()
  {
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }
  SymbolicFactor(const SymbolicFactor&) = delete;
  SymbolicFactor& operator=(const SymbolicFactor&) = delete;

  int n_fronts() const { return static_cast<int>(factor_->nsuper); }
  std::span<const int> order() const { return numbers(factor_->Perm, factor_->n); }
  std::span<const int> first_column() const { return numbers(factor_->super, factor_->nsuper + 1); }
  std::span<const int> first_row() const { return numbers(factor_->pi, factor_->nsuper + 1); }
  std::span<const int> rows() const { return numbers(factor_->s, factor_->ssize); }

 private:
  static std::span<const int> numbers(const void* p, std::size_t n) { return {static_cast<const int*>(p), n}; }

  cholmod_common common_;
  cholmod_factor* factor_ = nullptr;
};

/// Eigen splits large products among threads, and sums in an order that depends on their number.
class OneThread {
 public:
  OneThread() : before_(Eigen::nbThreads()) { Eigen::setNbThreads(1); }
  ~OneThread() { Eigen::setNbThreads(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_;
};

/// L D L' of a small dense block in place of its lower triangle; L has a unit diagonal, D takes its place.
bool eliminate_block(Eigen::Ref<Eigen::MatrixXd> A)
{
  const Eigen::Index n = A.rows();
  for (Eigen::Index j = 0; j < n; ++j) {
    const double d = A(j, j);
    if (d == 0 || !std::isfinite(d))
      return false;
    for (Eigen::Index c = j + 1; c < n; ++c)
      A.col(c).tail(n - c) -= A(c, j) / d * A.col(j).tail(n - c);
    A.col(j).tail(n - j - 1) /= d;
  }
  return true;
}

}  // namespace

Multifrontal::Multifrontal(const UpperTriangle& pattern)
{
  if (pattern.size() == 0)
    return;
  analyse(pattern);
  place_entries(pattern);
  count_children();
  stack_.resize(stack_size());
}

void Multifrontal::analyse(const UpperTriangle& pattern)
{
  const SymbolicFactor symbolic(pattern);
  permuted_.resize(pattern.size());
  for (int k = 0; k < pattern.size(); ++k)
    permuted_[symbolic.order()[k]] = k;
  rows_.assign(symbolic.rows().begin(), symbolic.rows().end());
  std::size_t numbers = 0;
  for (int s = 0; s < symbolic.n_fronts(); ++s) {
    const int first = symbolic.first_column()[s], row = symbolic.first_row()[s];
    fronts_.push_back({.first = first,
                       .n_pivots = symbolic.first_column()[s + 1] - first,
                       .n_rows = symbolic.first_row()[s + 1] - row,
                       .rows = static_cast<std::size_t>(row),
                       .panel = numbers});
    numbers += static_cast<std::size_t>(fronts_.back().n_rows) * fronts_.back().n_pivots;
  }
  L_.resize(numbers);
  local_.resize(pattern.size());
}

void Multifrontal::place_entries(const UpperTriangle& pattern)
{
  std::vector<int> front_of(pattern.size());
  for (std::size_t f = 0; f < fronts_.size(); ++f)
    std::fill_n(front_of.begin() + fronts_[f].first, fronts_[f].n_pivots, static_cast<int>(f));
  for (int j = 0; j < pattern.size(); ++j)
    for (int s = pattern.start[j]; s < pattern.start[j + 1]; ++s) {
      const auto [column, row] = std::minmax(permuted_[pattern.row[s]], permuted_[j]);
      const Front& f = fronts_[front_of[column]];
      const auto rows = rows_.begin() + static_cast<std::ptrdiff_t>(f.rows);
      const auto local = std::lower_bound(rows, rows + f.n_rows, row) - rows;
      place_.push_back(f.panel + static_cast<std::size_t>(local) +
                       static_cast<std::size_t>(column - f.first) * static_cast<std::size_t>(f.n_rows));
    }
}

/// The parent eliminates the first row below a front's pivots. Fronts are in postorder: a parent's children are the
/// last that nobody has taken yet.
void Multifrontal::count_children()
{
  for (const Front& f : fronts_) {
    if (f.n_below() == 0)
      continue;
    const int row = rows_[f.rows + static_cast<std::size_t>(f.n_pivots)];
    const auto after =
        std::upper_bound(fronts_.begin(), fronts_.end(), row, [](int r, const Front& g) { return r < g.first; });
    ++(after - 1)->n_children;
  }
}

/// Largest sum of the updates that wait for their parents, the one being made included.
std::size_t Multifrontal::stack_size() const
{
  std::size_t top = 0, largest = 0;
  std::vector<std::size_t> waiting;
  for (const Front& f : fronts_) {
    const auto own = static_cast<std::size_t>(f.n_below()) * static_cast<std::size_t>(f.n_below());
    largest = std::max(largest, top + own);
    for (std::size_t c = 0; c < f.n_children; ++c) {
      top -= waiting.back();
      waiting.pop_back();
    }
    if (own > 0)
      waiting.push_back(own);
    top += own;
  }
  return largest;
}

bool Multifrontal::factorise(std::span<const double> values)
{
  const OneThread deterministic;
  std::fill(L_.begin(), L_.end(), 0.0);
  for (std::size_t s = 0; s < place_.size(); ++s)
    L_[place_[s]] = values[s];
  n_negative_pivots_ = 0;
  std::vector<std::pair<const Front*, std::size_t>> waiting;  // fronts with updates on the stack, and where
  std::size_t top = 0;
  for (const Front& f : fronts_) {
    const auto own = static_cast<std::size_t>(f.n_below()) * static_cast<std::size_t>(f.n_below());
    double* update = stack_.data() + top;
    std::fill_n(update, own, 0.0);
    for (int i = 0; i < f.n_rows; ++i)
      local_[rows_[f.rows + static_cast<std::size_t>(i)]] = i;
    for (std::size_t c = 0; c < f.n_children; ++c) {
      const auto [child, start] = waiting.back();
      add_child(*child, stack_.data() + start, f, update);
      waiting.pop_back();
      top = start;
    }
    if (!eliminate(f))
      return false;
    if (own == 0)
      continue;
    update_below(f, update);
    std::copy_n(update, own, stack_.data() + top);  // over its children, which are no longer needed
    waiting.emplace_back(&f, top);
    top += own;
  }
  return true;
}

void Multifrontal::add_child(const Front& child, const double* update, const Front& parent, double* parent_update)
{
  const int n = child.n_below(), n_below = parent.n_below();
  const int* row = rows_.data() + child.rows + child.n_pivots;
  for (int k = 0; k < n; ++k) {
    const int column = local_[row[k]];
    const double* from = update + static_cast<std::size_t>(k) * static_cast<std::size_t>(n);
    const bool pivot = column < parent.n_pivots;
    double* to = pivot ? L_.data() + parent.panel + static_cast<std::size_t>(column) * parent.n_rows
                       : parent_update + static_cast<std::size_t>(column - parent.n_pivots) * n_below;
    const int first = pivot ? 0 : parent.n_pivots;
    for (int i = k; i < n; ++i)
      to[local_[row[i]] - first] += from[i];
  }
}

/// Pivots of a front, a block of columns at a time: L11 D11 L11' = A11, L21 = A21 L11^-T D11^-1, A22 -= L21 D11 L21'.
bool Multifrontal::eliminate(const Front& f)
{
  constexpr Eigen::Index block_size = 32;
  Panel P = panel(f);
  for (Eigen::Index k = 0; k < f.n_pivots; k += block_size) {
    const Eigen::Index b = std::min(block_size, f.n_pivots - k), below = f.n_rows - k - b, right = f.n_pivots - k - b;
    auto A11 = P.block(k, k, b, b);
    if (!eliminate_block(A11))
      return false;
    n_negative_pivots_ += static_cast<int>((A11.diagonal().array() < 0).count());
    auto L21 = P.block(k + b, k, below, b);
    A11.template triangularView<Eigen::UnitLower>().transpose().template solveInPlace<Eigen::OnTheRight>(L21);
    if (right > 0)
      scaled_ = L21.topRows(right);
    L21.array().rowwise() /= A11.diagonal().transpose().array();
    if (right > 0)
      P.block(k + b, k + b, below, right).noalias() -= L21 * scaled_.transpose();
  }
  return true;
}

/// What is left of the front for its parent: A22 - L21 D L21', lower triangle.
void Multifrontal::update_below(const Front& f, double* update)
{
  const ConstPanel P = std::as_const(*this).panel(f);
  const auto L21 = P.bottomRows(f.n_below());
  scaled_ = L21 * P.diagonal().asDiagonal();
  Panel(update, f.n_below(), f.n_below()).triangularView<Eigen::Lower>() -= L21 * scaled_.transpose();
}

void Multifrontal::solve(Eigen::VectorXd& b) const
{
  const OneThread deterministic;
  Eigen::VectorXd x(b.size()), below;
  for (Eigen::Index i = 0; i < b.size(); ++i)
    x[permuted_[i]] = b[i];
  for (const Front& f : fronts_) {
    const ConstPanel P = panel(f);
    auto own = x.segment(f.first, f.n_pivots);
    P.topRows(f.n_pivots).template triangularView<Eigen::UnitLower>().solveInPlace(own);
    below.noalias() = P.bottomRows(f.n_below()) * own;
    for (int i = 0; i < f.n_below(); ++i)
      x[rows_[f.rows + static_cast<std::size_t>(f.n_pivots + i)]] -= below[i];
  }
  for (auto f = fronts_.rbegin(); f != fronts_.rend(); ++f) {
    const ConstPanel P = panel(*f);
    auto own = x.segment(f->first, f->n_pivots);
    own.array() /= P.diagonal().array();
    below.resize(f->n_below());
    for (int i = 0; i < f->n_below(); ++i)
      below[i] = x[rows_[f->rows + static_cast<std::size_t>(f->n_pivots + i)]];
    own.noalias() -= P.bottomRows(f->n_below()).transpose() * below;
    P.topRows(f->n_pivots).template triangularView<Eigen::UnitLower>().transpose().solveInPlace(own);
  }
  for (Eigen::Index i = 0; i < b.size(); ++i)
    b[i] = x[permuted_[i]];
}

}  // namespace luff::shell
