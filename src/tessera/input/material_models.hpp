#pragma once

#include <span>
#include <string>

#include "tessera/laws/material.hpp"

namespace tessera::input {

/// A material model as the input knows it: its name, one sentence, and how it sets the law of a material whose
/// constants have been read.
struct MaterialModel {
  const char* name;
  const char* sentence;
  void (*set_law)(Material&);
};

std::span<const MaterialModel> material_models();

}  // namespace tessera::input
