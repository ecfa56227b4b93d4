#include <gtest/gtest.h>

#include "mesh_helpers.hpp"
#include "tessera/tessellation/vtu.hpp"

namespace tessera::test {
namespace {

std::string array(const std::string& type, const std::string& name, const std::string& values) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"3\" format=\"ascii\">\n" +
         values + "\n</DataArray>\n";
}

/// A grid of one tetrahedron and one triangle, with any part of it replaced.
struct Grid {
  std::string attributes = "type=\"UnstructuredGrid\" byte_order='LittleEndian'";
  std::string counts = "NumberOfPoints=\"4\" NumberOfCells=\"2\"";
  std::string points = array("Float64", "Points", "0 0 0 1 0 0 0 1 0 0 0 1");
  std::string connectivity = array("Int32", "connectivity", "0 1 2 0 1 2 3");
  std::string offsets = array("Int64", "offsets", "3 7");
  std::string types = array("UInt8", "types", "5 10");
  std::string after;

  std::string text() const {
    return "<?xml version=\"1.0\"?>\n<!-- made by hand > here -->\n<VTKFile " + attributes +
           ">\n<UnstructuredGrid>\n<Piece " + counts + ">\n<Points>\n" + points + "</Points>\n<Cells>\n" +
           connectivity + offsets + types + "</Cells>\n</Piece>\n" + "</UnstructuredGrid>\n" + after + "</VTKFile>\n";
  }
};

std::string refusal(const std::string& text) {
  return geometry_error([&] { read_vtu("part.vtu", text); });
}

TEST(Vtu, TetrahedraAreTakenAndTrianglesPassedOver) {
  const FileMesh mesh = read_vtu("part.vtu", Grid().text());
  EXPECT_EQ(mesh.points.size(), 4u);
  ASSERT_EQ(mesh.tetrahedra.size(), 1u);
  EXPECT_EQ(mesh.tetrahedra[0].vertices, (Tetrahedron{0, 1, 2, 3}));
  EXPECT_EQ(mesh.tetrahedra[0].number, 1);
  EXPECT_EQ(mesh.tetrahedra[0].place, 12);
  EXPECT_TRUE(mesh.triangles.empty());
}

TEST(Vtu, Base64OfHeaderAndDataMayBePaddedApartOrTogether) {
  Grid grid;  // two bytes 5 10: together "AgAAAAUK", apart "AgAAAA==" "BQo="
  for (const char* text : {"AgAAAAUK", "AgAAAA==BQo=", " AgAA AA==\nBQo= "}) {
    grid.types = std::string("<DataArray type=\"UInt8\" Name=\"types\" format=\"binary\">") + text + "</DataArray>";
    EXPECT_EQ(read_vtu("part.vtu", grid.text()).tetrahedra.size(), 1u) << text;
  }
}

TEST(Vtu, DamagedBase64IsRefusedWithItsLine) {
  Grid grid;
  const auto with = [&](const char* text) {
    grid.types = std::string("<DataArray type=\"UInt8\" Name=\"types\" format=\"binary\">\n") + text + "</DataArray>\n";
    return refusal(grid.text());
  };
  expect_contains(with("AgAAAAU"), {"part.vtu:18:", "end too early"});
  expect_contains(with("AgAA*AUK"), {"part.vtu:18:", "not base64"});
  expect_contains(with("Ag=AAAUK"), {"padded in a wrong place"});
  expect_contains(with("/////wUK"), {"end too early"});
  expect_contains(with("AQAAAAU="), {"holds 1 values instead of 2"});
}

TEST(Vtu, DamagedCompressionIsRefused) {
  Grid grid;
  grid.attributes += " compressor=\"vtkZLibDataCompressor\"";
  const auto with = [&](const char* text) {
    grid.types = std::string("<DataArray type=\"UInt8\" Name=\"types\" format=\"binary\">\n") + text + "</DataArray>\n";
    return refusal(grid.text());
  };
  // blocks, size, last size, compressed size; then the block
  expect_contains(with("AQAAAAIAAAAAAAAAAgAAAA==BQo="), {"cannot be unpacked"});
  expect_contains(with("AQAAAP///38AAAAAAgAAAA==BQo="), {"impossible size"});
  expect_contains(with("////fwIAAAAAAAAAAgAAAA==BQo="), {"more blocks than the file holds"});
  grid.attributes = "type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\"";
  expect_contains(with("AQAAAAIAAAAAAAAAAgAAAA==BQo="), {"vtkLZ4DataCompressor", "zlib or none"});
}

TEST(Vtu, OppositeByteOrderIsRefusedOnlyWhereItMatters) {
  Grid grid;
  grid.attributes = "type=\"UnstructuredGrid\" byte_order=\"BigEndian\"";
  EXPECT_EQ(read_vtu("part.vtu", grid.text()).tetrahedra.size(), 1u);
  grid.types = "<DataArray type=\"UInt8\" Name=\"types\" format=\"binary\">AgAAAAUK</DataArray>";
  expect_contains(refusal(grid.text()), {"big-endian"});
}

TEST(Vtu, OtherFilesAndSeveralPiecesAreRefused) {
  expect_contains(refusal("hello"), {"part.vtu:1: is no VTK unstructured grid"});
  expect_contains(refusal("<VTKFile type=\"PolyData\"></VTKFile>"), {"part.vtu:1: is no VTK unstructured grid"});
  expect_contains(refusal("<VTKFile type=\"UnstructuredGrid\"></VTKFile>"), {"no <Piece>"});
  expect_contains(refusal("<VTKFile type=\"UnstructuredGrid\"><Piece a='1'/>\n<Piece a='1'/></VTKFile>"),
                  {"part.vtu:2: a second piece"});
}

TEST(Vtu, DamagedTagsAreRefusedWithTheirLine) {
  const std::string text = Grid().text();
  expect_contains(refusal(text.substr(0, text.find("</Cells>"))),
                  {"part.vtu:", "<Cells> is never closed", "truncated"});
  expect_contains(refusal("<VTKFile type=\"UnstructuredGrid\">\n</Piece>"), {"part.vtu:2: </Piece> closes nothing"});
  expect_contains(refusal("<VTKFile type=\"UnstructuredGrid"), {"a value in quotes is expected"});
  expect_contains(refusal("<VTKFile type"), {"ends inside a tag"});
  expect_contains(refusal("\n< >"), {"part.vtu:2: a name is expected"});
  expect_contains(refusal("<!-- "), {"\"-->\" is missing"});
}

TEST(Vtu, CountsAreCompared) {
  Grid grid;
  grid.counts = "NumberOfPoints=\"5\" NumberOfCells=\"2\"";
  expect_contains(refusal(grid.text()), {"part.vtu:7: the array holds 12 values instead of 15"});
  grid.counts = "NumberOfPoints=\"99999999999999\" NumberOfCells=\"2\"";
  expect_contains(refusal(grid.text()), {"part.vtu:5: NumberOfPoints is no count"});
  grid.counts = "NumberOfPoints=\"4\" NumberOfCells=\"3\"";
  expect_contains(refusal(grid.text()), {"holds 2 values instead of 3"});
}

TEST(Vtu, BadCellsAreNamed) {
  Grid grid;
  grid.connectivity = array("Int32", "connectivity", "0 1 2 0 1 2 4");
  expect_contains(refusal(grid.text()), {"part.vtu:12: cell 1 has point 4", "0 to 3"});
  grid = {};
  grid.types = array("UInt8", "types", "5 12");
  expect_contains(refusal(grid.text()), {"cell 1 has VTK type 12", "type 10"});
  grid = {};
  grid.offsets = array("Int64", "offsets", "4 7");
  expect_contains(refusal(grid.text()), {"cell 1 is a tetrahedron with 3 points"});
  grid.offsets = array("Int64", "offsets", "8 7");
  expect_contains(refusal(grid.text()), {"offset of cell 1 is smaller"});
}

TEST(Vtu, BadArraysAreRefused) {
  Grid grid;
  grid.points = array("Float64", "Points", "0 0 zero");
  expect_contains(refusal(grid.text()), {"part.vtu:7: number 3 of the array cannot be read"});
  grid.points = array("Int32", "Points", "0 0 0 1 0 0 0 1 0 0 0 1");
  expect_contains(refusal(grid.text()), {"type \"Int32\"", "Float64"});
  grid = {};
  grid.types = "";
  expect_contains(refusal(grid.text()), {"no array types"});
  grid.types = "<DataArray type=\"UInt8\" Name=\"types\" format=\"appended\" offset=\"0\"/>";
  expect_contains(refusal(grid.text()), {"no <AppendedData> follows"});
  grid.after = "<AppendedData encoding=\"raw\">_AB";
  expect_contains(refusal(grid.text()), {"end too early"});
  grid.after = "<AppendedData encoding=\"hex\">_AB";
  expect_contains(refusal(grid.text()), {"encoding \"hex\"", "raw, base64"});
  grid.types = "<DataArray type=\"UInt8\" Name=\"types\" format=\"appended\" offset=\"7777\"/>";
  expect_contains(refusal(grid.text()), {"offset does not lie in the appended data"});
  grid.types = "<DataArray type=\"UInt8\" Name=\"types\" format=\"other\"/>";
  expect_contains(refusal(grid.text()), {"format \"other\""});
}

TEST(Vtu, AppendedRawDataMayHoldAnything) {
  Grid grid;
  grid.types = "<DataArray type=\"UInt8\" Name=\"types\" format=\"appended\" offset=\"2\"/>";
  grid.after = std::string("<AppendedData encoding=\"raw\">\n _<<\2\0\0\0\5\12", 40) + "\n</AppendedData>\n";
  EXPECT_EQ(read_vtu("part.vtu", grid.text()).tetrahedra.size(), 1u);
}

}  // namespace
}  // namespace tessera::test
