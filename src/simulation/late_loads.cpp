// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/late_loads.hpp"

namespace luff::simulation {

StepLoads loads_of_step(Simulation& simulation)
{
  const Structure& structure = simulation.structure();
  const fluid::PressureLoads pressure = simulation.surroundings().pressure_loads();
  return {structure.loads(), structure.felt(pressure.at_end), structure.felt(pressure.in_middle)};
}

LateSums::LateSums(const TimeStep& step, std::vector<double> at_end, const std::vector<double>& pressure_at_end,
                   std::vector<double> pressure)
    : t_(step.t_new), dt_(step.dt), at_end_(std::move(at_end)), rest_(at_end_), pressure_(std::move(pressure))
{
  for (std::size_t n = 0; n < rest_.size(); ++n)
    rest_[n] -= pressure_at_end[n];
}

std::vector<double> LateSums::interpolated(const TimeStep& next, std::span<const double> next_pressure) const
{
  const double before = next.dt / (dt_ + next.dt);
  std::vector<double> sums = rest_;
  for (std::size_t n = 0; n < sums.size(); ++n)
    sums[n] += before * pressure_[n] + (1.0 - before) * next_pressure[n];
  return sums;
}

std::vector<double> LateSums::numbers() const
{
  std::vector<double> all{t_, dt_};
  for (const std::vector<double>* part : {&at_end_, &rest_, &pressure_})
    all.insert(all.end(), part->begin(), part->end());
  return all;
}

std::optional<LateSums> LateSums::of(std::span<const double> numbers)
{
  if (numbers.empty())
    return std::nullopt;
  LateSums late;
  late.t_ = numbers[0];
  late.dt_ = numbers[1];
  const std::size_t size = (numbers.size() - 2) / 3;
  auto from = numbers.begin() + 2;
  for (std::vector<double>* part : {&late.at_end_, &late.rest_, &late.pressure_}) {
    part->assign(from, from + static_cast<std::ptrdiff_t>(size));
    from += static_cast<std::ptrdiff_t>(size);
  }
  return late;
}

}  // namespace luff::simulation
