// An output image of a case, stored like the reference with the format's rounding.
#pragma once

#include "capture/pass_case.h"
#include "spirv/group.h"

namespace rainref::spirv {

class StoredImage final : public StorageImage<Float> {
 public:
  /// An image of zeros. Throws Error(port_files) for a format that a shader cannot store as floats.
  explicit StoredImage(const capture::CaseOutput& output);
  void write(int x, int y, const Float* texel, int count) override;
  void read(int x, int y, Float* texel) const override;
  const capture::Array& array() const { return array_; }

 private:
  std::size_t offset(int x, int y, int channel) const;

  capture::Array array_;
  FormatInfo format_;
  Rounding rounding_;
};

}  // namespace rainref::spirv
