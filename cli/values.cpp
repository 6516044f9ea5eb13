#include "cli/values.h"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "scenes/problem.h"
#include "scenes/read/registry.h"
#include "scenes/yaml/yaml_scalar.h"
#include "sim/base/error.h"

namespace espalier::cli {
namespace {

/// A value as if it stood in a file, in place of the key's own.
template <class Read>
auto readAs(const rules::Key& key, const std::string& option, const std::string& text, Read read) {
  scenes::YamlNode node;
  node.kind = scenes::YamlNode::Kind::scalar;
  node.place.path = std::make_shared<const std::string>();
  node.text = text;
  scenes::Problems problems;
  const auto value = read(scenes::ScalarReader{key, option, problems}, node);
  if (!value) throw sim::InputError(fmt::format("espalier: {}", problems.sorted().front().text));
  return *value;
}

std::vector<std::string> optionsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> commandsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::string unexpected(const std::string& word, const CLI::App& command) {
  if (!word.starts_with("-")) {
    return fmt::format("{} is one too many; expected no more than the command takes", scenes::inQuotes(word));
  }
  const auto names = optionsOf(command);
  const auto name = word.substr(0, word.find('='));
  return fmt::format("there is no option {}; expected one of {}{}", scenes::inQuotes(name),
                     scenes::listed(names, name), scenes::didYouMean(name, names));
}

/// Of an option that has too few values or too many: CLI11 tells which in its words alone.
std::string mismatched(const std::string& theirs) {
  auto name = theirs.substr(0, theirs.find_first_of(": "));
  if (!name.starts_with("-")) name = "--" + name;  // as it is of a flag
  return fmt::format("{} {}", name,
                     theirs.ends_with("missing")    ? "has no value; expected one after it"
                     : theirs.ends_with("override") ? "has a value; expected none"
                                                    : "is given more than once; expected it once");
}

}  // namespace

const rules::Key& sceneKey(std::string_view path) {
  const rules::Table* table = &scenes::sceneTable();
  for (auto dot = path.find('.'); dot != path.npos; dot = path.find('.')) {
    table = rules::find(*table, path.substr(0, dot))->child.get();
    path.remove_prefix(dot + 1);
  }
  return *rules::find(*table, path);
}

CLI::Option* addWhole(CLI::App& command, const std::string& name, const rules::Key& key,
                      std::function<void(std::int64_t)> take, const std::string& about) {
  const auto read = [name, key, take = std::move(take)](const std::string& text) {
    take(readAs(key, name, text, [](const auto& reader, const auto& node) { return reader.whole(node); }));
  };
  return command.add_option_function<std::string>(name, read, about)->type_name("NUMBER");
}

CLI::Option* addChoice(CLI::App& command, const std::string& name, const rules::Key& key,
                       std::function<void(const std::string&)> take, const std::string& about) {
  const auto read = [name, key, take = std::move(take)](const std::string& text) {
    take(readAs(key, name, text, [](const auto& reader, const auto& node) { return reader.choice(node); }));
  };
  return command.add_option_function<std::string>(name, read, about)->type_name("WORD");
}

std::string explained(const CLI::App& app, const CLI::ParseError& error) {
  const auto chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const std::string called = chosen.empty() ? "espalier" : "espalier " + command.get_name();
  const auto unread = app.remaining(true);
  std::string what = error.what();
  if (chosen.empty() && (unread.empty() || !unread.front().starts_with("-"))) {
    const auto commands = commandsOf(app);
    const std::string word = unread.empty() ? "" : unread.front();
    what =
        fmt::format("{}; expected one of {}{}",
                    unread.empty() ? "no command is given" : "there is no command " + scenes::inQuotes(word),
                    scenes::listed(commands), scenes::didYouMean(word, commands));
  } else if (!unread.empty()) {
    what = unexpected(unread.front(), command);
  } else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    what = mismatched(what);
  }
  return fmt::format("{}: {} (see {} --help)", called, what, called);
}

}  // namespace espalier::cli
