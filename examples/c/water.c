// A puddle's water frame by frame, its picture, a port's output judged from memory, and the state in a file.
#include <rainref.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int check(int result) {
  if (result != RR_OK) {
    puts(rr_error());
    exit(result);
  }
  return result;
}
static int to_file(void* file, const void* bytes, size_t count) { return fwrite(bytes, 1, count, file) != count; }

// Where a GPU would run and be read back. This one is right but for one mistake: its rows begin at the top.
static void my_display(const rr_array* right, unsigned char* pixels) {
  for (int y = 0; y < right->height; ++y)
    memcpy(pixels + (size_t)y * right->row_bytes, (const unsigned char*)right->plane[0] + (size_t)(right->height - 1 - y) * right->row_bytes,
           right->row_bytes);
}

int main(void) {
  const char* set[] = {"rain.rate = 20", "run.size = [96, 54]", "environment.width = 256"};  // the default takes seconds
  const rr_open_options options = {.struct_bytes = sizeof options, .set = set, .set_count = 3};
  rr_simulation* sim;
  check(rr_open("effect = 'puddle'", &options, &sim));  // or rr_open_file("puddle/default.toml", ...)
  rr_array wave = {.struct_bytes = sizeof wave};
  for (int frame = 0; frame < 3; ++frame) {
    check(rr_next_frame(sim));
    check(rr_get_buffer(sim, "wave", &wave));  // no copy: plane, row_bytes, texel_bytes, type
  }
  printf("%s %dx%d in %d planes\n", wave.format, wave.width, wave.height, wave.planes);
  check(rr_write_png(sim, "puddle.png"));

  rr_cases* cases;  // what the pass takes in the next frame, and what the reference gives
  check(rr_cases_of_simulation(sim, &cases));
  check(rr_next_frame_cases(sim, (const char*[]){"display"}, 1, cases));
  rr_array picture = {.struct_bytes = sizeof picture};
  check(rr_get_expected(cases, 0, 0, &picture));
  unsigned char* pixels = malloc(picture.row_bytes * (size_t)picture.height);
  my_display(&picture, pixels);
  check(rr_give(cases, 0, 0, pixels, picture.row_bytes, (size_t)picture.height));
  free(pixels);
  rr_judgement* judgement;
  rr_verdict verdict = {.struct_bytes = sizeof verdict};
  rr_cause cause = {.struct_bytes = sizeof cause};
  check(rr_judge(cases, NULL, &judgement));
  check(rr_get_verdict(judgement, &verdict));
  check(rr_get_cause(judgement, 0, 0, &cause));
  printf("%s in %s: %s\n", verdict.status, verdict.first_bad_pass, cause.name);
  rr_free_judgement(judgement);
  rr_free_cases(cases);

  FILE* file = fopen("puddle.state", "wb");
  if (!file) return 1;
  check(rr_save(sim, to_file, file));  // rr_load goes on from it with the same bits
  fclose(file);
  rr_close(sim);
  return 0;
}
