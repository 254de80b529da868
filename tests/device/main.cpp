// SPDX-License-Identifier: BSD-3-Clause
// Kernels on a GPU against the same on the processor.
//
// Usage: device_kernels_processor write FILE    what it finds
//        device_kernels_gpu compare FILE        finds the same within tolerances, cells on the GPU, or fails
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>

#include <mpi.h>

#include "device/findings.hpp"
#include "support/curvilinear.hpp"
#include "support/faces.hpp"

namespace luff::test {
namespace {

Findings find_all()
{
  Findings found;
  const Index3 cells{45, 30, 22};
  const std::array<bool, 3> periodic{false, false, true};
  const auto straight = [&](double amplitude) {
    return std::array{stretched_faces(0.0, 3.0, cells[0], amplitude), stretched_faces(0.0, 2.0, cells[1], -amplitude),
                      stretched_faces(0.0, 1.0, cells[2], amplitude)};
  };
  find_operators("uniform", {MPI_COMM_WORLD, straight(0.0), periodic}, found);
  find_operators("rectilinear", {MPI_COMM_WORLD, straight(0.3), periodic}, found);
  find_operators("curvilinear", {MPI_COMM_WORLD, cells, mapped_nodes(cells, Waved{}), periodic}, found);
  find_operators("left-handed", {MPI_COMM_WORLD, cells, mapped_nodes(cells, Mirrored<Waved>{}), {}}, found);
  find_flows(found);
  return found;
}

void write(const Findings& found, const char* path)
{
  std::ofstream file(path, std::ios::binary);
  for (const Finding& f : found)
    file.write(reinterpret_cast<const char*>(f.values.data()), sizeof(double) * f.values.size());
}

/// Reads what should have been found and prints what differs.  Whether nothing differs by more than its tolerance.
bool agree(const Findings& found, const char* path)
{
  std::ifstream file(path, std::ios::binary);
  bool all = true;
  for (const Finding& f : found) {
    std::vector<double> expected(f.values.size());
    file.read(reinterpret_cast<char*>(expected.data()), sizeof(double) * expected.size());
    double difference = 0.0;
    double scale = 0.0;
    for (std::size_t n = 0; n < expected.size(); ++n) {
      difference = std::fmax(difference, std::abs(f.values[n] - expected[n]));
      scale = std::fmax(scale, std::abs(expected[n]));
    }
    const bool same = f.values == expected;
    const bool good = file && scale > 0.0 && (same || difference <= f.tolerance * scale) &&
                      std::isfinite(std::accumulate(f.values.begin(), f.values.end(), 0.0));
    std::printf("%-32s %9zu values  %s %.2g\n", f.name.c_str(), f.values.size(),
                same   ? "the same bits, differ by"
                : good ? "differ by"
                       : "FAILED: differ by",
                difference / scale);
    all = all && good;
  }
  return all;
}

int run(const std::string& act, const char* path)
{
  const int architecture = architecture_of_cells();
  if (architecture > 0)
    std::printf("cells run on a GPU of architecture %d\n", architecture);
  else
    std::printf("cells run on the processor\n");
  if (act == "write")
    write(find_all(), path);
  else if (architecture == 0 || !agree(find_all(), path))
    return 1;
  return 0;
}

}  // namespace
}  // namespace luff::test

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  int status = 2;
  try {
    if (argc == 3)
      status = luff::test::run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::printf("FAILED: %s\n", error.what());
    status = 1;
  }
  MPI_Finalize();
  return status;
}
