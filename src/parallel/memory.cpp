// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/memory.hpp"

#include <cstdlib>
#include <new>

#include "core/error.hpp"

namespace luff {

#ifdef __CUDACC__

void* allocate_for_kernels(std::size_t bytes)
{
  void* memory = nullptr;
  const cudaError_t error = cudaMallocManaged(&memory, bytes);
  if (error == cudaErrorMemoryAllocation)
    throw std::bad_alloc();
  if (error != cudaSuccess)
    fail_run("no memory for kernels on a GPU: {}", cudaGetErrorString(error));
  return memory;
}

void free_for_kernels(void* memory) noexcept
{
  cudaFree(memory);  // fails only after an error that a launch has told of, or when the program ends
}

#else

void* allocate_for_kernels(std::size_t bytes)
{
  constexpr std::size_t line = 64;
  void* memory = std::aligned_alloc(line, (bytes + line - 1) / line * line);
  if (memory == nullptr)
    throw std::bad_alloc();
  return memory;
}

void free_for_kernels(void* memory) noexcept
{
  std::free(memory);
}

#endif

}  // namespace luff
