// SPDX-License-Identifier: BSD-3-Clause
// Meshes come back from every kind of file, and bad files are refused with clear words.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.hpp"
#include "surface/readers.hpp"

namespace luff::surface {
namespace {

/// A folder of this test's own, removed at its end.
class Readers : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  /// The message with which read_mesh() refuses the file; nothing may be printed.
  static std::string refusal(const std::filesystem::path& file)
  {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    std::string message = "accepted";
    try {
      read_mesh(file);
    } catch (const InputError& error) {
      message = error.what();
    }
    EXPECT_EQ(::testing::internal::GetCapturedStdout() + ::testing::internal::GetCapturedStderr(), "");
    EXPECT_NE(message.find(file.filename().string()), std::string::npos) << message;
    return message;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("luff-readers-" + std::to_string(::getpid()));
};

const std::string ply_header =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";

std::string obj_square()
{
  return "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3\nf 1 3 4\n";
}

std::string stl_square()
{
  const auto facet = [](const std::string& a, const std::string& b, const std::string& c) {
    return "facet normal 0 0 1\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c + "\nendloop\nendfacet\n";
  };
  return "solid square\n" + facet("0 0 0", "1 0 0", "1 1 0") + facet("0 0 0", "1 1 0", "0 1 0.5") + "endsolid square\n";
}

std::string ply_square()
{
  return ply_header +
         "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n3 0 1 2\n3 0 2 3\n";
}

std::string vtp(const std::string& connectivity, const std::string& offsets, int polygons)
{
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<PolyData>\n"
         "<Piece NumberOfPoints=\"4\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
         std::to_string(polygons) +
         "\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n"
         "0 0 0 1 0 0 1 1 0 0 1 0.5\n</DataArray></Points>\n"
         "<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" +
         connectivity + "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + offsets +
         "</DataArray></Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

TEST_F(Readers, TheSameMeshComesFromEveryKindOfFile)
{
  for (const auto& file : {write("a.obj", obj_square()), write("a.STL", stl_square()), write("a.ply", ply_square()),
                           write("a.vtp", vtp("0 1 2 0 2 3", "3 6", 2))}) {
    const TriangleMesh mesh = read_mesh(file);
    ASSERT_EQ(mesh.n_vertices(), 4) << file;
    ASSERT_EQ(mesh.n_triangles(), 2) << file;
    EXPECT_EQ(mesh.triangles[1], (std::array<int, 3>{0, 2, 3})) << file;
    EXPECT_EQ(mesh.vertices[3], Vec3(0, 1, 0.5)) << file;
  }
}

TEST_F(Readers, BinaryStlIsRead)
{
  std::string text(80, ' ');
  const auto append = [&](const auto& value) { text.append(reinterpret_cast<const char*>(&value), sizeof value); };
  append(std::uint32_t{1});
  for (const float number : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 2.f, 0.f, 0.f, 0.f, 3.f, 0.f})
    append(number);
  append(std::uint16_t{0});
  EXPECT_DOUBLE_EQ(total_area(read_mesh(write("binary.stl", text))), 3);
}

TEST_F(Readers, MissingFileIsRefused)
{
  EXPECT_NE(refusal(folder_ / "nowhere.stl").find("no such file"), std::string::npos);
}

TEST_F(Readers, UnknownEndingIsRefused)
{
  EXPECT_NE(refusal(write("mesh.step", "x")).find(".stl, .obj, .ply and .vtp"), std::string::npos);
}

TEST_F(Readers, FolderAndEmptyFileAreRefused)
{
  std::filesystem::create_directories(folder_ / "folder.stl");
  EXPECT_NE(refusal(folder_ / "folder.stl").find("not a file"), std::string::npos);
  EXPECT_NE(refusal(write("nothing.ply", "")).find("empty"), std::string::npos);
}

TEST_F(Readers, FilesOfAnotherKindAreRefusedWithoutVtkPrinting)
{
  for (const char* name : {"noise.stl", "noise.obj", "noise.ply", "noise.vtp"})
    EXPECT_NE(refusal(write(name, "this is a letter, not a mesh\n")), "accepted") << name;
}

TEST_F(Readers, TruncatedFilesAreRefusedWithoutVtkPrinting)
{
  EXPECT_NE(refusal(write("cut.vtp", vtp("0 1 2 0 2 3", "3 6", 2).substr(0, 400))), "accepted");
  for (const std::size_t missing : {2, 4, 12, 40, 80, 120})
    EXPECT_NE(refusal(write("cut.ply", ply_square().substr(0, ply_square().size() - missing))), "accepted") << missing;
  EXPECT_NE(refusal(write("cut.stl", stl_square().substr(0, 150))), "accepted");
}

TEST_F(Readers, CornersAndOffsetsOutOfRangeAreRefusedWithoutVtkPrinting)
{
  EXPECT_NE(refusal(write("far.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n")), "accepted");
  EXPECT_NE(refusal(write("far.vtp", vtp("0 1 2 0 2 9", "3 6", 2))), "accepted");
  EXPECT_NE(refusal(write("offsets.vtp", vtp("0 1 2 0 2 3", "3 60", 2))), "accepted");
  EXPECT_NE(refusal(write("point.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n")), "accepted");
  EXPECT_NE(refusal(write("far.ply", ply_square().replace(ply_square().size() - 2, 1, "9"))), "accepted");
}

TEST_F(Readers, PolygonsThatAreNotTrianglesAreRefused)
{
  for (const auto& file : {write("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"),
                           write("quad.vtp", vtp("0 1 2 3", "4", 1))})
    EXPECT_NE(refusal(file).find("4 corners"), std::string::npos) << file;
}

TEST_F(Readers, BadMeshInAFileIsRefusedWithTheFilesName)
{
  const std::string message = refusal(write("flipped.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 4 3\n"));
  EXPECT_NE(message.find("flipped.obj: triangle"), std::string::npos) << message;
}

}  // namespace
}  // namespace luff::surface
