#include "scenes/import/reading.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <stdexcept>
#include <string_view>

#include "render/image/image_io.h"
#include "scenes/import/density_reader.h"
#include "scenes/import/mesh_import.h"
#include "scenes/import/picture_reader.h"
#include "scenes/import/skeleton_reader.h"
#include "scenes/import/sky_reader.h"
#include "scenes/import/vector_grid.h"
#include "scenes/import/wire.h"

namespace espalier::scenes {
namespace {

using Ask = std::vector<std::string>;

struct Reader {
  std::string_view name;
  std::string (*read)(const Ask& ask);
  bool decodes = false;  // pictures
};

constexpr std::array kReaders{
    Reader{"density", [](const Ask& ask) { return packedDensity(ask.at(0)); }, true},
    Reader{"mesh",
           [](const Ask& ask) {
             return packedMesh(ask.at(0),
                               ask.at(1) == "material" ? RegionsFrom::material : RegionsFrom::group);
           }},
    Reader{"picture", [](const Ask& ask) { return packedPicture(ask.at(0)); }, true},
    Reader{"skeleton", [](const Ask& ask) { return packedSkeletons(ask.at(0)); }},
    Reader{"sky", [](const Ask& ask) { return packedSky(ask.at(0)); }, true},
    Reader{"texture", [](const Ask& ask) { return packedTexture(ask.at(0), ask.at(1)); }, true},
    Reader{"volume", [](const Ask& ask) { return packedLattice(ask.at(0), ask.at(1)); }},
};

const Reader& readerOf(const FileReading& reading) {
  const auto* const at = std::find_if(kReaders.begin(), kReaders.end(),
                                      [&](const Reader& reader) { return reader.name == reading.reader; });
  if (at == kReaders.end()) throw std::logic_error("there is no reader '" + reading.reader + "'");
  return *at;
}

std::string packed(const FileReading& reading) {
  Packer out;
  out.putText(reading.reader);
  out.put(static_cast<std::uint64_t>(reading.ask.size()));
  for (const std::string& one : reading.ask) out.putText(one);
  return out.take();
}

FileReading readingIn(std::string_view bytes) {
  Unpacker in(bytes);
  FileReading reading;
  reading.reader = in.getText();
  reading.ask.resize(in.getCount(sizeof(std::uint64_t)));
  for (std::string& one : reading.ask) one = in.getText();
  in.requireEnd();
  return reading;
}

std::mutex program_lock;
std::filesystem::path program_that_reads;

}  // namespace

std::string readHere(const FileReading& reading) {
  return readerOf(reading).read(reading.ask);
}

ChildResult readBeside(const FileReading& reading, const ChildLimits& limits) {
  const std::filesystem::path program = [] {
    const std::lock_guard lock(program_lock);
    return program_that_reads;
  }();
  if (!program.empty()) return runInProgram(program, packed(reading), limits);
  return runInChild([&] { return readHere(reading); }, limits);
}

void readInProgram(const std::filesystem::path& program) {
  const std::lock_guard lock(program_lock);
  program_that_reads = program;
}

void readForParent() {
  answerParent([](const std::string& ask) -> std::function<std::string()> {
    const FileReading reading = readingIn(ask);
    // A forked child has it from its parent: what a library takes to be loaded is no fault of the file.
    if (readerOf(reading).decodes) render::makeReadyToDraw();
    return [reading] { return readHere(reading); };
  });
}

}  // namespace espalier::scenes
