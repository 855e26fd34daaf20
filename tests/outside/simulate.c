// A C program of another project: a puddle's water, frame by frame, and its picture.
#include <rainref.h>
#include <stdio.h>

int main(void) {
  const char* set[] = {"rain.rate = 20", "run.size = [32, 18]"};
  const rr_open_options options = {.struct_bytes = sizeof options, .set = set, .set_count = 2};
  rr_simulation* sim;
  if (rr_open("effect = 'puddle'", &options, &sim) != RR_OK) return puts(rr_error()), 1;
  rr_array wave = {.struct_bytes = sizeof wave};
  for (int frame = 0; frame < 3; ++frame) {
    rr_next_frame(sim);
    rr_get_buffer(sim, "wave", &wave);  // no copy: plane, row_bytes, texel_bytes, type
  }
  printf("%s %dx%d in %d planes\n", wave.format, wave.width, wave.height, wave.planes);
  if (rr_write_png(sim, "puddle.png") != RR_OK) return puts(rr_error()), 1;
  rr_close(sim);
  return 0;
}
