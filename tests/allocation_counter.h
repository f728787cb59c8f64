#pragma once

namespace wishbone {

/// Heap allocations by operator new since the program started. Link allocation_counter.cpp to use it.
long allocation_count();

}  // namespace wishbone
