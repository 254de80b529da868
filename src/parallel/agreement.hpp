// SPDX-License-Identifier: BSD-3-Clause
// What ranks must agree on before they go on together.
#pragma once

#include <chrono>

#include <mpi.h>

namespace luff {

/// Whether it holds on every rank.  Collective.
[[nodiscard]] bool on_all_ranks(MPI_Comm comm, bool holds);

/// Whether every rank calls this within the time given.  An error that all ranks met brings all of them here; one that
/// some met alone, such as a disk that refuses to be written, must not leave the others waiting.  After a false one
/// nothing collective may follow on this communicator.
[[nodiscard]] bool all_ranks_arrive(MPI_Comm comm, std::chrono::seconds patience = std::chrono::seconds(3));

}  // namespace luff
