// SPDX-License-Identifier: BSD-3-Clause
// What standard output is connected to.
#pragma once

namespace luff::output {

/// True when a person may be watching: a live line makes sense.
bool standard_output_is_terminal();

/// Columns of the terminal, 80 if it does not say.
int terminal_width();

/// Moves to the start of the line and empties it.
inline constexpr const char* clear_line = "\r\033[K";

}  // namespace luff::output
