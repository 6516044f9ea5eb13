#pragma once
#include <sys/wait.h>
#include <array>
#include <cstdio>
#include <string>

/// The program as a user runs it.
namespace espalier::tests {

struct Ran {
  int status = -1;     ///< exit status; 128 + signal if it was killed
  std::string output;  ///< both streams
};

inline Ran run(const std::string& command) {
  Ran ran;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return ran;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    ran.output.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  ran.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return ran;
}

inline Ran espalier(const std::string& arguments) {
  return run(std::string(ESPALIER_PROGRAM) + " " + arguments);
}

}  // namespace espalier::tests
