// SPDX-License-Identifier: BSD-3-Clause
// Vectors that mesh files keep for their triangles.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "surface/triangle_vectors.hpp"

namespace luff::surface {
namespace {

class TriangleVectors : public ::testing::Test {
 protected:
  void SetUp() override
  {
    std::filesystem::create_directories(folder_);
    std::ofstream(file_) << R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="4" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="2">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 1 1 0 0 1 0.5</DataArray></Points>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 0 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3 6</DataArray></Polys>
<CellData><DataArray type="Float64" Name="grain" NumberOfComponents="3" format="ascii">1 0 0 0.5 2 -1</DataArray>
<DataArray type="Float64" Name="age" format="ascii">3 4</DataArray></CellData>
</Piece></PolyData></VTKFile>
)";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string refusal(const std::string& name) const
  {
    try {
      read_triangle_vectors(file_, name);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("luff-triangle-vectors-" + std::to_string(::getpid()));
  std::filesystem::path file_ = folder_ / "sheet.vtp";
};

TEST_F(TriangleVectors, AreReadInTheFilesOrder)
{
  EXPECT_EQ(read_triangle_vectors(file_, "grain"), (std::vector{Vec3(1, 0, 0), Vec3(0.5, 2, -1)}));
}

TEST_F(TriangleVectors, OfAnotherNameOrKindAreRefusedWithWhatThereIs)
{
  EXPECT_NE(refusal("grian").find("it has: 'grain', 'age'"), std::string::npos);
  EXPECT_NE(refusal("age").find("array 'age' has 1 components; a direction has 3"), std::string::npos);
  EXPECT_THROW(read_triangle_vectors(folder_ / "sheet.stl", "grain"), InputError);
}

}  // namespace
}  // namespace luff::surface
