// Memory of the machine and of this process.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trace::os {

/// The memory of this machine, or of the container that the process runs in, in bytes.
std::uint64_t machineMemory();
/// The most memory this process ever held, in bytes.
std::uint64_t peakMemory();

/// From now on the process gets so much more memory than it has, and the stacks of so many threads: what is
/// beyond fails with std::bad_alloc, wherever it is asked for. False where the system has no such limit, or
/// under a sanitizer, whose own memory counts too.
bool limitMemory(std::uint64_t bytes, int threads);
/// Takes the limit away, so that there is memory to say what happened.
void liftMemoryLimit();

/// Memory that reading has freed serves to build, and so on: memory that is given back and asked for anew
/// costs a page fault every 4 KiB.
void keepFreedMemory();

/// The size of a huge page.
constexpr std::size_t kLargePage = std::size_t{2} << 20;

/// Memory for large arrays, in huge pages where the system has them. It is mapped anew each time: what an
/// allocator hands out again has mostly become small pages before. Throws std::bad_alloc.
void* allocateLarge(std::size_t bytes);
void freeLarge(void* memory, std::size_t bytes);
/// Whether allocateLarge() is better than the allocator for so many bytes: rounding up to pages wastes
/// little.
bool isLarge(std::size_t bytes);

}  // namespace trace::os
