#pragma once
#include <stdexcept>
#include <string>

namespace espalier::sim {

/// Something that the caller gave is wrong; the message says what, what was expected, and where if there is a
/// place.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Our own code, or a growth process, broke a contract: a fault to report, not something that the caller
/// gave.
class BrokenContract : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// The job was stopped by the caller (Ctrl-C); nothing was written.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("stopped") {}
};

}  // namespace espalier::sim
