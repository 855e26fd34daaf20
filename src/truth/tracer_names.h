// This room speaks the tracer's language: its scenes, surfaces and pictures are named here without their room.
#pragma once

#include "compositor/picture.h"

namespace rainref::truth {

using namespace compositor;

}  // namespace rainref::truth
