#include "tessera/geometry/surface_reader.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <random>

#include "shapes.hpp"
#include "support/surfaces.hpp"
#include "tessera/geometry/surface_check.hpp"
#include "tessera/geometry/surface_load.hpp"

namespace tessera {
namespace {

using test::ball_surface;
using test::expect_contains;
using test::message_of;

std::string data_path(const std::string& name) {
  return std::string(TESSERA_SOURCE_DIR "/tests/data/surfaces/") + name;
}

template <class T>
void append(std::string& bytes, T value, std::endian order) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (order != std::endian::native) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

std::string binary_stl(const TriangleSurface& surface) {
  std::string bytes = "solid but binary all the same";
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(surface.size()), std::endian::little);
  for (Index t = 0; t < surface.size(); ++t) {
    for (int d = 0; d < 3; ++d) append(bytes, 0.0F, std::endian::little);
    for (const Vec3& X : surface.corners(t))
      for (int d = 0; d < 3; ++d) append(bytes, static_cast<float>(X[d]), std::endian::little);
    append(bytes, std::uint16_t{0}, std::endian::little);
  }
  return bytes;
}

std::string text_stl(const TriangleSurface& surface) {
  std::string text;
  for (std::size_t s = 0; s < surface.side_names.size(); ++s) {
    text += fmt::format("solid {}\r\n", surface.side_names[s]);
    for (Index t = 0; t < surface.size(); ++t) {
      if (surface.side[static_cast<std::size_t>(t)] != static_cast<Index>(s)) continue;
      text += "FACET NORMAL 0 0 0\r\nOUTER LOOP\r\n";
      for (const Vec3& X : surface.corners(t)) text += fmt::format("VERTEX {} {} {}\r\n", X.x, X.y, X.z);
      text += "ENDLOOP\r\nENDFACET\r\n";
    }
    text += "endsolid\r\n";
  }
  return text;
}

std::string binary_ply(const TriangleSurface& surface, std::endian order) {
  std::string bytes = fmt::format(
      "ply\nformat binary_{}_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nproperty short quality\nend_header\n",
      order == std::endian::little ? "little" : "big", surface.vertices.size(), surface.size());
  for (const Vec3& X : surface.vertices)
    for (int d = 0; d < 3; ++d) append(bytes, X[d], order);
  for (const Triangle& t : surface.triangles) {
    append(bytes, std::uint8_t{3}, order);
    for (const Index v : t) append(bytes, v, order);
    append(bytes, std::int16_t{-1}, order);
  }
  return bytes;
}

std::string obj(const TriangleSurface& surface) {
  std::string text;
  for (const Vec3& X : surface.vertices) text += fmt::format("v {} {} {}\n", X.x, X.y, X.z);
  for (const Triangle& t : surface.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string off(const TriangleSurface& surface) {
  std::string text = fmt::format("OFF\n{} {} 0\n", surface.vertices.size(), surface.size());
  for (const Vec3& X : surface.vertices) text += fmt::format("{} {} {}\n", X.x, X.y, X.z);
  for (const Triangle& t : surface.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

double area_of_side(const TriangleSurface& surface, const std::string& name) {
  double sum = 0.0;
  for (Index t = 0; t < surface.size(); ++t)
    if (surface.side_names[static_cast<std::size_t>(surface.side[static_cast<std::size_t>(t)])] == name)
      sum += norm(area_vector(surface, t));
  return sum;
}

TEST(SurfaceReader, EveryFormatGivesBackTheSurface) {
  const TriangleSurface ball = ball_surface(1, 9, 11);
  for (const FileSurface& file :
       {read_ply("a.ply", binary_ply(ball, std::endian::little)), read_ply("a.ply", binary_ply(ball, std::endian::big)),
        read_obj("a.obj", obj(ball)), read_off("a.off", off(ball))}) {
    EXPECT_EQ(file.surface.vertices, ball.vertices);
    EXPECT_EQ(file.surface.triangles, ball.triangles);
    EXPECT_EQ(file.surface.side_names, std::vector<std::string>{"surface"});
  }
  for (const FileSurface& file : {read_stl("a.stl", binary_stl(ball)), read_stl("a.stl", text_stl(ball))}) {
    const CheckedSurface checked = check_surface(file);
    EXPECT_EQ(checked.surface.vertices.size(), ball.vertices.size());
    EXPECT_EQ(checked.surface.size(), ball.size());
    EXPECT_NEAR(volume(checked.surface), volume(ball), 1e-6);
  }
}

TEST(SurfaceReader, SolidsOfAnStlFileBecomeSides) {
  const FileSurface file = read_surface(data_path("tetrahedron.stl"));
  EXPECT_EQ(file.surface.side_names, (std::vector<std::string>{"legs", "the cut"}));
  EXPECT_EQ(file.surface.side, (std::vector<Index>{0, 0, 0, 1}));
  EXPECT_EQ(file.place, (std::vector<std::int64_t>{2, 9, 16, 25}));
  EXPECT_DOUBLE_EQ(volume(check_surface(file).surface), 1.0 / 6.0);
}

TEST(SurfaceReader, GroupsOfAnObjFileBecomeSides) {
  const CheckedSurface box = check_surface(read_surface(data_path("box.obj")));
  EXPECT_EQ(box.surface.side_names, (std::vector<std::string>{"bottom", "top", "mantle"}));
  EXPECT_DOUBLE_EQ(volume(box.surface), 2);
  EXPECT_DOUBLE_EQ(area_of_side(box.surface, "bottom"), 2);
  EXPECT_DOUBLE_EQ(area_of_side(box.surface, "top"), 2);
  EXPECT_DOUBLE_EQ(area_of_side(box.surface, "mantle"), 6);
}

TEST(SurfaceReader, TheGroupingThatTellsMostApartMakesTheSides) {
  const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const auto names = [&](const std::string& faces) { return read_obj("a.obj", head + faces).surface.side_names; };
  EXPECT_EQ(names("o a\nusemtl x\nf 1 3 2\nf 1 2 4\no b\nf 1 4 3\nf 2 3 4\n"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(names("o a\nusemtl x\nf 1 3 2\nusemtl y\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"),
            (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(names("f 1 3 2\nusemtl y\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"), (std::vector<std::string>{"surface", "y"}));
  EXPECT_EQ(names("o part\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"), (std::vector<std::string>{"part"}));
}

TEST(SurfaceReader, PolygonsThatAreNotConvexAreDivided) {
  const CheckedSurface prism = check_surface(read_surface(data_path("l_prism.off")));
  EXPECT_DOUBLE_EQ(volume(prism.surface), 4);
  EXPECT_EQ(prism.surface.size(), 2 * 4 + 6 * 2);
  EXPECT_FALSE(prism.repairs.any());
}

TEST(SurfaceReader, PassesOverWhatPlyFilesCarryBesides) {
  const CheckedSurface checked = check_surface(read_surface(data_path("tetrahedron.ply")));
  EXPECT_DOUBLE_EQ(volume(checked.surface), 1.0 / 6.0);
}

TEST(SurfaceReader, PhysicalSurfacesOfGmshBecomeSides) {
  const CheckedSurface named = check_surface(read_surface(data_path("tetrahedron_22.msh")));
  EXPECT_EQ(named.surface.side_names, (std::vector<std::string>{"legs", "cut"}));
  EXPECT_DOUBLE_EQ(area_of_side(named.surface, "legs"), 1.5);
  EXPECT_DOUBLE_EQ(volume(named.surface), 1.0 / 6.0);
  const CheckedSurface nameless = check_surface(read_surface(data_path("tetrahedron_41.msh")));
  EXPECT_EQ(nameless.surface.side_names, std::vector<std::string>{"surface"});
  EXPECT_DOUBLE_EQ(volume(nameless.surface), 1.0 / 6.0);
}

TEST(LoadSurface, GivesMetresAndSaysWhatWasMended) {
  const CheckedSurface box = load_surface(data_path("box.obj"), 1e-3);
  EXPECT_NEAR(volume(box.surface), 2e-9, 1e-23);
  EXPECT_EQ(bounds(box.surface).upper, (Vec3{2e-3, 1e-3, 1e-3}));
  EXPECT_EQ(describe(box), "12 triangles, 8 vertices, 1 shell");
  CheckedSurface mended = box;
  mended.repairs.moved_vertices = 2;
  mended.repairs.turned_triangles = 1;
  EXPECT_EQ(describe(mended), "12 triangles, 8 vertices, 1 shell; mended: 2 vertices welded, 1 triangle turned round");
}

TEST(CutEars, DividesCombsAndSpirals) {
  // A comb with teeth of random lengths, in a tilted plane, either way round.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> length(0.1, 5);
  for (const bool reversed : {false, true}) {
    std::vector<Vec3> comb;
    for (int i = 0; i < 40; ++i) comb.push_back({0.5 * i, i % 2 == 0 ? 0 : length(random), 0.3 * i});
    comb.push_back({19.5, -1, 11.7});
    comb.push_back({0, -1, 0});
    if (reversed) std::reverse(comb.begin(), comb.end());
    Vec3 whole, parts;
    for (std::size_t i = 0; i < comb.size(); ++i) whole += 0.5 * cross(comb[i], comb[(i + 1) % comb.size()]);
    const auto triangles = cut_ears(comb);
    ASSERT_EQ(triangles.size(), comb.size() - 2);
    double total = 0.0;
    for (const auto& [i, j, k] : triangles) {
      const Vec3 part = 0.5 * cross(comb[j] - comb[i], comb[k] - comb[i]);
      parts += part;
      total += norm(part);
    }
    EXPECT_LT(norm(parts - whole), 1e-12);
    EXPECT_NEAR(total, norm(whole), 1e-12);  // none of them runs the other way
  }
}

TEST(CutEars, TakesStraightCornersAndRefusesCrossings) {
  const std::vector<Vec3> straight{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}};
  EXPECT_EQ(cut_ears(straight).size(), 4u);
  const std::vector<Vec3> bow{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_TRUE(cut_ears(bow).empty());
}

std::string fault_of(FileSurface (*read)(const std::string&, std::string_view), const std::string& bytes) {
  return message_of<GeometryError>([&] { read("f", bytes); });
}

TEST(SurfaceReader, FaultsNameLineAndWhatIsAllowed) {
  expect_contains(fault_of(read_stl, "solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 x\n"),
                  "f:4: a number is expected here, found \"x\"");
  expect_contains(fault_of(read_stl, "solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\n"), "truncated");
  expect_contains(fault_of(read_stl, "solid a\nfoo\n"), "f:2: \"facet\" or \"endsolid\"");
  expect_contains(fault_of(read_stl, "something else"), "no STL file");
  expect_contains(fault_of(read_obj, "v 0 0 0\nf 1 2 3\n"), "f:2: there is no vertex 2: 1 were given above");
  expect_contains(fault_of(read_obj, "v 0 0 0\nf -2 1 1\n"), "there is no vertex -2");
  expect_contains(fault_of(read_obj, "v 0 0 0\nv 0 0 1\nf 1 2\n"), "f:3: a face has 2 corners");
  expect_contains(fault_of(read_obj, "v 0 0 0\ncstype bezier\n"), "f:2: the statement \"cstype\" cannot be used");
  expect_contains(fault_of(read_obj, "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 3 4\n"),
                  "f:6: the outline of a face");
  expect_contains(fault_of(read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
                  "f:6: there is no vertex 3: numbers from 0 to 2");
  expect_contains(fault_of(read_obj, "v 0 0 0\nv 1 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3 4\n"), "f:5: a face has a corner");
  expect_contains(fault_of(read_obj, "v 0 0 0\nv 1 0 0\nv 1e999 1 0\nv 0 1 0\nf 1 2 3 4\n"),
                  "f:5: a face has a corner");
  expect_contains(fault_of(read_off, "4OFF\n3 1 0\n"), "\"4OFF\"");
  expect_contains(fault_of(read_off, "OFF\n2000000000 1 0\n0 0 0\n"), "2000000000 vertices are announced");
  expect_contains(fault_of(read_ply, "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"),
                  "x, y and z are needed");
  expect_contains(fault_of(read_ply, "ply\nformat binary 1.0\n"), "f:2: the format \"binary\"");
  expect_contains(fault_of(read_ply, "plx\n"), "f:1: \"ply\" is expected");
  expect_contains(message_of<GeometryError>([] { read_surface("part.step"); }), ".stl, .obj, .ply, .off and .msh");
  expect_contains(message_of<GeometryError>([] { read_surface("nowhere.stl"); }), "no such file");
}

TEST(SurfaceReader, FaultsSayWhatIsOdd) {
  expect_contains(fault_of(read_stl, "solid a\rfacet normal 0 0 1\r"), "carriage returns alone");
  for (const char* text : {"v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", "# a comment\rv 0 0 0\r"})
    expect_contains(fault_of(read_obj, text), "f:1: the file is one line: its lines end in carriage returns alone");
  expect_contains(fault_of(read_ply,
                           "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                           "property list uchar float y\nproperty float z\nend_header\n0 1 0 0\n"),
                  "f:5: the coordinate y of vertices is a list; one number is allowed, as in \"property float y\"");
  expect_contains(fault_of(read_ply,
                           "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
                           "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
                           "3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n"),
                  "f:9: no vertices are given above the faces");
  expect_contains(fault_of(read_stl, binary_stl(ball_surface(1, 4, 4)) + "more"), "or more was appended to it");
  expect_contains(message_of<GeometryError>([] { read_surface(TESSERA_SOURCE_DIR "/tests/data.stl"); }),
                  "no such file");
  expect_contains(message_of<GeometryError>([] { read_whole_file(data_path("")); }), "it is a folder");
  expect_contains(message_of<GeometryError>([] { check_surface(read_off("f", "OFF\n0 0 0\n")); }), "no triangle");
  const auto flat = [] { check_surface(read_obj("f", "v 0 0 0\nv 1 0 0\nv 3e38 0 0\nf 1 2 3\n")); };
  expect_contains(message_of<GeometryError>(flat), "1 are no thicker than 7");
}

TEST(SurfaceReader, PassesOverMarksAndLineEndsOfOtherSystems) {
  const TriangleSurface ball = ball_surface(1.0, 3, 4);
  const double exact = volume(check_surface(read_stl("f", text_stl(ball))).surface);
  const std::string mark = "\xef\xbb\xbf";
  EXPECT_EQ(volume(check_surface(read_stl("f", mark + text_stl(ball))).surface), exact);
  EXPECT_EQ(volume(check_surface(read_obj("f", mark + obj(ball))).surface), exact);
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    std::string ply = binary_ply(ball, order);
    const std::size_t end = ply.find("end_header");
    for (std::size_t i = 0; i < ply.find("end_header") + 11; ++i)
      if (ply[i] == '\n') ply.insert(i++, 1, '\r');
    ASSERT_NE(ply.find("end_header"), end);
    EXPECT_EQ(volume(check_surface(read_ply("f", ply)).surface), exact);
  }
}

TEST(SurfaceReader, FaultsOfBinaryFilesNameTheByte) {
  std::string stl = binary_stl(ball_surface(1, 4, 4));
  stl.pop_back();
  expect_contains(fault_of(read_stl, stl),
                  "f: byte 81: 24 triangles are announced, which take 1284 bytes, but the file has 1283");
  std::string ply = binary_ply(ball_surface(1, 4, 4), std::endian::little);
  expect_contains(fault_of(read_ply, ply.substr(0, ply.size() - 20)), "truncated");
  ply[ply.size() - 6] = 100;  // the last corner of the last face, which takes 15 bytes
  expect_contains(fault_of(read_ply, ply), fmt::format("f: byte {}: there is no vertex 100", ply.size() - 15 + 1));
}

/// Whatever is cut off or changed, a reader gives a surface with valid numbers or an error of one line.
void survive(FileSurface (*read)(const std::string&, std::string_view), const std::string& bytes, unsigned seed) {
  const auto attempt = [&](const std::string& damaged) {
    try {
      const FileSurface file = read("f", damaged);
      for (const Triangle& t : file.surface.triangles)
        for (const Index v : t) ASSERT_LT(static_cast<std::size_t>(v), file.surface.vertices.size());
      ASSERT_EQ(file.surface.side.size(), file.surface.triangles.size());
      ASSERT_EQ(file.place.size(), file.surface.triangles.size());
      check_surface(file);
    } catch (const GeometryError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  };
  for (std::size_t end = 0; end < bytes.size(); end += 1 + bytes.size() / 300) attempt(bytes.substr(0, end));
  std::mt19937 random(seed);
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = bytes;
    for (int k = 0; k <= i % 3; ++k) {
      const std::size_t at = random() % damaged.size();
      if (i % 2 == 0)
        damaged[at] = static_cast<char>(random());
      else
        damaged.replace(at, 1, std::array{"-", "9", "\n", " ", "1e999", "99999999999999999999", "nan"}[random() % 7]);
    }
    attempt(damaged);
  }
}

TEST(SurfaceReader, DamagedFilesGiveErrorsAndNoCrash) {
  const TriangleSurface ball = ball_surface(1, 3, 4);
  survive(read_stl, binary_stl(ball), 1);
  survive(read_stl, text_stl(ball), 2);
  survive(read_ply, binary_ply(ball, std::endian::little), 3);
  survive(read_ply, binary_ply(ball, std::endian::big), 4);
  survive(read_ply, read_whole_file(data_path("tetrahedron.ply")), 5);
  survive(read_obj, read_whole_file(data_path("box.obj")), 6);
  survive(read_off, read_whole_file(data_path("l_prism.off")), 7);
  survive(read_msh_surface, read_whole_file(data_path("tetrahedron_22.msh")), 8);
  survive(read_msh_surface, read_whole_file(data_path("tetrahedron_41.msh")), 9);
}

}  // namespace
}  // namespace tessera
