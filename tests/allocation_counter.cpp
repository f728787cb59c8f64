#include "allocation_counter.h"

#include <atomic>
#include <cstdlib>
#include <new>

// In a file of its own, so that no compiler sees through the pair and warns of free() on memory from new.
namespace {
std::atomic<long> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}

long wishbone::allocation_count() {
  return allocations;
}
