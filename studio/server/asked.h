#pragma once
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>

#include "sim/base/vec.h"

namespace espalier::studio {

/// What a request's body says, as JSON. All throw Refused for what is not as it should be.
class AskedBody {
 public:
  explicit AskedBody(const std::string& body);
  ~AskedBody();
  AskedBody(const AskedBody&) = delete;
  AskedBody& operator=(const AskedBody&) = delete;

  bool has(const char* key) const;
  std::string text(const char* key) const;
  std::map<std::string, std::string> texts(const char* key) const;
  /// Three numbers that are finite.
  sim::Vec3 place(const char* key) const;
  template <class Number>
  Number whole(const char* key) const {
    return static_cast<Number>(number(key, 0, std::numeric_limits<Number>::max()));
  }

 private:
  std::int64_t number(const char* key, std::int64_t low, std::int64_t high) const;

  struct Parsed;
  std::unique_ptr<const Parsed> parsed_;
};

/// A number of metres of an address.
double metresOf(const std::string& text);
/// A whole number of an address.
std::int64_t wholeNumber(const std::string& text, std::int64_t high);
template <class Number>
Number wholeOf(const std::string& text) {
  return static_cast<Number>(wholeNumber(text, std::numeric_limits<Number>::max()));
}

}  // namespace espalier::studio
