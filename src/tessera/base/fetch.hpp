#pragma once

#include <cstdint>

#include "tessera/base/index.hpp"

// Data that are on the way before they are needed. Addresses may lie outside of arrays: fetching has no effect but
// time.

namespace tessera {

template <class T>
inline void fetch(const T* value) {
  const char* first = reinterpret_cast<const char*>(value);
  __builtin_prefetch(first);
  if constexpr (sizeof(T) > 64) __builtin_prefetch(first + sizeof(T) - 1);
}

/// Fetches what follows in an array that is streamed: the processor's own prefetcher stops at pages, and gives way to
/// what waits for other data.
template <Offset bytes, class T>
inline void fetch_ahead(const T* now) {
  __builtin_prefetch(reinterpret_cast<const char*>(now) + bytes);
}
template <Offset bytes, class T>
inline void fetch_to_write(const T* now) {
  __builtin_prefetch(reinterpret_cast<const char*>(now) + bytes, 1);
}

}  // namespace tessera
