#pragma once
#include <CLI/App.hpp>

namespace espalier::cli {

inline constexpr int kFailed = 1;      ///< exit status: it could not be done, for no fault of what was given
inline constexpr int kInputError = 2;  ///< exit status: something is wrong with what was given
inline constexpr int kStopped = 130;   ///< exit status: Ctrl-C
inline constexpr const char* kStoppedText = "espalier: stopped";

/// Each adds its subcommand; the status that its callback leaves in `exit_status` is the program's.
void addGrow(CLI::App& app, int& exit_status);
void addRender(CLI::App& app, int& exit_status);
void addExpose(CLI::App& app, int& exit_status);
void addCheck(CLI::App& app, int& exit_status);
void addCertify(CLI::App& app, int& exit_status);
void addInspect(CLI::App& app, int& exit_status);
void addRules(CLI::App& app, int& exit_status);
void addSchema(CLI::App& app, int& exit_status);
void addInit(CLI::App& app, int& exit_status);
void addExplain(CLI::App& app, int& exit_status);
void addGallery(CLI::App& app, int& exit_status);
void addStudio(CLI::App& app, int& exit_status);

}  // namespace espalier::cli
