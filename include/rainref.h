// rainref for C and for every language that calls C: scenes that run, their buffers, cases of passes, verdicts. C11.
//
// A function that can fail returns an rr_result. If it is not RR_OK, rr_error() says why in one sentence. No function throws or ends the
// process. The caller may have any floating-point state; every call restores it. A struct that the caller provides begins with its size:
// {.struct_bytes = sizeof(rr_array)}. Another size is refused, so the library never writes past the end of the caller's struct.
//
// One thread at a time may use a handle; different threads may use different handles at once. Texts and arrays that a handle returns belong
// to the handle. Paths and texts are UTF-8 and end with a zero byte.
#ifndef RAINREF_H_
#define RAINREF_H_

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(RAINREF_BUILDS_C_LIBRARY)
#define RR_API __declspec(dllexport)
#elif defined(_WIN32)
#define RR_API __declspec(dllimport)
#elif defined(__GNUC__)
#define RR_API __attribute__((visibility("default")))
#else
#define RR_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// Result of a call. The values are the exit codes of the command line.
enum rr_result {
  RR_OK = 0,
  RR_USAGE = 2,    ///< invalid arguments or scene, or an input that cannot be decoded
  RR_FILES = 3,    ///< a pack or the output of a port is missing or malformed
  RR_IO = 4,       ///< unreadable, unwritable, disk full
  RR_INTERNAL = 5  ///< a defect of rainref
};
/// Returns why the last failed call of this thread failed: place, key, expected, found, nearest name; "" if no call has failed. Valid until
/// the next failure.
RR_API const char* rr_error(void);

/// "major.minor.patch" of the library.
RR_API const char* rr_version(void);
/// Generation of the golden results. It rises when a change alters the bits of any published pass. Two libraries of one generation give the
/// same bits.
RR_API uint32_t rr_golden_generation(void);

/// "puddle", ..., in the order of `rainref list`; NULL if index is past the end.
RR_API const char* rr_effect_name(size_t index);
/// "ieee", "vulkan", ...: the profiles that a port can be judged under; NULL if index is past the end.
RR_API const char* rr_profile_name(size_t index);
/// Returns the output of `rainref describe EFFECT --json`: parameters with units, ranges and defaults; passes; buffers; layouts. Valid as
/// long as the library is loaded.
RR_API int rr_describe(const char* effect, const char** json);

// ---- running a scene ----

typedef struct rr_simulation rr_simulation;

typedef struct rr_open_options {
  size_t struct_bytes;
  const char* file;        ///< name of the text in errors; files that the scene names are relative to its folder; NULL: "scene"
  const char* const* set;  ///< "key=value", as for `rainref run --set`; overrides the text
  size_t set_count;
  int32_t threads;  ///< 0: one for each processor. Does not affect results
} rr_open_options;

/// Sets the folder in which all simulations of this process keep generated images that are the same in every run (such as the street around
/// a puddle) for later runs. NULL: they are not kept. Without this call the folder is that of `rainref run`: $XDG_CACHE_HOME/rainref, or
/// ~/.cache/rainref. Does not affect results. Returns RR_USAGE after a simulation has been opened.
RR_API int rr_keep_images(const char* folder);
/// Opens a simulation from the text of a scene; the text may be "" if `set` gives everything. `options` may be NULL. Files that the scene
/// names are read. Call rr_close on the result.
RR_API int rr_open(const char* toml, const rr_open_options* options, rr_simulation** simulation);
/// The same for a scene file, a bundled scene ("puddle/default.toml"), or a picture that rainref wrote; options->file is ignored.
RR_API int rr_open_file(const char* path, const rr_open_options* options, rr_simulation** simulation);
/// `simulation` may be NULL.
RR_API void rr_close(rr_simulation* simulation);

typedef struct rr_simulation_info {
  size_t struct_bytes;
  const char* effect;
  const char* variant;     ///< "corrected" or "as-published"
  int32_t frame;           ///< frames simulated so far
  int32_t frames;          ///< number of frames that the scene asks for; more may be simulated
  size_t buffers;          ///< number of buffers, for rr_buffer_name
  size_t warnings;         ///< number of warnings, for rr_warning
  const char* scene_json;  ///< every key with its value: {"key": value, ...}
} rr_simulation_info;
/// The texts in `info` are valid until the next call of this function or of rr_set.
RR_API int rr_get_info(rr_simulation* simulation, rr_simulation_info* info);
/// Returns a sentence about a doubtful property of the scene's files, valid until rr_set; NULL if index is past the end.
RR_API const char* rr_warning(const rr_simulation* simulation, size_t index);

/// Simulates the next frame (0, 1, 2 ...) without rendering it. It invalidates every array of the simulation, as do the next three
/// functions, rr_next_frame_cases, rr_load and rr_set.
RR_API int rr_simulate(rr_simulation* simulation);
/// Renders the last simulated frame. Call it at most once for each frame if textures carry over between frames (windshield).
RR_API int rr_render(rr_simulation* simulation);
/// Simulates and renders the next frame.
RR_API int rr_next_frame(rr_simulation* simulation);
/// Simulates and renders the next frame, and returns the lines of `rainref hash`: "frame pass buffer hash", each ended by a newline, valid
/// until the next call of this function.
RR_API int rr_next_frame_hashes(rr_simulation* simulation, const char** lines);

/// Writes the last rendered picture: as 8-bit RGB PNG, or radiance with its auxiliary channels as EXR.
RR_API int rr_write_png(rr_simulation* simulation, const char* path);
RR_API int rr_write_exr(rr_simulation* simulation, const char* path);

// ---- state of a simulation ----

/// Receives the next bytes of a state. Returns 0 on success. Any other value means that they could not be written; then it is not called
/// again.
typedef int (*rr_write)(void* user, const void* bytes, size_t count);
/// Supplies the next bytes of a state: at most `count`, which is not 0. Returns how many it supplied, 0 at the end, or a negative value if
/// they could not be read.
typedef int64_t (*rr_read)(void* user, void* bytes, size_t count);

/// Passes the state to `write`, with `user`, as bytes (docs/notes/state.md). The simulation does not change, so arrays stay valid. Returns
/// RR_IO if `write` fails.
RR_API int rr_save(rr_simulation* simulation, rr_write write, void* user);
/// Loads everything that `read` supplies as the state of this scene (run.frames may differ). The simulation then continues with the same
/// bits as the saved one. Pictures come with the next frame or rr_render. Returns RR_IO if `read` fails, and RR_USAGE for bytes that are no
/// state, cut short, damaged, or of another golden generation, scene or pictures. After an error the simulation is unchanged.
RR_API int rr_load(rr_simulation* simulation, rr_read read, void* user);
/// Sets a key to another value, written as in TOML ("rain.rate", "30"), from the next frame on. Returns RR_USAGE and names the key if the
/// scene does not allow the value or the state does not fit it (effect, variant, sizes, storage); the simulation is then unchanged. Files
/// that the scene names are read again.
RR_API int rr_set(rr_simulation* simulation, const char* key, const char* value);

// ---- arrays ----

enum rr_type {
  RR_UNORM8 = 1,  ///< code / 255
  RR_SRGB8,       ///< as RR_UNORM8, sRGB-encoded
  RR_FLOAT16,
  RR_FLOAT32,
  RR_UINT32,
  RR_INT32,
  RR_RECORDS  ///< structs, described by `layout`
};

/// The members of a record or a uniform block.
typedef struct rr_layout rr_layout;

/// An image, a list of records, or a uniform block. A texel (x, y) lies at y * row_bytes + x * texel_bytes. If there is one plane, it holds
/// all channels. If there are several, channel c is in plane c, and channels without a plane are 0 everywhere. Row 0 is the bottom row of a
/// picture, and v = 0 of the pass that writes it.
typedef struct rr_array {
  size_t struct_bytes;
  const char* name;
  const char* format;  ///< "rg16f"; for records the name of their layout
  int32_t type;        ///< rr_type of one channel
  int32_t channels;    ///< number of channels of the format; 1 for records
  int32_t width;       ///< texels, or records
  int32_t height;      ///< 1 for records
  int32_t levels;      ///< mip levels
  int32_t planes;
  size_t texel_bytes;       ///< distance between texels in a plane, or between records
  size_t row_bytes;         ///< distance between rows in a plane
  const void* plane[4];     ///< NULL after the last plane; any pointer for an empty list
  const rr_layout* layout;  ///< NULL for images
} rr_array;

typedef struct rr_layout_info {
  size_t struct_bytes;
  const char* name;  ///< name of its struct in shaders
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
  double low, high;    ///< range of each component, both ends included; infinite if not declared
} rr_member;
RR_API int rr_get_layout(const rr_layout* layout, rr_layout_info* info);
RR_API int rr_get_member(const rr_layout* layout, size_t index, rr_member* member);

/// Returns the name of a buffer that the simulation holds between frames, valid until rr_set; NULL if index is past the end.
RR_API const char* rr_buffer_name(rr_simulation* simulation, size_t index);
/// Returns one of these buffers without copying it; valid until the simulation changes.
RR_API int rr_get_buffer(rr_simulation* simulation, const char* name, rr_array* buffer);
/// Returns the last rendered picture: rgba8 display code.
RR_API int rr_get_picture(rr_simulation* simulation, rr_array* picture);

// ---- cases: runs of passes with their inputs and outputs ----

typedef struct rr_cases rr_cases;

/// Receives how much is done (frames, or runs of passes), and the total. Returns 0 to continue. Any other value ends the work, which then
/// returns RR_USAGE and leaves no partial file.
typedef int (*rr_progress)(void* user, int32_t done, int32_t of);

/// Makes an empty set of cases; rr_next_frame_cases adds to it. It may outlive the simulation. Call rr_free_cases on it.
RR_API int rr_cases_of_simulation(rr_simulation* simulation, rr_cases** cases);
/// Runs the next frame like rr_next_frame. Adds each run of the named passes to `cases`, which must be of the same effect and variant, with
/// copies of its inputs and outputs: some tens of MiB for a 1080p frame. If no pass is named, all are added.
RR_API int rr_next_frame_cases(rr_simulation* simulation, const char* const* passes, size_t pass_count, rr_cases* cases);
/// Reads the cases of a pack (`rainref pack`) with all their values. If no pass is named, all are read. Call rr_free_cases on the result.
RR_API int rr_cases_of_pack(const char* folder, const char* const* passes, size_t pass_count, rr_cases** cases);
/// `cases` may be NULL.
RR_API void rr_free_cases(rr_cases* cases);
/// Number of cases.
RR_API size_t rr_case_count(const rr_cases* cases);

typedef struct rr_case_info {
  size_t struct_bytes;
  const char* id;  ///< "puddle.wave_step/0001.0"
  const char* effect;
  const char* variant;
  const char* pass;
  const char* formula;  ///< "puddle.wave_step.corrected/2"
  int32_t frame, step;
  int32_t level;   ///< the mip level, if the pass runs once for each; else -1
  float time, dt;  ///< [s] start of the frame, and time step of this run
  size_t inputs, outputs;
} rr_case_info;
RR_API int rr_get_case(const rr_cases* cases, size_t index, rr_case_info* info);

/// How a pass reads an input; "none" loads by integer texel.
typedef struct rr_sampling {
  size_t struct_bytes;
  const char* filter;      ///< "none", "nearest", "linear"
  const char* mip_filter;  ///< "none": level 0 only
  const char* address_u;   ///< "clamp", "repeat", ...
  const char* address_v;
  float border[4];
} rr_sampling;

// Arrays of a case: one plane, rows without padding. Valid as long as `cases`.
RR_API int rr_get_uniforms(const rr_cases* cases, size_t index, rr_array* block);
RR_API int rr_get_input(const rr_cases* cases, size_t index, size_t input, int32_t level, rr_array* array);
RR_API int rr_get_sampling(const rr_cases* cases, size_t index, size_t input, rr_sampling* sampling);
/// Returns the reference's output.
RR_API int rr_get_expected(const rr_cases* cases, size_t index, size_t output, rr_array* array);
/// Returns how the output is judged: "envelope", "bits", "keyed" (records, matched by their member id) or "input_only" (not judged).
RR_API const char* rr_get_judge(const rr_cases* cases, size_t index, size_t output);

/// Gives a port's result for an output; it is copied. For an image `count` is its height and `row_bytes` the distance between its rows; for
/// records they are their number and their size. If a scene key determines the length of the list, another number of records is a FAIL.
RR_API int rr_give(rr_cases* cases, size_t index, size_t output, const void* data, size_t row_bytes, size_t count);
/// The same for an image that describes itself: type, channels, width, height, planes (1), texel_bytes, row_bytes and plane[0] of `image`
/// are used. As for files (docs/dumps.md), channels beyond the output's are ignored, and the report notes this. Floats are also accepted
/// for halves and 8-bit codes: they are converted to the format of the output, rounded to nearest even, and sRGB-encoded if the output is
/// sRGB. Returns RR_FILES for another size or type.
RR_API int rr_give_image(rr_cases* cases, size_t index, size_t output, const rr_array* image);

// ---- files of a running scene: packs and films ----

typedef struct rr_pack_options {
  size_t struct_bytes;
  const int32_t* frames;  ///< if none is named: 0, 1 and 12, and a later one for a pass that does nothing in these
  size_t frame_count;
  const char* const* passes;  ///< if none is named, all are taken
  size_t pass_count;
  const char* seed;      ///< NULL: the scene's; a whole number; "random": one that nobody can predict. The pack's manifest has it
  rr_progress progress;  ///< called after each frame; begins anew if the pack is written again with more frames; may be NULL
  void* user;
} rr_pack_options;
/// Writes a pack of the simulation's scene into a folder, like `rainref pack`, from the scene's first frame on; the simulation does not
/// change. The pack appears whole or not at all, and replaces an older one. `notes` are sentences, each ended by a newline: passes that it
/// leaves out, frames that it adds, passes of which it says nothing. They are valid until the next call of this function. `options` and
/// `notes` may be NULL.
RR_API int rr_write_pack(rr_simulation* simulation, const char* folder, const rr_pack_options* options, const char** notes);
/// Simulates the next `frames` frames (0: those that remain of the scene's), and writes a film of those whose number `every` divides, like
/// `rainref run --film`: .mp4, .webm or .gif, made by ffmpeg. The last frame is rendered in any case. `progress` is called after each
/// frame; it may be NULL. It invalidates every array of the simulation. Not in the WebAssembly
/// module.
RR_API int rr_film(rr_simulation* simulation, const char* path, int32_t frames, int32_t every, rr_progress progress, void* user);

// ---- verdicts ----

typedef struct rr_judgement rr_judgement;

typedef struct rr_judge_options {
  size_t struct_bytes;
  const char* profile;  ///< NULL: "vulkan"
  const char* port;     ///< name of the port in reports; NULL: "outputs in memory"
  const char* half;     ///< how the port rounds stores to binary16: "rne", "rtz"; NULL: inferred from the outputs if the profile leaves it
                        ///< open
  int32_t threads;      ///< 0: one for each processor
  int32_t strict;       ///< 1: each WARN is a FAIL
  int32_t exhaustive;   ///< 1: compute every envelope, also for statistics of widths that otherwise use a sample
  const char* spirv;    ///< folder with bindings.json and the port's SPIR-V (docs/shader.md): causes get lines; NULL: none
} rr_judge_options;
/// Judges every pass that has at least one given output, and says why a pass fails. A run with a missing output is NOT JUDGED. `options`
/// may be NULL. The judgement may outlive the cases. Call rr_free_judgement on it.
RR_API int rr_judge(const rr_cases* cases, const rr_judge_options* options, rr_judgement** judgement);

typedef struct rr_folder_options {
  size_t struct_bytes;
  const char* profile;        ///< NULL: "vulkan"
  const char* const* passes;  ///< judge only these; if none is named, all are judged
  size_t pass_count;
  int32_t partial;       ///< 1: a pass without any file is NOT JUDGED; its files do not count as missing
  int32_t threads;       ///< 0: one for each processor
  rr_progress progress;  ///< called by the thread that judges, after each run of a pass; may be NULL
  void* user;
  int32_t strict;      ///< 1: each WARN is a FAIL
  int32_t exhaustive;  ///< as in rr_judge_options
  const char* spirv;   ///< as in rr_judge_options
} rr_folder_options;
/// Judges the files that a port wrote (docs/dumps.md) for the cases of a pack, like `rainref validate PACK --port PORT`. One case is in
/// memory at a time. The reports list missing and unusable files; everything else is judged, and the result is RR_OK. Returns RR_FILES if
/// nothing can be judged, and RR_USAGE if `progress` ended it. `options` may be NULL. Reports with pictures read both folders again. Call
/// rr_free_judgement on the result.
RR_API int rr_judge_folder(const char* pack, const char* port, const rr_folder_options* options, rr_judgement** judgement);
/// `judgement` may be NULL.
RR_API void rr_free_judgement(rr_judgement* judgement);

// The texts are valid as long as the judgement.
typedef struct rr_verdict {
  size_t struct_bytes;
  const char* status;          ///< "PASS", "WARN", "FAIL", "UNTESTED", "DATA", "NOT JUDGED"
  const char* reason;          ///< "" if the status says all
  const char* first_bad_pass;  ///< in the order of dataflow; "" if none
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
  const char* where;  ///< common property of the failures: "only channel y of wave"; "" if none
  int64_t cases;
  int64_t elements;   ///< judged elements: channels of texels, fields of records
  int64_t outside;    ///< elements that the profile does not allow
  int64_t differing;  ///< elements that differ from the reference's bits
  int64_t vacuous;    ///< sampled elements with a useless, very wide envelope
  size_t causes, worst;
  int64_t sampled;  ///< elements whose envelope was computed: all, or a sample of a large picture
} rr_pass_verdict;
RR_API int rr_get_pass_verdict(const rr_judgement* judgement, size_t pass, rr_pass_verdict* verdict);

/// A possible cause of the failures of a pass; the best comes first.
typedef struct rr_cause {
  size_t struct_bytes;
  const char* name;
  const char* sentence;
  int64_t explained;  ///< failing texels or records whose bits it reproduces
  int64_t of;         ///< failing texels or records that were examined
  int64_t inside;     ///< failing ones that it comes near
  int32_t is_likely;  ///< 1: it explains nearly all
  size_t lines;       ///< number of its lines in the port's shaders
} rr_cause;
RR_API int rr_get_cause(const rr_judgement* judgement, size_t pass, size_t index, rr_cause* cause);
/// Gets a line of a cause in the port's shaders, best first: "shade.comp:57: vec3 bent = refract(view, normal, WATER_IOR);".
RR_API int rr_get_line(const rr_judgement* judgement, size_t pass, size_t cause, size_t index, const char** line);

/// An element outside its envelope; the worst comes first. The pass's `reason` counts missing and surplus records.
typedef struct rr_failure {
  size_t struct_bytes;
  const char* case_id;
  const char* output;
  const char* field;    ///< field of a record; "" for an image
  int32_t x, y;         ///< texel; for a record x is its number or id
  int32_t channel;      ///< 0 to 3
  int32_t is_a_number;  ///< 0: NaN
  double got, low, high, expected;
  const char* text;  ///< place, then the value found, accepted and expected, with their bits
} rr_failure;
RR_API int rr_get_failure(const rr_judgement* judgement, size_t pass, size_t index, rr_failure* failure);

/// The reports of `rainref validate`. docs/reports.md lists the JSON keys.
RR_API int rr_report_text(rr_judgement* judgement, const char** text);
RR_API int rr_report_json(rr_judgement* judgement, const char** json);
RR_API int rr_report_html(rr_judgement* judgement, const char** html);
RR_API int rr_report_junit(rr_judgement* judgement, const char** junit);

#ifdef __cplusplus
}
#endif

#endif  // RAINREF_H_
