#include "tessera/loads/surface.hpp"

namespace tessera {

std::span<const std::string> Surface::names_of(const SurfacePiece& piece) const {
  if (piece.side < 0) return {};
  return side_names[static_cast<std::size_t>(piece.side)];
}

}  // namespace tessera
