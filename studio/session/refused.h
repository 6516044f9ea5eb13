#pragma once
#include <stdexcept>
#include <string>

namespace espalier::studio {

/// What was asked cannot be done, and why in words; with the status of HTTP that says so.
class Refused : public std::runtime_error {
 public:
  Refused(int status, const std::string& why) : std::runtime_error(why), status_(status) {}
  int status() const { return status_; }

 private:
  int status_;
};

}  // namespace espalier::studio
