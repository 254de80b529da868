// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/build.hpp"
#include "simulation/check_flow.hpp"
#include "simulation/check_output.hpp"

namespace luff::simulation {

coupling::AccelerationOptions build_acceleration(const config::CouplingOptions& options)
{
  coupling::AccelerationOptions result;
  result.relaxation = options.relaxation;
  switch (options.acceleration) {
    case config::CouplingAcceleration::QuasiNewton:
      result.method = coupling::AccelerationMethod::QuasiNewton;
      break;
    case config::CouplingAcceleration::Aitken:
      result.method = coupling::AccelerationMethod::Aitken;
      break;
    case config::CouplingAcceleration::Constant:
      result.method = coupling::AccelerationMethod::Constant;
      break;
  }
  return result;
}

CouplingPolicy build_policy(const config::CouplingOptions& options)
{
  CouplingPolicy policy;
  policy.criterion.tolerance = options.tolerance;
  policy.criterion.max_iterations = options.max_iterations;
  if (options.scheme == config::CouplingScheme::Loose) {
    policy.scheme = Scheme::Loose;
    policy.criterion.max_iterations = 1;
  }
  return policy;
}

std::unique_ptr<Simulation> build_simulation(MPI_Comm comm, const config::Case& options)
{
  auto structure = build_structure(options);
  check_sheets_inside(options, *structure);
  auto surroundings = build_surroundings(comm, options, *structure);
  if (auto* flow = surroundings->flow()) {
    check_sheets_inside(flow->grid(), options, *structure);
    check_output(flow->grid(), options.output, *structure);
  }
  return std::make_unique<Simulation>(
      Clock(options.time.end, options.time.step, options.time.cfl), std::move(surroundings), std::move(structure),
      coupling::make_acceleration(build_acceleration(options.coupling)), build_policy(options.coupling));
}

}  // namespace luff::simulation
