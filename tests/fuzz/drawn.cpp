#include "tests/fuzz/drawn.h"

#include <algorithm>

namespace espalier::fuzz {
namespace {

class Writer {
 public:
  void entries(std::vector<DrawnEntry>& entries, bool list, std::size_t depth) {
    for (DrawnEntry& entry : entries) {
      entry.line = line_;
      text_ += std::string(2 * depth, ' ') + (list ? std::string("-") : entry.key + ":");
      const bool empty = entry.value.entries.empty();
      if (entry.value.kind == Drawn::Kind::text || empty) {
        text_ += " " + (entry.value.kind == Drawn::Kind::list  ? "[]"
                        : entry.value.kind == Drawn::Kind::map ? "{}"
                                                               : entry.value.text);
      }
      text_ += '\n';
      ++line_;
      if (!empty) this->entries(entry.value.entries, entry.value.kind == Drawn::Kind::list, depth + 1);
    }
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  int line_ = 1;
};

int takeOutOf(std::vector<DrawnEntry>& entries, int line) {
  const auto behind = std::find_if(entries.begin(), entries.end(),
                                   [&](const DrawnEntry& entry) { return entry.line > line; });
  if (behind == entries.begin()) return 0;
  const auto around = behind - 1;
  if (const int inner = takeOutOf(around->value.entries, line)) return inner;
  if (around->required) return 0;
  const int began = around->line;
  entries.erase(around);
  return began;
}

}  // namespace

std::string write(Drawn& root) {
  Writer writer;
  writer.entries(root.entries, false, 0);
  return writer.take();
}

int takeOut(Drawn& root, int line) {
  return takeOutOf(root.entries, line);
}

}  // namespace espalier::fuzz
