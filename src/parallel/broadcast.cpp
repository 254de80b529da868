// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/broadcast.hpp"

namespace luff {

std::string broadcast(MPI_Comm comm, std::string text)
{
  auto length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, comm);
  text.resize(length);
  MPI_Bcast(text.data(), length, MPI_CHAR, 0, comm);
  return text;
}

}  // namespace luff
