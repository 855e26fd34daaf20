// A C program that knows rainref by its header alone and loads the library while it runs, as an engine's plug-in does.
#ifndef C_LIBRARY_CLIENT_H_
#define C_LIBRARY_CLIENT_H_

#include <stdio.h>

#include "rainref.h"

// Every function of the header. c_library_test.cpp compares this list with what the library exports.
#define RR_FUNCTIONS(X)     \
  X(rr_error)               \
  X(rr_version)             \
  X(rr_golden_generation)   \
  X(rr_effect_name)         \
  X(rr_profile_name)        \
  X(rr_describe)            \
  X(rr_keep_images)         \
  X(rr_open)                \
  X(rr_open_file)           \
  X(rr_close)               \
  X(rr_get_info)            \
  X(rr_warning)             \
  X(rr_simulate)            \
  X(rr_render)              \
  X(rr_next_frame)          \
  X(rr_next_frame_hashes)   \
  X(rr_write_png)           \
  X(rr_write_exr)           \
  X(rr_save)                \
  X(rr_load)                \
  X(rr_set)                 \
  X(rr_get_layout)          \
  X(rr_get_member)          \
  X(rr_buffer_name)         \
  X(rr_get_buffer)          \
  X(rr_get_picture)         \
  X(rr_cases_of_simulation) \
  X(rr_next_frame_cases)    \
  X(rr_cases_of_pack)       \
  X(rr_free_cases)          \
  X(rr_case_count)          \
  X(rr_get_case)            \
  X(rr_get_uniforms)        \
  X(rr_get_input)           \
  X(rr_get_sampling)        \
  X(rr_get_expected)        \
  X(rr_get_judge)           \
  X(rr_give)                \
  X(rr_give_image)          \
  X(rr_write_pack)          \
  X(rr_film)                \
  X(rr_judge)               \
  X(rr_judge_folder)        \
  X(rr_free_judgement)      \
  X(rr_get_verdict)         \
  X(rr_get_pass_verdict)    \
  X(rr_get_cause)           \
  X(rr_get_line)            \
  X(rr_get_failure)         \
  X(rr_report_text)         \
  X(rr_report_json)         \
  X(rr_report_html)         \
  X(rr_report_junit)

struct library {
#define RR_MEMBER(name) __typeof__(name)* name;
  RR_FUNCTIONS(RR_MEMBER)
#undef RR_MEMBER
};
extern struct library rr;

/// Ends the program, naming the line, unless the condition holds.
#define CHECK(condition)                                                                           \
  do {                                                                                             \
    if (!(condition)) {                                                                            \
      fprintf(stderr, "%s:%d: %s; rr_error: %s\n", __FILE__, __LINE__, #condition, rr.rr_error()); \
      exit(1);                                                                                     \
    }                                                                                              \
  } while (0)

/// Runs a golden scene for so many frames and compares those that were recorded. A scene file's first line names it: "# puddle/corrected".
/// `threads` as rr_open_options.threads. 0 where all are as recorded.
int compare_golden(const char* scene, const char* hashes, int frames, int threads);
/// The other things that the program is asked to do; each ends it where something is not as it should be.
void four_threads(char** scenes, int count, const char* hashes);
void after_fork(const char* scene, const char* hashes);
void in_other_states(const char* scene, const char* hashes);
void refusals(const char* scene);
void judging(const char* scene);
void folder_judged(const char* pack, const char* port, const char* out);
void folder_refusals(const char* pack, const char* port);
void views(const char* scene);
void wave_of_8_bits(const char* scene);
/// Two frames, their hashes printed, with images kept in `folder`: "-" says nothing to the library, "none" forbids it.
void kept(const char* scene, const char* folder);
void states_saved(const char* scene);

#endif  // C_LIBRARY_CLIENT_H_
