// c_library_client LIBRARY WHAT [HASHES] SCENE...: see client.h.
#define _POSIX_C_SOURCE 200809L  // nanosleep
#include "client.h"

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

struct library rr;

static void* load(const char* path) {
  void* const handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    fprintf(stderr, "%s\n", dlerror());
    exit(1);
  }
#define RR_LOAD(name)                           \
  {                                             \
    void* const address = dlsym(handle, #name); \
    if (!address) {                             \
      fprintf(stderr, "%s\n", dlerror());       \
      exit(1);                                  \
    }                                           \
    memcpy(&rr.name, &address, sizeof address); \
  }
  RR_FUNCTIONS(RR_LOAD)
#undef RR_LOAD
  return handle;
}

/// As an engine's editor does with its plug-ins. What runs on after the library was closed shows within the wait.
static void reload(const char* path, const char* scene) {
  for (int time = 0; time < 4; ++time) {
    void* const handle = load(path);
    const rr_open_options options = {.struct_bytes = sizeof options, .threads = 2};
    rr_simulation* simulation = NULL;
    CHECK(rr.rr_open_file(scene, &options, &simulation) == RR_OK);
    CHECK(rr.rr_next_frame(simulation) == RR_OK);
    rr.rr_close(simulation);
    if (dlclose(handle) != 0) exit(1);
    const struct timespec wait = {.tv_nsec = 200 * 1000 * 1000};
    nanosleep(&wait, NULL);
  }
}

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const char* what = argv[2];
  if (strcmp(what, "reload") == 0) return reload(argv[1], argv[3]), 0;
  load(argv[1]);
  if (strcmp(what, "golden") == 0 && argc == 5) return compare_golden(argv[4], argv[3], 60, 2);
  if (strcmp(what, "threads") == 0) return four_threads(argv + 4, argc - 4, argv[3]), 0;
  if (strcmp(what, "fork") == 0 && argc == 5) return after_fork(argv[4], argv[3]), 0;
  if (strcmp(what, "states") == 0 && argc == 5) return in_other_states(argv[4], argv[3]), 0;
  if (strcmp(what, "refusals") == 0) return refusals(argv[3]), 0;
  if (strcmp(what, "judging") == 0) return judging(argv[3]), 0;
  if (strcmp(what, "folder") == 0 && argc == 6) return folder_refusals(argv[3], argv[4]), folder_judged(argv[3], argv[4], argv[5]), 0;
  if (strcmp(what, "views") == 0) return views(argv[3]), 0;
  if (strcmp(what, "wave_of_8_bits") == 0) return wave_of_8_bits(argv[3]), 0;
  if (strcmp(what, "kept") == 0 && argc == 5) return kept(argv[3], argv[4]), 0;
  if (strcmp(what, "saved") == 0) return states_saved(argv[3]), 0;
  return 2;
}
