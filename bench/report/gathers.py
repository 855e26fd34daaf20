"""scripts/bench --bounds: what a gather takes here, which the model of another processor does not know: of floats that lie in the nearest cache or farther off."""
import os
import subprocess
import tempfile

KIB = (16, 256, 4096)
SOURCE = r"""
#include <immintrin.h>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>
#ifdef __AVX512F__
typedef __m512i Index; typedef __m512 Floats; enum { lanes = 16 };
static Floats gather(const float* p, Index i) { return _mm512_i32gather_ps(i, p, 4); }
static Floats larger(Floats a, Floats b) { return _mm512_max_ps(a, b); }
static Index next(Index i, int mask) { return _mm512_and_si512(_mm512_add_epi32(i, _mm512_set1_epi32(4093)), _mm512_set1_epi32(mask)); }
#else
typedef __m256i Index; typedef __m256 Floats; enum { lanes = 8 };
static Floats gather(const float* p, Index i) { return _mm256_i32gather_ps(p, i, 4); }
static Floats larger(Floats a, Floats b) { return _mm256_max_ps(a, b); }
static Index next(Index i, int mask) { return _mm256_and_si256(_mm256_add_epi32(i, _mm256_set1_epi32(4093)), _mm256_set1_epi32(mask)); }
#endif
int main(int count, char** kib) {
  for (int a = 1; a < count; ++a) {
    const int size = 256 * std::atoi(kib[a]), rounds = 100000;
    std::vector<float> from(size, 1.0f);
    Index at[8];
    for (Index& i : at) for (int k = 0; k < lanes; ++k) ((int*)&i)[k] = std::rand() % size;
    double best = 1;
    for (int go = 0; go < 7; ++go) {
      Floats most = gather(from.data(), at[0]);
      timespec b, e;
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &b);
      for (int r = 0; r < rounds; ++r)
        for (Index& i : at) most = larger(most, gather(from.data(), i)), i = next(i, size - 1);
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &e);
      volatile float kept = ((float*)&most)[0];
      (void)kept;
      const double s = (e.tv_sec - b.tv_sec) + 1e-9 * (e.tv_nsec - b.tv_nsec);
      if (s / rounds / 8 < best) best = s / rounds / 8;
    }
    std::printf("%g ", 1e9 * best);
  }
}
"""


def sentence(clock, lanes):
    """Of places at random, eight gathers on their way at once. clock: [GHz]. lanes: of a vector of floats, 8 or 16."""
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "gathers")
        subprocess.run(["c++", "-O2", "-fno-strict-aliasing", "-mavx512f" if lanes == 16 else "-mavx2", "-x", "c++", "-", "-o", program], input=SOURCE, text=True, check=True)
        found = subprocess.run([program, *map(str, KIB)], capture_output=True, text=True, check=True).stdout.split()
    return f"A gather of {lanes} floats takes " + ", ".join(f"{clock * float(ns):.0f} cycles from {kib} KiB" for kib, ns in zip(KIB, found)) + ".\n"
