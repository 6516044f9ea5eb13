#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "studio/session/session.h"
#include "tests/bench/rows.h"

namespace espalier::bench {
namespace {

constexpr const char* kRow = "15 the studio";

/// How long after an edit something was heard of.
struct Waits {
  double problems_s = 0.0, first_s = 0.0, whole_s = 0.0;
  std::size_t segments = 0;
};

/// Makes an edit and listens to what comes of it.
Waits waitsFor(studio::Session& session, studio::Listener& page, const std::string& file,
               const std::string& text) {
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  const auto since = [&] { return std::chrono::duration<double>(Clock::now() - began).count(); };
  Waits waits;
  const auto version = nlohmann::json::parse(session.edit({{file, text}}))["version"].get<std::uint32_t>();
  waits.problems_s = since();
  for (;;) {
    const auto frame = page.next(std::chrono::seconds(30));
    if (!frame || frame->empty()) throw sim::InputError("the studio did not answer");
    std::uint32_t words[3];
    std::memcpy(words, frame->data(), sizeof words);
    if (words[1] != 1 && words[2] == version && waits.first_s == 0.0) waits.first_s = since();
    if (words[1] != 1) continue;
    const auto event = nlohmann::json::parse(frame->substr(8));
    if (event["event"] != "growth" || event["version"] != version || !event["done"]) continue;
    waits.whole_s = since();
    waits.segments = event["segments"];
    return waits;
  }
}

void editScene(const std::string& name, const std::filesystem::path& scene, const std::string& word,
               const std::string& other, double whole_s, Report& report) {
  studio::Session session(scene, sim::threadCount());
  const auto page = session.listen();
  const auto project = nlohmann::json::parse(session.project());
  std::string file, text;
  for (const auto& one : project["files"]) {
    if (one["text"].get<std::string>().find(word) == std::string::npos) continue;
    file = one["name"];
    text = one["text"];
  }
  std::string changed = text;
  changed.replace(changed.find(word), word.size(), other);
  waitsFor(session, *page, file, text);
  bool other_way = false;
  Waits last;
  std::map<double, Waits> sorted;
  for (int i = 0; i < 9; ++i) {
    last = waitsFor(session, *page, file, (other_way = !other_way) ? changed : text);
    sorted[last.whole_s] = last;
  }
  const Waits median = std::next(sorted.begin(), static_cast<std::ptrdiff_t>(sorted.size() / 2))->second;
  report.note(fmt::format("  {}: {} for {}, {} segments", name, other, word, last.segments));
  report.add({kRow, "    an edit to what is wrong with it", median.problems_s, "s", 0, Target{0.05, false}});
  report.add({kRow, "    to the first new geometry", median.first_s, "s", 0, Target{0.3, false}});
  report.add({kRow, "    to the whole plant", median.whole_s, "s", 0, Target{whole_s, false}});
}

}  // namespace

void benchStudio(Report& report) {
  report.title("15. The studio: from an edit to what the page hears, medians of nine edits");
  const std::filesystem::path source = ESPALIER_SOURCE_DIR;
  editScene("the first scene", source / "docs/first/scene.yaml", "up: 0.08", "up: 0.09", 1.0, report);
  editScene("the garden wall", source / "scenes/library/garden_wall.yaml", "iterations: 51", "iterations: 50",
            1.5, report);
}

}  // namespace espalier::bench
