// SPDX-License-Identifier: BSD-3-Clause
// What a kernel is to a compiler.
#pragma once

#ifdef __CUDACC__
#define LUFF_KERNEL __host__ __device__
#else
#define LUFF_KERNEL
#endif
/// A function that kernels call: a call that is not inlined keeps the loop over cells from being vectorised.
#define LUFF_INLINE_KERNEL LUFF_KERNEL inline __attribute__((always_inline))
