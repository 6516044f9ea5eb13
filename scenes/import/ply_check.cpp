#include "scenes/import/ply_check.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

constexpr std::size_t kLongestLine = 4096;
constexpr int kMostLines = 1000;
constexpr std::uint64_t kMostElements = 100'000'000;

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::uint64_t bytes_each = 0;  ///< at least: an empty list is its count alone
  bool has_position = false;
  bool has_indices = false;
};

std::uint64_t sizeOf(const std::string& type) {
  struct Named {
    std::array<const char*, 2> names;
    std::uint64_t bytes;
  };
  static constexpr std::array<Named, 8> kTypes{{{{"char", "int8"}, 1},
                                                {{"uchar", "uint8"}, 1},
                                                {{"short", "int16"}, 2},
                                                {{"ushort", "uint16"}, 2},
                                                {{"int", "int32"}, 4},
                                                {{"uint", "uint32"}, 4},
                                                {{"float", "float32"}, 4},
                                                {{"double", "float64"}, 8}}};
  for (const auto& known : kTypes) {
    if (type == known.names[0] || type == known.names[1]) return known.bytes;
  }
  return 0;
}

class HeaderReader {
 public:
  explicit HeaderReader(const std::filesystem::path& file) : in_(file, std::ios::binary) {}

  PlyCounts read() {
    if (nextLine() != "ply") fail("a PLY file begins with the line 'ply'");
    while (readLine()) {
    }
    if (!format_known_)
      fail("the line 'format ascii 1.0' (or binary_little_endian, binary_big_endian) is missing");
    requireBody();
    std::optional<std::uint64_t> vertices, faces;
    for (const auto& element : elements_) {
      if (element.name == "vertex" && element.has_position) vertices = element.count;
      if (element.name == "face" && element.has_indices) faces = element.count;
    }
    if (!vertices) fail("there is no 'element vertex' with properties x, y and z");
    if (!faces) fail("there is no 'element face' with a list property vertex_indices");
    return {*vertices, *faces};
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw sim::InputError(fmt::format("damaged PLY header, line {}: {}", line_number_, what));
  }

  std::string nextLine() {
    ++line_number_;
    std::string line;
    char c = 0;
    while (in_.get(c) && c != '\n') {
      line.push_back(c);
      if (line.size() > kLongestLine) fail("the line is too long");
    }
    if (!in_) fail("the file ends before 'end_header'");
    if (line.ends_with('\r')) line.pop_back();
    return line;
  }

  /// False at the header's end.
  bool readLine() {
    if (line_number_ > kMostLines) fail("there are too many lines before 'end_header'");
    std::istringstream words(nextLine());
    std::string key;
    words >> key;
    if (key == "end_header") return false;
    if (key == "comment" || key == "obj_info" || key.empty()) return true;
    if (key == "format") {
      readFormat(words);
    } else if (key == "element") {
      readElement(words);
    } else if (key == "property") {
      readProperty(words);
    } else {
      fail(fmt::format("'{}' is not one of format, element, property, comment, obj_info, end_header", key));
    }
    return true;
  }

  void readFormat(std::istringstream& words) {
    std::string format;
    std::string version;
    words >> format >> version;
    ascii_ = format == "ascii";
    format_known_ = ascii_ || format == "binary_little_endian" || format == "binary_big_endian";
    if (!format_known_ || version != "1.0")
      fail(fmt::format("'{} {}' is not a known format", format, version));
  }

  void readElement(std::istringstream& words) {
    Element element;
    std::string count;
    words >> element.name >> count;
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (element.name.empty() || error != std::errc() || end != count.data() + count.size()) {
      fail(fmt::format("'{}' is not a number of elements", count));
    }
    if (element.count > kMostElements)
      fail(fmt::format("{} elements are more than {}", count, kMostElements));
    elements_.push_back(element);
  }

  void readProperty(std::istringstream& words) {
    if (elements_.empty()) fail("a property stands before the first element");
    auto& element = elements_.back();
    std::string type;
    words >> type;
    const bool is_list = type == "list";
    std::string item_type = "uchar";
    if (is_list) words >> type >> item_type;
    std::string name;
    words >> name;
    if (sizeOf(type) == 0 || sizeOf(item_type) == 0) {
      fail(fmt::format("'{}' is not a known type", sizeOf(type) == 0 ? type : item_type));
    }
    if (name.empty()) fail("the property has no name");
    element.bytes_each += ascii_ ? 2 : sizeOf(type);  // in text at least a digit and a space
    element.has_position = element.has_position || name == "x";
    element.has_indices = element.has_indices || (is_list && name.starts_with("vertex_ind"));
  }

  void requireBody() {
    const auto begin = in_.tellg();
    in_.seekg(0, std::ios::end);
    const auto have = static_cast<std::uint64_t>(in_.tellg() - begin);
    std::uint64_t needed = 0;
    std::uint64_t lines = 0;
    for (const auto& element : elements_) {
      needed += element.count * element.bytes_each;
      lines += element.count;
    }
    if (have + 1 < needed) {  // the last line may lack its end
      throw sim::InputError(fmt::format(
          "the file is cut: its header promises at least {} bytes of data and {} follow", needed, have));
    }
    in_.seekg(begin);
    if (ascii_) requireLines(lines);
  }

  /// Assimp takes a letter for a zero, and repeats the last line where lines are missing.
  void requireLines(std::uint64_t promised) {
    std::uint64_t found = 0;
    for (std::string line; std::getline(in_, line);) {
      ++line_number_;
      const auto strange = line.find_first_not_of("0123456789+-.eE \t\rnaifNAIF");
      if (strange != std::string::npos) {
        throw sim::InputError(fmt::format("line {}: '{}' is no number", line_number_, line[strange]));
      }
      found += line.find_first_not_of(" \t\r") == std::string::npos ? 0 : 1;
    }
    if (found < promised) {
      throw sim::InputError(fmt::format("the file is cut: its header promises {} lines of data and {} follow",
                                        promised, found));
    }
  }

  std::ifstream in_;
  int line_number_ = 0;
  bool ascii_ = false;
  bool format_known_ = false;
  std::vector<Element> elements_;
};

}  // namespace

PlyCounts checkPly(const std::filesystem::path& file) {
  return HeaderReader(file).read();
}

}  // namespace espalier::scenes
