// SPDX-License-Identifier: BSD-3-Clause
// Rules between different tables of a case.
#pragma once

#include "config/options.hpp"
#include "config/schema.hpp"

namespace luff::config {

void state_case_rules(Schema& s, const Case& options);

}  // namespace luff::config
