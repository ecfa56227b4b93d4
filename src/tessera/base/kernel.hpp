#pragma once

// One binary serves several instruction sets: the loader picks the clone (sanitizers start before it can, clang clones
// no flat functions). What needs registers of 512 bits is a function of its own, for processors that have them.
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__OPTIMIZE_SIZE__) && defined(__OPTIMIZE__)
#define TESSERA_KERNEL __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"), flatten))
#define TESSERA_WIDE_KERNEL __attribute__((target("arch=x86-64-v4"), flatten))
#define TESSERA_WIDE_INLINE __attribute__((target("arch=x86-64-v4"))) inline
#else
#define TESSERA_KERNEL
#endif

namespace tessera {

#ifdef TESSERA_WIDE_KERNEL
/// The processor runs wide kernels.
inline bool has_wide_registers() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
}
#endif

/// What the processor's widest registers hold.
enum class Registers { four_numbers, eight_numbers };

/// Found out once.
inline Registers widest_registers() {
#ifdef TESSERA_WIDE_KERNEL
  static const Registers widest = has_wide_registers() ? Registers::eight_numbers : Registers::four_numbers;
  return widest;
#else
  return Registers::four_numbers;
#endif
}

}  // namespace tessera
