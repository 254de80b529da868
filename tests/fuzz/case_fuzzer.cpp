// SPDX-License-Identifier: BSD-3-Clause
// Any bytes are a case or are refused with a reason; a case written out is the same case.
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "config/case.hpp"
#include "core/error.hpp"
#include "input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace luff;
  try {
    const config::Case options = config::load_case(fuzz::input_file("case.toml", data, size));
    std::ostringstream text;
    config::write_case(options, text);
    const std::string written = text.str();
    std::ostringstream again;
    config::write_case(config::load_case(fuzz::input_file(
                           "again.toml", reinterpret_cast<const std::uint8_t*>(written.data()), written.size())),
                       again);
    if (again.str() != written) {
      std::fprintf(stderr, "a case changed when it was written and read again\n");
      std::abort();
    }
  } catch (const InputError&) {
  }
  return 0;
}
