// SPDX-License-Identifier: BSD-3-Clause
// Numbers too small for full precision.
#pragma once

#include <omp.h>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace luff {

/// Takes denormal numbers for zero on all threads from now on.  Corrections of the pressure decay into them far from a
/// sheet, where each operation would cost a hundred times as much (measured: steps of 9 s instead of 0.03 s).
inline void flush_denormals()
{
#if defined(__SSE2__)
#pragma omp parallel
  _mm_setcsr(_mm_getcsr() | 0x8040);  // flush-to-zero and denormals-are-zero
#endif
}

}  // namespace luff
