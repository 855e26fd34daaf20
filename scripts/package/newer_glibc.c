// Three things that GCC 12's static runtime takes from glibc and that glibc 2.27 lacks. They are part of each file that is linked for the
// Linux archive, so that it starts on every Linux since 2018. All are hidden: a program's own glibc keeps its own.
#define _GNU_SOURCE
#include <link.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/random.h>

#define HIDDEN __attribute__((visibility("hidden")))

// glibc 2.32: "no other thread runs". Never said here: atomic operations are then right in any case.
HIDDEN char __libc_single_threaded = 0;

// glibc 2.36, for std::random_device.
HIDDEN uint32_t arc4random(void) {
  uint32_t value;
  if (getrandom(&value, sizeof value, 0) != sizeof value) abort();
  return value;
}

// glibc 2.35: the file of the program or library in which an instruction lies, and its table for exceptions. The layout is glibc's.
struct dl_find_object {
  unsigned long long flags;
  void *map_start, *map_end;
  struct link_map* link_map;  // the unwinder does not read it
  void* eh_frame;
  unsigned long long reserved[7];
};
struct search {
  uintptr_t instruction;
  struct dl_find_object* found;
};

static int visit(struct dl_phdr_info* info, size_t size, void* data) {
  const struct search* search = data;
  uintptr_t table = 0;
  int inside = 0;
  (void)size;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)* header = &info->dlpi_phdr[i];
    const uintptr_t start = info->dlpi_addr + header->p_vaddr;
    if (header->p_type == PT_GNU_EH_FRAME) table = start;
    if (header->p_type != PT_LOAD || search->instruction - start >= header->p_memsz) continue;
    inside = 1;
    search->found->map_start = (void*)start;
    search->found->map_end = (void*)(start + header->p_memsz);
  }
  if (!inside || table == 0) return 0;
  search->found->eh_frame = (void*)table;
  return 1;
}

HIDDEN int _dl_find_object(void* instruction, struct dl_find_object* found) {
  struct search search = {(uintptr_t)instruction, found};
  return dl_iterate_phdr(visit, &search) == 1 ? 0 : -1;
}
