// SPDX-License-Identifier: BSD-3-Clause
#include "operators/vector_algebra.hpp"

#include "parallel/for_each.hpp"

namespace luff::operators {

void set_multiple(const IndexBox& owned, double factor, const View3<const double>& v, const View3<double>& result)
{
  for (int d = 0; d < 3; ++d) {
    const View<const double> x = v[d];
    const View<double> y = result[d];
    for_each_cell(owned, [=] LUFF_KERNEL(int i, int j, int k) { y(i, j, k) = factor * x(i, j, k); });
  }
}

void add_multiple(const IndexBox& owned, double factor, const View3<const double>& v, const View3<double>& result)
{
  for (int d = 0; d < 3; ++d) {
    const View<const double> x = v[d];
    const View<double> y = result[d];
    for_each_cell(owned, [=] LUFF_KERNEL(int i, int j, int k) { y(i, j, k) += factor * x(i, j, k); });
  }
}

}  // namespace luff::operators
