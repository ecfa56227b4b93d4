#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tessera/base/error.hpp"
#include "tessera/geometry/gmsh.hpp"
#include "tessera/tessellation/mesh_faces.hpp"
#include "tessera/tessellation/surface_mesher.hpp"

namespace tessera {
namespace {

namespace fs = std::filesystem;

// Points per direction, at most, where gmsh is told the local size; it interpolates between them.
constexpr int size_samples = 64;

/// A new folder that is gone with this object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "tessera-mesh-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw GeometryError(fmt::format("cannot make a folder of temporary files {}: {}", name, std::strerror(errno)));
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const char* name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

/// The program's path, empty when there is none.
std::string find_gmsh() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string program = (folder.empty() ? "." : folder) + "/gmsh";
    if (access(program.c_str(), X_OK) == 0 && fs::is_regular_file(program)) return program;
  }
  return {};
}

void write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw GeometryError(fmt::format("cannot write the temporary file {}", path));
}

/// Gmsh 2.2: patches as surfaces, lines as curves, each an entity of its own.
std::string surface_text(const TriangleSurface& surface, const SurfaceFeatures& features) {
  std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", surface.vertices.size());
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    const Vec3& X = surface.vertices[v];
    text += fmt::format("{} {} {} {}\n", v + 1, X.x, X.y, X.z);
  }
  std::string elements;
  std::size_t count = 0;
  for (Index t = 0; t < surface.size(); ++t) {
    const Triangle& v = surface.triangle(t);
    const Index entity = features.patch[static_cast<std::size_t>(t)] + 1;
    elements += fmt::format("{} 2 2 {} {} {} {} {}\n", ++count, entity, entity, v[0] + 1, v[1] + 1, v[2] + 1);
  }
  for (std::size_t l = 0; l < features.lines.size(); ++l)
    for (std::size_t i = 1; i < features.lines[l].size(); ++i)
      elements += fmt::format("{} 1 2 {} {} {} {}\n", ++count, l + 1, l + 1, features.lines[l][i - 1] + 1,
                              features.lines[l][i] + 1);
  return text + fmt::format("$EndNodes\n$Elements\n{}\n{}$EndElements\n", count, elements);
}

/// The local size at the points of a grid around the surface, in the text form of gmsh's field Structured. The grid is
/// half a step wider than the surface: where round-off puts a point outside, gmsh has another size and never ends.
std::string size_text(const Bounds& box, const SurfaceMeshSpec& spec) {
  const Vec3 extent = box.size();
  const double step = std::max({extent.x, extent.y, extent.z}) / (size_samples - 1);
  const Vec3 lower = box.lower - 0.5 * step * Vec3{1.0, 1.0, 1.0};
  std::array<int, 3> n{};
  for (int d = 0; d < 3; ++d) n[static_cast<std::size_t>(d)] = static_cast<int>(std::ceil(extent[d] / step + 0.5)) + 1;
  std::string text =
      fmt::format("{} {} {}\n{} {} {}\n{} {} {}\n", lower.x, lower.y, lower.z, step, step, step, n[0], n[1], n[2]);
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k)
        text += fmt::format("{}\n", spec.size(lower + step * Vec3{1.0 * i, 1.0 * j, 1.0 * k}));
  return text;
}

/// What gmsh is to do: keep the lines, mesh the rest anew with the size that is asked for.
std::string script_text(const SurfaceMeshSpec& spec, const TemporaryFolder& folder) {
  std::string text = fmt::format(
      "Merge \"surface.msh\";\n"
      "ClassifySurfaces{{{} * Pi / 180, 1, 1, {} * Pi / 180}};\n"
      "CreateGeometry;\n"
      "Surface Loop(1) = Surface{{:}};\n"
      "Volume(1) = {{1}};\n"
      "Mesh.CharacteristicLengthFromPoints = 0;\n"
      "Mesh.CharacteristicLengthExtendFromBoundary = 0;\n"
      "Mesh.RandomSeed = 1;\n"
      "Mesh.MshFileVersion = 2.2;\n"
      "Mesh.Binary = 0;\n"
      "Mesh.SaveAll = 1;\n",
      spec.feature_angle, kCornerAngle);
  if (!spec.size)
    return text +
           fmt::format("Mesh.CharacteristicLengthMin = {0};\nMesh.CharacteristicLengthMax = {0};\n", spec.spacing);
  return text + fmt::format(
                    "Field[1] = Structured;\n"
                    "Field[1].FileName = \"{}\";\n"
                    "Field[1].TextFormat = 1;\n"
                    "Background Field = 1;\n",
                    folder.file("size.txt"));
}

/// The program's environment: its settings are not those of the user, so that a mesh depends on the case alone.
std::vector<std::string> environment(const std::string& home) {
  std::vector<std::string> all{"GMSH_HOME=" + home, "OMP_NUM_THREADS=1"};
  for (char** e = environ; *e != nullptr; ++e)
    if (!std::string_view(*e).starts_with("GMSH_HOME=") && !std::string_view(*e).starts_with("OMP_NUM_THREADS="))
      all.emplace_back(*e);
  return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

/// Runs the program in the folder, its output to the file log.txt there; returns its status as waitpid gives it.
int run_in(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  std::vector<std::string> variables = environment(folder.path());
  const std::vector<char*> argv = pointers_to(arguments), envp = pointers_to(variables);
  const std::string log = folder.file("log.txt");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = 0;
  const int failed = posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), envp.data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw GeometryError(fmt::format("cannot run {}: {}", arguments[0], std::strerror(failed)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw GeometryError(fmt::format("lost {}: {}", arguments[0], std::strerror(errno)));
  return status;
}

/// The lines in which gmsh tells of errors, without the summary at their end; or else its last line.
std::string complaint(const std::string& log) {
  std::ifstream file(log);
  std::string errors, last;
  for (std::string line; std::getline(file, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    if (!line.starts_with("Error")) continue;
    const std::string text = line.substr(std::min(line.find_first_not_of(" :", 5), line.size()));
    if (text.starts_with("---")) break;
    errors += (errors.empty() ? "" : "; ") + text;
  }
  return errors.empty() ? last : errors;
}

void refuse_failure(int status, const std::string& program, const TemporaryFolder& folder) {
  const bool made = fs::exists(folder.file("mesh.msh"));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && made) return;
  const std::string how =
      WIFSIGNALED(status) ? fmt::format("was ended by signal {}", WTERMSIG(status))
                          : fmt::format("ended with status {}{}", WEXITSTATUS(status), made ? "" : " and left no mesh");
  const std::string said = complaint(folder.file("log.txt"));
  throw GeometryError(
      fmt::format("{} {}{}; a finer spacing may help, or mesher = \"cgal\", or a mesh made by hand: "
                  "particles = {{ mesh = \"part.msh\" }}",
                  program, how, said.empty() ? "" : ", saying: " + said));
}

/// The points that tetrahedra use, and those.
RawMesh used_part(const FileMesh& file) {
  RawMesh mesh;
  std::vector<Index> number(file.points.size(), -1);
  for (const auto& element : file.tetrahedra) {
    Tetrahedron t{};
    for (std::size_t i = 0; i < 4; ++i) {
      Index& n = number[static_cast<std::size_t>(element.vertices[i])];
      if (n < 0) {
        n = static_cast<Index>(mesh.points.size());
        mesh.points.push_back(file.points[static_cast<std::size_t>(element.vertices[i])]);
      }
      t[i] = n;
    }
    if (six_volume(t, mesh.points) < 0.0) std::swap(t[2], t[3]);
    mesh.tetrahedra.push_back(t);
  }
  return mesh;
}

}  // namespace

bool has_gmsh() { return !find_gmsh().empty(); }

RawMesh mesh_with_gmsh(const TriangleSurface& surface, const SurfaceFeatures& features, const SurfaceMeshSpec& spec) {
  const std::string program = find_gmsh();
  if (program.empty())
    throw GeometryError(
        "mesher = \"gmsh\" needs the program gmsh on the search path (Debian: apt-get install gmsh); it is not there");
  const TemporaryFolder folder;
  write_file(folder.file("surface.msh"), surface_text(surface, features));
  write_file(folder.file("mesh.geo"), script_text(spec, folder));
  if (spec.size) write_file(folder.file("size.txt"), size_text(bounds(surface), spec));
  const int status = run_in(folder, {program, folder.file("mesh.geo"), "-3", "-nt", "1", "-nopopup", "-v", "2", "-o",
                                     folder.file("mesh.msh")});
  refuse_failure(status, program, folder);
  return used_part(read_gmsh(folder.file("mesh.msh"), read_whole_file(folder.file("mesh.msh"))));
}

}  // namespace tessera
