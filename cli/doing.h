#pragma once
#include <stdexcept>
#include <string>

#include "sim/base/error.h"

/// What the program is at, for words about what goes wrong there.
namespace espalier::cli {

/// Something failed that is no fault of what was given; the message says what was being done, and of what.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// From now on it is at a stage ("tiling") of its work with a file.
void nowDoing(const std::string& file, const std::string& stage);

/// Throws what the exception that is being handled means, as a Failure in words of ours, whether it came from
/// a library, the system or a lack of memory. Rethrows what was meant for the user: sim::InputError,
/// sim::Stopped.
[[noreturn]] void failDoing();

/// Does work with a file, and fails as above.
template <typename Work>
auto doing(const std::string& file, const std::string& stage, Work work) {
  nowDoing(file, stage);
  try {
    return work();
  } catch (...) {
    failDoing();
  }
}

/// From now on an exception that nobody can catch (thrown on a thread of a library's) is said likewise, and
/// ends the program with kFailed and without files half written.
void keepLastWords();

}  // namespace espalier::cli
