#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace tessera {

/// Allocates on cache-line boundaries, as the vector loads of the sweeps need it; large arrays on the boundaries of
/// huge pages, which it asks for: the sweeps jump between neighbours, and small pages would cost an address translation
/// each time.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::size_t cache_line = 64, huge_page = std::size_t{1} << 21U;
  static constexpr std::align_val_t alignment(std::size_t n) {
    return std::align_val_t{n * sizeof(T) >= 2 * huge_page ? huge_page : cache_line};
  }

  CacheLineAllocator() = default;
  template <class U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>&) {}

  T* allocate(std::size_t n) {
    void* p = ::operator new(n * sizeof(T), alignment(n));
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (n * sizeof(T) >= 2 * huge_page) madvise(p, n * sizeof(T), MADV_HUGEPAGE);  // a wish; refusal costs nothing
#endif
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t n) { ::operator delete(p, alignment(n)); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

/// The same for arrays that are written before they are read: leaves new elements as they are, so that the threads that
/// fill an array are the first to touch its pages.
template <class T>
struct RawAllocator : CacheLineAllocator<T> {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  template <class U>
  struct rebind {
    using other = RawAllocator<U>;
  };
  RawAllocator() = default;
  template <class U>
  explicit RawAllocator(const RawAllocator<U>&) {}

  template <class U>
  void construct(U*) {}
  template <class U, class First, class... Rest>
  void construct(U* p, First&& first, Rest&&... rest) {
    ::new (static_cast<void*>(p)) U(std::forward<First>(first), std::forward<Rest>(rest)...);
  }
};

/// One value per bond or the like; resize() leaves the new ones undefined.
template <class T>
using RawField = std::vector<T, RawAllocator<T>>;

/// One value per particle, node or bond.
template <class T>
using Field = std::vector<T, CacheLineAllocator<T>>;

}  // namespace tessera
