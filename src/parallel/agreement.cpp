// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/agreement.hpp"

#include <thread>

namespace luff {

bool on_all_ranks(MPI_Comm comm, bool holds)
{
  int all = holds ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, comm);
  return all == 1;
}

bool all_ranks_arrive(MPI_Comm comm, std::chrono::seconds patience)
{
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(comm, &request);
  const auto deadline = std::chrono::steady_clock::now() + patience;
  int arrived = 0;
  while (arrived == 0 && std::chrono::steady_clock::now() < deadline) {
    MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return arrived != 0;
}

}  // namespace luff
