// Lookups for every number but the lanes. Text only, after math/optics-inl.h where a pass takes that too; the order matters.
#include "image/sampling_perturbed-inl.h"
#include "image/sampling-inl.h"
#include "image/sampling_enclosed-inl.h"
#include "image/sampling_rearranged-inl.h"
