// SPDX-License-Identifier: BSD-3-Clause
// Loops over boxes of cells: threaded over rows, vectorised along them, the same bits on any number of threads.
//
// A kernel captures plain views by value and holds no containers, virtual calls, exceptions or allocation, so that it
// runs on a GPU unchanged.
#pragma once

#include <algorithm>
#include <vector>

#include <omp.h>

#include "parallel/index_box.hpp"
#include "parallel/kernel.hpp"
#include "parallel/launch.hpp"

namespace luff {

/// Boxes below this many cells are not worth waking threads for (measured: a barrier costs about 4 us).
inline constexpr std::ptrdiff_t serial_cells = 4096;

inline int threads_for(const IndexBox& box)
{
  return box.volume() < serial_cells ? 1 : omp_get_max_threads();
}

/// kernel(i, j, k) for every cell of the box, in any order.
template <class Kernel>
void for_each_cell(const IndexBox& box, Kernel kernel)
{
#ifdef __CUDACC__
  launch_cells(box, kernel);
#else
#pragma omp parallel for collapse(2) schedule(static) num_threads(threads_for(box))
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
#pragma omp simd
      for (int i = box.lo[0]; i < box.hi[0]; ++i)
        kernel(i, j, k);
#endif
}

/// function(i, j, k) for every cell of the box, i fastest, on the calling thread: for user functions of place and time.
template <class Function>
void for_each_cell_in_order(const IndexBox& box, Function function)
{
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      for (int i = box.lo[0]; i < box.hi[0]; ++i)
        function(i, j, k);
}

/// kernel(i_lo, i_hi, j, k) for every row of the box, in any order; on the processor always.
template <class Kernel>
void for_each_row(const IndexBox& box, Kernel kernel)
{
#pragma omp parallel for collapse(2) schedule(static) num_threads(threads_for(box))
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      kernel(box.lo[0], box.hi[0], j, k);
}

namespace detail {

/// One partial result per row, combined in the order of rows: the sum does not depend on the number of threads.
template <class Row>
std::vector<double> row_results(const IndexBox& box, Row row)
{
  const int nj = box.extent(1);
  std::vector<double> partial(static_cast<std::size_t>(nj) * box.extent(2));
#pragma omp parallel for collapse(2) schedule(static) num_threads(threads_for(box))
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      partial[static_cast<std::size_t>(k - box.lo[2]) * nj + (j - box.lo[1])] = row(j, k);
  return partial;
}

}  // namespace detail

/// Sum of kernel(i, j, k) over the cells of this rank's box.
template <class Kernel>
double sum_cells(const IndexBox& box, Kernel kernel)
{
#ifdef __CUDACC__
  const auto partial = launch_row_sums(box, kernel);
#else
  const auto partial = detail::row_results(box, [&](int j, int k) {
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (int i = box.lo[0]; i < box.hi[0]; ++i)
      sum += kernel(i, j, k);
    return sum;
  });
#endif
  double sum = 0.0;
  for (const double s : partial)
    sum += s;
  return sum;
}

/// Largest kernel(i, j, k) >= 0 over the cells of this rank's box; NaN when any value is NaN.
template <class Kernel>
double max_cells(const IndexBox& box, Kernel kernel)
{
#ifdef __CUDACC__
  const auto partial = launch_row_maxima(box, kernel);
#else
  const auto partial = detail::row_results(box, [&](int j, int k) {
    double largest = 0.0;
    double poison = 0.0;  // 0 * finite stays 0; 0 * NaN or infinity does not
#pragma omp simd reduction(max : largest) reduction(+ : poison)
    for (int i = box.lo[0]; i < box.hi[0]; ++i) {
      const double value = kernel(i, j, k);
      largest = largest > value ? largest : value;
      poison += 0.0 * value;
    }
    return largest + poison;
  });
#endif
  double largest = 0.0;
  for (const double m : partial) {
    if (!(m == m))
      return m;
    largest = std::max(largest, m);
  }
  return largest;
}

}  // namespace luff
