// For a build without Embree: every scene is as it always is, but no ray is traced.
#include "compositor/tracer.h"
#include "rainref/error.h"

namespace rainref::compositor {

struct Tracer::State {};

Tracer::Tracer(const TracerOptions&) { throw Error(ExitCode::usage, "this build of rainref traces no rays: it was made without Embree"); }
Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;

// Never called: there is no tracer to call them of.
std::uint32_t Tracer::add(std::shared_ptr<const Surface>) { return 0; }
const Surface& Tracer::surface(std::uint32_t) const { throw Error(ExitCode::internal, "a tracer that cannot be was asked for a surface"); }
void Tracer::commit() {}
void Tracer::first_hits(std::span<const Ray>, std::span<Hit>) const {}
void Tracer::first_hits(const RayArrays&, std::span<Hit>) const {}
void Tracer::any_hits(std::span<const Ray>, std::span<std::uint8_t>) const {}

}  // namespace rainref::compositor
