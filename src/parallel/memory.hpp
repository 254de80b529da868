// SPDX-License-Identifier: BSD-3-Clause
// Memory that kernels read and write: the processor's, or what it shares with a GPU where nvcc compiles luff.
#pragma once

#include <cstddef>
#include <vector>

namespace luff {

/// Memory without values, aligned to 64 bytes.  Throws std::bad_alloc; compiled by nvcc, RunError without a GPU.
[[nodiscard]] void* allocate_for_kernels(std::size_t bytes);
void free_for_kernels(void* memory) noexcept;

template <class T>
struct KernelAllocator {
  using value_type = T;
  KernelAllocator() = default;
  template <class U>
  KernelAllocator(const KernelAllocator<U>&)  // NOLINT: allocators of two types are one
  {
  }
  [[nodiscard]] T* allocate(std::size_t n) { return static_cast<T*>(allocate_for_kernels(n * sizeof(T))); }
  void deallocate(T* p, std::size_t) noexcept { free_for_kernels(p); }
  friend bool operator==(const KernelAllocator&, const KernelAllocator&) { return true; }
};

/// A list whose values kernels read.
template <class T>
using KernelVector = std::vector<T, KernelAllocator<T>>;

}  // namespace luff
