// SPDX-License-Identifier: BSD-3-Clause
// The .pvd list of instants.
#include <fmt/format.h>

#include "output/atomic_file.hpp"
#include "output/series.hpp"

namespace luff::output {

void TimeIndex::add(double time, const std::string& file)
{
  instants_.push_back({time, file});
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const Instant& instant : instants_)
    text += fmt::format("    <DataSet timestep=\"{}\" file=\"{}\"/>\n", instant.time, instant.file);
  text += "  </Collection>\n</VTKFile>\n";
  write_atomically(pvd_file_, text);
}

}  // namespace luff::output
