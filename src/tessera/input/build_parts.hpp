#pragma once

#include <string>
#include <vector>

#include "tessera/input/reader.hpp"
#include "tessera/simulation/case.hpp"

namespace tessera::input {

// Each makes one part of a case of its normalized table and throws InputError for what does not fit together.

BodySpec build_body(const Reader& table, const std::vector<std::string>& materials, const MethodSpec& method);

Shape build_shape(const Reader& table);

BoundaryCondition build_boundary(const Reader& table, const std::vector<std::string>& bodies, int dimension);

OutputSpec build_output(const Reader& table);

ProbeSpec build_probe(const Reader& table, const std::vector<std::string>& bodies);

}  // namespace tessera::input
