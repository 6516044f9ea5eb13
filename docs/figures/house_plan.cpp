#include "docs/figures/house_plan.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "sim/base/error.h"

namespace espalier::figures {
namespace {

namespace fs = std::filesystem;

Names words(const std::string& text) {
  std::istringstream in(text);
  Names names;
  for (std::string name; in >> name;) names.push_back(name);
  return names;
}

Names headersIn(const fs::path& folder) {
  Names names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".h") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// What a README's first line says after "# sim: ".
std::string titleOf(const std::string& room) {
  std::ifstream in(fs::path(ESPALIER_SOURCE_DIR) / room / "README.md");
  std::string line;
  std::getline(in, line);
  const std::string start = "# " + room + ": ";
  if (!line.starts_with(start))
    throw sim::InputError(room + "/README.md begins with '" + line + "'; expected '" + start + "...'");
  return line.substr(start.size());
}

/// Takes out what follows from the rest: a to c where a leads to b, and b to c.
template <typename Part>
void reduce(std::map<std::string, Part>& parts) {
  const auto all = parts;
  for (auto& [name, part] : parts) {
    const auto& direct = all.at(name).builds_on;
    std::erase_if(part.builds_on, [&](const std::string& far) {
      return std::any_of(direct.begin(), direct.end(), [&](const std::string& near) {
        const auto& next = all.at(near).builds_on;
        return std::find(next.begin(), next.end(), far) != next.end();
      });
    });
  }
}

}  // namespace

std::map<std::string, Room> readHouse() {
  const fs::path source = ESPALIER_SOURCE_DIR;
  std::map<std::string, Room> house;
  std::ifstream in(source / "tests/house/wings.txt");
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    const auto colon = line.find(':');
    const auto slash = line.find('/');
    if (colon == line.npos) throw sim::InputError("wings.txt: '" + line + "' has no colon");
    const std::string room = line.substr(0, std::min(slash, colon));
    const Names seen = words(line.substr(colon + 1));
    if (slash == line.npos) {
      house[room] = {titleOf(room), seen, {}, {}, headersIn(source / room)};
    } else if (const std::string wing = line.substr(slash + 1, colon - slash - 1); wing == "*") {
      house.at(room).flat = seen;
    } else {
      house.at(room).wings[wing] = {seen, headersIn(source / room / wing)};
    }
  }
  reduce(house);
  for (auto& [name, room] : house) reduce(room.wings);
  return house;
}

}  // namespace espalier::figures
