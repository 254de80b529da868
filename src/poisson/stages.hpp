// SPDX-License-Identifier: BSD-3-Clause
// Runs stages of work over the planes of a level, each stage one plane behind the one before.
#pragma once

#include <algorithm>
#include <array>
#include <functional>

#include <omp.h>

namespace luff::poisson {

/// work(stage, plane) for every stage and plane, where a stage may read planes k - 1 ... k + 1 of the stage before.
///
/// Alone, a thread follows a wave: while plane k is in cache all stages pass over it.  Several threads first do what
/// needs nothing beyond their slab, then the wedges between slabs, so that results do not depend on their number.
template <class Work>
void run_stages(int begin, int end, int stages, int threads, Work work)
{
  threads = std::min(threads, (end - begin) / (2 * stages));
  if (threads <= 1) {
    for (int front = begin; front < end + stages - 1; ++front)
      for (int s = 0; s < stages; ++s)
        if (const int k = front - s; k >= begin && k < end)
          work(s, k);
    return;
  }
#pragma omp parallel num_threads(threads)
  {
    const int t = omp_get_thread_num();
    const int T = omp_get_num_threads();
    const auto slab = [&](int n) { return begin + static_cast<int>(static_cast<long>(end - begin) * n / T); };
    const int low = slab(t);
    const int high = slab(t + 1);
    for (int front = low; front < high + stages - 1; ++front)
      for (int s = 0; s < stages; ++s) {
        const int k = front - s;
        if (k >= (t == 0 ? low : low + s) && k < (t == T - 1 ? high : high - s) && k < high)
          work(s, k);
      }
#pragma omp barrier
    // The wedge around the slab's low edge: stage s still lacks the planes within s of it.
    if (t > 0)
      for (int s = 1; s < stages; ++s)
        for (int k = low - s; k < low + s; ++k)
          work(s, k);
  }
}

/// The same where stage s also reads, beyond both ends, what share(s - 1) brings there from the stage before: from
/// other ranks, or from the opposite end.  The wave passes over what needs nothing from beyond; then the wedges that
/// are left at the ends, stage by stage.  On one thread.
template <class Work, class Share>
void run_stages_between_halos(int begin, int end, int stages, Work work, Share share)
{
  const bool room = end - begin >= 2 * stages;
  for (int front = begin; room && front < end; ++front)
    for (int s = 0; s < stages; ++s)
      if (const int k = front - s; k >= begin + s && k < end - s)
        work(s, k);
  for (int s = 0; s < stages; ++s) {
    const int low = room ? begin + s : end;
    const int high = room ? end - s : end;
    for (int k = begin; k < low; ++k)
      work(s, k);
    for (int k = high; k < end; ++k)
      work(s, k);
    share(s);
  }
}

}  // namespace luff::poisson
