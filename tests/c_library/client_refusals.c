// Arguments that no caller should pass: each gives a code and a sentence, and nothing crashes.
#include <stdlib.h>
#include <string.h>

#include "client.h"

static void expect(int line, int result, int code, const char* text) {
  if (result == code && strstr(rr.rr_error(), text)) return;
  fprintf(stderr, "client_refusals.c:%d: expected %d and '%s', found %d and '%s'\n", line, code, text, result, rr.rr_error());
  exit(1);
}
#define REFUSED(result, text) expect(__LINE__, result, RR_USAGE, text)

static void opening(const char* scene) {
  rr_simulation* s = (rr_simulation*)&s;
  REFUSED(rr.rr_open(NULL, NULL, &s), "toml: expected an address, found NULL");
  CHECK(s == NULL);
  REFUSED(rr.rr_open("", NULL, NULL), "simulation: expected an address, found NULL");
  REFUSED(rr.rr_open("", NULL, &s), "effect");
  REFUSED(rr.rr_open("effect = 'pudle'", NULL, &s), "did you mean 'puddle'?");
  REFUSED(rr.rr_open_file(NULL, NULL, &s), "path: ");
  expect(__LINE__, rr.rr_open_file("/nowhere/scene.toml", NULL, &s), RR_IO, "/nowhere/scene.toml");
  rr_open_options options = {0};
  REFUSED(rr.rr_open("", &options, &s), "rr_open_options.struct_bytes: expected sizeof(rr_open_options), which is ");
  options.struct_bytes = sizeof options + 8;
  REFUSED(rr.rr_open("", &options, &s), "rr_open_options.struct_bytes");
  options.struct_bytes = sizeof options;
  options.set_count = 1;
  REFUSED(rr.rr_open("", &options, &s), "rr_open_options.set: ");
  const char* set[] = {"run.szie=[3,3]", NULL};
  options.set = set;
  REFUSED(rr.rr_open_file(scene, &options, &s), "did you mean 'run.size'?");
  options.set_count = 2;
  REFUSED(rr.rr_open_file(scene, &options, &s), "rr_open_options.set: ");
  options.set_count = 0;
  options.threads = -1;
  REFUSED(rr.rr_open_file(scene, &options, &s), "threads");
  options.threads = 0;
  options.file = "mine.toml";
  REFUSED(rr.rr_open("effect = 'puddle'\n[wave]\nspeeed = 1\n", &options, &s), "mine.toml:3:1: wave.speeed: ");
  CHECK(s == NULL);
  rr.rr_close(NULL);
  const char* json = "";
  REFUSED(rr.rr_describe("pudle", &json), "did you mean 'puddle'?");
  CHECK(json == NULL);
  REFUSED(rr.rr_describe(NULL, &json), "effect: ");
  REFUSED(rr.rr_describe("puddle", NULL), "json: ");
  CHECK(rr.rr_effect_name(1000) == NULL && rr.rr_profile_name(1000) == NULL);
}

static void running(rr_simulation* s) {
  rr_simulation_info info = {.struct_bytes = sizeof info};
  REFUSED(rr.rr_get_info(NULL, &info), "simulation: ");
  REFUSED(rr.rr_get_info(s, NULL), "rr_simulation_info: ");
  info.struct_bytes = 4;
  REFUSED(rr.rr_get_info(s, &info), "rr_simulation_info.struct_bytes");
  REFUSED(rr.rr_simulate(NULL), "simulation: ");
  REFUSED(rr.rr_render(NULL), "simulation: ");
  REFUSED(rr.rr_next_frame(NULL), "simulation: ");
  REFUSED(rr.rr_next_frame_hashes(s, NULL), "lines: ");
  REFUSED(rr.rr_write_png(s, NULL), "path: ");
  REFUSED(rr.rr_save(s, NULL, NULL), "write: ");
  REFUSED(rr.rr_load(s, NULL, NULL), "read: ");
  REFUSED(rr.rr_set(s, NULL, "1"), "key: ");
  REFUSED(rr.rr_set(s, "seed", NULL), "value: ");
  REFUSED(rr.rr_set(NULL, "seed", "1"), "simulation: ");
  rr_array a = {.struct_bytes = sizeof a};
  REFUSED(rr.rr_get_buffer(s, "no_such", &a), "has no buffer 'no_such'");
  REFUSED(rr.rr_get_buffer(s, NULL, &a), "name: ");
  REFUSED(rr.rr_get_buffer(NULL, "picture", &a), "simulation: ");
  REFUSED(rr.rr_get_buffer(s, "picture", NULL), "rr_array: ");
  a.struct_bytes = 0;
  REFUSED(rr.rr_get_picture(s, &a), "rr_array.struct_bytes");
  CHECK(rr.rr_buffer_name(s, 1000) == NULL && rr.rr_buffer_name(NULL, 0) == NULL && rr.rr_warning(NULL, 0) == NULL);
  CHECK(rr.rr_next_frame(s) == RR_OK);
  expect(__LINE__, rr.rr_write_png(s, "/nowhere/a.png"), RR_IO, "/nowhere");
}

static int stop_at_once(void* user, int32_t done, int32_t of) {
  (void)user, (void)of;
  return done == 1;
}
static void files(rr_simulation* s) {
  rr_pack_options o = {.struct_bytes = sizeof o};
  const char* notes = "";
  REFUSED(rr.rr_write_pack(NULL, "p", NULL, &notes), "simulation: ");
  REFUSED(rr.rr_write_pack(s, NULL, NULL, &notes), "folder: ");
  o.seed = "luck";
  REFUSED(rr.rr_write_pack(s, "p", &o, &notes), "seed: expected \"random\" or a whole number");
  CHECK(notes == NULL);
  o.seed = "3";
  o.frame_count = 1;
  REFUSED(rr.rr_write_pack(s, "p", &o, NULL), "rr_pack_options.frames: expected an address");
  const int32_t frames[] = {-1};
  o.frames = frames;
  REFUSED(rr.rr_write_pack(s, "p", &o, NULL), "frames: expected 0 or more, found -1");
  o.frame_count = 0;
  o.progress = stop_at_once;
  REFUSED(rr.rr_write_pack(s, "p", &o, NULL), "stopped by rr_pack_options.progress after 1 of ");
  const char* passes[] = {"displya"};
  o.passes = passes;
  o.pass_count = 1;
  REFUSED(rr.rr_write_pack(s, "p", &o, NULL), "did you mean 'display'?");
  o.struct_bytes = 8;
  REFUSED(rr.rr_write_pack(s, "p", &o, NULL), "rr_pack_options.struct_bytes");
  REFUSED(rr.rr_film(NULL, "a.mp4", 1, 1, NULL, NULL), "simulation: ");
  REFUSED(rr.rr_film(s, NULL, 1, 1, NULL, NULL), "path: ");
  REFUSED(rr.rr_film(s, "a.avi", 1, 1, NULL, NULL), "expected a name that ends in .mp4, .webm or .gif");
  REFUSED(rr.rr_film(s, "a.mp4", 1, 0, NULL, NULL), "film: every: expected 1 or more, found 0");
}

static void cases_and_judging(rr_simulation* s, const char* scene) {
  rr_cases* cases = NULL;
  REFUSED(rr.rr_cases_of_simulation(NULL, &cases), "simulation: ");
  REFUSED(rr.rr_cases_of_simulation(s, NULL), "cases: ");
  CHECK(rr.rr_cases_of_simulation(s, &cases) == RR_OK && rr.rr_case_count(cases) == 0);
  const char* wrong[] = {"displya"};
  REFUSED(rr.rr_next_frame_cases(s, wrong, 1, cases), "has no pass 'displya'; did you mean 'display'?");
  REFUSED(rr.rr_next_frame_cases(s, NULL, 1, cases), "passes: ");
  REFUSED(rr.rr_next_frame_cases(s, NULL, 0, NULL), "cases: ");
  rr_simulation_info info = {.struct_bytes = sizeof info};
  CHECK(rr.rr_get_info(s, &info) == RR_OK && info.frame == 1);  // nothing that was refused has run
  const char* passes[] = {"display"};
  CHECK(rr.rr_next_frame_cases(s, passes, 1, cases) == RR_OK && rr.rr_case_count(cases) == 1);

  rr_case_info c = {.struct_bytes = sizeof c};
  REFUSED(rr.rr_get_case(cases, 1, &c), "case 1: expected one of 1, counted from 0");
  REFUSED(rr.rr_get_case(NULL, 0, &c), "cases: ");
  REFUSED(rr.rr_get_case(cases, 0, NULL), "rr_case_info: ");
  CHECK(rr.rr_get_case(cases, 0, &c) == RR_OK);
  rr_array a = {.struct_bytes = sizeof a};
  REFUSED(rr.rr_get_input(cases, 0, c.inputs, 0, &a), "input ");
  REFUSED(rr.rr_get_input(cases, 0, 0, 99, &a), "level 99");
  REFUSED(rr.rr_get_input(cases, 0, 0, -1, &a), "level ");
  REFUSED(rr.rr_get_expected(cases, 0, c.outputs, &a), "output ");
  CHECK(rr.rr_get_judge(cases, 0, 99) == NULL);
  CHECK(rr.rr_get_uniforms(cases, 0, &a) == RR_OK);
  rr_member member = {.struct_bytes = sizeof member};
  REFUSED(rr.rr_get_member(a.layout, 1000, &member), "member 1000");
  REFUSED(rr.rr_get_member(NULL, 0, &member), "layout: ");

  rr_judgement* j = NULL;
  expect(__LINE__, rr.rr_judge(cases, NULL, &j), RR_FILES, "expected outputs of a port");
  CHECK(rr.rr_get_expected(cases, 0, 0, &a) == RR_OK);
  REFUSED(rr.rr_give(cases, 0, 0, NULL, a.row_bytes, (size_t)a.height), "data: ");
  REFUSED(rr.rr_give(cases, 0, 0, a.plane[0], a.row_bytes - 1, (size_t)a.height), "bytes for each row");
  REFUSED(rr.rr_give(cases, 0, 0, a.plane[0], a.row_bytes, (size_t)a.height - 1), "rows, found");
  REFUSED(rr.rr_give(cases, 7, 0, a.plane[0], a.row_bytes, (size_t)a.height), "case 7");
  CHECK(rr.rr_give(cases, 0, 0, a.plane[0], a.row_bytes, (size_t)a.height) == RR_OK);
  rr_judge_options options = {.struct_bytes = sizeof options, .profile = "vulcan"};
  REFUSED(rr.rr_judge(cases, &options, &j), "did you mean 'vulkan'?");
  options.profile = "typical";
  REFUSED(rr.rr_judge(cases, &options, &j), "typical");
  options.profile = NULL;
  options.half = "up";
  REFUSED(rr.rr_judge(cases, &options, &j), "rr_judge_options.half: expected \"rne\", \"rtz\" or NULL, found \"up\"");
  CHECK(j == NULL);
  CHECK(rr.rr_judge(cases, NULL, &j) == RR_OK);
  rr_pass_verdict v = {.struct_bytes = sizeof v};
  REFUSED(rr.rr_get_pass_verdict(j, 1, &v), "pass 1");
  rr_cause cause = {.struct_bytes = sizeof cause};
  REFUSED(rr.rr_get_cause(j, 0, 0, &cause), "cause 0");
  const char* line = "";
  REFUSED(rr.rr_get_line(j, 0, 0, 0, &line), "cause 0");
  CHECK(line == NULL);
  rr_judgement* none = NULL;
  options.half = NULL;
  options.spirv = "nowhere";
  expect(__LINE__, rr.rr_judge(cases, &options, &none), RR_IO, "nowhere");
  CHECK(none == NULL);
  rr_failure failure = {.struct_bytes = sizeof failure};
  REFUSED(rr.rr_get_failure(j, 0, 0, &failure), "failure 0");
  REFUSED(rr.rr_report_text(NULL, NULL), "judgement: ");
  REFUSED(rr.rr_report_text(j, NULL), "text: ");
  rr.rr_free_judgement(j);
  rr.rr_free_judgement(NULL);

  // Cases are of one effect.
  rr_simulation* other = NULL;
  CHECK(rr.rr_open("effect = 'rainy_glass'\nmaps.size = 16\nrun.size = [9, 9]\n", NULL, &other) == RR_OK);
  REFUSED(rr.rr_next_frame_cases(other, NULL, 0, cases), "expected those of a simulation of rainy_glass corrected, found those of ");
  rr.rr_close(other);
  rr.rr_free_cases(cases);
  rr.rr_free_cases(NULL);
  CHECK(rr.rr_case_count(NULL) == 0);
  expect(__LINE__, rr.rr_cases_of_pack(scene, NULL, 0, &cases), RR_IO, "expected a pack's folder");
  REFUSED(rr.rr_cases_of_pack(NULL, NULL, 0, &cases), "folder: ");
}

void refusals(const char* scene) {
  opening(scene);
  rr_simulation* s = NULL;
  CHECK(rr.rr_open_file(scene, NULL, &s) == RR_OK);
  running(s);
  files(s);
  cases_and_judging(s, scene);
  rr.rr_close(s);
}
