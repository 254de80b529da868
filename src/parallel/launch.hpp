// SPDX-License-Identifier: BSD-3-Clause
// What a kernel is to a compiler, and its launch on a GPU.  Fields are not yet allocated where a GPU reaches them: the
// `cuda` preset compiles all kernels, so that they keep to the rules; nothing runs them there yet.
#pragma once

#ifdef __CUDACC__
#define LUFF_KERNEL __host__ __device__
#else
#define LUFF_KERNEL
#endif
/// A function that kernels call: a call that is not inlined keeps the loop over cells from being vectorised.
#define LUFF_INLINE_KERNEL LUFF_KERNEL inline __attribute__((always_inline))


#ifdef __CUDACC__

#include <vector>

#include "parallel/index_box.hpp"

namespace luff {

namespace detail {

inline constexpr int threads_per_block = 128;

template <class Kernel>
__global__ void run_cell(IndexBox box, Kernel kernel)
{
  const int i = box.lo[0] + static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (i < box.hi[0])
    kernel(i, box.lo[1] + static_cast<int>(blockIdx.y), box.lo[2] + static_cast<int>(blockIdx.z));
}

/// One thread to a row, rows in the order of the host's: the same sums.
template <class Kernel, class Combine>
__global__ void run_row(IndexBox box, Kernel kernel, Combine combine, double* result)
{
  const int nj = box.hi[1] - box.lo[1];
  const int row = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (row >= nj * (box.hi[2] - box.lo[2]))
    return;
  double value = 0.0;
  for (int i = box.lo[0]; i < box.hi[0]; ++i)
    value = combine(value, kernel(i, box.lo[1] + row % nj, box.lo[2] + row / nj));
  result[row] = value;
}

struct Sum {
  __device__ double operator()(double a, double b) const { return a + b; }
};
/// NaN when any value is NaN.
struct Maximum {
  __device__ double operator()(double a, double b) const { return b > a || b != b ? b : a; }
};

template <class Kernel, class Combine>
std::vector<double> launch_rows(const IndexBox& box, Kernel kernel, Combine combine)
{
  const int rows = box.extent(1) * box.extent(2);
  std::vector<double> result(rows);
  double* on_device = nullptr;
  cudaMalloc(&on_device, rows * sizeof(double));
  run_row<<<(rows + threads_per_block - 1) / threads_per_block, threads_per_block>>>(box, kernel, combine, on_device);
  cudaMemcpy(result.data(), on_device, rows * sizeof(double), cudaMemcpyDeviceToHost);
  cudaFree(on_device);
  return result;
}

}  // namespace detail

template <class Kernel>
void launch_cells(const IndexBox& box, Kernel kernel)
{
  if (box.volume() == 0)
    return;
  const dim3 blocks((box.extent(0) + detail::threads_per_block - 1) / detail::threads_per_block, box.extent(1),
                    box.extent(2));
  detail::run_cell<<<blocks, detail::threads_per_block>>>(box, kernel);
}

template <class Kernel>
std::vector<double> launch_row_sums(const IndexBox& box, Kernel kernel)
{
  return detail::launch_rows(box, kernel, detail::Sum{});
}

template <class Kernel>
std::vector<double> launch_row_maxima(const IndexBox& box, Kernel kernel)
{
  return detail::launch_rows(box, kernel, detail::Maximum{});
}

}  // namespace luff

#endif
