#include "tessera/geometry/binary_cursor.hpp"

#include "tessera/base/error.hpp"
#include "tessera/geometry/file_place.hpp"

namespace tessera {

void BinaryCursor::fail(const std::string& message) const {
  throw GeometryError(locate(path_, PlaceUnit::byte, static_cast<std::int64_t>(last_) + 1) + message);
}

}  // namespace tessera
