#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/import/child_process.h"

namespace espalier::scenes {

/// What is to be read, as a plain value that can be handed to another process.
struct FileReading {
  std::string reader;            ///< its name: mesh, picture, texture, density, sky, skeleton, volume
  std::vector<std::string> ask;  ///< what it is asked: paths, names, or bytes
};

/// What the reader makes of it, in this process and without a guard. Throws sim::InputError, without the
/// file's name, and std::logic_error where there is no such reader or it is asked too little.
std::string readHere(const FileReading& reading);

/// The same in a child process under `limits`: a forked one, or where readInProgram was called an executed
/// one.
ChildResult readBeside(const FileReading& reading, const ChildLimits& limits);

/// From now on all readings of this process are done by children that execute `program`, as they must be
/// where several threads are at work (scenes/import/child_process.h); an empty path: by forked ones again.
/// The program itself can do it, as /proc/self/exe, whose main calls readForParent first of all where
/// kAnswerFlag is all that it is called with.
void readInProgram(const std::filesystem::path& program);

/// Does one reading for the parent of this process, and ends.
[[noreturn]] void readForParent();

}  // namespace espalier::scenes
