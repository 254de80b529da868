// SPDX-License-Identifier: BSD-3-Clause
// Chooses the acceleration by name and checks its numbers.
#include "coupling/acceleration.hpp"

#include "core/error.hpp"
#include "coupling/aitken.hpp"
#include "coupling/constant_relaxation.hpp"
#include "coupling/quasi_newton.hpp"

namespace luff::coupling {

namespace {

void check(const AccelerationOptions& o)
{
  if (!(o.relaxation > 0 && o.relaxation <= 1))
    fail_input("coupling.relaxation = {}: allowed is 0 < relaxation <= 1; try 0.5, less for light shells",
               o.relaxation);
  if (!(o.largest_factor > 0))
    fail_input("coupling.largest_factor = {}: must be positive; try 1", o.largest_factor);
  if (o.reused_steps < 0)
    fail_input("coupling.reused_steps = {}: must not be negative; try 2", o.reused_steps);
  if (!(o.filter > 0 && o.filter < 1))
    fail_input("coupling.filter = {}: allowed is 0 < filter < 1; try 1e-2", o.filter);
}

}  // namespace

std::unique_ptr<Acceleration> make_acceleration(const AccelerationOptions& options)
{
  check(options);
  switch (options.method) {
    case AccelerationMethod::Constant:
      return std::make_unique<ConstantRelaxation>(options.relaxation);
    case AccelerationMethod::Aitken:
      return std::make_unique<Aitken>(options.relaxation, options.largest_factor);
    case AccelerationMethod::QuasiNewton:
      return std::make_unique<QuasiNewton>(options.relaxation, options.reused_steps, options.filter);
  }
  fail_input("coupling.acceleration: unknown method");
}

}  // namespace luff::coupling
