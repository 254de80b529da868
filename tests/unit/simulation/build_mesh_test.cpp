// SPDX-License-Identifier: BSD-3-Clause
// Meshes of a case are read, repaired and placed; their names go with them and are written as fields.
#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
#include "simulation/build_mesh.hpp"
#include "simulation/mark_fields.hpp"
#include "support/program.hpp"

namespace luff::simulation {
namespace {

/// The unit square of three triangles; the last one, of the group "flap", faces down.
config::MeshOptions square(const test::WorkFolder& folder)
{
  config::MeshOptions options;
  options.file = folder.write("square.obj",
                              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 1 0\ng body\nf 1 2 3\nf 1 3 4\n"
                              "g flap\nf 1 5 4\n");
  return options;
}

TEST(BuildMesh, RepairsPlacesAndKeepsNames)
{
  const test::WorkFolder folder;
  config::PlacementOptions placement;
  placement.scale = 2;
  placement.rotate = config::RotateOptions{.axis = Vec3(0, 0, 1), .angle = 90};
  placement.translate = Vec3(0, 0, 5);
  const surface::MarkedMesh built = build_mesh(square(folder), placement, "shell 'square'");
  EXPECT_LT((built.mesh.vertices[1] - Vec3(0, 2, 5)).norm(), 1e-15);
  EXPECT_EQ(built.marks.repairs.reversed_triangles, 1);
  EXPECT_EQ(built.marks.sets.triangles.at("flap"), (std::vector<int>{2}));
  EXPECT_GT(surface::unit_normal(built.mesh, 2).z(), 0);
}

TEST(BuildMesh, RefusesWhatItMayNotRepair)
{
  const test::WorkFolder folder;
  config::MeshOptions options = square(folder);
  options.repair = false;
  options.mark.text = "case.toml:7";
  try {
    (void)build_mesh(options, {}, "shell 'square'");
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.rfind("case.toml:7: ", 0), 0u) << text;
    EXPECT_NE(text.find("triangle 2 (vertices 0, 4, 3)"), std::string::npos) << text;
    EXPECT_NE(text.find("flipped"), std::string::npos) << text;
  }
}

TEST(MarkFields, AreOneOnMembersAndZeroElsewhere)
{
  SheetRange sheet;
  sheet.vertices = 4;
  sheet.triangles = 2;
  sheet.marks.sets.vertices["corner"] = {2};
  sheet.marks.sets.edges["side"] = {{0, 3}};
  sheet.marks.sets.triangles["belly"] = {1};
  sheet.marks.directions["grain"] = {Vec3(1, 2, 3), Vec3(4, 5, 6)};
  output::SurfaceSnapshot snapshot;
  add_marks(sheet, snapshot);
  ASSERT_EQ(snapshot.point_fields.size(), 2u);
  EXPECT_EQ(snapshot.point_fields[0].name, "corner");
  EXPECT_EQ(std::get<std::vector<float>>(snapshot.point_fields[0].values), (std::vector<float>{0, 0, 1, 0}));
  EXPECT_EQ(std::get<std::vector<float>>(snapshot.point_fields[1].values), (std::vector<float>{1, 0, 0, 1}));
  ASSERT_EQ(snapshot.face_fields.size(), 2u);
  EXPECT_EQ(std::get<std::vector<float>>(snapshot.face_fields[0].values), (std::vector<float>{0, 1}));
  EXPECT_EQ(snapshot.face_fields[1].components, 3);
  EXPECT_EQ(std::get<std::vector<double>>(snapshot.face_fields[1].values), (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

}  // namespace
}  // namespace luff::simulation
