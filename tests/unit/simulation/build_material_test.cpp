// SPDX-License-Identifier: BSD-3-Clause
// Materials and fibres from the options of a case.
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "core/error.hpp"
#include "simulation/build_material.hpp"
#include "simulation/build_mesh.hpp"
#include "support/program.hpp"
#include "surface/generators.hpp"

namespace luff::simulation {
namespace {

config::ShellOptions leaflet(const config::FibreOptions& fibre)
{
  config::ShellOptions options;
  options.name = "leaflet";
  options.material.model = config::MaterialModel::MayNewmanYin;
  options.material.fibre = fibre;
  return options;
}

surface::MarkedMesh square()
{
  return surface::make(surface::Rectangle{.a = Vec3::UnitX(), .b = Vec3::UnitY(), .divisions = {1, 1}});
}

TEST(BuildMaterial, GivesEachLawItsConstants)
{
  config::MaterialOptions m;
  m.model = config::MaterialModel::HolzapfelGasserOgden;
  m.shear_modulus = 3;
  m.k1 = 2;
  m.k2 = 4;
  m.dispersion = 0.1;
  m.angle = 60;
  const auto artery = std::get<shell::HolzapfelGasserOgden>(build_material(m));
  EXPECT_EQ((std::array{artery.shear_modulus, artery.k1, artery.k2, artery.dispersion}), (std::array{3., 2., 4., 0.1}));
  EXPECT_DOUBLE_EQ(artery.angle, std::numbers::pi / 3);
  m.model = config::MaterialModel::Fung;
  m.c = 10;
  m.a11 = 5;
  m.a23 = 0.5;
  const auto skin = std::get<shell::Fung>(build_material(m));
  EXPECT_EQ(skin.A(0, 0), 5);
  EXPECT_EQ(skin.A(1, 2), 0.5);
  EXPECT_EQ(skin.A(2, 1), 0.5);
  m.model = config::MaterialModel::LeeSacks;
  m.weight = 0.25;
  EXPECT_EQ(std::get<shell::LeeSacks>(build_material(m)).weight, 0.25);
}

TEST(BuildMaterial, TurnsAFieldOfTheFileWithItsMesh)
{
  const test::WorkFolder folder;
  const auto file = folder.write("sheet.vtp", R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="4" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="2">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 1 1 0 0 1 0</DataArray></Points>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 0 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3 6</DataArray></Polys>
<CellData><DataArray type="Float64" Name="grain" NumberOfComponents="3" format="ascii">1 0 0 0 1 0</DataArray></CellData>
</Piece></PolyData></VTKFile>
)");
  config::FibreOptions fibre;
  fibre.field = "grain";
  config::ShellOptions options = leaflet(fibre);
  options.mesh.file = file;
  options.placement.rotate = config::RotateOptions{.axis = Vec3(0, 0, 2), .angle = 90};
  const surface::MarkedMesh placed = build_mesh(options.mesh, options.placement, "shell 'leaflet'");
  const std::vector<Vec3> directions = build_fibres(options, placed);
  ASSERT_EQ(directions.size(), 2u);
  EXPECT_LT((directions[0] - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_LT((directions[1] + Vec3::UnitX()).norm(), 1e-15);
}

TEST(BuildMaterial, RefusesFibresThatHaveNoDirectionInTheSheet)
{
  config::FibreOptions normal, field;
  normal.direction = Vec3::UnitZ();
  field.field = "grain";
  EXPECT_THROW(build_fibres(leaflet(normal), square()), InputError);
  EXPECT_THROW(build_fibres(leaflet(field), square()), InputError) << "a made mesh has none";
}

}  // namespace
}  // namespace luff::simulation
