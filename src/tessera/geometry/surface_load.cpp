#include "tessera/geometry/surface_load.hpp"

#include <fmt/format.h>

#include "tessera/geometry/surface_reader.hpp"
#include "tessera/geometry/surface_transform.hpp"

namespace tessera {

CheckedSurface load_surface(const std::string& path, double unit) {
  CheckedSurface checked = check_surface(read_surface(path));
  checked.surface = transformed(std::move(checked.surface), diagonal(unit, unit, unit), {});
  checked.repairs.tolerance *= unit;
  return checked;
}

std::string describe(const CheckedSurface& checked) {
  std::string text;
  const auto add = [&text](Index count, std::string_view one, std::string_view many, std::string_view what) {
    if (count == 0) return;
    text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", count, count == 1 ? one : many, what);
  };
  add(checked.surface.size(), "triangle", "triangles", "");
  add(static_cast<Index>(checked.surface.vertices.size()), "vertex", "vertices", "");
  add(checked.shells, "shell", "shells", "");
  add(checked.cavities, "cavity", "cavities", "");
  std::string found = std::move(text);
  text.clear();
  const SurfaceRepairs& repairs = checked.repairs;
  add(repairs.moved_vertices, "vertex", "vertices", " welded");
  add(repairs.flat_triangles, "flat triangle", "flat triangles", " dropped");
  add(repairs.doubled_triangles, "doubled triangle", "doubled triangles", " dropped");
  add(repairs.back_to_back, "pair", "pairs", " of triangles back to back dropped");
  add(repairs.split_triangles, "triangle", "triangles", " split at vertices on edges");
  add(repairs.turned_triangles, "triangle", "triangles", " turned round");
  return text.empty() ? found : found + "; mended: " + text;
}

}  // namespace tessera
