#pragma once
// A template of which two files have copies that use different registers. A linker takes the first one for both files.
namespace rainref::test {

template <typename T>
__attribute__((noinline)) T next_of(T value) {
#ifdef RAINREF_SPOILING_COPY
  asm volatile("xor %%edx, %%edx\n xor %%r8d, %%r8d\n xor %%r9d, %%r9d\n xor %%r10d, %%r10d\n xor %%r11d, %%r11d" ::
                   : "rdx", "r8", "r9", "r10", "r11", "cc");
#endif
  return value + 1;
}

/// The next of a, and 3 b + 5 c + 7 d: values that live while next_of is called.
long long weighted(long long a, long long b, long long c, long long d);

}  // namespace rainref::test
