#pragma once
// Counts every operator new of a test program: hot paths take no memory. Replaces the global
// operators, so include it in exactly one source of a program.
#include <cstddef>
#include <cstdlib>
#include <new>

namespace vpdr::testing {
inline std::size_t allocations = 0;
}

// Not inlined: a compiler that sees one of malloc() and free() alone takes it for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++vpdr::testing::allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++vpdr::testing::allocations;
  const auto align = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(align, (size + align - 1) / align * align)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
