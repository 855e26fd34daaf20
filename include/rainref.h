// rainref for C and for every language that calls C: scenes that run, their buffers, cases of passes, verdicts. C11.
//
// A function that can fail returns RR_OK or an rr_result, and rr_error() then says why in one sentence. Nothing throws, nothing ends the
// process, and the caller's floating-point state is as it was after every call, whatever it is. A struct that the caller provides begins
// with its size: {.struct_bytes = sizeof(rr_array)}; another size is refused, so that no library writes past what its caller knows.
//
// Handles are for one thread at a time, different ones for any number of threads at once. A text or array that a handle gives belongs to
// the handle. Paths and texts are UTF-8 and end with a zero.
#ifndef RAINREF_H_
#define RAINREF_H_

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define RR_API __attribute__((visibility("default")))
#else
#define RR_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// What a call came to; the exit codes of the command line.
enum rr_result {
  RR_OK = 0,
  RR_USAGE = 2,    ///< arguments, a scene, an input that cannot be decoded
  RR_FILES = 3,    ///< a pack or what a port gave is missing or malformed
  RR_IO = 4,       ///< unreadable, unwritable, disk full
  RR_INTERNAL = 5  ///< a defect of rainref
};
/// Why the last call of this thread that failed did: place, key, expected, found, nearest name. "" where none has failed. Valid until
/// the next one fails.
RR_API const char* rr_error(void);

/// "major.minor.patch" of the library.
RR_API const char* rr_version(void);
/// The identity of the bits: it rises when a change alters those of any published pass. Two libraries of one generation give the same.
RR_API uint32_t rr_golden_generation(void);

/// "puddle", ..., in the order of `rainref list`; NULL past the last.
RR_API const char* rr_effect_name(size_t index);
/// "ieee", "vulkan", ...: what a port may be judged under; NULL past the last.
RR_API const char* rr_profile_name(size_t index);
/// What `rainref describe EFFECT --json` prints: parameters with units, ranges and defaults; passes; buffers; layouts. Valid as long as the
/// library is loaded.
RR_API int rr_describe(const char* effect, const char** json);

// ---- a scene that runs ----

typedef struct rr_simulation rr_simulation;

typedef struct rr_open_options {
  size_t struct_bytes;
  const char* file;        ///< what errors call the text, and whose folder the files that it names lie in; NULL: "scene"
  const char* const* set;  ///< "key=value", as `rainref run --set` takes them: they win over the text
  size_t set_count;
  int32_t threads;  ///< 0: one for each processor. No bit hangs on it
} rr_open_options;

/// Where made images that are the same in every run (the street around a puddle) are kept for later runs, by every simulation of this
/// process; NULL: nowhere. Without this call as `rainref run` keeps them: in $XDG_CACHE_HOME/rainref, or ~/.cache/rainref. No bit hangs on
/// it. RR_USAGE once a simulation was opened.
RR_API int rr_keep_images(const char* folder);
/// Opens the text of a scene; "" where `set` says everything. `options` may be NULL. A scene may name files, which are read. Close it.
RR_API int rr_open(const char* toml, const rr_open_options* options, rr_simulation** simulation);
/// The same of a scene file, of a scene that came with rainref ("puddle/default.toml"), or of a picture that rainref wrote;
/// options->file is not used.
RR_API int rr_open_file(const char* path, const rr_open_options* options, rr_simulation** simulation);
/// NULL is allowed.
RR_API void rr_close(rr_simulation* simulation);

typedef struct rr_simulation_info {
  size_t struct_bytes;
  const char* effect;
  const char* variant;     ///< "corrected" or "as-published"
  int32_t frame;           ///< frames simulated so far
  int32_t frames;          ///< that the scene asks for; more may be simulated
  size_t buffers;          ///< for rr_buffer_name
  size_t warnings;         ///< for rr_warning
  const char* scene_json;  ///< every key with its value: {"key": value, ...}
} rr_simulation_info;
/// Its texts are valid until the next call of this function or of rr_set.
RR_API int rr_get_info(rr_simulation* simulation, rr_simulation_info* info);
/// What is doubtful about the scene's files, a sentence, valid until rr_set; NULL past the last.
RR_API const char* rr_warning(const rr_simulation* simulation, size_t index);

/// To the next frame: 0, 1, 2 ... Nothing is rendered. It ends the validity of every array of the simulation, as do the next three,
/// rr_next_frame_cases, rr_load and rr_set.
RR_API int rr_simulate(rr_simulation* simulation);
/// The frame that was simulated last; once for each frame at most where textures have a past (windshield).
RR_API int rr_render(rr_simulation* simulation);
/// Both.
RR_API int rr_next_frame(rr_simulation* simulation);
/// Both, with the lines of `rainref hash`: "frame pass buffer hash", each ended by a newline, valid until the next such call.
RR_API int rr_next_frame_hashes(rr_simulation* simulation, const char** lines);

/// The picture that was rendered last: PNG 8 bits RGB, or radiance and what belongs to it as EXR.
RR_API int rr_write_png(rr_simulation* simulation, const char* path);
RR_API int rr_write_exr(rr_simulation* simulation, const char* path);

// ---- what a simulation holds between frames ----

/// Takes the next bytes of a state. Returns 0; anything else: they could not be written, and no more are offered.
typedef int (*rr_write)(void* user, const void* bytes, size_t count);
/// Gives the next bytes of a state, at most `count`, which is not 0. Returns how many it gave; 0: there are no more; negative: they could
/// not be read.
typedef int64_t (*rr_read)(void* user, void* bytes, size_t count);

/// Hands the state to `write`, with `user`, as bytes (docs/notes/state.md). Arrays stay valid: nothing changes. RR_IO where `write` fails.
RR_API int rr_save(rr_simulation* simulation, rr_write write, void* user);
/// Takes all that `read` gives as the state of this scene (run.frames may differ); the simulation goes on with the bits of the one that was
/// saved. Pictures come with the next frame or rr_render. RR_IO where `read` fails; RR_USAGE for bytes that are no state, cut short,
/// damaged, of another golden generation, scene or pictures. The simulation then is as it was.
RR_API int rr_load(rr_simulation* simulation, rr_read read, void* user);
/// Gives a key another value, as TOML writes it ("rain.rate", "30"), from the next frame on. RR_USAGE, naming the key, where the scene may
/// not say that or what is held does not fit it (effect, variant, sizes, storage); the simulation then is as it was. Files that the scene
/// names are read again.
RR_API int rr_set(rr_simulation* simulation, const char* key, const char* value);

// ---- arrays ----

enum rr_type {
  RR_UNORM8 = 1,  ///< code / 255
  RR_SRGB8,       ///< the same code of sRGB
  RR_FLOAT16,
  RR_FLOAT32,
  RR_UINT32,
  RR_INT32,
  RR_RECORDS  ///< structs, as `layout` says
};

/// The members of a record or a uniform block.
typedef struct rr_layout rr_layout;

/// An image, a list of records, or a uniform block. A texel (x, y) lies at y * row_bytes + x * texel_bytes: all its channels in the one
/// plane, or, where an image keeps them apart, channel c in plane c; those beyond the last of several planes are 0 everywhere. Row 0 is the
/// bottom one of pictures, and v = 0 of the pass that writes it.
typedef struct rr_array {
  size_t struct_bytes;
  const char* name;
  const char* format;  ///< "rg16f"; of records the name of their layout
  int32_t type;        ///< rr_type, of one channel
  int32_t channels;    ///< of the format; 1 of records
  int32_t width;       ///< texels, or records
  int32_t height;      ///< 1 of records
  int32_t levels;      ///< mip levels
  int32_t planes;
  size_t texel_bytes;       ///< from a texel to the next in a plane, or from a record to the next
  size_t row_bytes;         ///< from a row to the next in a plane
  const void* plane[4];     ///< NULL past the last; of an empty list any
  const rr_layout* layout;  ///< NULL of images
} rr_array;

typedef struct rr_layout_info {
  size_t struct_bytes;
  const char* name;  ///< of its struct in shaders
  size_t bytes;
  size_t members;
} rr_layout_info;
typedef struct rr_member {
  size_t struct_bytes;
  const char* name;
  const char* unit;
  const char* sentence;
  int32_t type;        ///< RR_FLOAT32, RR_UINT32 or RR_INT32
  int32_t components;  ///< 1 to 4
  size_t offset;       ///< [byte]
  double low, high;    ///< what each component may be, both included; infinite where nothing is said
} rr_member;
RR_API int rr_get_layout(const rr_layout* layout, rr_layout_info* info);
RR_API int rr_get_member(const rr_layout* layout, size_t index, rr_member* member);

/// Names of what the simulation holds between frames, valid until rr_set; NULL past the last.
RR_API const char* rr_buffer_name(rr_simulation* simulation, size_t index);
/// One of them, without a copy, valid until the simulation changes.
RR_API int rr_get_buffer(rr_simulation* simulation, const char* name, rr_array* buffer);
/// The picture that was rendered last: rgba8 display code.
RR_API int rr_get_picture(rr_simulation* simulation, rr_array* picture);

// ---- cases: runs of passes with what they took and gave ----

typedef struct rr_cases rr_cases;

/// No case yet; rr_next_frame_cases adds some. It may outlive the simulation. Free it.
RR_API int rr_cases_of_simulation(rr_simulation* simulation, rr_cases** cases);
/// The next frame, as rr_next_frame gives it. Each run of the named passes is added to `cases`, which must be of a scene of the same effect
/// and variant, with copies of its inputs and outputs: some tens of MiB for a frame of 1080p. No pass named: every one.
RR_API int rr_next_frame_cases(rr_simulation* simulation, const char* const* passes, size_t pass_count, rr_cases* cases);
/// The cases of a pack (`rainref pack`), with all their values. No pass named: every one. Free it.
RR_API int rr_cases_of_pack(const char* folder, const char* const* passes, size_t pass_count, rr_cases** cases);
/// NULL is allowed.
RR_API void rr_free_cases(rr_cases* cases);
/// How many there are.
RR_API size_t rr_case_count(const rr_cases* cases);

typedef struct rr_case_info {
  size_t struct_bytes;
  const char* id;  ///< "puddle.wave_step/0001.0"
  const char* effect;
  const char* variant;
  const char* pass;
  const char* formula;  ///< "puddle.wave_step.corrected/2"
  int32_t frame, step;
  int32_t level;   ///< the mip level, where the pass runs once for each; else -1
  float time, dt;  ///< [s] of the frame's start, and that this run advances
  size_t inputs, outputs;
} rr_case_info;
RR_API int rr_get_case(const rr_cases* cases, size_t index, rr_case_info* info);

/// How a pass reads an input: "none" loads by integer texel.
typedef struct rr_sampling {
  size_t struct_bytes;
  const char* filter;      ///< "none", "nearest", "linear"
  const char* mip_filter;  ///< "none": level 0 only
  const char* address_u;   ///< "clamp", "repeat", ...
  const char* address_v;
  float border[4];
} rr_sampling;

// Arrays of a case: one plane, rows without padding. Valid as long as the cases.
RR_API int rr_get_uniforms(const rr_cases* cases, size_t index, rr_array* block);
RR_API int rr_get_input(const rr_cases* cases, size_t index, size_t input, int32_t level, rr_array* array);
RR_API int rr_get_sampling(const rr_cases* cases, size_t index, size_t input, rr_sampling* sampling);
/// What the reference gives.
RR_API int rr_get_expected(const rr_cases* cases, size_t index, size_t output, rr_array* array);
/// How it is judged: "envelope", "bits", "keyed" (records, matched by their member id) or "input_only" (not at all).
RR_API const char* rr_get_judge(const rr_cases* cases, size_t index, size_t output);

/// What a port gave for an output; a copy is taken. Of an image `count` is its height, `row_bytes` from one of its rows to the next; of
/// records their number and their size. Where the list's length is a key's, another number of records is a FAIL.
RR_API int rr_give(rr_cases* cases, size_t index, size_t output, const void* data, size_t row_bytes, size_t count);
/// The same of an image that says itself what it is: type, channels, width, height, planes (1), texel_bytes, row_bytes and plane[0] of
/// `image` count. As of files (docs/dumps.md) channels beyond the output's are left out, which the report notes. Floats may also be given
/// for halves and for 8-bit codes: they are stored as the output stores them, to nearest even, sRGB encoded where it is sRGB. RR_FILES for
/// another size or type.
RR_API int rr_give_image(rr_cases* cases, size_t index, size_t output, const rr_array* image);

// ---- verdicts ----

typedef struct rr_judgement rr_judgement;

typedef struct rr_judge_options {
  size_t struct_bytes;
  const char* profile;  ///< NULL: "vulkan"
  const char* port;     ///< what reports call the port; NULL: "outputs in memory"
  const char* half;     ///< how the port rounds stores to binary16: "rne", "rtz"; NULL: found out where the profile leaves it open
  int32_t threads;      ///< 0: one for each processor
  int32_t strict;       ///< 1: each WARN is a FAIL
  int32_t exhaustive;   ///< 1: every envelope is computed, where widths and shares are otherwise a sample's
  const char* spirv;    ///< a folder with bindings.json and the port's SPIR-V (docs/shader.md): causes have lines; NULL: none
} rr_judge_options;
/// Judges every pass that anything was given for, and says why one fails. A run with an output that was not given is NOT JUDGED. `options`
/// may be NULL. Free it; it may outlive the cases.
RR_API int rr_judge(const rr_cases* cases, const rr_judge_options* options, rr_judgement** judgement);

/// Told how many runs of passes are judged, of how many. Returns 0 to go on; anything else ends the judging.
typedef int (*rr_progress)(void* user, int32_t done, int32_t of);
typedef struct rr_folder_options {
  size_t struct_bytes;
  const char* profile;        ///< NULL: "vulkan"
  const char* const* passes;  ///< judge these alone; none named: every one
  size_t pass_count;
  int32_t partial;       ///< 1: a pass without any file is NOT JUDGED, and its files are not missing
  int32_t threads;       ///< 0: one for each processor
  rr_progress progress;  ///< called by the thread that judges; may be NULL
  void* user;
  int32_t strict;      ///< 1: each WARN is a FAIL
  int32_t exhaustive;  ///< as in rr_judge_options
  const char* spirv;   ///< as in rr_judge_options
} rr_folder_options;
/// Judges the files that a port wrote (docs/dumps.md) for the cases of a pack, as `rainref validate PACK --port PORT` does; one case is in
/// memory at a time. Files that are missing or cannot be used stand in the reports, and what does not need them is judged: RR_OK. RR_FILES
/// where nothing can be judged, RR_USAGE where `progress` ended it. `options` may be NULL. Reports with pictures read both folders again.
/// Free it.
RR_API int rr_judge_folder(const char* pack, const char* port, const rr_folder_options* options, rr_judgement** judgement);
/// NULL is allowed.
RR_API void rr_free_judgement(rr_judgement* judgement);

// Texts of a judgement are valid as long as it.
typedef struct rr_verdict {
  size_t struct_bytes;
  const char* status;          ///< "PASS", "WARN", "FAIL", "UNTESTED", "DATA", "NOT JUDGED"
  const char* reason;          ///< "" where the status says all
  const char* first_bad_pass;  ///< in the order of dataflow; ""
  const char* profile;
  size_t passes;
} rr_verdict;
RR_API int rr_get_verdict(const rr_judgement* judgement, rr_verdict* verdict);

typedef struct rr_pass_verdict {
  size_t struct_bytes;
  const char* pass;
  const char* formula;
  const char* status;
  const char* reason;
  const char* where;  ///< what the failures share: "only channel y of wave"; ""
  int64_t cases;
  int64_t elements;   ///< judged: channels of texels, fields of records
  int64_t outside;    ///< of these not what the profile allows
  int64_t differing;  ///< not the reference's bits
  int64_t vacuous;    ///< of the sampled: without a bound that says anything
  size_t causes, worst;
  int64_t sampled;  ///< whose bounds were asked: all, or a sample of a large picture
} rr_pass_verdict;
RR_API int rr_get_pass_verdict(const rr_judgement* judgement, size_t pass, rr_pass_verdict* verdict);

/// What would explain the failures of a pass; the best is the first.
typedef struct rr_cause {
  size_t struct_bytes;
  const char* name;
  const char* sentence;
  int64_t explained;  ///< failing texels, or records, whose bits it gives
  int64_t of;         ///< failing ones that were looked at
  int64_t inside;     ///< that it comes near
  int32_t is_likely;  ///< 1: it explains nearly all
  size_t lines;       ///< of the port's shaders where it is
} rr_cause;
RR_API int rr_get_cause(const rr_judgement* judgement, size_t pass, size_t index, rr_cause* cause);
/// A line of the port's shaders where a cause is, the best first: "shade.comp:57: vec3 bent = refract(view, normal, WATER_IOR);".
RR_API int rr_get_line(const rr_judgement* judgement, size_t pass, size_t cause, size_t index, const char** line);

/// An element outside what is allowed; the worst is the first. Records that are missing or too many are in the pass's `reason`.
typedef struct rr_failure {
  size_t struct_bytes;
  const char* case_id;
  const char* output;
  const char* field;    ///< of a record's; ""
  int32_t x, y;         ///< texel; of a record x is its number or id
  int32_t channel;      ///< 0 to 3
  int32_t is_a_number;  ///< 0: NaN
  double got, low, high, expected;
  const char* text;  ///< place, what was got, accepted and expected, with their bits
} rr_failure;
RR_API int rr_get_failure(const rr_judgement* judgement, size_t pass, size_t index, rr_failure* failure);

/// The reports of `rainref validate`. docs/reports.md lists the keys of the JSON.
RR_API int rr_report_text(rr_judgement* judgement, const char** text);
RR_API int rr_report_json(rr_judgement* judgement, const char** json);
RR_API int rr_report_html(rr_judgement* judgement, const char** html);
RR_API int rr_report_junit(rr_judgement* judgement, const char** junit);

#ifdef __cplusplus
}
#endif

#endif  // RAINREF_H_
