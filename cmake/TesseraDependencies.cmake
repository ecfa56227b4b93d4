# Libraries from the system. Of CGAL the kernel (LGPL) is always used, the triangulations (GPL) with TESSERA_WITH_CGAL.
find_package(Threads REQUIRED)
find_package(muparser REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(ZLIB REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS C)

find_package(CGAL CONFIG REQUIRED)
message(STATUS "Delaunay tetrahedra by CGAL (GPL): ${TESSERA_WITH_CGAL}")

if(TESSERA_BUILD_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
  # An independent implementation of Voronoi cells, for comparison.
  find_path(VOROPP_INCLUDE_DIR voro++/voro++.hh REQUIRED)
  find_library(VOROPP_LIBRARY voro++ REQUIRED)
  add_library(voropp::voropp UNKNOWN IMPORTED)
  set_target_properties(voropp::voropp PROPERTIES IMPORTED_LOCATION ${VOROPP_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${VOROPP_INCLUDE_DIR})
endif()
