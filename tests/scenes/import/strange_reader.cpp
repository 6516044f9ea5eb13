// A program that a test executes to be answered by it: it does what it is asked, however strange.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/import/child_process.h"

namespace {

namespace fs = std::filesystem;

std::string spin() {
  for (volatile bool forever = true; forever;) {
  }
  return "";
}

std::string eat() {
  std::vector<std::string> eaten;
  for (;;) eaten.emplace_back(1 << 20, 'x');
}

/// Descriptors above the standard ones, but for the one that the answer goes to and that of the folder here.
std::string openFiles() {
  std::string files;
  for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
    std::error_code error;
    const std::string name = entry.path().filename().string(), to = fs::read_symlink(entry.path(), error);
    if (std::stoi(name) > STDERR_FILENO && to.find("pipe:") != 0 && to.find("/fd") == std::string::npos)
      files += to + "\n";
  }
  return files;
}

std::string signals() {
  std::string text;
  sigset_t blocked;
  ::sigprocmask(SIG_BLOCK, nullptr, &blocked);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    text += ::sigismember(&blocked, signal) == 1 ? 'b' : '-';
    text += action.sa_handler == SIG_DFL ? 'd' : action.sa_handler == SIG_IGN ? 'i' : 'h';
  }
  return text;
}

std::string limits() {
  std::string text;
  for (const auto resource : {RLIMIT_CORE, RLIMIT_FSIZE, RLIMIT_CPU}) {
    rlimit limit{};
    ::getrlimit(resource, &limit);
    text += std::to_string(limit.rlim_cur) + " ";
  }
  return text;
}

const std::map<std::string, std::function<std::string()>> kStrange{
    {"throw", []() -> std::string { throw std::runtime_error("no good"); }},
    {"abort", []() -> std::string { std::abort(); }},
    {"exit", []() -> std::string { ::_exit(3); }},
    {"kill", [] { return std::to_string(std::raise(SIGKILL)); }},
    {"interrupt", [] { return std::to_string(std::raise(SIGINT)); }},
    {"sleep",
     []() -> std::string {
       for (;;) ::pause();
     }},
    {"spin", spin},
    {"eat", eat},
    {"long", [] { return std::string(5'000'000, 'x'); }},
    {"open files", openFiles},
    {"signals", signals},
    {"limits", limits},
    {"babble",
     [] {
       std::puts("this is no answer");
       std::fflush(stdout);
       return std::string("an answer");
     }},
};

}  // namespace

int main(int argc, char** argv) {
  // As a parent that tells which child it has and waits.
  if (argc == 3) {
    const auto ended = espalier::scenes::runInProgram(argv[1], argv[2], {});
    return ended.end == espalier::scenes::ChildEnd::finished ? 0 : 1;
  }
  espalier::scenes::answerParent([](const std::string& ask) -> std::function<std::string()> {
    if (ask == "throw early") throw std::runtime_error("not ready");
    const auto strange = kStrange.find(ask);
    if (strange != kStrange.end()) return strange->second;
    return [ask] { return ask; };
  });
}
