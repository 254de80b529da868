// SPDX-License-Identifier: BSD-3-Clause
// The .pvd list of instants.
#include <fmt/format.h>

#include "output/atomic_file.hpp"
#include "output/series.hpp"

namespace luff::output {

TimeIndex::TimeIndex(const RunFolder& folder, std::string name, const EarlierOutput* earlier)
    : pvd_file_(folder.file(name + ".pvd")), writes_(folder.writes()), series_{name, {}}
{
  const SeriesMark* before = earlier != nullptr ? earlier->of(series_.name) : nullptr;
  if (before == nullptr)
    return;
  for (const Instant& instant : before->instants) {
    std::error_code error;
    const std::filesystem::path file = std::filesystem::relative(earlier->folder / instant.file, folder.path(), error);
    series_.instants.push_back({instant.time, error ? instant.file : file.string()});
  }
  write();
}

void TimeIndex::add(double time, const std::string& file)
{
  series_.instants.push_back({time, file});
  write();
}

void TimeIndex::write() const
{
  if (!writes_)
    return;
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const Instant& instant : series_.instants)
    text += fmt::format("    <DataSet timestep=\"{}\" file=\"{}\"/>\n", instant.time, instant.file);
  text += "  </Collection>\n</VTKFile>\n";
  write_atomically(pvd_file_, text);
}

}  // namespace luff::output
