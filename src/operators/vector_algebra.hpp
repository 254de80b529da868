// SPDX-License-Identifier: BSD-3-Clause
// Linear combinations of vector fields.
#pragma once

#include "parallel/field.hpp"

namespace luff::operators {

/// result <- factor v in every owned cell; v may be the result.
void set_multiple(const IndexBox& owned, double factor, const View3<const double>& v, const View3<double>& result);

/// result <- result + factor v in every owned cell.
void add_multiple(const IndexBox& owned, double factor, const View3<const double>& v, const View3<double>& result);

}  // namespace luff::operators
