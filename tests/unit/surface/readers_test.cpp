// SPDX-License-Identifier: BSD-3-Clause
// Meshes come back from every kind of file, and bad files are refused with clear words.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <string>

#include "unit/surface/file_folder.hpp"
#include "unit/surface/gmsh_files.hpp"

namespace luff::surface {
namespace {

using Readers = test::FileFolder;

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

std::string data_array(const std::string& attributes, const std::string& numbers)
{
  return "<DataArray " + attributes + " format=\"ascii\">" + numbers + "</DataArray>\n";
}

/// The square as an unstructured grid; `data` is what it holds besides.
std::string vtu(const std::string& connectivity, const std::string& offsets, const std::string& types,
                const std::string& data = "")
{
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">\n" +
         data + "<Points>" + data_array("type=\"Float64\" NumberOfComponents=\"3\"", "0 0 0 1 0 0 1 1 0 0 1 0.5") +
         "</Points>\n<Cells>" + data_array("type=\"Int64\" Name=\"connectivity\"", connectivity) +
         data_array("type=\"Int64\" Name=\"offsets\"", offsets) + data_array("type=\"UInt8\" Name=\"types\"", types) +
         "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

TEST_F(Readers, TheSameMeshComesFromEveryKindOfFile)
{
  for (const auto& file :
       {write("a.obj", obj_square()), write("a.STL", stl_square()), write("a.ply", ply_square()),
        write("a.vtp", vtp("0 1 2 0 2 3", "3 6", 2)), write("a.vtu", vtu("0 1 2 0 2 3", "3 6", "5 5")),
        write("2.msh", test::gmsh_2_ascii()), write("2b.msh", test::gmsh_2_binary())}) {
    const TriangleMesh mesh = read_mesh(file).mesh;
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
  EXPECT_DOUBLE_EQ(total_area(read_mesh(write("binary.stl", text)).mesh), 3);
}

// Before room for half a billion triangles is asked for.
TEST_F(Readers, AnStlOfFewerTrianglesThanItSaysIsRefused)
{
  const std::string text = "solid square\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n" + std::string(30, ' ');
  const std::string told = refusal(write("mixed.stl", text + std::string(30, '\0') + "endsolid square\n"));
  EXPECT_NE(told.find("a binary STL of 538976288 triangles has"), std::string::npos) << told;
}

TEST_F(Readers, MissingFileIsRefused)
{
  EXPECT_NE(refusal(folder_ / "nowhere.stl").find("no such file"), std::string::npos);
}

TEST_F(Readers, UnknownEndingIsRefused)
{
  EXPECT_NE(refusal(write("mesh.step", "x")).find(".stl, .obj, .ply, .vtp, .vtu and .msh"), std::string::npos);
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
  const std::string message = refusal(write("fin.obj",
                                            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n"
                                            "f 1 2 3\nf 1 3 4\nf 1 3 5\n"));
  EXPECT_NE(message.find("fin.obj: 3 triangles"), std::string::npos) << message;
}

TEST_F(Readers, NumbersAtPointsAndCellsMakeSetsAndVectorsMakeFields)
{
  const std::string data =
      "<PointData>" + data_array("type=\"Int32\" Name=\"attached\"", "1 0 0 -2") +
      data_array("type=\"Float64\" Name=\"at points\" NumberOfComponents=\"3\"", "3 0 0 0 3 0 0 0 3 3 3 0") +
      "</PointData>\n<CellData>" + data_array("type=\"Float32\" Name=\"belly\"", "0 0.5") +
      data_array("type=\"Float64\" Name=\"fibre\" NumberOfComponents=\"3\"", "1 0 0 0 2 0") + "</CellData>\n";
  const Marks marks = read_mesh(write("marked.vtu", vtu("0 1 2 0 2 3", "3 6", "5 5", data))).marks;
  EXPECT_EQ(marks.sets.vertices.at("attached"), (std::vector<int>{0, 3}));
  EXPECT_EQ(marks.sets.triangles.at("belly"), (std::vector<int>{1}));
  EXPECT_EQ(marks.directions.at("fibre"), (std::vector<Vec3>{Vec3(1, 0, 0), Vec3(0, 2, 0)}));
  EXPECT_EQ(marks.directions.at("at points"), (std::vector<Vec3>{Vec3(1, 1, 1), Vec3(2, 1, 1)}));
  EXPECT_EQ(&direction_field(marks, "fibre", "shell"), &marks.directions.at("fibre"));
  try {
    (void)direction_field(marks, "fiber", "shell 'leaflet'");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "shell 'leaflet': the mesh has no field of vectors 'fiber' (did you mean 'fibre'?)");
  }
}

TEST_F(Readers, UnstructuredGridsOfOtherCellsAreRefused)
{
  EXPECT_NE(refusal(write("quads.vtu", vtu("0 1 2 3 0 1 2", "4 7", "9 5"))).find("type 9, not a triangle"),
            std::string::npos);
  EXPECT_NE(refusal(write("four.vtu", vtu("0 1 2 3 0 1 2", "4 7", "5 5"))), "accepted");
}

TEST_F(Readers, FieldsShorterThanTheirFileSaysAreRefused)
{
  const std::string fibre = data_array("type=\"Float64\" Name=\"fibre\" NumberOfComponents=\"3\"", "1 0 0 0");
  for (const std::string place : {"CellData", "PointData"}) {
    const std::string data = "<" + place + ">" + fibre + "</" + place + ">\n";
    EXPECT_NE(refusal(write("short.vtu", vtu("0 1 2 0 2 3", "3 6", "5 5", data))).find("fibre"), std::string::npos);
  }
}

TEST_F(Readers, PhysicalGroupsOfEveryGmshFormatMakeSets)
{
  for (const auto& file : {write("2.msh", test::gmsh_2_ascii()), write("2b.msh", test::gmsh_2_binary()),
                           write("4.msh", test::gmsh_4_ascii()), write("4b.msh", test::gmsh_4_binary())}) {
    const MarkedMesh marked = read_mesh(file);
    const Sets& sets = marked.marks.sets;
    ASSERT_EQ(marked.mesh.n_vertices(), 4) << file;
    ASSERT_EQ(marked.mesh.n_triangles(), 2) << file;
    EXPECT_EQ(marked.marks.repairs.dropped_vertices, 1) << file;
    EXPECT_EQ(sets.triangles.at("skin of it"), (std::vector<int>{0, 1})) << file;
    ASSERT_EQ(sets.edges.at("left").size(), 1u) << file;
    const auto [a, b] = sets.edges.at("left")[0];
    EXPECT_LT((marked.mesh.vertices[a] - Vec3(0, 0, 0)).norm(), 1e-15) << file;
    EXPECT_LT((marked.mesh.vertices[b] - Vec3(0, 1, 0.5)).norm(), 1e-15) << file;
    EXPECT_LT((marked.mesh.vertices[sets.vertices.at("11")[0]] - Vec3(1, 0, 0)).norm(), 1e-15) << file;
    EXPECT_NEAR(total_area(marked.mesh), 0.5 + 0.5 * std::sqrt(1.5), 1e-15) << file;
  }
}

std::string changed(std::string text, const std::string& from, const std::string& to)
{
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(Readers, BadGmshFilesAreRefusedWithTheLine)
{
  const std::string good = test::gmsh_2_ascii();
  const auto told = [&](const std::string& from, const std::string& to) {
    return refusal(write("bad.msh", changed(good, from, to)));
  };
  EXPECT_NE(told("2.2 0 8", "4 0 8").find("line 2, format 4 is not known; save it as 4.1 or 2.2"), std::string::npos);
  EXPECT_NE(told("2 1 0 0", "2 1 zero 0").find("line 12, 'zero' must be a number"), std::string::npos);
  EXPECT_NE(told("2 1 0 0", "1 1 0 0").find("line 12, node 1 is defined twice"), std::string::npos);
  EXPECT_NE(told("1 1 2 5", "1 1 2 6").find("line 21, an element uses node 6"), std::string::npos);
  EXPECT_NE(told("3 2 2 3 1 1 2 5", "3 3 2 3 1 1 2 5 7").find("elements of type 3"), std::string::npos);
  EXPECT_NE(told("$Nodes\n5", "$Nodes\n6").find("line 16, '$EndNodes' must be an integer"), std::string::npos);
  EXPECT_NE(told("$Nodes\n5", "$Nodes\n999999999").find("more than the file can hold"), std::string::npos);
  EXPECT_NE(told("$EndNodes", "$EndNode").find("where $EndNodes must"), std::string::npos);
  EXPECT_NE(told("\"left\"", "left").find("in quotes"), std::string::npos);
}

/// Cut short or with a byte changed, a file may be accepted if what is left is a mesh, but must never do worse than be
/// refused.
TEST_F(Readers, FilesCutShortOrWithChangedBytesAreReadOrRefusedButNeverCrash)
{
  const std::map<std::string, std::string> files{{"a.obj", obj_square()},
                                                 {"a.stl", stl_square()},
                                                 {"a.ply", ply_square()},
                                                 {"a.vtp", vtp("0 1 2 0 2 3", "3 6", 2)},
                                                 {"a.vtu", vtu("0 1 2 0 2 3", "3 6", "5 5")},
                                                 {"2.msh", test::gmsh_2_ascii()},
                                                 {"2b.msh", test::gmsh_2_binary()},
                                                 {"4.msh", test::gmsh_4_ascii()},
                                                 {"4b.msh", test::gmsh_4_binary()}};
  std::mt19937 random(1);
  for (const auto& [name, good] : files)
    for (int trial = 0; trial < 40; ++trial) {
      std::string bad = good;
      if (trial % 2 == 0)
        bad.resize(random() % good.size());
      else
        bad[random() % good.size()] = static_cast<char>(random() % 256);
      EXPECT_FALSE(refusal(write(name, bad)).empty());
    }
}

}  // namespace
}  // namespace luff::surface
