// SPDX-License-Identifier: BSD-3-Clause
// Case files made by tests: a small valid one, changed in one place, in a folder that goes away.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "config/case.hpp"
#include "core/error.hpp"

#include "support/program.hpp"

namespace luff::config {

inline const std::filesystem::path data_folder = std::filesystem::path(LUFF_SOURCE_DIR) / "tests/unit/config/data";

using test::contents_of;
using TemporaryFolder = test::WorkFolder;

/// A valid case in 41 lines; the tests of errors count them.
inline const std::string small_case = R"toml(title = "Small"
[time]
end = 2.0
step = 0.01
[fluid]
density = 1.0
viscosity = 0.01
initial.velocity = [1, "sin(y)", 0]
[grid]
x = { from = -2, to = 8, cells = 100, refine = { from = -0.5, to = 1.5, spacing = 0.04 } }
y = { from = -4, to = 4, cells = 80 }
z = { from = -2, to = 2, cells = 40 }
[boundary]
x_min = { type = "velocity", value = [1, 0, 0] }
x_max = { type = "outflow" }
y_min = { type = "slip" }
y_max = { type = "slip" }
z_min = { type = "periodic" }
z_max = { type = "periodic" }
[[shell]]
name = "flag"
mesh = { shape = "rectangle", origin = [0, 0, -0.5], a = [1, 0, 0], b = [0, 0, 1], divisions = [20, 10] }
thickness = 0.01
density = 100.0
material = { model = "saint-venant-kirchhoff", young = 1e6, poisson = 0.4 }
[[shell.support]]
where = { edge = [[0, 0, -0.5], [0, 0, 0.5]] }
type = "clamped"
[[shell.load]]
where = { point = [1, 0, 0] }
force = [0, "40*t", 0]
[[body]]
name = "plate"
mesh = { shape = "rectangle", origin = [3, 0, -0.5], a = [0, 1, 0], b = [0, 0, 1], divisions = [8, 4] }
motion = { type = "prescribed", translation = ["cos(t)", 0, 0] }
[output]
fields = { every = 0.5 }
[[output.probe]]
name = "tip"
shell = "flag"
point = [1, 0, 0]
)toml";

/// The text with its only occurrence of `from` replaced.
inline std::string changed(std::string text, const std::string& from, const std::string& to)
{
  const auto position = text.find(from);
  EXPECT_NE(position, std::string::npos) << "nothing to change: " << from;
  EXPECT_EQ(text.find(from, position + 1), std::string::npos) << "more than one place to change: " << from;
  return text.replace(position, from.size(), to);
}

/// What is said about a case file, with its folder left out; "" if nothing is wrong.
inline std::string complaint_about(const std::string& text, const Overrides& overrides = {})
{
  const TemporaryFolder folder;
  const auto file = folder.write("case.toml", text);
  try {
    load_case(file, overrides);
    return "";
  } catch (const InputError& error) {
    std::string message = error.what();
    const std::string prefix = folder.path().string() + "/";
    for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
      message.erase(at, prefix.size());
    return message;
  }
}

inline Case load_text(const std::string& text, const Overrides& overrides = {})
{
  const TemporaryFolder folder;
  return load_case(folder.write("case.toml", text), overrides);
}

}  // namespace luff::config
