// SPDX-License-Identifier: BSD-3-Clause
// Asks the system about the terminal.
#include "output/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

namespace luff::output {

bool standard_output_is_terminal()
{
  // mpirun gives its first rank a terminal of its own as output wherever that goes, but never as input.
  return isatty(STDOUT_FILENO) == 1 && isatty(STDIN_FILENO) == 1;
}

int terminal_width()
{
  winsize size{};
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace luff::output
