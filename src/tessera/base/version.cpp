#include "tessera/base/version.hpp"

namespace tessera {

std::string version() { return TESSERA_VERSION; }

}  // namespace tessera
