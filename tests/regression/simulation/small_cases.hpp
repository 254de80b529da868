// SPDX-License-Identifier: BSD-3-Clause
// Small valid cases, which tests run or spoil in one place.
#pragma once

#include <string>

#include "support/program.hpp"

namespace luff::test {

/// A flag in a stream on a coarse grid, five steps; the tests of bad input count its lines.
inline const std::string small_flag = R"toml(title = "Small flag"
[time]
end = 0.1
step = 0.02
[fluid]
density = 1.0
viscosity = 0.01
initial.velocity = [1.0, 0.0, 0.0]
[grid]
x = { from = -1.0, to = 2.0, cells = 24 }
y = { from = -1.0, to = 1.0, cells = 16 }
z = { from = -0.5, to = 0.5, cells = 8 }
[boundary]
x_min = { type = "velocity", value = [1.0, 0.0, 0.0] }
x_max = { type = "outflow" }
y_min = { type = "slip" }
y_max = { type = "slip" }
z_min = { type = "slip" }
z_max = { type = "slip" }
[[shell]]
name = "flag"
mesh = { shape = "rectangle", origin = [0, 0.01, -0.3], a = [0.8, 0, 0], b = [0, 0, 0.6], divisions = [6, 4] }
rotate = { axis = [0, 0, 1], angle = 10.0, about = [0, 0.01, 0] }
thickness = 0.01
density = 100.0
material = { model = "saint-venant-kirchhoff", young = 5000.0, poisson = 0.3 }
[[shell.support]]
where = { edge = [[0, 0.01, -0.3], [0, 0.01, 0.3]] }
type = "hinged"
[output]
fields = { every = 0.05 }
shells = { every = 0.05 }
[[output.probe]]
name = "tip"
shell = "flag"
point = [0.8, 0.15, 0.0]
[[output.probe]]
name = "wake"
point = [1.5, 0.0, 0.0]
)toml";

/// What can be asked of the small flag's output besides.
inline const std::string all_output = R"toml([output.statistics]
start = 0.04
every = 0.06
[[output.rake]]
name = "wake"
from = [1.5, 0.0, 0.0]
to = [1.5, 0.8, 0.3]
points = 5
every = 0.04
[[output.section]]
name = "span"
shell = "flag"
axis = [0, 0, 1]
bins = 3
every = 0.04
[[output.slice]]
name = "middle"
point = [0, 0, 0.1]
normal = [0, 0, 1]
every = 0.05
[[output.isosurface]]
name = "slow"
of = "velocity"
value = 0.5
what = ["pressure", "q_criterion"]
every = 0.05
)toml";

/// Two flags in a stream that loads press together from both sides; they meet within 0.62.
inline const std::string two_flags_that_meet = R"toml(title = "Two flags that meet"
[time]
end = 0.8
step = 0.02
[fluid]
density = 1.0
viscosity = 0.01
initial.velocity = [1.0, 0.0, 0.0]
[grid]
x = { from = -1.0, to = 2.0, cells = 24 }
y = { from = -1.0, to = 1.0, cells = 16 }
z = { from = -0.5, to = 0.5, cells = 8 }
[boundary]
x_min = { type = "velocity", value = [1.0, 0.0, 0.0] }
x_max = { type = "outflow" }
y_min = { type = "slip" }
y_max = { type = "slip" }
z_min = { type = "slip" }
z_max = { type = "slip" }
[contact]
distance = 0.05
stiffness = 10.0
[[shell]]
name = "lower"
mesh = { shape = "rectangle", origin = [0, -0.11, -0.3], a = [0.8, 0, 0], b = [0, 0, 0.6], divisions = [6, 4] }
thickness = 0.01
density = 100.0
material = { model = "saint-venant-kirchhoff", young = 5000.0, poisson = 0.3 }
[[shell.support]]
where = { edge = [[0, -0.11, -0.3], [0, -0.11, 0.3]] }
type = "hinged"
[[shell.load]]
where = { all = true }
traction = [0.0, 0.5, 0.0]
[[shell]]
name = "upper"
mesh = { shape = "rectangle", origin = [0, 0.11, -0.3], a = [0.8, 0, 0], b = [0, 0, 0.6], divisions = [6, 4] }
thickness = 0.01
density = 100.0
material = { model = "saint-venant-kirchhoff", young = 5000.0, poisson = 0.3 }
[[shell.support]]
where = { edge = [[0, 0.11, -0.3], [0, 0.11, 0.3]] }
type = "hinged"
[[shell.load]]
where = { all = true }
traction = [0.0, -0.5, 0.0]
[[output.probe]]
name = "lower"
shell = "lower"
point = [0.8, -0.11, 0.0]
[[output.probe]]
name = "upper"
shell = "upper"
point = [0.8, 0.11, 0.0]
)toml";

/// The edge of a strip pulled down, without a fluid.
inline const std::string small_strip = R"toml(title = "Small strip"
[time]
end = 0.5
step = 0.05
[[shell]]
name = "strip"
mesh = { shape = "rectangle", origin = [0, 0, 0], a = [1, 0, 0], b = [0, 0.25, 0], divisions = [4, 1] }
thickness = 0.05
density = 1.0
material = { model = "saint-venant-kirchhoff", young = 1000.0, poisson = 0.0 }
[[shell.support]]
where = { edge = [[0, 0, 0], [0, 0.25, 0]] }
type = "clamped"
[[shell.load]]
where = { edge = [[1, 0, 0], [1, 0.25, 0]] }
force = [0.0, 0.0, "0.001*t"]
[output]
shells = { every = 0.25 }
[[output.probe]]
name = "end"
shell = "strip"
point = [1, 0, 0]
)toml";

/// A quarter of a shallow roof hinged along its straight sides, which snaps through under a force in its middle.
inline const std::string small_roof = R"toml(title = "Small roof"
[structure]
analysis = "arc-length"
steps = 10
[[shell]]
name = "roof"
mesh = { shape = "cylinder", centre = [254, 0, 0], axis = [-1, 0, 0], start = [0, 0, 1], radius = 2540.0, length = 254.0, angle = { from = 0, to = 5.729577951308232 }, divisions = [6, 6], pattern = "alternating" }
thickness = 6.35
density = 1.0
material = { model = "saint-venant-kirchhoff", young = 3102.75, poisson = 0.3 }
[[shell.support]]
where = { plane = { point = [0, 0, 0], normal = [1, 0, 0] } }
type = "symmetry"
[[shell.support]]
where = { plane = { point = [0, 0, 0], normal = [0, 1, 0] } }
type = "symmetry"
[[shell.support]]
where = { plane = { point = [0, 253.576878, 0], normal = [0, 1, 0] } }
type = "hinged"
[[shell.load]]
where = { point = [0, 0, 2540] }
force = [0.0, 0.0, -750.0]
[[output.probe]]
name = "force"
shell = "roof"
point = [0, 0, 2540]
)toml";

/// Two strips, clamped 0.06 apart, that a load presses together, and a plate that comes up 0.03 from below the lower
/// one.
inline const std::string pressed_strips = R"toml(title = "Pressed strips"
[structure]
analysis = "static"
steps = 4
[contact]
distance = 0.04
stiffness = 1.0
[[shell]]
name = "lower"
mesh = { shape = "rectangle", origin = [0, 0, 0], a = [1, 0, 0], b = [0, 0.25, 0], divisions = [8, 2] }
thickness = 0.05
density = 1.0
material = { model = "saint-venant-kirchhoff", young = 1000.0, poisson = 0.0 }
[[shell.support]]
where = { edge = [[0, 0, 0], [0, 0.25, 0]] }
type = "clamped"
[[shell]]
name = "upper"
mesh = { shape = "rectangle", origin = [0, 0, 0.06], a = [1, 0, 0], b = [0, 0.25, 0], divisions = [7, 2] }
thickness = 0.05
density = 1.0
material = { model = "saint-venant-kirchhoff", young = 1000.0, poisson = 0.0 }
[[shell.support]]
where = { edge = [[0, 0, 0.06], [0, 0.25, 0.06]] }
type = "clamped"
[[shell.load]]
where = { edge = [[1, 0, 0.06], [1, 0.25, 0.06]] }
force = [0.0, 0.0, -0.002]
[[body]]
name = "plate"
mesh = { shape = "rectangle", origin = [0.6, -0.1, -0.06], a = [0.3, 0, 0], b = [0, 0.45, 0], divisions = [1, 1] }
motion = { type = "prescribed", translation = [0, 0, "0.05*t"] }
[output]
shells = { every = 1.0 }
[[output.probe]]
name = "lower"
shell = "lower"
point = [1, 0.25, 0]
[[output.probe]]
name = "upper"
shell = "upper"
point = [1, 0.25, 0.06]
)toml";

/// The text with its only occurrence of `from` replaced.
inline std::string changed(std::string text, const std::string& from, const std::string& to)
{
  const auto position = text.find(from);
  EXPECT_NE(position, std::string::npos) << "nothing to change: " << from;
  EXPECT_EQ(text.find(from, position + 1), std::string::npos) << "more than one place to change: " << from;
  return text.replace(position, from.size(), to);
}

/// The small flag, two and a half cells thick: the flow sees its faces.
inline std::string thick_flag()
{
  return changed(small_flag, "thickness = 0.01", "thickness = 0.3\nwetted = \"faces\"");
}

/// A ball lighter than the fluid in a stream, free but for a spring, five steps.
inline const std::string small_ball = R"toml(title = "Small ball"
[time]
end = 0.1
step = 0.02
[fluid]
density = 1.0
viscosity = 0.01
initial.velocity = [1.0, 0.0, 0.0]
[grid]
x = { from = -1.0, to = 2.0, cells = 24 }
y = { from = -1.0, to = 1.0, cells = 16 }
z = { from = -1.0, to = 1.0, cells = 16 }
[boundary]
x_min = { type = "velocity", value = [1.0, 0.0, 0.0] }
x_max = { type = "outflow" }
y_min = { type = "slip" }
y_max = { type = "slip" }
z_min = { type = "slip" }
z_max = { type = "slip" }
[[body]]
name = "ball"
mesh = { shape = "sphere-cap", centre = [0, 0.01, 0.02], radius = 0.4, polar = { from = 0, to = 180 }, rings = 8 }
motion = { type = "free", density = 0.1, stiffness = [2, 0, 0], gravity = [0, 0, -1], spin = [0, 1, 0] }
[output]
fields = { every = 0.05 }
)toml";

}  // namespace luff::test
