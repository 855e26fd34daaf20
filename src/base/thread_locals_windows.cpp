// GCC's code for Windows asks this function for the address of each `thread_local` object, and each operation of an enclosure does. That of
// its own runtime takes a lock at each call. The name and the layout are those of GCC's libgcc/emutls.c.
#include <windows.h>

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace {

/// One for each thread_local object of the program.
struct Object {
  std::size_t size, alignment;
  std::uintptr_t number;  ///< 0: no thread has asked for it
  const void* initial;    ///< null: zeros
};

/// The addresses of a thread's objects, by their number.
struct Table {
  std::uintptr_t count;
  void* objects[];
};

std::atomic<std::uintptr_t> numbers{0};

DWORD slot() {
  static std::atomic<DWORD> taken{TLS_OUT_OF_INDEXES};
  DWORD here = taken.load(std::memory_order_acquire);
  if (here != TLS_OUT_OF_INDEXES) return here;
  const DWORD mine = ::TlsAlloc();
  if (mine == TLS_OUT_OF_INDEXES) std::abort();
  if (taken.compare_exchange_strong(here, mine)) return mine;
  ::TlsFree(mine);  // another thread was sooner
  return here;
}

/// Where Windows keeps the slot of this thread. TlsGetValue would lose the thread's last error.
Table*& table_of_thread() {
  const DWORD here = slot();
  if (here >= 64) std::abort();  // a process that has taken all of the first 64 before its libraries are loaded
  char* block;                   // NtCurrentTeb(), of which GCC 12 warns
  asm("movq %%gs:0x30, %0" : "=r"(block));
  return *reinterpret_cast<Table**>(block + 0x1480 + 8 * here);  // TEB::TlsSlots
}

std::uintptr_t number_of(Object& object) {
  const std::atomic_ref<std::uintptr_t> number(object.number);
  std::uintptr_t here = number.load(std::memory_order_acquire);
  if (here != 0) return here;
  const std::uintptr_t mine = numbers.fetch_add(1) + 1;
  return number.compare_exchange_strong(here, mine) ? mine : here;
}

void grow(Table*& table, std::uintptr_t count) {
  const std::uintptr_t before = table ? table->count : 0, after = std::max(count, numbers.load());
  auto* const grown = static_cast<Table*>(std::realloc(table, sizeof(Table) + after * sizeof(void*)));
  if (!grown) std::abort();
  std::memset(grown->objects + before, 0, (after - before) * sizeof(void*));
  grown->count = after;
  table = grown;
}

void* made(const Object& object) {
  void* const memory = ::_aligned_malloc(object.size, std::max(object.alignment, alignof(std::max_align_t)));
  if (!memory) std::abort();
  if (object.initial)
    std::memcpy(memory, object.initial, object.size);
  else
    std::memset(memory, 0, object.size);
  return memory;
}

void NTAPI thread_ends(void*, DWORD reason, void*) {
  if (reason != DLL_THREAD_DETACH) return;
  Table*& table = table_of_thread();
  if (!table) return;
  for (std::uintptr_t i = 0; i < table->count; ++i) ::_aligned_free(table->objects[i]);
  std::free(table);
  table = nullptr;
}

}  // namespace

extern "C" {

// Windows calls what lies in these sections in the order of their names. Destructors of thread_local objects are called from XLB to XLD.
__attribute__((section(".CRT$XLY"), used)) const PIMAGE_TLS_CALLBACK rainref_thread_ends = thread_ends;

void* __emutls_get_address(void* of) {
  Object& object = *static_cast<Object*>(of);
  const std::uintptr_t number = number_of(object);
  Table*& table = table_of_thread();
  if (!table || table->count < number) grow(table, number);
  void*& address = table->objects[number - 1];
  if (!address) address = made(object);
  return address;
}
}
