// SPDX-License-Identifier: BSD-3-Clause
// Any bytes are a mesh or are refused with a reason.  LUFF_FUZZ_ENDING: the kind of file, such as .stl.
#include <cstdlib>

#include "core/error.hpp"
#include "input_file.hpp"
#include "surface/readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace luff;
  static const std::string ending =
      std::getenv("LUFF_FUZZ_ENDING") != nullptr ? std::getenv("LUFF_FUZZ_ENDING") : ".stl";
  const auto file = fuzz::input_file("mesh" + ending, data, size);
  for (const surface::Repair repairing : {surface::Repair::Yes, surface::Repair::No})
    try {
      (void)surface::read_mesh(file, repairing);
    } catch (const InputError&) {
    }
  return 0;
}
