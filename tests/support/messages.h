#pragma once
#include <functional>
#include <string>

#include "sim/base/error.h"

namespace espalier::tests {

/// What a piece of work says of wrong input.
inline std::string messageOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const sim::InputError& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace espalier::tests
