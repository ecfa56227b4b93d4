#include "tessera/input/material_models.hpp"

namespace tessera::input {

namespace {

constexpr MaterialModel models[] = {
    {"neo-hookean", "compressible neo-Hookean solid, U = lambda/2 (ln J)^2 - mu ln J + mu/2 (F:F - 3)",
     [](Material& m) { m.law = NeoHookean::from_young_poisson(m.young, m.poisson); }},
};

}  // namespace

std::span<const MaterialModel> material_models() { return models; }

}  // namespace tessera::input
