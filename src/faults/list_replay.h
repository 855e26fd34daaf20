// Mistakes made in a list of records, matched by id.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "faults/probe.h"
#include "faults/replay.h"
#include "rainref/executor.h"

namespace rainref::faults {

/// A word of a record.
struct Word {
  std::size_t offset;
  bool is_float;
  double leeway = 0;  ///< how far a conforming device may be from the reference, roughly
};

using ById = std::map<std::uint32_t, Records>;
ById by_id(const capture::Array& list);
/// Those of an id: none where there are none.
const Records& of(const ById& list, std::uint32_t id);

class ListReplay : public Replay {
 public:
  /// Of output `output`, where the port stored `port`. `model` may be null. What is given must outlive it.
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

 protected:
  /// The list of a varied case.
  ListReplay(const ListReplay& of, const capture::PassCase& c, const capture::PassModel& model);

 private:
  /// A failing record as a list of its own, where it is treated by itself.
  struct Alone {
    capture::PassCase c;
    std::unique_ptr<capture::PassModel> model;
    std::uint32_t id;
    std::vector<std::byte> port, right;
  };
  void find_alone();
  /// Whether a mistake gives none of the records that stand alone: it need not be made in the whole list.
  bool is_none_alone(const Fault& d) const;
  Tried cause(const Fault& d) const;
  const std::vector<double>* own_leeway(std::uint32_t id) const;
  /// Uniforms that a pass of whole numbers hands on, as the port stored them.
  std::vector<Fault> uniforms_read_off() const;
  void add_scale(std::vector<Fault>& out, const scene::Member& m) const;

  const capture::PackPass& pass_;
  const capture::PassCase& c_;
  const capture::PassCase* before_;
  const capture::PassEvaluations* evaluations_;
  const capture::PassModel* model_;
  std::size_t output_;
  const parallel::Executor& executor_;
  capture::Array reference_;  ///< in the order of the port
  Records stored_;            ///< by the port
  std::vector<std::uint32_t> failing_;
  ById got_, right_;
  std::vector<Word> words_;
  std::map<std::uint32_t, std::vector<double>> own_leeway_;  ///< of records by their ids, for each word; 0: none is known
  Constants constants_;
  std::vector<std::shared_ptr<Alone>> alone_;  ///< some
};

}  // namespace rainref::faults
