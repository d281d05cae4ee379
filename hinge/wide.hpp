// Loops over rows of cells and nodes, several at once.
//
// The same bits on every processor: wider registers, no fused multiply-add. (ThreadSanitizer cannot start a program
// that chooses its functions while loading, and clang chooses no templates.)
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define DIPTYCH_WIDE [[gnu::target_clones("avx2", "default")]]
#else
#define DIPTYCH_WIDE
#endif
#define DIPTYCH_INLINE __attribute__((always_inline))  // a lambda that stays a call keeps its loop from being widened
