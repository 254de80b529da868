// SPDX-License-Identifier: BSD-3-Clause
// Launches of kernels on a GPU, in what nvcc compiles (preset `cuda`): fields lie in memory that processor and GPU
// share, for_each_cell, sum_cells and max_cells run on the GPU, and the processor waits for them.  All else stays on
// the processor.
#pragma once

#ifdef __CUDACC__

#include "core/error.hpp"
#include "parallel/index_box.hpp"
#include "parallel/kernel.hpp"
#include "parallel/memory.hpp"

namespace luff {

namespace detail {

inline constexpr int threads_per_block = 128;

/// Waits for the kernel just launched.  Throws RunError when it could not run.
inline void finish_kernel()
{
  cudaError_t error = cudaGetLastError();
  if (error == cudaSuccess)
    error = cudaDeviceSynchronize();
  if (error != cudaSuccess)
    fail_run("a kernel did not run on the GPU: {}", cudaGetErrorString(error));
}

template <class Kernel>
__global__ void run_cell(IndexBox box, Kernel kernel)
{
  const int i = box.lo[0] + static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (i < box.hi[0])
    kernel(i, box.lo[1] + static_cast<int>(blockIdx.y), box.lo[2] + static_cast<int>(blockIdx.z));
}

/// One thread to a row, from its first cell to its last; the processor's vector units add in another order.
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
KernelVector<double> launch_rows(const IndexBox& box, Kernel kernel, Combine combine)
{
  const int rows = box.extent(1) * box.extent(2);
  KernelVector<double> result(rows);
  if (rows == 0)
    return result;
  const int blocks = (rows + threads_per_block - 1) / threads_per_block;
  run_row<<<blocks, threads_per_block>>>(box, kernel, combine, result.data());
  finish_kernel();
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
  detail::finish_kernel();
}

template <class Kernel>
KernelVector<double> launch_row_sums(const IndexBox& box, Kernel kernel)
{
  return detail::launch_rows(box, kernel, detail::Sum{});
}

template <class Kernel>
KernelVector<double> launch_row_maxima(const IndexBox& box, Kernel kernel)
{
  return detail::launch_rows(box, kernel, detail::Maximum{});
}

}  // namespace luff

#endif
