#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

/// The house as it stands in the sources.
namespace espalier::figures {

using Names = std::vector<std::string>;

struct Wing {
  Names builds_on;  ///< wings of its room, without those that follow from others
  Names headers;
};

struct Room {
  std::string title;  ///< of its README
  Names builds_on;    ///< rooms, without those that follow from others
  std::map<std::string, Wing> wings;
  Names flat;     ///< files that all of its wings see
  Names headers;  ///< of a room without wings
};

/// Reads tests/house/wings.txt, the folders and their READMEs. Throws InputError.
std::map<std::string, Room> readHouse();

}  // namespace espalier::figures
