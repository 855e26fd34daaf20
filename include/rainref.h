// The C interface of rainref (C11), for every language that can call C: running scenes, their buffers, cases of passes, verdicts.
//
// A function that can fail returns an rr_result. If it is not RR_OK, rr_error() says why in one sentence. No function throws or ends the
// process. The caller may use any floating-point state; every call restores it. The first member of a struct is its size, which the caller
// sets: {.struct_bytes = sizeof(rr_array)}. A function refuses another size, so it never writes past the end of the struct.
//
// Only one thread at a time may use a handle. Different threads may use different handles at the same time. A handle owns the texts and
// arrays that it returns. Paths and texts are UTF-8 and end with a zero byte.
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
  RR_IO = 4,       ///< a file cannot be read or written, or the disk is full
  RR_INTERNAL = 5  ///< a defect of rainref
};
/// Returns why this thread's last failed call failed: place, key, what was expected, what was found, nearest valid name. "" if no call has
/// failed. Valid until the next failure.
RR_API const char* rr_error(void);

/// "major.minor.patch" of the library.
RR_API const char* rr_version(void);
/// Generation of the golden results. It rises when a change alters the bits of any published pass. Two libraries of the same generation
/// give the same bits.
RR_API uint32_t rr_golden_generation(void);

/// "puddle", ..., in the order of `rainref list`; NULL if index is past the end.
RR_API const char* rr_effect_name(size_t index);
/// "ieee", "vulkan", ...: the profiles that a port can be judged under; NULL if index is past the end.
RR_API const char* rr_profile_name(size_t index);
/// Returns the output of `rainref describe EFFECT --json`: parameters with units, ranges and defaults; passes; buffers; layouts. It stays
/// valid while the library is loaded.
RR_API int rr_describe(const char* effect, const char** json);

// ---- running a scene ----

typedef struct rr_simulation rr_simulation;

typedef struct rr_open_options {
  size_t struct_bytes;
  const char* file;        ///< name of the text in errors (NULL: "scene"); the scene's file names are relative to its folder
  const char* const* set;  ///< "key=value", as for `rainref run --set`; overrides the text
  size_t set_count;
  int32_t threads;  ///< 0: one for each processor; does not affect results
} rr_open_options;

/// Sets the folder where this process keeps generated images that are the same in every run, such as the street around a puddle. NULL: it
/// keeps none. Without this call the folder is that of `rainref run`: $XDG_CACHE_HOME/rainref, or ~/.cache/rainref. Does not affect
/// results. Returns RR_USAGE once a simulation has been opened.
RR_API int rr_keep_images(const char* folder);
/// Opens a simulation from the text of a scene, and reads the files that the scene names. The text may be "" if `set` gives everything.
/// `options` may be NULL. Free the result with rr_close.
RR_API int rr_open(const char* toml, const rr_open_options* options, rr_simulation** simulation);
/// Does the same for a scene file, a bundled scene ("puddle/default.toml"), or the scene in a picture that rainref wrote. Ignores
/// options->file.
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
/// Returns a sentence about a doubtful property of the scene's files. Valid until rr_set. NULL if index is past the end.
RR_API const char* rr_warning(const rr_simulation* simulation, size_t index);

/// Simulates the next frame (0, 1, 2 ...) without rendering it. This call makes every array of the simulation invalid. So do rr_render,
/// rr_next_frame, rr_next_frame_hashes, rr_next_frame_cases, rr_load, rr_set and rr_film.
RR_API int rr_simulate(rr_simulation* simulation);
/// Renders the last simulated frame. Call it at most once for each frame if textures carry over between frames (windshield).
RR_API int rr_render(rr_simulation* simulation);
/// Simulates and renders the next frame.
RR_API int rr_next_frame(rr_simulation* simulation);
/// Simulates and renders the next frame, and returns the lines of `rainref hash`: "frame pass buffer hash", each ended by a newline. They
/// are valid until the next call of this function.
RR_API int rr_next_frame_hashes(rr_simulation* simulation, const char** lines);

/// Writes the last rendered picture: 8-bit RGB as PNG, or radiance and its auxiliary channels as EXR.
RR_API int rr_write_png(rr_simulation* simulation, const char* path);
RR_API int rr_write_exr(rr_simulation* simulation, const char* path);

// ---- state of a simulation ----

/// A callback that writes the next bytes of a state. It returns 0 on success. After any other value it is not called again.
typedef int (*rr_write)(void* user, const void* bytes, size_t count);
/// A callback that reads the next bytes of a state: at most `count`, which is never 0. It returns how many it read, 0 at the end, or a
/// negative value on an error.
typedef int64_t (*rr_read)(void* user, void* bytes, size_t count);

/// Saves the state as bytes (docs/notes/state.md): calls `write`, with `user`, until all are written. The simulation does not change, so
/// arrays stay valid. Returns RR_IO if `write` fails.
RR_API int rr_save(rr_simulation* simulation, rr_write write, void* user);
/// Loads a state of this scene (run.frames may differ) from `read`, up to its end. The simulation then continues with the same bits as the
/// saved one. The next frame or rr_render makes the picture. Returns RR_IO if `read` fails. Returns RR_USAGE if the bytes are not a whole,
/// undamaged state, or belong to another golden generation, another scene or other pictures. After an error the simulation is unchanged.
RR_API int rr_load(rr_simulation* simulation, rr_read read, void* user);
/// Changes the value of a key from the next frame on. The value is written as in TOML: ("rain.rate", "30"). Reads the scene's files again.
/// Returns RR_USAGE, and rr_error() names the key, if the scene does not allow the value or the state does not fit it (effect, variant,
/// sizes, storage). The simulation is then unchanged.
RR_API int rr_set(rr_simulation* simulation, const char* key, const char* value);

// ---- arrays ----

enum rr_type {
  RR_UNORM8 = 1,  ///< code / 255
  RR_SRGB8,       ///< like RR_UNORM8, but sRGB-encoded
  RR_FLOAT16,
  RR_FLOAT32,
  RR_UINT32,
  RR_INT32,
  RR_RECORDS  ///< structs, described by `layout`
};

/// The members of a record or a uniform block.
typedef struct rr_layout rr_layout;

/// An image, a list of records, or a uniform block. Texel (x, y) lies at y * row_bytes + x * texel_bytes in its plane. If there is one
/// plane, it holds all channels. If there are several, plane c holds channel c, and a channel without a plane is 0 everywhere. Row 0 is the
/// bottom row of a picture, and v = 0 of the pass that writes the image.
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
  const void* plane[4];     ///< NULL after the last plane; may be any pointer if the list is empty
  const rr_layout* layout;  ///< NULL for images
} rr_array;

typedef struct rr_layout_info {
  size_t struct_bytes;
  const char* name;  ///< name of the struct in shaders
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
  double low, high;    ///< inclusive range of each component; infinite if not declared
} rr_member;
RR_API int rr_get_layout(const rr_layout* layout, rr_layout_info* info);
RR_API int rr_get_member(const rr_layout* layout, size_t index, rr_member* member);

/// Returns the name of a buffer that the simulation keeps between frames. Valid until rr_set. NULL if index is past the end.
RR_API const char* rr_buffer_name(rr_simulation* simulation, size_t index);
/// Returns one of these buffers without a copy. Valid until the simulation changes.
RR_API int rr_get_buffer(rr_simulation* simulation, const char* name, rr_array* buffer);
/// Returns the last rendered picture: rgba8 display code.
RR_API int rr_get_picture(rr_simulation* simulation, rr_array* picture);

// ---- cases: runs of passes with their inputs and outputs ----

typedef struct rr_cases rr_cases;

/// A callback that learns how many frames or runs of passes are done, and how many there are. It returns 0 to continue. Any other value
/// ends the work: the function that called it returns RR_USAGE and leaves no partial file.
typedef int (*rr_progress)(void* user, int32_t done, int32_t of);

/// Makes an empty set of cases, to which rr_next_frame_cases adds. The set may outlive the simulation. Free it with rr_free_cases.
RR_API int rr_cases_of_simulation(rr_simulation* simulation, rr_cases** cases);
/// Runs the next frame like rr_next_frame. Adds each run of the named passes to `cases`, with copies of its inputs and outputs: some tens
/// of MiB for a 1080p frame. If no pass is named, it adds the runs of all passes. `cases` must be of the same effect and variant.
RR_API int rr_next_frame_cases(rr_simulation* simulation, const char* const* passes, size_t pass_count, rr_cases* cases);
/// Reads the cases of a pack (`rainref pack`) with all their values. If no pass is named, it reads the cases of all passes. Free the result
/// with rr_free_cases.
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
  int32_t level;   ///< mip level, if the pass runs once for each level; else -1
  float time, dt;  ///< [s] start of the frame, and time step of this run
  size_t inputs, outputs;
} rr_case_info;
RR_API int rr_get_case(const rr_cases* cases, size_t index, rr_case_info* info);

/// How a pass reads an input.
typedef struct rr_sampling {
  size_t struct_bytes;
  const char* filter;      ///< "none": by integer texel; "nearest", "linear"
  const char* mip_filter;  ///< "none": level 0 only
  const char* address_u;   ///< "clamp", "repeat", ...
  const char* address_v;
  float border[4];
} rr_sampling;

// The arrays of a case have one plane and rows without padding. They are valid as long as `cases`.
RR_API int rr_get_uniforms(const rr_cases* cases, size_t index, rr_array* block);
RR_API int rr_get_input(const rr_cases* cases, size_t index, size_t input, int32_t level, rr_array* array);
RR_API int rr_get_sampling(const rr_cases* cases, size_t index, size_t input, rr_sampling* sampling);
/// Returns the reference's output.
RR_API int rr_get_expected(const rr_cases* cases, size_t index, size_t output, rr_array* array);
/// Returns how the output is judged: "envelope", "bits", "keyed" (records, matched by their member id) or "input_only" (not judged).
RR_API const char* rr_get_judge(const rr_cases* cases, size_t index, size_t output);

/// Gives a port's result for an output, and copies it. For an image, `count` is its height and `row_bytes` the distance between its rows.
/// For records, `count` is their number and `row_bytes` the size of one. If a scene key determines the length of the list, another number
/// of records is a FAIL.
RR_API int rr_give(rr_cases* cases, size_t index, size_t output, const void* data, size_t row_bytes, size_t count);
/// Does the same for an image, which may have another type and more channels. It uses these members of `image`: type, channels, width,
/// height, planes (1), texel_bytes, row_bytes and plane[0]. As in files (docs/dumps.md), surplus channels are ignored, and the report notes
/// this. If the output has halves or 8-bit codes, floats are accepted too: they are rounded to nearest even, and sRGB-encoded if the output
/// is sRGB. Returns RR_FILES for another size or type.
RR_API int rr_give_image(rr_cases* cases, size_t index, size_t output, const rr_array* image);

// ---- files of a running scene: packs and films ----

typedef struct rr_pack_options {
  size_t struct_bytes;
  const int32_t* frames;  ///< if none is given: 0, 1 and 12, and a later frame for a pass that does nothing in these
  size_t frame_count;
  const char* const* passes;  ///< if none is named, all are taken
  size_t pass_count;
  const char* seed;      ///< NULL: the scene's; else a whole number, or "random" for an unpredictable one. The manifest records it
  rr_progress progress;  ///< called after each frame; starts over if the pack is written again with more frames; may be NULL
  void* user;
} rr_pack_options;
/// Writes a pack of the simulation's scene into a folder, like `rainref pack`. It runs the scene from the first frame; the simulation does
/// not change. The pack appears whole or not at all, and replaces an older one. `notes` are sentences, each ended by a newline: passes left
/// out, frames added, passes where even a null port is a PASS. They are valid until the next call of this function. `options` and `notes`
/// may be NULL.
RR_API int rr_write_pack(rr_simulation* simulation, const char* folder, const rr_pack_options* options, const char** notes);
/// Simulates the next `frames` frames (0: the scene's remaining frames), and writes a film of the frames whose number is a multiple of
/// `every`, like `rainref run --film`. ffmpeg makes the film: .mp4, .webm or .gif. The last frame is rendered in any case. `progress` is
/// called after each frame; it may be NULL. Not in the WebAssembly module.
RR_API int rr_film(rr_simulation* simulation, const char* path, int32_t frames, int32_t every, rr_progress progress, void* user);

// ---- verdicts ----

typedef struct rr_judgement rr_judgement;

typedef struct rr_judge_options {
  size_t struct_bytes;
  const char* profile;  ///< NULL: "vulkan"
  const char* port;     ///< name of the port in reports; NULL: "outputs in memory"
  const char* half;     ///< how the port rounds stores to binary16: "rne", "rtz"; NULL: inferred if the profile leaves it open
  int32_t threads;      ///< 0: one for each processor
  int32_t strict;       ///< 1: each WARN is a FAIL
  int32_t exhaustive;   ///< 1: compute every envelope; 0: the statistics of envelope widths may use a sample
  const char* spirv;    ///< folder with bindings.json and the port's SPIR-V (docs/shader.md), for the lines of causes; NULL: none
} rr_judge_options;
/// Judges every pass that has at least one given output, and says why a pass fails. A run with a missing output is NOT JUDGED. `options`
/// may be NULL. The judgement may outlive the cases. Free it with rr_free_judgement.
RR_API int rr_judge(const rr_cases* cases, const rr_judge_options* options, rr_judgement** judgement);

typedef struct rr_folder_options {
  size_t struct_bytes;
  const char* profile;        ///< NULL: "vulkan"
  const char* const* passes;  ///< judge only these; if none is named, all are judged
  size_t pass_count;
  int32_t partial;       ///< 1: a pass without any file is NOT JUDGED, and its files do not count as missing
  int32_t threads;       ///< 0: one for each processor
  rr_progress progress;  ///< called after each run of a pass, on the thread that judges; may be NULL
  void* user;
  int32_t strict;      ///< 1: each WARN is a FAIL
  int32_t exhaustive;  ///< as in rr_judge_options
  const char* spirv;   ///< as in rr_judge_options
} rr_folder_options;
/// Judges the files that a port wrote (docs/dumps.md) for the cases of a pack, like `rainref validate PACK --port PORT`. Holds one case in
/// memory at a time. If some files are missing or unusable, the reports list them, the other files are judged, and the result is RR_OK.
/// Returns RR_FILES if nothing can be judged, and RR_USAGE if `progress` ended the work. `options` may be NULL. Reports with pictures read
/// both folders again. Free the result with rr_free_judgement.
RR_API int rr_judge_folder(const char* pack, const char* port, const rr_folder_options* options, rr_judgement** judgement);
/// `judgement` may be NULL.
RR_API void rr_free_judgement(rr_judgement* judgement);

// The texts below are valid as long as the judgement.
typedef struct rr_verdict {
  size_t struct_bytes;
  const char* status;          ///< "PASS", "WARN", "FAIL", "UNTESTED", "DATA", "NOT JUDGED"
  const char* reason;          ///< "" if the status says it all
  const char* first_bad_pass;  ///< the first FAIL in the order of dataflow; "" if none
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
  const char* where;  ///< what the failures have in common: "only channel y of wave"; "" if nothing
  int64_t cases;
  int64_t elements;   ///< judged elements: channels of texels, fields of records
  int64_t outside;    ///< elements whose value the profile does not allow
  int64_t differing;  ///< elements whose bits differ from the reference's
  int64_t vacuous;    ///< sampled elements whose envelope is too wide to be useful
  size_t causes, worst;
  int64_t sampled;  ///< elements whose envelope was computed: all, or a sample of a large picture
} rr_pass_verdict;
RR_API int rr_get_pass_verdict(const rr_judgement* judgement, size_t pass, rr_pass_verdict* verdict);

/// A possible cause of the failures of a pass; the best comes first.
typedef struct rr_cause {
  size_t struct_bytes;
  const char* name;
  const char* sentence;
  int64_t explained;  ///< failing texels or records whose bits the cause reproduces
  int64_t of;         ///< failing texels or records that were examined
  int64_t inside;     ///< failing texels or records that the cause comes near
  int32_t is_likely;  ///< 1: it explains nearly all of them
  size_t lines;       ///< number of its lines in the port's shaders
} rr_cause;
RR_API int rr_get_cause(const rr_judgement* judgement, size_t pass, size_t index, rr_cause* cause);
/// Gets a line of a cause in the port's shaders, best first: "shade.comp:57: vec3 bent = refract(view, normal, WATER_IOR);".
RR_API int rr_get_line(const rr_judgement* judgement, size_t pass, size_t cause, size_t index, const char** line);

/// An element outside its envelope. Index 0 is the worst. Missing and surplus records are counted in the pass's `reason` instead.
typedef struct rr_failure {
  size_t struct_bytes;
  const char* case_id;
  const char* output;
  const char* field;    ///< field of a record; "" for an image
  int32_t x, y;         ///< texel; for a record, x is its number or id
  int32_t channel;      ///< 0 to 3
  int32_t is_a_number;  ///< 0: NaN
  double got, low, high, expected;
  const char* text;  ///< place, then the values found, accepted and expected, with their bits
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
