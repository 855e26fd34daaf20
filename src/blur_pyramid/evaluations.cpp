#include "blur_pyramid/blur_pyramid.h"
#include "blur_pyramid/scalar.h"
#include "pass/model.h"

namespace rainref::blur_pyramid {

std::unique_ptr<capture::PassModel> bind_blur(const capture::PassCase& c) {
  return c.level == 0 ? pass::bind<FogPass, scalar::FogPassText>(c) : pass::bind<HalvePass, scalar::HalvePassText>(c);
}

}  // namespace rainref::blur_pyramid
