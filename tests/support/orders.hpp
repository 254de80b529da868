// SPDX-License-Identifier: BSD-3-Clause
// What tests of the order of accuracy measure and expect.
#pragma once

#include <iostream>

#include <gtest/gtest.h>

#include "support/flow.hpp"

namespace luff::test {

struct Errors {
  double velocity = 0.0;
  double pressure = 0.0;
  double divergence = 0.0;
};

/// Velocity and pressure of the orders given or better.
inline void expect_orders(const Errors& coarse, const Errors& fine, double velocity_order, double pressure_order = 1.9)
{
  const double velocity = observed_order(coarse.velocity, fine.velocity);
  const double pressure = observed_order(coarse.pressure, fine.pressure);
  std::cout << "  order of velocity " << velocity << ", of pressure " << pressure << "; divergence "
            << std::max(coarse.divergence, fine.divergence) << '\n';
  EXPECT_GE(velocity, velocity_order);
  EXPECT_GE(pressure, pressure_order);
  EXPECT_LE(std::max(coarse.divergence, fine.divergence), 1e-13);
}

}  // namespace luff::test
