// espalier check: what it names, and how often it looks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/inotify.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>

#include "tests/cli/plot.h"

namespace espalier {
namespace {

class Check : public tests::Plot {};

/// Counts how often files are opened while it lives.
class Openings {
 public:
  ~Openings() { ::close(descriptor_); }
  bool watch(const std::filesystem::path& file) {
    // Its end is asked for too: openings that follow on each other would count as one.
    const int watched = ::inotify_add_watch(descriptor_, file.c_str(), IN_OPEN | IN_CLOSE);
    names_[watched] = file.filename().string();
    return watched >= 0;
  }
  std::map<std::string, int> counted() {
    std::map<std::string, int> times;
    alignas(inotify_event) std::array<char, 4096> buffer{};
    for (ssize_t n = 0; (n = ::read(descriptor_, buffer.data(), buffer.size())) > 0;) {
      for (std::size_t at = 0; at < static_cast<std::size_t>(n);) {
        inotify_event event;
        std::memcpy(&event, buffer.data() + at, sizeof event);
        if ((event.mask & IN_OPEN) != 0) ++times[names_.at(event.wd)];
        at += sizeof event + event.len;
      }
    }
    return times;
  }

 private:
  int descriptor_ = ::inotify_init1(IN_NONBLOCK);
  std::map<int, std::string> names_;
};

TEST_F(Check, NamesEveryErrorOfEveryFile) {
  const auto a = scratch_.write("a.yaml", "espalier: rules\nnam: x\nlight: {boost: -1}\n");
  const auto b = scratch_.write("b.yaml", "espalier: scene\nmeshes: 3\n");
  const auto ran = tests::espalier("check " + a.string() + " " + b.string());
  EXPECT_EQ(ran.status, 2);
  for (const char* part : {"a.yaml:2:1:", "did you mean 'name'", "a.yaml:3:", "b.yaml:2:"}) {
    EXPECT_NE(ran.output.find(part), std::string::npos) << part << " in\n" << ran.output;
  }
}

/// One that changes meanwhile is judged as it was.
TEST_F(Check, ReadsEachFileOnce) {
  scratch_.write("alone.yaml", "espalier: rules\n");
  scratch_.write("bad.yaml", "espalier: scene\nmeshes: 3\n");
  for (const auto& [asked, status, read] :
       {std::tuple{"scene.yaml", 0, std::map<std::string, int>{{"scene.yaml", 1}, {"vine.yaml", 1}}},
        {"alone.yaml", 0, {{"alone.yaml", 1}}},
        {"bad.yaml", 2, {{"bad.yaml", 1}}}}) {
    Openings openings;
    for (const char* name : {"scene.yaml", "vine.yaml", "alone.yaml", "bad.yaml"})
      ASSERT_TRUE(openings.watch(scratch_.path(name))) << std::strerror(errno);
    const auto ran = tests::espalier("check " + scratch_.path(asked).string());
    EXPECT_EQ(ran.status, status) << ran.output;
    EXPECT_EQ(openings.counted(), read) << asked;
  }
}

/// A house in centimetres: the voxel size that would fit is no cure, and the unit is named on a line of its
/// own.
TEST_F(Check, NamesTheUnitOfAMeshThatIsFarTooLarge) {
  std::string mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh += fmt::format("v {} {} {}\n", (corner & 1) * 880, (corner & 2) * 305, (corner & 4) * 145);
  scratch_.write("plot.obj", mesh + "f 1 2 6 5\nf 1 3 4 2\nf 5 6 8 7\nf 1 5 7 3\nf 2 4 8 6\n");
  const std::string scene =
      scratch_.write("house.yaml", "espalier: scene\nmeshes: [plot.obj]\nworld: {voxel: 1 cm}\n").string();
  const auto ran = tests::espalier("check " + scene);
  EXPECT_EQ(ran.status, 2);
  EXPECT_TRUE(ran.output.starts_with(scene + ": a world of ")) << ran.output;
  EXPECT_NE(ran.output.find("would fit\n" + scene + ":2:10: the mesh 'plot'"), std::string::npos)
      << ran.output;
}

}  // namespace
}  // namespace espalier
