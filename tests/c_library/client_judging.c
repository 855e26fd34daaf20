// Buffers seen without a copy, and outputs judged from memory.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "client.h"

static rr_simulation* opened(const char* scene) {
  rr_simulation* simulation = NULL;
  CHECK(rr.rr_open_file(scene, NULL, &simulation) == RR_OK);
  return simulation;
}

/// Each buffer says enough of itself to be read from its first byte to its last.
void views(const char* scene) {
  rr_simulation* const s = opened(scene);
  CHECK(rr.rr_next_frame(s) == RR_OK && rr.rr_next_frame(s) == RR_OK);
  rr_simulation_info info = {.struct_bytes = sizeof info};
  CHECK(rr.rr_get_info(s, &info) == RR_OK && info.frame == 2 && info.buffers > 3 && strstr(info.scene_json, "\"run.size\""));
  unsigned sum = 0;
  int images = 0, lists = 0;
  for (size_t i = 0; rr.rr_buffer_name(s, i); ++i) {
    rr_array a = {.struct_bytes = sizeof a};
    CHECK(rr.rr_get_buffer(s, rr.rr_buffer_name(s, i), &a) == RR_OK);
    CHECK(strcmp(a.name, rr.rr_buffer_name(s, i)) == 0 && a.planes >= 1 && a.planes <= 4 && a.channels >= a.planes);
    for (int p = 0; p < a.planes; ++p) {
      const unsigned char* const first = a.plane[p];
      for (int y = 0; y < a.height; ++y)
        for (size_t x = 0; x < (size_t)a.width * a.texel_bytes; ++x) sum = 31 * sum + first[(size_t)y * a.row_bytes + x];
    }
    if (a.type == RR_RECORDS) {
      ++lists;
      rr_layout_info layout = {.struct_bytes = sizeof layout};
      CHECK(rr.rr_get_layout(a.layout, &layout) == RR_OK && layout.bytes == a.texel_bytes && layout.members > 0);
    } else {
      ++images;
      CHECK(a.layout == NULL);
    }
  }
  CHECK(images >= 3 && (lists == 1) == (strcmp(info.effect, "windshield") == 0) && sum != 0);
  rr_array picture = {.struct_bytes = sizeof picture};
  CHECK(rr.rr_get_picture(s, &picture) == RR_OK && picture.width == 97 && picture.height == 61 && picture.type == RR_UNORM8);
  rr.rr_close(s);
}

/// Its two levels lie apart, one byte each, and the other two channels nowhere; as WebGPU's ports have it, it may be given with more
/// channels.
void wave_of_8_bits(const char* scene) {
  const char* set[] = {"puddle.storage=rgba8", "rain.rate=200"};
  const rr_open_options options = {.struct_bytes = sizeof options, .set = set, .set_count = 2, .threads = 1};
  rr_simulation* s = NULL;
  CHECK(rr.rr_open_file(scene, &options, &s) == RR_OK && rr.rr_next_frame(s) == RR_OK);
  rr_cases* cases = NULL;
  CHECK(rr.rr_cases_of_simulation(s, &cases) == RR_OK);
  CHECK(rr.rr_next_frame_cases(s, (const char*[]){"wave_step"}, 1, cases) == RR_OK);
  rr_array wave = {.struct_bytes = sizeof wave}, last = wave;
  CHECK(rr.rr_get_buffer(s, "wave", &wave) == RR_OK && rr.rr_get_expected(cases, rr.rr_case_count(cases) - 1, 0, &last) == RR_OK);
  CHECK(wave.channels == 4 && wave.planes == 2 && wave.texel_bytes == 1 && wave.plane[1] && !wave.plane[2]);
  CHECK(last.channels == 4 && last.planes == 1 && last.texel_bytes == 4 && last.width == wave.width && last.height == wave.height);
  for (int y = 0; y < wave.height; ++y)
    for (int x = 0; x < wave.width; ++x) {
      const unsigned char* const texel = (const unsigned char*)last.plane[0] + (size_t)y * last.row_bytes + (size_t)x * last.texel_bytes;
      for (int c = 0; c < 4; ++c)
        CHECK(texel[c] == (c < wave.planes ? ((const unsigned char*)wave.plane[c])[(size_t)y * wave.row_bytes + (size_t)x] : 0));
    }
  rr.rr_free_cases(cases);
  rr.rr_close(s);
}

static rr_judgement* judged_with(rr_cases* cases, const unsigned char* data, const rr_array* like) {
  CHECK(rr.rr_give(cases, 0, 0, data, like->row_bytes, (size_t)like->height) == RR_OK);
  rr_judgement* j = NULL;
  CHECK(rr.rr_judge(cases, NULL, &j) == RR_OK);
  return j;
}

/// A port of display that gives what is expected, and one that is upside down.
void judging(const char* scene) {
  rr_simulation* const s = opened(scene);
  rr_cases* cases = NULL;
  CHECK(rr.rr_cases_of_simulation(s, &cases) == RR_OK);
  const char* passes[] = {"display"};
  CHECK(rr.rr_next_frame_cases(s, passes, 1, cases) == RR_OK);
  rr.rr_close(s);  // cases live on

  rr_case_info c = {.struct_bytes = sizeof c};
  CHECK(rr.rr_get_case(cases, 0, &c) == RR_OK && strcmp(c.pass, "display") == 0 && c.outputs == 1 && c.frame == 0);
  rr_array uniforms = {.struct_bytes = sizeof uniforms};
  CHECK(rr.rr_get_uniforms(cases, 0, &uniforms) == RR_OK && uniforms.type == RR_RECORDS && uniforms.width == 1);
  rr_member member = {.struct_bytes = sizeof member};
  CHECK(rr.rr_get_member(uniforms.layout, 0, &member) == RR_OK && member.offset < uniforms.texel_bytes && *member.sentence);
  for (size_t i = 0; i < c.inputs; ++i) {
    rr_array input = {.struct_bytes = sizeof input};
    rr_sampling sampling = {.struct_bytes = sizeof sampling};
    CHECK(rr.rr_get_input(cases, 0, i, 0, &input) == RR_OK && input.planes == 1);
    CHECK(rr.rr_get_sampling(cases, 0, i, &sampling) == RR_OK && *sampling.filter && *sampling.address_u);
  }
  rr_array a = {.struct_bytes = sizeof a};
  CHECK(rr.rr_get_expected(cases, 0, 0, &a) == RR_OK && strcmp(rr.rr_get_judge(cases, 0, 0), "envelope") == 0);

  rr_judgement* good = judged_with(cases, a.plane[0], &a);
  rr_verdict verdict = {.struct_bytes = sizeof verdict};
  rr_pass_verdict pass = {.struct_bytes = sizeof pass};
  CHECK(rr.rr_get_verdict(good, &verdict) == RR_OK && strcmp(verdict.status, "PASS") == 0 && verdict.passes == 1);
  CHECK(rr.rr_get_pass_verdict(good, 0, &pass) == RR_OK && pass.outside == 0 && pass.differing == 0 && pass.cases == 1);
  CHECK(pass.elements == (int64_t)a.width * a.height * a.channels && pass.causes == 0 && pass.worst == 0);

  // The same as floats, with a channel too many where there is room for one, in rows with padding.
  const int channels = a.channels < 4 ? a.channels + 1 : 4;
  const size_t row = (size_t)(a.width + 3) * (size_t)channels;
  float* const floats = calloc((size_t)a.height * row, sizeof *floats);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int k = 0; k < a.channels; ++k) {
        const unsigned char* const texel = (const unsigned char*)a.plane[0] + (size_t)y * a.row_bytes + (size_t)x * a.texel_bytes;
        floats[(size_t)y * row + (size_t)x * (size_t)channels + (size_t)k] = (float)texel[k] / 255.0f;
      }
  rr_array image = {.struct_bytes = sizeof image,
                    .type = RR_FLOAT32,
                    .channels = channels,
                    .width = a.width,
                    .height = a.height,
                    .planes = 1,
                    .texel_bytes = (size_t)channels * sizeof *floats,
                    .row_bytes = row * sizeof *floats,
                    .plane = {floats}};
  CHECK(rr.rr_give_image(cases, 0, 0, &image) == RR_OK);
  free(floats);  // a copy was taken
  rr.rr_free_judgement(good);
  CHECK(rr.rr_judge(cases, NULL, &good) == RR_OK && rr.rr_get_pass_verdict(good, 0, &pass) == RR_OK && pass.differing == 0);
  CHECK(rr.rr_get_verdict(good, &verdict) == RR_OK && strcmp(verdict.status, "PASS") == 0);
  image.width += 1;
  CHECK(rr.rr_give_image(cases, 0, 0, &image) == RR_FILES && strstr(rr.rr_error(), "/out.picture: expected "));
  image.planes = 2;
  CHECK(rr.rr_give_image(cases, 0, 0, &image) == RR_USAGE && strstr(rr.rr_error(), "rr_array.planes: expected 1 to 1, found 2"));
  image.width = -1;
  CHECK(rr.rr_give_image(cases, 0, 0, &image) == RR_USAGE && strstr(rr.rr_error(), "rr_array.width: expected 1 to 65536, found -1"));

  unsigned char* const turned = malloc(a.row_bytes * (size_t)a.height);
  for (int y = 0; y < a.height; ++y)
    memcpy(turned + (size_t)y * a.row_bytes, (const unsigned char*)a.plane[0] + (size_t)(a.height - 1 - y) * a.row_bytes, a.row_bytes);
  rr_judgement* const bad = judged_with(cases, turned, &a);
  free(turned);  // a copy was taken
  rr.rr_free_cases(cases);
  CHECK(rr.rr_get_verdict(bad, &verdict) == RR_OK && strcmp(verdict.status, "FAIL") == 0 && strcmp(verdict.first_bad_pass, "display") == 0);
  CHECK(rr.rr_get_pass_verdict(bad, 0, &pass) == RR_OK && pass.outside > 1000 && pass.causes >= 1 && pass.worst == 100);
  rr_cause cause = {.struct_bytes = sizeof cause};
  CHECK(rr.rr_get_cause(bad, 0, 0, &cause) == RR_OK);
  CHECK(strcmp(cause.name, "upside down") == 0 && cause.explained == cause.of && cause.of > 0);
  rr_failure worst = {.struct_bytes = sizeof worst}, least = worst;
  CHECK(rr.rr_get_failure(bad, 0, 0, &worst) == RR_OK && rr.rr_get_failure(bad, 0, pass.worst - 1, &least) == RR_OK);
  CHECK(worst.got < worst.low || worst.got > worst.high);
  CHECK(worst.low <= worst.expected && worst.expected <= worst.high && worst.is_a_number && *worst.text);
  CHECK(fabs(worst.got - worst.expected) >= fabs(least.got - least.expected) - 0.01);
  const char *text, *json, *html;
  CHECK(rr.rr_report_text(bad, &text) == RR_OK && strstr(text, "upside down"));
  CHECK(rr.rr_report_json(bad, &json) == RR_OK && strstr(json, "rainref.judgement"));
  CHECK(rr.rr_report_html(bad, &html) == RR_OK && strstr(html, "<html") && strstr(html, "data:image/png"));
  rr.rr_free_judgement(bad);
  CHECK(rr.rr_get_verdict(good, &verdict) == RR_OK && strcmp(verdict.status, "PASS") == 0);  // one judgement does not hang on another
  CHECK(rr.rr_report_html(good, &html) == RR_OK);
  rr.rr_free_judgement(good);
}
