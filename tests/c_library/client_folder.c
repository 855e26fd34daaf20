// Files of a port, judged as `rainref validate` judges them.
#include <stdlib.h>
#include <string.h>

#include "client.h"

static int count_runs(void* user, int32_t done, int32_t of) {
  int* const calls = user;
  ++*calls;
  CHECK(done == *calls && done <= of);
  return 0;
}
static int stop_at_two(void* user, int32_t done, int32_t of) {
  (void)user, (void)of;
  return done == 2;
}

/// Writes the four reports to files beside `out`, and looks at the verdict of a port of which one pass fails and one has no files.
void folder_judged(const char* pack, const char* port, const char* out) {
  int calls = 0;
  rr_folder_options o = {.struct_bytes = sizeof o, .partial = 1, .progress = count_runs, .user = &calls};
  rr_judgement* j = NULL;
  CHECK(rr.rr_judge_folder(pack, port, &o, &j) == RR_OK && calls > 0);
  rr_verdict verdict = {.struct_bytes = sizeof verdict};
  CHECK(rr.rr_get_verdict(j, &verdict) == RR_OK && strcmp(verdict.status, "FAIL") == 0 && strcmp(verdict.profile, "vulkan") == 0);
  int absent = 0, failing = 0;
  for (size_t p = 0; p < verdict.passes; ++p) {
    rr_pass_verdict pass = {.struct_bytes = sizeof pass};
    CHECK(rr.rr_get_pass_verdict(j, p, &pass) == RR_OK);
    absent += strcmp(pass.status, "NOT JUDGED") == 0;
    if (strcmp(pass.status, "FAIL") != 0) continue;
    ++failing;
    CHECK(strcmp(pass.pass, verdict.first_bad_pass) == 0 && pass.worst > 0);
  }
  CHECK(absent == 1 && failing == 1);
  const struct {
    const char* ending;
    int (*report)(rr_judgement*, const char**);
  } reports[] = {{"txt", rr.rr_report_text}, {"json", rr.rr_report_json}, {"html", rr.rr_report_html}, {"xml", rr.rr_report_junit}};
  for (size_t k = 0; k < sizeof reports / sizeof *reports; ++k) {
    const char *text = NULL, *again = NULL;
    CHECK(reports[k].report(j, &text) == RR_OK && reports[k].report(j, &again) == RR_OK && text == again);
    char name[4096];
    CHECK(snprintf(name, sizeof name, "%s.%s", out, reports[k].ending) < (int)sizeof name);
    FILE* const file = fopen(name, "w");
    CHECK(file && fputs(text, file) >= 0 && fclose(file) == 0);
  }
  rr.rr_free_judgement(j);

  // One pass alone, under another profile.
  const char* passes[] = {"display"};
  const rr_folder_options one = {
      .struct_bytes = sizeof one, .profile = "webgpu", .passes = passes, .pass_count = 1, .threads = 1, .exhaustive = 1};
  CHECK(rr.rr_judge_folder(pack, port, &one, &j) == RR_OK && rr.rr_get_verdict(j, &verdict) == RR_OK);
  CHECK(verdict.passes == 1 && strcmp(verdict.profile, "webgpu") == 0);
  rr.rr_free_judgement(j);
}

static void refused(int line, int result, int expected, rr_judgement* judgement, const char* part) {
  if (result == expected && judgement == NULL && strstr(rr.rr_error(), part)) return;
  fprintf(stderr, "%s:%d: expected code %d with '%s', found %d: %s\n", __FILE__, line, expected, part, result, rr.rr_error());
  exit(1);
}

void folder_refusals(const char* pack, const char* port) {
  rr_judgement* j = NULL;
  rr_folder_options o = {.struct_bytes = sizeof o};
  refused(__LINE__, rr.rr_judge_folder(NULL, port, NULL, &j), RR_USAGE, j, "pack: expected an address");
  refused(__LINE__, rr.rr_judge_folder(pack, NULL, NULL, &j), RR_USAGE, j, "port: expected an address");
  refused(__LINE__, rr.rr_judge_folder(pack, port, NULL, NULL), RR_USAGE, j, "judgement: expected an address");
  refused(__LINE__, rr.rr_judge_folder(pack, pack, NULL, &j), RR_USAGE, j, "");
  refused(__LINE__, rr.rr_judge_folder("nowhere", port, NULL, &j), RR_IO, j, "nowhere");
  refused(__LINE__, rr.rr_judge_folder(pack, "nowhere", NULL, &j), RR_FILES, j, "nowhere");
  o.profile = "vulcan";
  refused(__LINE__, rr.rr_judge_folder(pack, port, &o, &j), RR_USAGE, j, "did you mean 'vulkan'?");
  o.profile = NULL;
  const char* passes[] = {"displya"};
  o.passes = passes;
  o.pass_count = 1;
  refused(__LINE__, rr.rr_judge_folder(pack, port, &o, &j), RR_USAGE, j, "did you mean 'display'?");
  o.passes = NULL;
  refused(__LINE__, rr.rr_judge_folder(pack, port, &o, &j), RR_USAGE, j, "rr_folder_options.passes: expected an address");
  o.pass_count = 0;
  o.partial = 1;
  o.progress = stop_at_two;
  refused(__LINE__, rr.rr_judge_folder(pack, port, &o, &j), RR_USAGE, j, "stopped by rr_folder_options.progress after 2 of ");
  o.struct_bytes = 8;
  refused(__LINE__, rr.rr_judge_folder(pack, port, &o, &j), RR_USAGE, j, "rr_folder_options.struct_bytes: expected");
  const char* text = NULL;
  refused(__LINE__, rr.rr_report_junit(NULL, &text), RR_USAGE, NULL, "judgement: ");
}
