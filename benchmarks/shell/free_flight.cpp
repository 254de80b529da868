// SPDX-License-Identifier: BSD-3-Clause
// What schemes in time keep of a free shell's energy and momentum: a table of steps.
// Usage: benchmark_shell_free_flight newmark|generalised-alpha|midpoint STEPS DT [consistent|lumped]
#include <cstdio>
#include <cstdlib>
#include <string>

#include "support/free_flight.hpp"

namespace {

luff::shell::TimeScheme scheme_named(const std::string& name)
{
  if (name == "midpoint")
    return luff::shell::TimeScheme::midpoint();
  if (name == "generalised-alpha")
    return luff::shell::TimeScheme::generalised_alpha(0.8);
  return luff::shell::TimeScheme::newmark();
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc < 4) {
    std::fprintf(stderr, "usage: %s newmark|generalised-alpha|midpoint STEPS DT [consistent|lumped]\n", argv[0]);
    return 2;
  }
  const int steps = std::atoi(argv[2]);
  const double dt = std::atof(argv[3]);
  luff::test::FreeFlight flight(scheme_named(argv[1]), argc > 4 && std::string(argv[4]) == "lumped");
  std::printf("step,t,energy,momentum,angular_momentum,elastic_part,newton_iterations\n");
  for (int n = 1; n <= steps; ++n) {
    flight.step(dt);
    const auto errors = flight.errors();
    const auto& ledger = flight.dynamics().ledger();
    std::printf("%d,%.9g,%.6e,%.6e,%.6e,%.4f,%ld\n", n, n * dt, errors.energy, errors.momentum, errors.angular_momentum,
                ledger.elastic / (ledger.elastic + ledger.kinetic), flight.iterations());
  }
}
