// Cases of passes for C: by number, with arrays that point into the cases.
#include <algorithm>

#include "base/path_text.h"
#include "c_library/arrays.h"
#include "c_library/call.h"
#include "c_library/handles.h"

using namespace rainref;
using c_library::call;
using c_library::required;
using c_library::sized;
using judging::Run;

namespace {

const Run& run_of(const rr_cases* cases, size_t index) { return required(cases, "cases").list.run(index); }

}  // namespace

int rr_cases_of_simulation(rr_simulation* simulation, rr_cases** cases) {
  return call([&] {
    const rr_simulation& s = required(simulation, "simulation");
    required(cases, "cases") = nullptr;
    *cases = new rr_cases{judging::CaseList(s.running)};
  });
}
int rr_next_frame_cases(rr_simulation* simulation, const char* const* passes, size_t pass_count, rr_cases* cases) {
  return call([&] {
    rr_simulation& s = required(simulation, "simulation");
    required(cases, "cases").list.add_next_frame(s.running, c_library::texts(passes, pass_count, "passes"));
  });
}
int rr_cases_of_pack(const char* folder, const char* const* passes, size_t pass_count, rr_cases** cases) {
  return call([&] {
    required(cases, "cases") = nullptr;
    *cases = new rr_cases{judging::CaseList(utf8_path(&required(folder, "folder")), c_library::texts(passes, pass_count, "passes"))};
  });
}

void rr_free_cases(rr_cases* cases) {
  call([&] { delete cases; });
}
size_t rr_case_count(const rr_cases* cases) { return cases ? cases->list.runs().size() : 0; }

int rr_get_case(const rr_cases* cases, size_t index, rr_case_info* info) {
  return call([&] {
    const Run& run = run_of(cases, index);
    const capture::PassCase& c = *run.c;
    sized(info, "rr_case_info") = {sizeof(rr_case_info),
                                   run.id.c_str(),
                                   c.effect.c_str(),
                                   c.variant.c_str(),
                                   c.pass.c_str(),
                                   run.formula.c_str(),
                                   c.frame,
                                   c.step,
                                   c.level,
                                   c.time,
                                   c.dt,
                                   c.inputs.size(),
                                   c.outputs.size()};
  });
}
int rr_get_uniforms(const rr_cases* cases, size_t index, rr_array* block) {
  return call([&] {
    const Run& run = run_of(cases, index);
    sized(block, "rr_array") = c_library::array_of(cases->list.pass_of(run).block, run.c->uniforms.data());
  });
}
int rr_get_input(const rr_cases* cases, size_t index, size_t input, int32_t level, rr_array* array) {
  return call([&] {
    const capture::CaseInput& from = run_of(cases, index).input(input);
    sized(array, "rr_array") = c_library::array_of(from.name.c_str(), from.array, level);
  });
}
int rr_get_sampling(const rr_cases* cases, size_t index, size_t input, rr_sampling* sampling) {
  return call([&] {
    const capture::CaseInput& from = run_of(cases, index).input(input);
    rr_sampling& to = sized(sampling, "rr_sampling");
    to = {sizeof to, name(from.filter), name(from.mip_filter), name(from.address_u), name(from.address_v), {}};
    std::copy(from.border.begin(), from.border.end(), to.border);
  });
}
int rr_get_expected(const rr_cases* cases, size_t index, size_t output, rr_array* array) {
  return call([&] {
    const capture::CaseOutput& from = run_of(cases, index).output(output);
    sized(array, "rr_array") = c_library::array_of(from.name.c_str(), from.array, 0);
  });
}
const char* rr_get_judge(const rr_cases* cases, size_t index, size_t output) {
  const char* how = nullptr;
  call([&] { how = capture::name(run_of(cases, index).output(output).judge); });
  return how;
}

int rr_give(rr_cases* cases, size_t index, size_t output, const void* data, size_t row_bytes, size_t count) {
  return call([&] { required(cases, "cases").list.give(index, output, data, row_bytes, count); });
}
int rr_give_image(rr_cases* cases, size_t index, size_t output, const rr_array* image) {
  return call([&] { required(cases, "cases").list.give_image(index, output, c_library::image_of(sized(image, "rr_array"))); });
}
