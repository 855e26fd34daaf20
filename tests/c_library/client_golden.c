// Golden hashes through the C library: alone, in four threads at once, after fork, in a hostile floating-point state.
#define _GNU_SOURCE  // feenableexcept
#include <fenv.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "client.h"

/// The whole text of a file, to be freed.
static char* text_of(const char* path) {
  FILE* const file = fopen(path, "rb");
  CHECK(file != NULL);
  CHECK(fseek(file, 0, SEEK_END) == 0);
  const long size = ftell(file);
  CHECK(size > 0);
  rewind(file);
  char* const text = calloc((size_t)size + 1, 1);
  CHECK(fread(text, 1, (size_t)size, file) == (size_t)size);
  fclose(file);
  return text;
}

/// The name of a scene: what its first line says.
static void read_name(const char* scene, char name[64]) {
  FILE* const file = fopen(scene, "r");
  CHECK(file && fscanf(file, "# %63s", name) == 1);
  fclose(file);
}

/// Whether each line of a frame was recorded for this scene, and how many were.
static int compare_lines(const char* name, const char* lines, const char* recorded) {
  int count = 0;
  for (const char* line = lines; *line; line = strchr(line, '\n') + 1, ++count) {
    char expected[256];
    const int length = (int)(strchr(line, '\n') - line);
    snprintf(expected, sizeof expected, "\n%s %.*s\n", name, length, line);
    if (strstr(recorded, expected)) continue;
    fprintf(stderr, "not as recorded: %s", expected + 1);
    return -1;
  }
  return count;
}

static rr_simulation* opened(const char* scene, int threads) {
  rr_simulation* simulation = NULL;
  const rr_open_options options = {.struct_bytes = sizeof options, .threads = threads};
  CHECK(rr.rr_open_file(scene, &options, &simulation) == RR_OK);
  return simulation;
}

static int is_as_recorded(rr_simulation* simulation, const char* name, const char* recorded) {
  const char* lines = NULL;
  CHECK(rr.rr_next_frame_hashes(simulation, &lines) == RR_OK);
  return compare_lines(name, lines, recorded) > 0;
}

int compare_golden(const char* scene, const char* hashes, int frames, int threads) {
  char name[64];
  read_name(scene, name);
  char* const recorded = text_of(hashes);
  rr_simulation* const simulation = opened(scene, threads);
  int good = 1;
  for (int frame = 0; frame < frames && good; ++frame) {
    if (frame <= 2 || frame == 59)
      good = is_as_recorded(simulation, name, recorded);
    else
      CHECK(rr.rr_next_frame(simulation) == RR_OK);
  }
  rr.rr_close(simulation);
  free(recorded);
  return good ? 0 : 1;
}

struct work {
  const char *scene, *hashes;
  int result;
};
static void* in_thread(void* argument) {
  struct work* const work = argument;
  // An error of one thread is not seen by the others.
  rr_simulation* none = NULL;
  char wrong[64];
  snprintf(wrong, sizeof wrong, "effect = 'no_%p'", argument);
  CHECK(rr.rr_open(wrong, NULL, &none) == RR_USAGE && none == NULL);
  work->result = compare_golden(work->scene, work->hashes, 3, 2);
  snprintf(wrong, sizeof wrong, "no_%p", argument);
  CHECK(strstr(rr.rr_error(), wrong) != NULL);
  return NULL;
}
void four_threads(char** scenes, int count, const char* hashes) {
  enum { many = 4 };
  pthread_t threads[many];
  struct work work[many];
  for (int i = 0; i < many; ++i) {
    work[i] = (struct work){scenes[i % count], hashes, -1};
    CHECK(pthread_create(&threads[i], NULL, in_thread, &work[i]) == 0);
  }
  for (int i = 0; i < many; ++i) {
    CHECK(pthread_join(threads[i], NULL) == 0);
    CHECK(work[i].result == 0);
  }
  CHECK(strcmp(rr.rr_error(), "") == 0);
}

void after_fork(const char* scene, const char* hashes) {
  char name[64];
  read_name(scene, name);
  char* const recorded = text_of(hashes);
  rr_simulation* const simulation = opened(scene, 1);
  CHECK(is_as_recorded(simulation, name, recorded));
  const pid_t child = fork();
  CHECK(child >= 0);
  CHECK(is_as_recorded(simulation, name, recorded));  // both go on
  if (child == 0) {
    // Threads do not survive fork; new ones are started.
    const int result = compare_golden(scene, hashes, 2, 2);
    _exit(result);
  }
  int status = -1;
  CHECK(waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0);
  rr.rr_close(simulation);
  free(recorded);
}

/// FTZ and DAZ, as engines set them; nothing where there are none.
static void flush_to_zero(void) {
#if defined(__x86_64__)
  __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8040);
#endif
}
static unsigned control(void) {
#if defined(__x86_64__)
  return __builtin_ia32_stmxcsr();
#else
  return (unsigned)fegetround();
#endif
}
void in_other_states(const char* scene, const char* hashes) {
  static const int roundings[] = {FE_TOWARDZERO, FE_UPWARD, FE_DOWNWARD};
  char name[64];
  read_name(scene, name);
  char* const recorded = text_of(hashes);
  for (int state = 0; state < 4; ++state) {
    fenv_t own;
    fegetenv(&own);
    if (state < 3) CHECK(fesetround(roundings[state]) == 0);
    flush_to_zero();
#if defined(__GLIBC__) && defined(__x86_64__)
    if (state == 3) feenableexcept(FE_ALL_EXCEPT & ~FE_INEXACT);
#endif
    const unsigned before = control();
    rr_simulation* const simulation = opened(scene, 2);
    for (int frame = 0; frame < 3; ++frame) CHECK(is_as_recorded(simulation, name, recorded));
    rr_cases* cases = NULL;
    CHECK(rr.rr_cases_of_simulation(simulation, &cases) == RR_OK);
    CHECK(rr.rr_next_frame_cases(simulation, NULL, 0, cases) == RR_OK);
    rr.rr_free_cases(cases);
    rr.rr_close(simulation);
    CHECK(control() == before);
    fesetenv(&own);
  }
  free(recorded);
}

void kept(const char* scene, const char* folder) {
  if (strcmp(folder, "-") != 0) CHECK(rr.rr_keep_images(strcmp(folder, "none") == 0 ? NULL : folder) == RR_OK);
  rr_simulation* const simulation = opened(scene, 2);
  const char* lines = NULL;
  for (int frame = 0; frame < 2; ++frame) {
    CHECK(rr.rr_next_frame_hashes(simulation, &lines) == RR_OK);
    fputs(lines, stdout);
  }
  CHECK(rr.rr_keep_images(NULL) == RR_USAGE && strstr(rr.rr_error(), "before the first simulation is opened"));
  rr.rr_close(simulation);
}
