// Adds mistakes in what a pass is given, for the diagnosis alone.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "faults/fault.h"

namespace rainref::faults {

class CaseAdder {
 public:
  explicit CaseAdder(std::vector<Fault>& out) : out_(out) {}
  void operator()(std::string name, std::string sentence, std::function<void(capture::PassCase&)> alter) {
    Fault d;
    d.name = std::move(name);
    d.sentence = std::move(sentence);
    d.alter_case = std::move(alter);
    d.for_diagnosis = true;
    out_.push_back(std::move(d));
  }

 private:
  std::vector<Fault>& out_;
};

}  // namespace rainref::faults
