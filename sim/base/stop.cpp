#include "sim/base/stop.h"

#include <utility>

#include "sim/base/error.h"

namespace espalier::sim {
namespace {

thread_local const StopScope* innermost = nullptr;

}  // namespace

StopScope::StopScope(std::stop_token token) : token_(std::move(token)), outer_(innermost) {
  innermost = this;
}
StopScope::~StopScope() {
  innermost = outer_;
}

bool stopRequested() {
  for (const StopScope* scope = innermost; scope != nullptr; scope = scope->outer_) {
    if (scope->token_.stop_requested()) return true;
  }
  return false;
}

void throwIfStopped() {
  if (stopRequested()) throw Stopped();
}

HandedStops::HandedStops() : innermost_(innermost) {}

HandedStops::Scope::Scope(const HandedStops& stops) : before_(innermost) {
  innermost = stops.innermost_;
}
HandedStops::Scope::~Scope() {
  innermost = before_;
}

}  // namespace espalier::sim
