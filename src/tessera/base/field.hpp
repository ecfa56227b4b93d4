#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace tessera {

/// Allocates on cache-line boundaries, as the vector loads of the sweeps need it.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  CacheLineAllocator() = default;
  template <class U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>&) {}

  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

/// One value per particle, node or bond.
template <class T>
using Field = std::vector<T, CacheLineAllocator<T>>;

}  // namespace tessera
