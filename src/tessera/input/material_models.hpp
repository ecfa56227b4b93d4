#pragma once

#include <span>
#include <string>

#include "tessera/input/reader.hpp"
#include "tessera/laws/material.hpp"

namespace tessera::input {

/// A material model as the input knows it: its name, one sentence, and how it reads a material's constants and sets its
/// law. Models without Young's modulus and Poisson's ratio set those of the same solid at rest.
struct MaterialModel {
  const char* name;
  const char* sentence;
  void (*set_law)(Material&, const Reader&);
};

std::span<const MaterialModel> material_models();

}  // namespace tessera::input
