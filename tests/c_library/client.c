// c_library_client LIBRARY WHAT [HASHES] SCENE...: see client.h.
#include "client.h"

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

struct library rr;

static void load(const char* path) {
  void* const handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    fprintf(stderr, "%s\n", dlerror());
    exit(1);
  }
#define RR_LOAD(name)                                 \
  {                                                   \
    void* const address = dlsym(handle, #name);       \
    if (!address) {                                   \
      fprintf(stderr, "%s\n", dlerror());             \
      exit(1);                                        \
    }                                                 \
    memcpy(&rr.name, &address, sizeof address);       \
  }
  RR_FUNCTIONS(RR_LOAD)
#undef RR_LOAD
}

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  load(argv[1]);
  const char* what = argv[2];
  if (strcmp(what, "golden") == 0 && argc == 5) return compare_golden(argv[4], argv[3], 60, 2);
  if (strcmp(what, "threads") == 0) return four_threads(argv + 4, argc - 4, argv[3]), 0;
  if (strcmp(what, "fork") == 0 && argc == 5) return after_fork(argv[4], argv[3]), 0;
  if (strcmp(what, "states") == 0 && argc == 5) return in_other_states(argv[4], argv[3]), 0;
  if (strcmp(what, "refusals") == 0) return refusals(argv[3]), 0;
  if (strcmp(what, "judging") == 0) return judging(argv[3]), 0;
  if (strcmp(what, "folder") == 0 && argc == 6) return folder_refusals(argv[3], argv[4]), folder_judged(argv[3], argv[4], argv[5]), 0;
  if (strcmp(what, "views") == 0) return views(argv[3]), 0;
  if (strcmp(what, "saved") == 0) return states_saved(argv[3]), 0;
  return 2;
}
