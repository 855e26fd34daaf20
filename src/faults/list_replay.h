// Makes mistakes in a list of records that is matched by id.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "faults/probe.h"
#include "faults/replay.h"
#include "rainref/executor.h"

namespace rainref::faults {

/// One 4-byte word of a record.
struct Word {
  std::size_t offset;
  bool is_float;
  double leeway = 0;  ///< approximate tolerance: how far a conforming device may be from the reference
};

using ById = std::map<std::uint32_t, Records>;
ById by_id(const capture::Array& list);
/// The records of an id; empty if there are none.
const Records& of(const ById& list, std::uint32_t id);

class ListReplay : public Replay {
 public:
  /// For output `output`, where the port stored `port`. `model` may be null. The arguments must outlive it.
  ListReplay(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before, const capture::PassModel* model,
             const capture::Array& port, std::size_t output, const enclosed::Profile& profile, const parallel::Executor& executor);
  bool fails() const { return !failing_.empty(); }
  std::vector<Fault> plain() override;
  std::vector<Fault> deeper() override;
  std::vector<Fault> solved() override;
  std::vector<Fault> fitted() override;
  std::vector<Tried> causes(const std::vector<Fault>& all) const override;
  std::unique_ptr<Replay> elsewhere() const override;
  std::vector<float> given(const Fault& d) const override;
  void follow(const Fault& d, std::vector<Followed>& out) const override;
  void follow_right(std::vector<Followed>& failing, std::vector<Followed>& passing) const override;
  /// Sets the port's own program. It must outlive the replay.
  void take(const capture::TracedListProgram& program) { source_ = program_ = &program; }

 protected:
  /// For the list of a varied case.
  ListReplay(const ListReplay& of, const capture::PassCase& c, const capture::PassModel& model);

 private:
  /// A failing record as a list of its own, for passes that treat records separately.
  struct Alone {
    capture::PassCase c;
    std::unique_ptr<capture::PassModel> model;
    std::uint32_t id;
    std::vector<std::byte> port, right;
  };
  void find_alone();
  /// True if a mistake reproduces none of the separate records: then it need not be tried on the whole list.
  bool is_none_alone(const Fault& d) const;
  Tried cause(const Fault& d) const;
  const std::vector<double>* own_leeway(std::uint32_t id) const;
  /// Uniforms that an integer pass copies to its output, with the port's values.
  std::vector<Fault> uniforms_read_off() const;
  void add_scale(std::vector<Fault>& out, const scene::Member& m) const;

  const capture::PackPass& pass_;
  const capture::PassCase& c_;
  const capture::PassCase* before_;
  const capture::PassEvaluations* evaluations_;
  const capture::PassModel* model_;
  std::size_t output_;
  const parallel::Executor& executor_;
  capture::Array reference_;  ///< in the port's order
  Records stored_;            ///< stored by the port
  std::vector<std::uint32_t> failing_;
  ById got_, right_;
  std::vector<Word> words_;
  std::map<std::uint32_t, std::vector<double>> own_leeway_;  ///< of records by id, for each word; 0: not known
  Constants constants_;
  std::vector<std::shared_ptr<Alone>> alone_;  ///< some of the failing records
  const capture::TracedListProgram* program_ = nullptr;
};

}  // namespace rainref::faults
