#include "tessera/app/version.hpp"

#include <fmt/format.h>

#include "tessera/base/version.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera {

std::string version_text() {
  return fmt::format(
      "tessera {}\n"
      "compiler:   {}\n"
      "build type: {}\n"
      "options:    CGAL (Delaunay tetrahedra, booleans of shapes) {}\n"
      "\n"
      "Please cite the paper of the formulation that you use:\n"
      "  delaunay: G. Frenning, Towards a macroscopically consistent discrete method for granular materials:\n"
      "            Delaunay strain-based formulation, Comput. Part. Mech. 9, 1105-1118 (2022), "
      "doi:10.1007/s40571-021-00452-8\n"
      "  voronoi:  G. Frenning, A Voronoi strain-based method for granular materials and continua,\n"
      "            Comput. Part. Mech. 10, 427-443 (2023), doi:10.1007/s40571-022-00508-3\n",
      version(), TESSERA_COMPILER, TESSERA_BUILD_TYPE, has_delaunay() ? "on" : "off");
}

}  // namespace tessera
