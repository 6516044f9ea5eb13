#pragma once
#include <CLI/App.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "rules/language/key.h"

/// Values of options, read as files are read: the same numbers, limits and words of complaint. A value that
/// is none throws sim::InputError.
namespace espalier::cli {

/// A key of scene files: "seed", "exposure.band".
const rules::Key& sceneKey(std::string_view path);

/// An option that takes a whole number.
CLI::Option* addWhole(CLI::App& command, const std::string& name, const rules::Key& key,
                      std::function<void(std::int64_t)> take, const std::string& about);

/// An option or an argument that takes one of the key's words.
CLI::Option* addChoice(CLI::App& command, const std::string& name, const rules::Key& key,
                       std::function<void(const std::string&)> take, const std::string& about);

/// What is wrong with a command line, and what to do about it.
std::string explained(const CLI::App& app, const CLI::ParseError& error);

}  // namespace espalier::cli
