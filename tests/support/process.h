#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <regex>
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

/// Whatever it says, it counts as people do.
inline Ran espalier(const std::string& arguments) {
  Ran ran = run(std::string(ESPALIER_PROGRAM) + " " + arguments);
  static const std::regex kOneOfMany(
      "(^|[^x] |[(\n])1 "
      "(plants|seeds|segments|leaves|iterations|buds|triangles|voxels|points|images|edges|rims|times)\\b");
  std::smatch found;
  EXPECT_FALSE(std::regex_search(ran.output, found, kOneOfMany)) << found.str() << " in: " << ran.output;
  return ran;
}

}  // namespace espalier::tests
