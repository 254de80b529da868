// SPDX-License-Identifier: BSD-3-Clause
// Tells where in the case file the input stands that is refused.
#pragma once

#include <utility>

#include "config/mark.hpp"
#include "core/error.hpp"

namespace luff::simulation {

/// What `build` returns; the InputError that it throws is led by the place of the table that it builds from.
template <class Build>
auto refusing_at(const config::Mark& mark, Build build)
{
  try {
    return build();
  } catch (const InputError& error) {
    if (mark.text.empty())
      throw;
    throw InputError(fmt::format("{}: {}", mark.text, error.what()));
  }
}

}  // namespace luff::simulation
