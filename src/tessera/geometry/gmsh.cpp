#include "tessera/geometry/gmsh.hpp"

#include <fmt/format.h>

#include "tessera/geometry/gmsh_builder.hpp"

namespace tessera {
namespace {

enum class Version { v22, v41 };

Version read_version(GmshCursor& cursor) {
  const std::string_view version = cursor.read_word();
  if (version == "2.2") return Version::v22;
  if (version == "4.1") return Version::v41;
  cursor.fail(fmt::format(
      "format version \"{}\" cannot be read: write 4.1 or 2.2 (gmsh -format msh41, Mesh.MshFileVersion = 4.1)",
      version.substr(0, 20)));
}

/// In a binary file the number 1 shows the byte order.
void read_byte_order(GmshCursor& cursor) {
  cursor.skip_to_next_line();
  cursor.set_encoding(GmshEncoding::binary);
  const int one = cursor.read_int();
  if (one == 0x01000000)
    cursor.fail(
        "the file was written with the opposite byte order (big-endian): write it on this kind of machine, or in "
        "ASCII");
  if (one != 1) cursor.fail("the mark of the byte order is damaged: write the file again");
}

Version read_format(GmshCursor& cursor) {
  cursor.expect("$MeshFormat");
  const Version version = read_version(cursor);
  const std::int64_t encoding = cursor.read_text_long();
  const std::int64_t size = cursor.read_text_long();
  if (encoding < 0 || encoding > 1 || size != 8)
    cursor.fail(fmt::format("file type {} and data size {} are not known: 0 or 1, and 8, are", encoding, size));
  if (encoding == 1) read_byte_order(cursor);
  cursor.expect("$EndMeshFormat");
  return version;
}

std::vector<NamedSurface> read_physical_names(GmshCursor& cursor) {
  const std::size_t count = cursor.check_count(cursor.read_text_long(), 6, "physical names");
  std::vector<NamedSurface> surfaces;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t dimension = cursor.read_text_long();
    const auto group = static_cast<int>(cursor.read_text_long());
    std::string name = cursor.read_quoted();
    if (dimension == 2) surfaces.push_back({group, std::move(name)});
  }
  return surfaces;
}

/// Reads the sections one after the other; those that carry no geometry are passed over.
class SectionReader {
 public:
  SectionReader(FileMesh& mesh, GmshCursor& cursor, Version version)
      : mesh_(mesh), cursor_(cursor), version_(version), builder_(mesh, cursor) {}

  void read(std::string_view name) {
    cursor_.skip_to_next_line();
    if (name == "PhysicalNames")
      mesh_.surfaces = read_physical_names(cursor_);
    else if (name == "Nodes")
      version_ == Version::v22 ? read_nodes_22(cursor_, builder_) : read_nodes_41(cursor_, builder_);
    else if (name == "Elements")
      read_elements();
    else if (name == "Entities" && version_ == Version::v41)
      surfaces_ = read_entities_41(cursor_);
    else if (name == "PartitionedEntities")
      cursor_.fail("the mesh is partitioned: write it in one piece (gmsh without -part)");
    else
      return cursor_.skip_section(name);
    cursor_.expect(fmt::format("$End{}", name));
  }

 private:
  void read_elements() {
    if (version_ == Version::v22)
      read_elements_22(cursor_, builder_);
    else
      read_elements_41(cursor_, builder_, surfaces_);
  }

  FileMesh& mesh_;
  GmshCursor& cursor_;
  Version version_;
  GmshBuilder builder_;
  GmshSurfaces surfaces_;
};

}  // namespace

FileMesh read_gmsh(const std::string& path, std::string_view bytes) {
  GmshCursor cursor(path, bytes);
  const Version version = read_format(cursor);
  FileMesh mesh;
  mesh.path = path;
  mesh.unit = cursor.unit();
  SectionReader reader(mesh, cursor, version);
  for (cursor.skip_space(); !cursor.at_end(); cursor.skip_space()) {
    const std::string_view word = cursor.read_word();
    if (word.front() != '$')
      cursor.fail(fmt::format("a section ($Nodes, $Elements, ...) is expected here, found \"{}\"", word.substr(0, 40)));
    reader.read(word.substr(1));
  }
  return mesh;
}

}  // namespace tessera
