#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/doing.h"
#include "cli/interrupt.h"
#include "cli/say.h"
#include "scenes/job/check.h"
#include "scenes/yaml/yaml_text.h"
#include "sim/base/error.h"

namespace espalier::cli {
namespace {

constexpr const char* kStandardInput = "-";

struct CheckArguments {
  std::vector<std::string> files;
  std::string as;
  bool text_only = false, json = false;
};

/// As much of it as a file may have, and a byte more.
std::string standardInput() {
  std::string text(scenes::kMaxTextBytes + 1, '\0');
  std::cin.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::cin.gcount()));
  return text;
}

scenes::Checked checked(const std::string& file, const CheckArguments& arguments, std::stop_token stop) {
  const auto depth = arguments.text_only ? scenes::CheckDepth::text : scenes::CheckDepth::site;
  if (file != kStandardInput) return scenes::checkFile(file, depth, std::move(stop));
  return scenes::checkText(standardInput(), arguments.as, depth, std::move(stop));
}

void tell(const scenes::Checked& file) {
  for (const scenes::Problem& warning : file.warnings) say(scenes::formatWarning(warning));
  for (const scenes::Problem& problem : file.errors) say(scenes::format(problem));
  if (file.foretold) print(fmt::format("{}: {}\n", file.file.string(), scenes::toText(*file.foretold)));
}

int check(const CheckArguments& arguments) {
  const auto inputs = std::count(arguments.files.begin(), arguments.files.end(), kStandardInput);
  if (inputs > 1 || (inputs == 1) == arguments.as.empty()) {
    throw sim::InputError(
        "espalier: expected the file - (standard input) once with --as, which names the file that it is to "
        "become, or neither");
  }
  const Interrupt interrupt;
  int status = 0;
  std::vector<scenes::Checked> files;
  for (const std::string& file : arguments.files) {
    files.push_back(doing(file, "checking", [&] { return checked(file, arguments, interrupt.token()); }));
    if (!files.back().errors.empty()) status = kInputError;
    if (!arguments.json) tell(files.back());
  }
  if (arguments.json) printJson(scenes::toJson(files));
  return status;
}

}  // namespace

void addCheck(CLI::App& app, int& exit_status) {
  auto* const command = app.add_subcommand(
      "check",
      "Name every error in rule and scene files; of a scene say how long it will take, and how much memory");
  const auto arguments = std::make_shared<CheckArguments>();
  command->add_option("file", arguments->files, "Rule and scene files, or - for standard input")->required();
  command->add_flag("--text-only", arguments->text_only,
                    "Open no mesh: look at what the files say by themselves, while one types");
  command->add_option("--as", arguments->as, "The file that standard input is to become")->type_name("FILE");
  command->add_flag("--json", arguments->json, "Print problems as JSON on standard output, for editors");
  command->callback([arguments, &exit_status] { exit_status = check(*arguments); });
}

}  // namespace espalier::cli
