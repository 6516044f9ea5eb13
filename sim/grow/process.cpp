#include "sim/grow/process.h"

namespace espalier::sim {

std::string_view nameOf(Outcome outcome) {
  switch (outcome) {
    case Outcome::grown:
      return "grown";
    case Outcome::resting:
      return "resting";
    case Outcome::blocked:
      return "blocked";
    case Outcome::too_far:
      return "too_far";
    case Outcome::too_near:
      return "too_near";
    case Outcome::too_dark:
      return "too_dark";
    case Outcome::too_bright:
      return "too_bright";
    case Outcome::out_of_world:
      return "out_of_world";
    case Outcome::forbidden:
      return "forbidden";
    case Outcome::claimed:
      return "claimed";
    case Outcome::no_trial:
      return "no_trial";
    case Outcome::unmet:
      return "unmet";
  }
  return "";
}

}  // namespace espalier::sim
