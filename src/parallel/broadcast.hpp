// SPDX-License-Identifier: BSD-3-Clause
// What the first rank knows, told to all.
#pragma once

#include <string>

#include <mpi.h>

namespace luff {

/// The first rank's text.  Collective.
[[nodiscard]] std::string broadcast(MPI_Comm comm, std::string text);

}  // namespace luff
