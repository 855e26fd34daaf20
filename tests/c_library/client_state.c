// States through callbacks: what goes on has the bits of one run, and what cannot be read leaves a simulation as it was.
#include <stdlib.h>
#include <string.h>

#include "client.h"

enum { saved_frames = 5, frames = 8 };

/// A state in memory, which is read and written in pieces, and fails where it is told to.
struct bytes {
  unsigned char* data;
  size_t size, at;
  size_t piece;    ///< given by one call at most
  size_t fail_at;  ///< [byte] from the first on nothing is read or written; 0: never
};
static int put(void* user, const void* more, size_t count) {
  struct bytes* const b = user;
  if (b->fail_at != 0 && b->size + count > b->fail_at) return 28;
  b->data = realloc(b->data, b->size + count);
  CHECK(b->data != NULL);
  memcpy(b->data + b->size, more, count);
  b->size += count;
  return 0;
}
static int64_t take(void* user, void* to, size_t count) {
  struct bytes* const b = user;
  CHECK(count > 0);
  if (b->fail_at != 0 && b->at >= b->fail_at) return -5;
  size_t n = b->size - b->at;
  if (n > count) n = count;
  if (n > b->piece) n = b->piece;
  memcpy(to, b->data + b->at, n);
  b->at += n;
  return (int64_t)n;
}
static int64_t take_more_than_asked(void* user, void* to, size_t count) {
  (void)user, (void)to;
  return (int64_t)count + 1;
}

static struct bytes saved(rr_simulation* s) {
  struct bytes b = {.piece = 1000};
  CHECK(rr.rr_save(s, put, &b) == RR_OK && b.size > 100);
  return b;
}
static int load(rr_simulation* s, struct bytes* from, size_t piece) {
  from->at = 0;
  from->piece = piece;
  return rr.rr_load(s, take, from);
}
static int is_saved_as(rr_simulation* s, const struct bytes* expected) {
  struct bytes now = saved(s);
  const int same = now.size == expected->size && memcmp(now.data, expected->data, now.size) == 0;
  free(now.data);
  return same;
}
static rr_simulation* opened(const char* scene) {
  rr_simulation* s = NULL;
  CHECK(rr.rr_open_file(scene, NULL, &s) == RR_OK);
  return s;
}
static void advance(rr_simulation* s, int count) {
  for (int frame = 0; frame < count; ++frame) CHECK(rr.rr_next_frame(s) == RR_OK);
}
/// The hash lines of the next frames, to be freed.
static char* lines_of(rr_simulation* s, int count) {
  char* all = calloc(1, 1);
  for (int frame = 0; frame < count; ++frame) {
    const char* lines = NULL;
    CHECK(rr.rr_next_frame_hashes(s, &lines) == RR_OK);
    all = realloc(all, strlen(all) + strlen(lines) + 1);
    CHECK(all != NULL);
    strcat(all, lines);
  }
  CHECK(strlen(all) > 40);
  return all;
}
static void expect_lines(rr_simulation* s, const char* expected) {
  char* const found = lines_of(s, frames - saved_frames);
  CHECK(strcmp(found, expected) == 0);
  free(found);
}
static void expect_refused(rr_simulation* s, const struct bytes* before, int result, int code, const char* text) {
  if (result != code || !strstr(rr.rr_error(), text)) {
    fprintf(stderr, "expected %d and '%s', found %d and '%s'\n", code, text, result, rr.rr_error());
    exit(1);
  }
  CHECK(is_saved_as(s, before));
}

/// Another handle goes on from a state as the one run did, whatever it did before.
static struct bytes goes_on(const char* scene, const char* expected) {
  rr_simulation* const first = opened(scene);
  advance(first, saved_frames);
  struct bytes state = saved(first);
  expect_lines(first, expected);  // saving changed nothing
  rr_simulation* const fresh = opened(scene);
  CHECK(load(fresh, &state, 1) == RR_OK && is_saved_as(fresh, &state));
  rr_simulation_info info = {.struct_bytes = sizeof info};
  CHECK(rr.rr_get_info(fresh, &info) == RR_OK && info.frame == saved_frames);
  expect_lines(fresh, expected);
  CHECK(load(first, &state, (size_t)-1) == RR_OK);  // back
  expect_lines(first, expected);
  rr.rr_close(first);
  rr.rr_close(fresh);
  return state;
}

static void refuses(rr_simulation* s, struct bytes* state) {
  advance(s, 2);
  struct bytes before = saved(s);
  struct bytes full = {.fail_at = 100};
  expect_refused(s, &before, rr.rr_save(s, put, &full), RR_IO, "state: the callback that writes it failed: 28");
  free(full.data);
  state->fail_at = 50;
  expect_refused(s, &before, load(s, state, 25), RR_IO, "state: the callback that reads it failed after 50 bytes: -5");
  state->fail_at = 0;
  expect_refused(s, &before, rr.rr_load(s, take_more_than_asked, NULL), RR_IO, "asked for at most 1048576 bytes and says that it gave 1048577");

  const size_t size = state->size;
  state->size = 0;
  expect_refused(s, &before, load(s, state, 64), RR_USAGE, "state: expected a state that rainref saved, found other bytes");
  state->size = size - 1;
  expect_refused(s, &before, load(s, state, 64), RR_USAGE, "state: cut short or lengthened: expected ");
  state->size = size;
  for (int part = 1; part < 4; ++part) {
    unsigned char* const byte = state->data + size * (size_t)part / 4;
    *byte ^= 1;
    expect_refused(s, &before, load(s, state, 4096), RR_USAGE, "state: damaged: its checksum is not that of its bytes");
    *byte ^= 1;
  }
  free(before.data);
}

static void sets(rr_simulation* s, struct bytes* state, const char* expected) {
  CHECK(load(s, state, 4096) == RR_OK);
  expect_refused(s, state, rr.rr_set(s, "run.szie", "[9, 9]"), RR_USAGE, "did you mean 'run.size'?");
  expect_refused(s, state, rr.rr_set(s, "run.size", "[0, 9]"), RR_USAGE, "run.size");
  rr_simulation_info info = {.struct_bytes = sizeof info};
  CHECK(rr.rr_get_info(s, &info) == RR_OK);
  if (strcmp(info.effect, "puddle") == 0)
    expect_refused(s, state, rr.rr_set(s, "puddle.grid", "[88, 57]"), RR_USAGE, "puddle.grid: cannot change while the simulation runs");
  if (strcmp(info.effect, "windshield") == 0)
    expect_refused(s, state, rr.rr_set(s, "windshield.height_size", "[90, 53]"), RR_USAGE, "windshield.height_size: cannot change while");
  CHECK(rr.rr_set(s, "run.size", "[97, 61]") == RR_OK && is_saved_as(s, state));  // what it is already
  expect_lines(s, expected);

  CHECK(load(s, state, 4096) == RR_OK && rr.rr_set(s, "display.exposure", "-1.5") == RR_OK);
  CHECK(rr.rr_get_info(s, &info) == RR_OK && info.frame == saved_frames && strstr(info.scene_json, "\"display.exposure\": -1.5"));
  char* const darker = lines_of(s, frames - saved_frames);
  CHECK(strcmp(darker, expected) != 0);
  free(darker);
  CHECK(load(s, state, 4096) == RR_USAGE && strstr(rr.rr_error(), "of another scene: expected 'display.exposure = -1.5"));
}

void states_saved(const char* scene) {
  rr_simulation* const one = opened(scene);
  advance(one, saved_frames);
  char* const expected = lines_of(one, frames - saved_frames);
  rr.rr_close(one);
  struct bytes state = goes_on(scene, expected);
  rr_simulation* const s = opened(scene);
  refuses(s, &state);
  sets(s, &state, expected);
  rr.rr_close(s);
  free(state.data);
  free(expected);
}
