// SPDX-License-Identifier: BSD-3-Clause
// Writes summary.json.
#include "output/summary.hpp"

#include "output/atomic_file.hpp"

namespace luff::output {

void write_summary(const RunFolder& folder, const nlohmann::ordered_json& summary)
{
  if (folder.writes())
    write_atomically(folder.file("summary.json"), summary.dump(2) + "\n");
}

}  // namespace luff::output
