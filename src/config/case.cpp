// SPDX-License-Identifier: BSD-3-Clause
// Read and write case files.
#include "config/case.hpp"

#include <ostream>

#include "config/describe.hpp"
#include "config/document.hpp"
#include "config/reader.hpp"
#include "config/reference.hpp"
#include "config/resolution.hpp"
#include "config/writer.hpp"

namespace luff::config {

Case load_case(const std::filesystem::path& file, const Overrides& overrides)
{
  Document document(file);
  for (const auto& assignment : overrides.sets)
    document.set(assignment);

  Case options;
  Reader reader(document);
  reader.read(options);
  reader.issues().throw_if_any();

  if (overrides.resolution != 1.0) {
    Resolution resolution(overrides.resolution);
    describe(resolution, options);
  }
  return options;
}

void write_case(const Case& options, std::ostream& out)
{
  Case copy = options;
  out << Writer().write(copy);
}

void write_reference(std::ostream& out, Format format)
{
  Case defaults;
  out << Reference(format).write(defaults);
}

}  // namespace luff::config
