#include "tessera/output/fields.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "sample.hpp"

namespace tessera {
namespace {

FieldsSpec spec(FieldFormat format, std::vector<std::string> quantities = {}) {
  FieldsSpec s;
  s.format = format;
  s.quantities = std::move(quantities);
  return s;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST(FieldSeries, CsvHasOneColumnPerComponentWithUnits) {
  const sample::Folder folder;
  FieldSeries(folder.path(), spec(FieldFormat::csv, {"displacement", "deformation_gradient", "J", "body"}))
      .write(sample::snapshot());
  const std::string text = folder.read("fields_000000.csv");
  EXPECT_EQ(
      text.substr(0, text.find('\n')),
      "reference_position_x[m],reference_position_y[m],reference_position_z[m],displacement_x[m],displacement_y[m],"
      "displacement_z[m],deformation_gradient_xx[-],deformation_gradient_xy[-],deformation_gradient_xz[-],"
      "deformation_gradient_yx[-],deformation_gradient_yy[-],deformation_gradient_yz[-],"
      "deformation_gradient_zx[-],deformation_gradient_zy[-],deformation_gradient_zz[-],J[-],body[-]");
}

TEST(FieldSeries, CsvNumbersReadBackToTheSameBits) {
  const sample::Folder folder;
  const Snapshot s = sample::snapshot();
  FieldSeries(folder.path(), spec(FieldFormat::csv)).write(s);
  std::istringstream stream(folder.read("fields_000000.csv"));
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> header = split(line);
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  for (std::size_t a = 0; a < 8; ++a) {
    ASSERT_TRUE(std::getline(stream, line));
    const std::vector<std::string> cells = split(line);
    ASSERT_EQ(cells.size(), header.size());
    EXPECT_EQ(std::strtod(cells[column("displacement_y[m]")].c_str(), nullptr),
              s.position[a].y - s.reference_position[a].y);
    EXPECT_EQ(std::strtod(cells[column("force_x[N]")].c_str(), nullptr), s.force[a].x);
    EXPECT_EQ(std::strtod(cells[column("velocity_z[m/s]")].c_str(), nullptr), s.velocity[a].z);
    EXPECT_EQ(std::strtod(cells[column("deformation_gradient_yx[-]")].c_str(), nullptr), 0.1);
    EXPECT_EQ(cells[column("material[-]")], std::to_string(a % 2));
  }
  EXPECT_FALSE(std::getline(stream, line));
}

TEST(FieldSeries, EveryFormatHasItsFilesAndIndex) {
  const sample::Folder folder;
  FieldSeries(folder.path(), spec(FieldFormat::vtkhdf)).write(sample::snapshot());
  FieldSeries(folder.path(), spec(FieldFormat::vtu)).write(sample::snapshot());
  FieldSeries(folder.path(), spec(FieldFormat::csv)).write(sample::snapshot());
  for (const char* name : {"fields_000000.hdf", "fields.hdf.series", "fields_000000.vtu", "fields.pvd",
                           "fields_000000.csv", "fields.csv.series"})
    EXPECT_TRUE(folder.has(name)) << name;
  EXPECT_EQ(folder.files(), 6u);
}

TEST(FieldSeries, SameStateGivesTheSameBytesAtAnyTimeOfDay) {
  const sample::Folder one, two;
  for (const sample::Folder* folder : {&one, &two}) {
    for (const FieldFormat format : {FieldFormat::vtkhdf, FieldFormat::vtu})
      FieldSeries(folder->path(), spec(format)).write(sample::snapshot());
    std::this_thread::sleep_for(std::chrono::milliseconds(1050));  // HDF5 knows the time to a second
  }
  EXPECT_TRUE(one.read("fields_000000.vtu") == two.read("fields_000000.vtu"));
  EXPECT_TRUE(one.read("fields_000000.hdf") == two.read("fields_000000.hdf"));
  EXPECT_GT(one.read("fields_000000.hdf").size(), 1000u);
}

TEST(FieldSeries, AStateIsWrittenOnce) {
  const sample::Folder folder;
  FieldSeries series(folder.path(), spec(FieldFormat::csv));
  series.write(sample::snapshot(0.0));
  series.write(sample::snapshot(0.5));
  series.write(sample::snapshot(0.5));
  EXPECT_EQ(series.index().size(), 2u);
  EXPECT_FALSE(folder.has("fields_000002.csv"));
}

TEST(FieldSeries, GoesOnAfterTheKeptFrames) {
  const sample::Folder folder;
  FieldSeries series(folder.path(), spec(FieldFormat::vtkhdf));
  for (const double time : {0.0, 0.1, 0.2}) series.write(sample::snapshot(time));
  FieldSeries resumed(folder.path(), spec(FieldFormat::vtkhdf), ContinueFrom{0.15});
  EXPECT_EQ(resumed.index().size(), 2u);
  resumed.write(sample::snapshot(0.1));  // already there
  resumed.write(sample::snapshot(0.3));
  EXPECT_EQ(resumed.index().size(), 3u);
  EXPECT_TRUE(folder.has("fields_000002.hdf"));
}

TEST(CellSeries, PolyhedraAndTetrahedra) {
  const sample::Folder folder;
  const std::vector<Polyhedron> cells = {
      {3, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}}};
  CellSeries(folder.path(), spec(FieldFormat::vtkhdf), cells).write(sample::snapshot());
  const std::string text = folder.read("cells_000000.vtu");
  EXPECT_NE(text.find("NumberOfPoints=\"4\" NumberOfCells=\"1\""), std::string::npos);
  EXPECT_NE(text.find("Name=\"faceoffsets\""), std::string::npos);
  EXPECT_LT(text.find("<CellData>"), text.find("Name=\"cauchy_stress\""));

  const std::vector<std::array<Index, 4>> tetrahedra = {{0, 1, 2, 4}};
  CellSeries series(folder.path(), spec(FieldFormat::vtkhdf), tetrahedra, ContinueFrom{-1.0});
  EXPECT_EQ(series.index().size(), 0u);
  series.write(sample::snapshot());
  const std::string second = folder.read("cells_000000.vtu");
  EXPECT_NE(second.find("NumberOfPoints=\"8\" NumberOfCells=\"1\""), std::string::npos);
  EXPECT_LT(second.find("<PointData>"), second.find("Name=\"cauchy_stress\""));
  EXPECT_EQ(second.find("faceoffsets"), std::string::npos);
}

}  // namespace
}  // namespace tessera
