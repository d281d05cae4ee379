// Loops over rows of cells and nodes, several at once.
//
// The same bits on every processor: wider registers, no fused multiply-add. (ThreadSanitizer cannot start a program
// that chooses its functions while loading, and clang chooses no templates.)
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define DIPTYCH_WIDE [[gnu::target_clones("avx2", "default")]]
// Where the cache keeps up with registers of 512 bits: they cost the compiler as much again.
#define DIPTYCH_WIDEST [[gnu::target_clones("arch=x86-64-v4", "avx2", "default")]]
#else
#define DIPTYCH_WIDE
#define DIPTYCH_WIDEST
#endif
#define DIPTYCH_INLINE __attribute__((always_inline))  // a lambda that stays a call keeps its loop from being widened
