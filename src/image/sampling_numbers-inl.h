// Lookups for every number type except lanes. Text only; include it after math/optics-inl.h if a pass uses that too, because the order
// matters.
#include "image/sampling_perturbed-inl.h"
#include "image/sampling-inl.h"
#include "image/sampling_enclosed-inl.h"
#include "image/sampling_rearranged-inl.h"
